// State-based bonds that soften: of a bond of which 1 - D is left, so much counts in the
// dilatations of its ends, and so much of what these dilatations do to the bond's ends. Where the
// bond is broken nothing is left, as of one that has been taken out:
//
//   theta = sum g (1 - D) e,   force on the ends of a bond  (1 - D) (k e + A V g (theta + theta')).
//
// Both x = D e and the force that is lost, over k, y = D A V g (theta + theta')/k, are unknowns, so
// that the matrix of bonds that hold stays as it is. With the pressure in the bonds e and theta are
// those of rock under that stress (PressureInBonds); D follows from DrivingElongation.
#include "base/kink.h"
#include "fracture/peridynamics/driving_elongation.h"
#include "fracture/peridynamics/few_columns.h"
#include "fracture/peridynamics/peridynamics.h"

#include <algorithm>
#include <map>

namespace stockwork::peridynamics
{
using dealii::SymmetricTensor;
using dealii::Tensor;

/// The dilatation of a site that has bonds which soften.
template <int dim>
struct Peridynamics<dim>::SoftSite
{
  std::vector<unsigned int> family;
  std::vector<Tensor<1, dim>> functional;
  double modulus = 0., theta = 0.;
  std::vector<std::pair<unsigned int, double>> soft; ///< number of each softening bond, and its g
  std::map<unsigned int, double> lacks; ///< theta by the unknown of each traction, less
};


/// What the law of a bond that softens follows from: its elongation and the force of the
/// dilatations of both ends, and these two by the unknowns.
template <int dim>
struct Peridynamics<dim>::SoftBond
{
  using ByUnknown = std::array<double, 2>;

  double elongation = 0., added = 0., force = 0.; ///< added: to the elongation, by stress
  std::map<dealii::types::global_dof_index, ByUnknown> by_dof;
  std::map<unsigned int, ByUnknown> by_extra;
};


template <int dim>
std::vector<double>
Peridynamics<dim>::dilatation_forces(const State &state,
                                     const std::vector<SymmetricTensor<2, dim>> &strain) const
{
  if (!lattice.has_dilatations())
    return {};
  std::vector<double> lost(lattice.zone.sites().size(), 0.), forces(lost);
  for (const auto &[view, elongation] : lost_elongations(state, 0))
    lost[view.first] += lattice.coefficients[view.second].dilatation * elongation;
  std::vector<unsigned int> family;
  std::vector<Tensor<1, dim>> functional;
  for (const auto *sites : {&lattice.zone.peridynamic_sites(), &lattice.zone.rim_sites()})
    for (const unsigned int i : *sites)
    {
      const double modulus = lattice.find_dilatation(i, family, functional);
      double theta = -lost[i];
      for (unsigned int k = 0; k < family.size(); ++k)
        for (unsigned int d = 0; d < dim; ++d)
          theta += functional[k][d] * displacement[family[k] * dim + d];
      if (const double share = parameters.in_bonds ? lattice.share_that_lacks(i) : 0.; share > 0.)
        theta -= share * pressure_in_bonds.lacked_dilatation(i, strain);
      forces[i] = theta * modulus / lattice.zone.sites()[i].share;
    }
  return forces;
}


template <int dim>
std::map<unsigned int, typename Peridynamics<dim>::SoftSite>
Peridynamics<dim>::soft_sites(const State &state,
                              const std::vector<SymmetricTensor<2, dim>> &strain) const
{
  std::map<unsigned int, SoftSite> sites;
  for (unsigned int n = 0; n < softening_bonds.size(); ++n)
    for (const auto &[s, b] :
         lattice.bonds.views_of(softening_bonds[n].view.first, softening_bonds[n].view.second))
      sites[s].soft.emplace_back(n, lattice.coefficients[b].dilatation);
  for (auto &[site, own] : sites)
  {
    own.modulus = lattice.find_dilatation(site, own.family, own.functional);
    if (std::none_of(own.family.begin(), own.family.end(),
                     [this](const unsigned int k) { return has_rows(k); }))
      continue;
    for (const auto &[n, g] : own.soft)
      own.theta -= g * state.current.extra[n];
    for (unsigned int k = 0; k < own.family.size(); ++k)
      for (unsigned int d = 0; d < dim; ++d)
        own.theta +=
          own.functional[k][d] * state.current.bulk(lattice.zone.sites()[own.family[k]].dofs[d]);
    if (const double share = parameters.in_bonds ? lattice.share_that_lacks(site) : 0.; share > 0.)
    {
      own.theta -= share * pressure_in_bonds.lacked_dilatation(site, strain);
      for (const auto &[unknown, by_traction] : pressure_in_bonds.lacked_by_tractions(site))
        own.lacks[unknown] += share * by_traction;
    }
  }
  return sites;
}


/// What does not count of bonds. (What faces do to the family by broken ones is in their own rows.)
template <int dim>
void Peridynamics<dim>::assemble_on_family(const SoftSite &own,
                                           const State &state,
                                           Sink &sink) const
{
  LocalSystem local;
  for (const auto &entry : own.soft)
    local.extra.push_back(entry.first);
  for (unsigned int k = 0; k < own.family.size(); ++k)
    if (has_rows(own.family[k]))
    {
      const auto &dofs = lattice.zone.sites()[own.family[k]].dofs;
      local.bulk.assign(dofs.begin(), dofs.end());
      local.reinit();
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int m = 0; m < own.soft.size(); ++m)
        {
          const auto &[n, g] = own.soft[m];
          local.matrix(d, dim + m) = -own.modulus * own.functional[k][d] * g;
          local.residual(d) += local.matrix(d, dim + m) * state.current.extra[n];
        }
      sink.add(local);
    }
}


/// On the ends of a bond, what is not left of the force.
template <int dim>
void Peridynamics<dim>::assemble_on_ends(const unsigned int n, const State &state, Sink &sink) const
{
  const auto &[site, bond] = softening_bonds[n].view;
  const unsigned int unknown = softening_bonds.unknown_of_lost_force(n);
  LocalSystem local;
  local.extra.assign(1, unknown);
  for (const auto &[s, b] : lattice.bonds.views_of(site, bond))
    if (has_rows(s))
    {
      local.bulk.assign(lattice.zone.sites()[s].dofs.begin(), lattice.zone.sites()[s].dofs.end());
      local.reinit();
      for (unsigned int d = 0; d < dim; ++d)
      {
        local.matrix(d, dim) = lattice.stiffness(site, bond) * lattice.zone.sites()[s].share *
                               lattice.coefficients[b].direction[d];
        local.residual(d) = local.matrix(d, dim) * state.current.extra[unknown];
      }
      sink.add(local);
    }
}


template <int dim>
typename Peridynamics<dim>::SoftBond
Peridynamics<dim>::soft_bond(const unsigned int n,
                             const std::map<unsigned int, SoftSite> &sites,
                             const State &state,
                             const std::vector<SymmetricTensor<2, dim>> &strain) const
{
  SoftBond own;
  const auto &[site, bond] = softening_bonds[n].view;
  const FarEnd end = lattice.zone.far_end(site, bond);
  for (unsigned int d = 0; d < dim; ++d)
  {
    const double e = lattice.coefficients[bond].direction[d],
                 at_far = end.mirrored >> d & 1 ? -e : e;
    for (const auto &[s, direction] : {std::pair(site, -e), std::pair(end.site, at_far)})
    {
      const auto dof = lattice.zone.sites()[s].dofs[d];
      own.elongation += direction * state.current.bulk(dof);
      own.by_dof[dof][0] += direction;
    }
  }
  for (const unsigned int s : {site, end.site})
  {
    const SoftSite &of_site = sites.at(s);
    const double factor =
      lattice.coefficients[bond].dilatation * of_site.modulus / lattice.zone.sites()[s].share;
    own.force += factor * of_site.theta;
    for (unsigned int i = 0; i < of_site.family.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        own.by_dof[lattice.zone.sites()[of_site.family[i]].dofs[d]][1] +=
          factor * of_site.functional[i][d];
    for (const auto &[m, of_other] : of_site.soft)
      own.by_extra[m][1] -= factor * of_other;
    for (const auto &[m, of_traction] : of_site.lacks)
      own.by_extra[m][1] -= factor * of_traction;
  }
  const double length = lattice.coefficients[bond].length;
  own.added = softening_bonds[n].offset * length;
  if (!parameters.in_bonds)
    return own;
  const CellShares &shares = pressure_in_bonds.shares(n);
  const double by_stress = 2. * lattice.force_of_dilatation(bond);
  own.added = length * pressure_in_bonds.stretch(site, bond, shares, strain);
  own.force += by_stress * pressure_in_bonds.dilatation(site, bond, shares, strain);
  // What is stiffer has less of it, see PressureInBonds::stretch().
  const double per_stretch =
    length * lattice.coefficients[bond].stiffness / lattice.stiffness(site, bond);
  for (const auto &[cell, share] : shares)
    for (unsigned int m = 0; m < pressure_in_bonds.n_modes(); ++m)
    {
      auto &of_traction = own.by_extra[pressure_in_bonds.unknown_of_traction(cell, m)];
      of_traction[0] += share * per_stretch * pressure_in_bonds.stretch_of_traction(cell, m, bond);
      of_traction[1] += share * by_stress * pressure_in_bonds.dilatation_of_traction(cell, m);
    }
  return own;
}


template <int dim>
void Peridynamics<dim>::assemble_law(const unsigned int n,
                                     const SoftBond &own,
                                     const State &state,
                                     Sink &sink) const
{
  const auto &[site, bond] = softening_bonds[n].view;
  const double k = lattice.stiffness(site, bond);
  // Stress in situ is not the bond's to carry but where it is part of its law.
  const double released = parameters.in_bonds ? 0.
                                              : 2. * lattice.force_of_dilatation(bond) * dim *
                                                  lattice.rock_of_bonds.modulus(site, bond) *
                                                  softening_bonds[n].offset,
               carried = parameters.in_bonds ? own.elongation + own.added : own.elongation;
  const DrivingElongation driving =
    driving_elongation(own.elongation + own.added, own.force + released, k);
  const double per_elongation = equivalent_stretch(site, bond, 1.),
               stretch = per_elongation * driving.value,
               kappa = softening_bonds.maximum_stretch(softening_bonds[n], stretch),
               damage = lattice.softening.damage(kappa);
  const double slope = kappa > 0. && stretch > softening_bonds[n].committed - kink_width
                         ? (lattice.softening.slope(kappa) - damage) / kappa *
                             softening_bonds.relaxation() * per_elongation
                         : 0.;
  LocalSystem local;
  const auto enter = [&](const unsigned int column, const std::array<double, 2> &by_unknown)
  {
    const auto [e, f] = by_unknown;
    const double damaged = slope * (driving.by_elongation * e + driving.by_force * f);
    const unsigned int x = local.bulk.size();
    local.matrix(x, column) -= k * (damage * e + carried * damaged);
    local.matrix(x + 1, column) -= damage * f + own.force * damaged;
  };
  local.extra = {n, softening_bonds.unknown_of_lost_force(n)};
  for (auto entry = own.by_dof.begin(); entry != own.by_dof.end();)
  {
    local.bulk.clear();
    const auto first = entry;
    for (; entry != own.by_dof.end() && local.bulk.size() < most_columns; ++entry)
      local.bulk.push_back(entry->first);
    local.reinit();
    unsigned int column = 0;
    for (auto unknown = first; unknown != entry; ++unknown)
      enter(column++, unknown->second);
    sink.add(local);
  }
  local.bulk.clear();
  for (const auto &entry : own.by_extra)
    if (entry.first != local.extra[0] && entry.first != local.extra[1])
      local.extra.push_back(entry.first);
  local.reinit();
  for (unsigned int column = 0; column < local.extra.size(); ++column)
    if (const auto found = own.by_extra.find(local.extra[column]); found != own.by_extra.end())
      enter(column, found->second);
  local.matrix(0, 0) += k;
  local.matrix(1, 1) += k;
  local.residual(0) = k * state.current.extra[local.extra[0]] - damage * k * carried;
  local.residual(1) = k * state.current.extra[local.extra[1]] - damage * own.force;
  sink.add(local);
}


template <int dim>
void Peridynamics<dim>::assemble_soft_dilatation(const State &state, Sink &sink) const
{
  std::vector<SymmetricTensor<2, dim>> strain;
  if (parameters.in_bonds)
    strain = pressure_in_bonds.strain(state);
  const std::map<unsigned int, SoftSite> sites = soft_sites(state, strain);
  for (const auto &entry : sites)
    assemble_on_family(entry.second, state, sink);
  for (unsigned int n = 0; n < softening_bonds.size(); ++n)
  {
    assemble_on_ends(n, state, sink);
    if (lattice.zone.sites()[softening_bonds[n].view.first].owner == rank)
      assemble_law(n, soft_bond(n, sites, state, strain), state, sink);
  }
}

#define INSTANTIATE(dim)                                                \
  template std::vector<double> Peridynamics<dim>::dilatation_forces(    \
    const State &, const std::vector<SymmetricTensor<2, dim>> &) const; \
  template void Peridynamics<dim>::assemble_soft_dilatation(const State &, Sink &) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
