// Bonds that are moved by explicit steps, as the rest of the model sees them.
#include "fracture/peridynamics/peridynamics.h"

#include "stockwork/base/error.h"

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork::peridynamics
{
template <int dim>
void Peridynamics<dim>::make_explicit_bonds()
{
  if (!is_all_bonds())
    throw EntryError(
      "Time/Scheme", "explicit",
      "Newmark, or a 'Fracture/peridynamics/Zone' that holds all of the domain: explicit "
      "steps move bonds and no elements, and of " +
        std::to_string(n_nodes) + " vertices " +
        std::to_string(lattice.zone.n_peridynamic_sites()) + " are in the zone");
  SofteningLaw law_of_bonds = lattice.softening;
  if (!parameters.growth)
    law_of_bonds.first = law_of_bonds.last = std::numeric_limits<double>::max();
  energy_before_explicit = committed_energy;
  explicit_bonds = std::make_unique<ExplicitBonds<dim>>(
    lattice.zone, lattice.stencil, lattice.law, law_of_bonds, lattice.stretch_of_given_pressure(),
    [this](const unsigned int site, const unsigned int bond)
    {
      typename ExplicitBonds<dim>::Bond result{lattice.stiffness(site, bond), 1.};
      // Of the lattice's stress; what the surface correction adds does not push.
      result.by_fluid = lattice.stretch_of_given_pressure() /
                        lattice.rock_of_bonds.modulus(site, bond) / lattice.correction(site, bond);
      if (result.by_fluid != 0. && lattice.bonds.is_broken(site, bond))
      {
        result.stiffness =
          lattice.correction(site, bond) * lattice.uncorrected_stiffness(site, bond);
        result.greatest = std::numeric_limits<double>::infinity();
        return result;
      }
      if (lattice.never_breaks(site, bond))
        result.amplification = 0.;
      else if (result.stiffness > 0.)
        result.amplification = equivalent_stretch(site, bond, lattice.coefficients[bond].length);
      if (const SofteningBond *softened = softening_bonds.find(site, bond))
        result.greatest = softened->committed;
      return result;
    },
    rank);
}


template <int dim>
void Peridynamics<dim>::open_explicit_bonds(const Collectives &collectives)
{
  std::vector<double> volumes(fracture.cells.size(), 0.);
  for (const unsigned int i : lattice.bonds.damaged_sites())
    if (lattice.zone.sites()[i].owner == rank)
      lattice.bonds.for_each_broken(
        i,
        [&](const unsigned int b)
        {
          // Half of a bond belongs to each end.
          const double length = lattice.coefficients[b].length,
                       modulus = lattice.rock_of_bonds.modulus(i, b),
                       effective = explicit_bonds->elongation(i, b) +
                                   lattice.stretch_of_given_pressure() / modulus * length,
                       volume = 0.5 * lattice.zone.sites()[i].share *
                                lattice.uncorrected_stiffness(i, b) * length * effective *
                                lattice.strain_of_pressure;
          for (const auto &[cell, share] : pressure_in_bonds.shares(i, b, true))
            volumes[cell] += share * volume;
        });
  collectives.sum(volumes);
  for (unsigned int k = 0; k < fracture.owned_segments.size(); ++k)
  {
    // What it does to the rock, bonds do.
    fracture.owned_segments[k].opening = LinearFunctional();
    fracture.owned_segments[k].opening.constant =
      volumes[fracture.owned_cells[k]] / fracture.owned_segments[k].area;
  }
}


template <int dim>
bool Peridynamics<dim>::take_explicit_changes(const Collectives &collectives)
{
  const auto changes = collectives.gather(explicit_bonds->take_changes());
  if (changes.empty())
    return false;
  std::map<BondView, double> greatest;
  for (const auto &[place, bond, stretch] : changes)
    if (const unsigned int site = lattice.zone.find(place);
        site != dealii::numbers::invalid_unsigned_int && lattice.zone.sites()[site].has_bonds)
    {
      double &known = greatest[lattice.bonds.views_of(site, bond).front()];
      known = std::max(known, stretch);
    }
  std::map<BondView, SofteningBond> softened;
  for (const SofteningBond &bond : softening_bonds)
    softened[bond.view] = bond;
  bool changed = false;
  for (const auto &[view, stretch] : greatest)
  {
    const auto &[site, bond] = view;
    if (stretch >= lattice.softening.last)
    {
      softened.erase(view);
      changed = changed || !lattice.bonds.is_broken(site, bond);
      lattice.bonds.set_broken(site, bond);
      cracked.set_broken(site, bond);
      continue;
    }
    SofteningBond &soft = softened[view];
    soft.view = view;
    soft.committed = soft.trial = stretch;
    if (!cracked.is_broken(site, bond) && lets_fluid_in(soft))
    {
      cracked.set_broken(site, bond);
      changed = true;
    }
  }
  std::vector<SofteningBond> now;
  for (const auto &[view, bond] : softened)
    now.push_back(bond);
  softening_bonds.replace(std::move(now));
  return collectives.max(changed ? 1. : 0.) > 0.;
}


template <int dim>
bool Peridynamics<dim>::follow_explicit_bonds(const State &state, const Collectives &collectives)
{
  dissipated = energy_before_explicit + collectives.sum(explicit_bonds->dissipated());
  const bool changed = take_explicit_changes(collectives);
  if (changed)
  {
    refresh_segments();
    passes = 1; // what commit() keeps is new
  }
  if (lattice.stretch_of_given_pressure() == 0.)
    return changed;
  if (changed)
    pressure_in_bonds.find_crossed();
  open_explicit_bonds(collectives);
  warn_of_pressure(state);
  return true;
}

#define INSTANTIATE(dim)                                                       \
  template void Peridynamics<dim>::make_explicit_bonds();                      \
  template void Peridynamics<dim>::open_explicit_bonds(const Collectives &);   \
  template bool Peridynamics<dim>::take_explicit_changes(const Collectives &); \
  template bool Peridynamics<dim>::follow_explicit_bonds(const State &, const Collectives &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
