#include "fracture/peridynamics/softening_bonds.h"

#include <algorithm>

namespace stockwork::peridynamics
{
template <int dim>
SofteningBonds<dim>::SofteningBonds(const Lattice<dim> &lattice)
  : lattice(lattice)
{
}


template <int dim>
const SofteningBond *SofteningBonds<dim>::find(const unsigned int site,
                                               const unsigned int bond) const
{
  if (bonds.empty() || !lattice.bonds.can_break(site, bond))
    return nullptr;
  const BondView view = lattice.bonds.views_of(site, bond).front();
  const auto found =
    std::lower_bound(bonds.begin(), bonds.end(), view,
                     [](const SofteningBond &a, const BondView &b) { return a.view < b; });
  return found != bonds.end() && found->view == view ? &*found : nullptr;
}


template <int dim>
double SofteningBonds<dim>::damage(const unsigned int site, const unsigned int bond) const
{
  if (lattice.bonds.is_broken(site, bond))
    return 1.;
  const SofteningBond *const softened = find(site, bond);
  return softened != nullptr ? lattice.softening.damage(softened->trial) : 0.;
}


template <int dim>
double SofteningBonds<dim>::maximum_stretch(const SofteningBond &bond, const double stretch) const
{
  return bond.committed + relaxation_now * std::max(0., stretch - bond.committed);
}


template <int dim>
bool SofteningBonds<dim>::follows_tangent(const unsigned int number,
                                          const double kappa,
                                          const bool softens) const
{
  return turns[number].follows_tangent(kappa >= lattice.softening.last ? Turns::Leg::broken
                                       : softens && kappa > lattice.softening.first
                                         ? Turns::Leg::softens
                                         : Turns::Leg::elastic);
}


template <int dim>
bool SofteningBonds<dim>::uses_secants() const
{
  return std::any_of(turns.begin(), turns.end(),
                     [](const Turns &own) { return !own.follows_tangent(); });
}


template <int dim>
void SofteningBonds<dim>::forget_turns()
{
  turns.assign(bonds.size(), Turns());
}


template <int dim>
void SofteningBonds<dim>::begin_attempt(const unsigned int attempt, const bool converged)
{
  if (attempt == 0)
    relaxation_now = std::min(1., 1.25 * committed.relaxation);
  else if (attempt > 1 && !converged) // half of the step may do
    relaxation_now *= 0.5;
  forget_turns();
}


template <int dim>
void SofteningBonds<dim>::replace(std::vector<SofteningBond> others)
{
  bonds = std::move(others);
  std::sort(bonds.begin(), bonds.end(),
            [](const SofteningBond &a, const SofteningBond &b) { return a.view < b.view; });
  forget_turns();
}


template <int dim>
void SofteningBonds<dim>::commit()
{
  committed.bonds.clear();
  for (SofteningBond &bond : bonds)
  {
    bond.committed = bond.trial;
    committed.bonds.push_back(
      {lattice.bonds.places(bond.view.first, bond.view.second), {{bond.trial, bond.offset}}});
  }
  committed.relaxation = relaxation_now;
}


template <int dim>
void SofteningBonds<dim>::restore()
{
  std::vector<SofteningBond> known;
  for (const auto &[places, values] : committed.bonds)
    if (const auto found = lattice.bonds.find(places))
      known.push_back({lattice.bonds.views_of(found->first, found->second).front(), values[0],
                       values[0], values[1]});
  replace(std::move(known));
}

template class SofteningBonds<2>;
template class SofteningBonds<3>;
} // namespace stockwork::peridynamics
