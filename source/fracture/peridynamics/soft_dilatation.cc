// State-based bonds that soften: of a bond of which 1 - D is left, so much counts in the
// dilatations of its ends, and so much of what these dilatations do to the bond's ends. Where the
// bond is broken nothing is left, as of one that has been taken out:
//
//   theta = sum g (1 - D) e,   force on the ends of a bond  (1 - D) (k e + A V g (theta + theta')).
//
// Both x = D e and the force that is lost, over k, y = D A V g (theta + theta')/k, are unknowns, so
// that the matrix of bonds that hold stays as it is.
#include "base/kink.h"
#include "fracture/peridynamics/peridynamics.h"

#include <algorithm>
#include <map>

namespace stockwork::peridynamics
{
using dealii::SymmetricTensor;
using dealii::Tensor;


template <int dim>
typename Peridynamics<dim>::Softened Peridynamics<dim>::softened(const SofteningBond &soft,
                                                                 const double added,
                                                                 const State &state) const
{
  const auto &[site, bond] = soft.view;
  const FarEnd end = lattice.zone.far_end(site, bond);
  double elongated = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    elongated += lattice.coefficients[bond].direction[d] *
                 ((end.mirrored >> d & 1 ? -1. : 1.) *
                    state.current.bulk(lattice.zone.sites()[end.site].dofs[d]) -
                  state.current.bulk(lattice.zone.sites()[site].dofs[d]));
  const double by_elongation = equivalent_stretch(site, bond, 1.);
  const double stretch =
    by_elongation * (elongated + added);
  const double kappa = softening_bonds.maximum_stretch(soft, stretch);
  const double damage = lattice.softening.damage(kappa);
  const bool softens = stretch > soft.committed - kink_width;
  return {damage, softens ? (lattice.softening.slope(kappa) - damage) / kappa *
                              softening_bonds.relaxation() * by_elongation
                          : 0.};
}


template <int dim>
void Peridynamics<dim>::assemble_soft_dilatation(const State &state, Sink &sink) const
{
  struct Dilatation
  {
    std::vector<unsigned int> family;
    std::vector<Tensor<1, dim>> functional;
    double modulus, theta;
    std::vector<std::pair<unsigned int, double>> soft; ///< number of each softening bond, and its g
    std::map<unsigned int, double> lacks; ///< theta by the unknown of each traction, less
  };
  std::map<unsigned int, Dilatation> of_sites;
  for (unsigned int n = 0; n < softening_bonds.size(); ++n)
    for (const auto &[s, b] :
         lattice.bonds.views_of(softening_bonds[n].view.first, softening_bonds[n].view.second))
      of_sites[s].soft.emplace_back(n, lattice.coefficients[b].dilatation);

  std::vector<SymmetricTensor<2, dim>> strain;
  if (parameters.in_bonds)
    strain = pressure_in_bonds.strain(state);
  LocalSystem local;
  for (auto &[site, of_site] : of_sites)
  {
    of_site.modulus = lattice.find_dilatation(site, of_site.family, of_site.functional);
    const bool acts_here = std::any_of(of_site.family.begin(), of_site.family.end(),
                                       [this](const unsigned int k) { return has_rows(k); });
    if (!acts_here)
      continue;
    of_site.theta = 0.;
    local.extra.clear();
    for (const auto &[n, g] : of_site.soft)
    {
      of_site.theta -= g * state.current.extra[n];
      local.extra.push_back(n);
    }
    // What faces do to the family by that, is in their own rows.
    if (parameters.in_bonds && lattice.dilatation_factor(site) == 1.)
      for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
        if (lattice.bonds.is_broken(site, b))
          for (const auto &[cell, share] : pressure_in_bonds.shares(site, b, true))
          {
            const Tensor<1, dim> &e = lattice.coefficients[b].direction;
            const double lacks = share * lattice.coefficients[b].dilatation *
                                 lattice.coefficients[b].length /
                                 lattice.rock_of_bonds.modulus(site, b);
            of_site.theta -= lacks * (e * (strain[cell] * e));
            for (unsigned int m = 0; m < pressure_in_bonds.n_modes(); ++m)
              of_site.lacks[pressure_in_bonds.unknown_of_traction(cell, m)] +=
                lacks * pressure_in_bonds.stretch_of_traction(cell, m, b);
          }
    // On the family, what does not count.
    for (unsigned int k = 0; k < of_site.family.size(); ++k)
    {
      const auto &dofs = lattice.zone.sites()[of_site.family[k]].dofs;
      for (unsigned int d = 0; d < dim; ++d)
        of_site.theta += of_site.functional[k][d] * state.current.bulk(dofs[d]);
      if (!has_rows(of_site.family[k]))
        continue;
      local.bulk.assign(dofs.begin(), dofs.end());
      local.reinit();
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int m = 0; m < of_site.soft.size(); ++m)
        {
          const auto &[n, g] = of_site.soft[m];
          local.matrix(d, dim + m) = -of_site.modulus * of_site.functional[k][d] * g;
          local.residual(d) += local.matrix(d, dim + m) * state.current.extra[n];
        }
      sink.add(local);
    }
  }

  // On the ends of bonds, what is not left of the force.
  for (unsigned int n = 0; n < softening_bonds.size(); ++n)
  {
    const auto &[site, bond] = softening_bonds[n].view;
    const double k = lattice.stiffness(site, bond),
                 y = state.current.extra[softening_bonds.unknown_of_lost_force(n)];
    for (const auto &[s, b] : lattice.bonds.views_of(site, bond))
      if (has_rows(s))
      {
        local.bulk.assign(lattice.zone.sites()[s].dofs.begin(), lattice.zone.sites()[s].dofs.end());
        local.extra.assign(1, softening_bonds.unknown_of_lost_force(n));
        local.reinit();
        for (unsigned int d = 0; d < dim; ++d)
        {
          local.matrix(d, dim) =
            k * lattice.zone.sites()[s].share * lattice.coefficients[b].direction[d];
          local.residual(d) = local.matrix(d, dim) * y;
        }
        sink.add(local);
      }
    if (lattice.zone.sites()[site].owner != rank)
      continue;

    const double length = lattice.coefficients[bond].length;
    double added = softening_bonds[n].offset * length, dilatation = 0.;
    if (parameters.in_bonds)
    {
      added = length * pressure_in_bonds.stretch(site, bond, pressure_in_bonds.shares(n), strain);
      dilatation = pressure_in_bonds.dilatation(site, bond, pressure_in_bonds.shares(n), strain);
    }
    const Softened now = softened(softening_bonds[n], added, state);
    const FarEnd end = lattice.zone.far_end(site, bond);
    const double g = lattice.coefficients[bond].dilatation,
                 by_stress = 2. * lattice.push_of_dilatation(site, bond) /
                             lattice.zone.sites()[site].share;
    std::map<dealii::types::global_dof_index, double> by_dof;
    std::map<unsigned int, double> by_extra{{softening_bonds.unknown_of_lost_force(n), k}};
    double force = by_stress * dilatation; // of the dilatations of both ends
    for (const unsigned int s : {site, end.site})
    {
      const Dilatation &of_site = of_sites.at(s);
      const double factor = g * of_site.modulus / lattice.zone.sites()[s].share;
      force += factor * of_site.theta;
      for (unsigned int i = 0; i < of_site.family.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          by_dof[lattice.zone.sites()[of_site.family[i]].dofs[d]] -=
            now.damage * factor * of_site.functional[i][d];
      for (const auto &[m, of_other] : of_site.soft)
        by_extra[m] += now.damage * factor * of_other;
      for (const auto &[m, of_traction] : of_site.lacks)
        by_extra[m] += now.damage * factor * of_traction;
    }
    if (parameters.in_bonds)
      for (const auto &[cell, share] : pressure_in_bonds.shares(n))
        for (unsigned int m = 0; m < pressure_in_bonds.n_modes(); ++m)
          by_extra[pressure_in_bonds.unknown_of_traction(cell, m)] -=
            share * (now.damage * by_stress * pressure_in_bonds.dilatation_of_traction(cell, m) +
                     now.by_elongation * force * length * lattice.coefficients[bond].stiffness /
                       k * pressure_in_bonds.stretch_of_traction(cell, m, bond));
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double e = lattice.coefficients[bond].direction[d] * force * now.by_elongation;
      by_dof[lattice.zone.sites()[site].dofs[d]] += e;
      by_dof[lattice.zone.sites()[end.site].dofs[d]] -= end.mirrored >> d & 1 ? -e : e;
    }
    local.bulk.clear();
    local.extra.clear();
    for (const auto &entry : by_dof)
      local.bulk.push_back(entry.first);
    for (const auto &entry : by_extra)
      local.extra.push_back(entry.first);
    local.reinit();
    const unsigned int row =
      by_dof.size() + std::distance(by_extra.begin(), by_extra.find(softening_bonds.unknown_of_lost_force(n)));
    unsigned int column = 0;
    for (const auto &entry : by_dof)
      local.matrix(row, column++) = entry.second;
    for (const auto &entry : by_extra)
      local.matrix(row, column++) = entry.second;
    local.residual(row) = k * y - now.damage * force;
    sink.add(local);
  }
}

#define INSTANTIATE(dim)                                                                  \
  template Peridynamics<dim>::Softened Peridynamics<dim>::softened(const SofteningBond &, \
                                                                   double, const State &) const;  \
  template void Peridynamics<dim>::assemble_soft_dilatation(const State &, Sink &) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
