// Bonds that are moved by explicit steps, as the rest of the model sees them.
#include "fracture/peridynamics/peridynamics.h"

#include "stockwork/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork::peridynamics
{
namespace
{
void refuse_explicit(const std::string &allowed)
{
  throw EntryError("Time/Scheme", "explicit", allowed);
}
} // namespace


template <int dim>
void Peridynamics<dim>::check_explicit_steps() const
{
  if (!parameters.explicit_steps)
    return;
  if (parameters.state_based)
    refuse_explicit("Newmark with 'Bond law = state-based'");
  if (parameters.in_bonds || parameters.as_published || parameters.tensor_fluid)
    refuse_explicit("Newmark, or 'Fracture/peridynamics/Closure = conserving' and 'Fluid = "
                    "network': there is no fluid");
  if (scene.crack_pressure != 0.)
    refuse_explicit(
      "Newmark with a fluid in the cracks; dry ones have 'Cracks/Fluid pressure = 0 Pa'");
}


template <int dim>
void Peridynamics<dim>::make_explicit_bonds(const MeshView<dim> &mesh_view)
{
  if (mesh_view.dof_handler.n_dofs() != dim * zone.peridynamic_sites().size())
    refuse_explicit(
      "Newmark, or a 'Fracture/peridynamics/Zone' that holds all of the domain: explicit "
      "steps move bonds and no elements, and of " +
      std::to_string(mesh_view.dof_handler.n_dofs() / dim) + " vertices " +
      std::to_string(zone.peridynamic_sites().size()) + " are in the zone");
  SofteningLaw law_of_bonds = softening;
  if (!parameters.growth)
    law_of_bonds.first = law_of_bonds.last = std::numeric_limits<double>::infinity();
  energy_before_explicit = committed_energy;
  explicit_bonds = std::make_unique<ExplicitBonds<dim>>(
    zone, stencil, law, law_of_bonds,
    [this](const unsigned int site, const unsigned int bond)
    {
      typename ExplicitBonds<dim>::Bond result{stiffness(site, bond), 1.};
      if (never_breaks(site, bond))
        result.amplification = 0.;
      else if (result.stiffness > 0.)
        result.amplification = equivalent_stretch(site, bond, coefficients[bond].length);
      if (const SofteningBond *softened = softening_bond(site, bond))
        result.greatest = softened->committed;
      return result;
    },
    rank);
}


template <int dim>
bool Peridynamics<dim>::follow_explicit_bonds(const Collectives &collectives)
{
  dissipated = energy_before_explicit + collectives.sum(explicit_bonds->dissipated());
  std::map<BondView, double> greatest;
  for (const auto &[site, bond, stretch] : collectives.gather(explicit_bonds->softened()))
  {
    double &known = greatest[views_of(site, bond).front()];
    known = std::max(known, stretch);
  }
  softening_bonds.clear();
  bool changed = false;
  for (const auto &[view, stretch] : greatest)
  {
    const auto &[site, bond] = view;
    if (stretch >= softening.last)
    {
      changed = changed || !bonds.is_broken(site, bond);
      bonds.set_broken(site, bond);
      cracked.set_broken(site, bond);
      continue;
    }
    SofteningBond softened;
    softened.view = view;
    softened.committed = softened.trial = stretch;
    softening_bonds.push_back(softened);
    if (!cracked.is_broken(site, bond) && lets_fluid_in(softened))
    {
      cracked.set_broken(site, bond);
      changed = true;
    }
  }
  passes = 1; // what commit() keeps is new
  if (changed)
    refresh_segments();
  return changed;
}

#define INSTANTIATE(dim)                                                       \
  template void Peridynamics<dim>::check_explicit_steps() const;               \
  template void Peridynamics<dim>::make_explicit_bonds(const MeshView<dim> &); \
  template bool Peridynamics<dim>::follow_explicit_bonds(const Collectives &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
