#include "base/kink.h"
#include "fracture/peridynamics/peridynamics.h"
#include "stockwork/mesh/key.h"

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
using dealii::Tensor;

namespace
{
/// As SofteningLaw::wet_damage, of what softens beside a fracture that is there already; or
/// fractures would be several cells thick.
constexpr double wet_damage_beside = 0.5;
/// Of the stretch at which bonds soften: those that have come near it and are stretched by less
/// than this again, behind a tip that has passed, do without their unknown. Not with the pressure
/// in the bonds, where it was tried with a fault and not again (doc/laboratory/kgd.md).
constexpr double far_from_softening = 0.8;
} // namespace


template <int dim>
double Peridynamics<dim>::relative_energy(const unsigned int site, const unsigned int bond) const
{
  if constexpr (dim == 2)
    if (parameters.tracked && !is_alike())
      // Cement breaks by what it takes itself, also where a fracture's way crosses it.
      if (const BondAcross<dim> *const across = crossing_bonds.find(site, bond))
        return across->share * lattice.rock_of_bonds.energy(paths.point(across->crossing));
  return lattice.rock_of_bonds.energy(site, bond);
}


template <int dim>
double Peridynamics<dim>::relative_stretch(const unsigned int site, const unsigned int bond) const
{
  return is_alike()
           ? 1.
           : std::sqrt(relative_energy(site, bond) / lattice.rock_of_bonds.modulus(site, bond));
}


template <int dim>
double Peridynamics<dim>::equivalent_stretch(const unsigned int site,
                                             const unsigned int bond,
                                             const double elongation) const
{
  return lattice.equivalent_stretch(site, bond, elongation, relative_energy(site, bond));
}


template <int dim>
std::vector<ExtraUnknown> Peridynamics<dim>::extra_unknowns() const
{
  std::vector<ExtraUnknown> unknowns;
  if (parameters.explicit_steps)
    return unknowns;
  for (const SofteningBond &bond : softening_bonds)
  {
    const auto [from, to] = lattice.bonds.places(bond.view.first, bond.view.second);
    unknowns.push_back({Key()
                          .add(lattice.zone.position(from), 1e-4 * lattice.zone.spacing())
                          .add(lattice.zone.position(to), 1e-4 * lattice.zone.spacing())});
  }
  if (parameters.state_based)
    for (unsigned int n = 0; n < softening_bonds.size(); ++n)
      unknowns.push_back({Key().add(unknowns[n].key).add(1)});
  if (parameters.in_bonds)
    for (const ExtraUnknown &unknown : pressure_in_bonds.unknowns())
      unknowns.push_back(unknown);
  return unknowns;
}


/// With x = D e of a bond with stiffness k and elongation e, its force is k (e - x); the matrix of
/// the rock has k e. The rows of x say k (x - D e) = 0. Every rank adds the rows of its sites.
template <int dim>
void Peridynamics<dim>::assemble_softening(const State &state, Sink &sink) const
{
  LocalSystem force, law_of_bond;
  force.extra.resize(1);
  force.bulk.resize(dim);
  law_of_bond.extra.resize(1);
  law_of_bond.bulk.resize(2 * dim);
  std::vector<dealii::SymmetricTensor<2, dim>> strain;
  if (parameters.in_bonds && !parameters.state_based && !softening_bonds.empty())
    strain = pressure_in_bonds.strain(state);
  for (unsigned int n = 0; n < softening_bonds.size(); ++n)
  {
    const auto &[site, bond] = softening_bonds[n].view;
    const double k = lattice.stiffness(site, bond), x = state.current.extra[n];

    for (const auto &[s, b] : lattice.bonds.views_of(site, bond))
      if (lattice.zone.sites()[s].owner == rank)
      {
        force.extra[0] = n;
        force.reinit();
        for (unsigned int d = 0; d < dim; ++d)
        {
          force.bulk[d] = lattice.zone.sites()[s].dofs[d];
          force.matrix(d, dim) =
            k * lattice.zone.sites()[s].share * lattice.coefficients[b].direction[d];
          force.residual(d) = force.matrix(d, dim) * x;
        }
        sink.add(force);
      }

    if (lattice.zone.sites()[site].owner != rank || parameters.state_based)
      continue; // those rows are assemble_soft_dilatation()'s
    law_of_bond.extra[0] = n;
    const FarEnd end = lattice.zone.far_end(site, bond);
    const Tensor<1, dim> &e = lattice.coefficients[bond].direction;
    Tensor<1, dim> at_far;
    double elongation = 0.;
    for (unsigned int d = 0; d < dim; ++d)
    {
      at_far[d] = end.mirrored >> d & 1 ? -e[d] : e[d];
      law_of_bond.bulk[d] = lattice.zone.sites()[site].dofs[d];
      law_of_bond.bulk[dim + d] = lattice.zone.sites()[end.site].dofs[d];
      elongation += at_far[d] * state.current.bulk(law_of_bond.bulk[dim + d]) -
                    e[d] * state.current.bulk(law_of_bond.bulk[d]);
    }
    double added = softening_bonds[n].offset * lattice.coefficients[bond].length;
    if (parameters.in_bonds)
      added = lattice.coefficients[bond].length *
              pressure_in_bonds.stretch(site, bond, pressure_in_bonds.shares(n), strain);
    const double total = elongation + added;
    const double stretch = equivalent_stretch(site, bond, total);
    const double committed = softening_bonds[n].committed;
    const double kappa = softening_bonds.maximum_stretch(softening_bonds[n], stretch);
    const double damage = lattice.softening.damage(kappa);
    // What an in-situ stress adds to the stretch is not the bond's to carry, unless it is part of
    // its law.
    const double carried = parameters.in_bonds ? total : elongation;
    // Of damage times this elongation by the elongation. What has softened goes on.
    const bool softens = stretch > committed - kink_width,
               follows_tangent = softening_bonds.follows_tangent(n, kappa, softens);
    const double slope = follows_tangent && softens && total != 0.
                           ? damage + (lattice.softening.slope(kappa) - damage) *
                                        softening_bonds.relaxation() * stretch / kappa * carried /
                                        total
                           : damage;
    law_of_bond.extra.resize(1);
    if (parameters.in_bonds)
      for (const auto &[cell, share] : pressure_in_bonds.shares(n))
        for (unsigned int m = 0; m < pressure_in_bonds.n_modes(); ++m)
          law_of_bond.extra.push_back(pressure_in_bonds.unknown_of_traction(cell, m));
    law_of_bond.reinit();
    law_of_bond.residual(2 * dim) = k * (x - damage * carried);
    law_of_bond.matrix(2 * dim, 2 * dim) = k;
    unsigned int column = 2 * dim;
    if (parameters.in_bonds)
      for (const auto &[cell, share] : pressure_in_bonds.shares(n))
        for (unsigned int m = 0; m < pressure_in_bonds.n_modes(); ++m)
          law_of_bond.matrix(2 * dim, ++column) =
            -slope * share * lattice.coefficients[bond].stiffness *
            lattice.coefficients[bond].length *
            pressure_in_bonds.stretch_of_traction(cell, m, bond);
    for (unsigned int d = 0; d < dim; ++d)
    {
      law_of_bond.matrix(2 * dim, d) = k * slope * e[d];
      law_of_bond.matrix(2 * dim, dim + d) = -k * slope * at_far[d];
    }
    sink.add(law_of_bond);
  }
}


template <int dim>
bool Peridynamics<dim>::lets_fluid_in(const SofteningBond &bond) const
{
  const double damage = rounded(lattice.softening.damage(bond.trial));
  if (damage <= SofteningLaw::wet_damage || damage > wet_damage_beside)
    return damage > SofteningLaw::wet_damage;
  const auto &[site, b] = bond.view;
  for (const FractureCell<dim> &cell : fracture.cells)
  {
    Tensor<1, dim> away; // from the cell's centre to the bond's middle, in spacings
    for (unsigned int d = 0; d < dim; ++d)
      away[d] = lattice.zone.sites()[site].place[d] + 0.5 * lattice.stencil[b].offset[d] -
                cell.place[d] - 0.5;
    const double across = std::abs(away * cell.normal);
    if (across > 0.75 && across < parameters.horizon + 1. &&
        (away - (away * cell.normal) * cell.normal).norm() < parameters.horizon + 1.)
      return false;
  }
  return true;
}


template <int dim>
double Peridynamics<dim>::added_stretch(const SofteningBond &bond, const OfCells &of_cells) const
{
  return parameters.in_bonds ? added_stretch(bond.view.first, bond.view.second, of_cells)
                             : bond.offset;
}


template <int dim>
bool Peridynamics<dim>::soften_bonds(const std::vector<double> &u,
                                     const OfCells &of_cells,
                                     const std::vector<Candidate> &candidates)
{
  bool changed = false;
  const auto crack = [&](const BondView &view)
  {
    if (cracked.is_broken(view.first, view.second))
      return;
    cracked.set_broken(view.first, view.second);
    changed = true;
  };
  const auto stretch_of = [&](const BondView &view, const double added)
  {
    const auto &[site, b] = view;
    return stretch_that_counts(site, b, added, added_dilatation(site, b, added, of_cells), u,
                               of_cells);
  };
  const auto maximum_stretch = [&](const SofteningBond &bond)
  {
    return softening_bonds.maximum_stretch(bond,
                                           stretch_of(bond.view, added_stretch(bond, of_cells)));
  };
  softening_bonds.forget_turns();
  for (SofteningBond &bond : softening_bonds)
  {
    bond.trial = maximum_stretch(bond);
    if (!parameters.tracked && lets_fluid_in(bond))
      crack(bond.view);
  }
  std::vector<BondView> views, about_to_soften;
  for (const Candidate &candidate : candidates)
  {
    views.push_back(lattice.bonds.views_of(candidate.site, candidate.bond).front());
    if (candidate.stretch >= 1.)
      about_to_soften.emplace_back(candidate.site, candidate.bond);
  }
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  // Their stretch is by the pieces that `of_cells` has; once tips have advanced there are others.
  std::vector<SofteningBond> new_ones;
  for (const BondView &view : views)
  {
    SofteningBond bond;
    bond.view = view;
    if (!parameters.in_bonds)
      bond.offset = added_stretch(view.first, view.second, of_cells);
    bond.trial = maximum_stretch(bond);
    new_ones.push_back(bond);
  }
  if (parameters.tracked)
    changed = tips.advance(paths, about_to_soften);
  else if (changed)
    changed = find_fracture_cells(lattice.zone, cracked).size() != fracture.cells.size();
  if (!changed && about_to_soften.empty())
    return false;

  // Those that were broken before this step do not need their unknowns any more; but what stress
  // in situ does between the faces of a dry path is theirs, for it has no segments. Nor do those
  // that have not softened after all; once in a step, or they might come and go by turns.
  const auto is_whole = [&](const SofteningBond &bond)
  {
    const auto &[site, b] = bond.view;
    return !parameters.in_bonds && passes == 0 &&
           lattice.softening.damage(std::max(bond.committed, bond.trial)) == 0. &&
           rounded(stretch_of(bond.view, added_stretch(site, b, of_cells)) /
                   lattice.softening.first) < far_from_softening;
  };
  std::vector<SofteningBond> softening_now;
  for (const SofteningBond &bond : softening_bonds)
    if (bond.committed >= lattice.softening.last &&
        !(parameters.tracked &&
          pressure_in_bonds.dry_stretch(bond.view.first, bond.view.second) != 0.))
      lattice.bonds.set_broken(bond.view.first, bond.view.second);
    else if (!is_whole(bond))
      softening_now.push_back(bond);
  for (const SofteningBond &bond : new_ones)
  {
    if (!parameters.tracked && lets_fluid_in(bond))
      cracked.set_broken(bond.view.first, bond.view.second);
    softening_now.push_back(bond);
  }
  softening_bonds.replace(std::move(softening_now));
  return true;
}


template <int dim>
void Peridynamics<dim>::restore_softening()
{
  cracked.reinit(lattice.zone, lattice.stencil);
  cracked.set_broken(committed_cracked);
  softening_bonds.restore();
}


#define INSTANTIATE(dim)                                                                           \
  template double Peridynamics<dim>::relative_energy(unsigned int, unsigned int) const;            \
  template double Peridynamics<dim>::relative_stretch(unsigned int, unsigned int) const;           \
  template double Peridynamics<dim>::equivalent_stretch(unsigned int, unsigned int, double) const; \
  template std::vector<ExtraUnknown> Peridynamics<dim>::extra_unknowns() const;                    \
  template void Peridynamics<dim>::assemble_softening(const State &, Sink &) const;                \
  template double Peridynamics<dim>::added_stretch(const SofteningBond &, const OfCells &) const;  \
  template bool Peridynamics<dim>::soften_bonds(const std::vector<double> &, const OfCells &,      \
                                                const std::vector<Candidate> &);                   \
  template bool Peridynamics<dim>::lets_fluid_in(const SofteningBond &) const;                     \
  template void Peridynamics<dim>::restore_softening();
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
