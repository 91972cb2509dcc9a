#include "fracture/peridynamics/tips.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace stockwork::peridynamics
{
namespace
{
// How far the fluid is ahead, in spacings (doc/laboratory/peridynamics_paths.md, The front of the
// fluid).

/// Of the tip, at least. Where viscosity dominates nothing softens ahead of it, and with less the
/// fracture becomes too long.
constexpr double least_lead = 0.25;
/// Of the tip of the equivalent elastic crack, at most. With more the net pressure is too low where
/// the process zone is long.
constexpr double most_over_elastic_tip = 0.25;
/// Share of a piece that lies in the process zone when fluid gets into it. With all of it the
/// pressure is a little too low, see there.
constexpr double share_in_zone = 0.8;
} // namespace


template <int dim>
Tips<dim>::Tips(const Lattice<dim> &lattice,
                const SofteningBonds<dim> &softening_bonds,
                const CrossingBonds<dim> &crossing_bonds)
  : lattice(lattice)
  , softening_bonds(softening_bonds)
  , crossing_bonds(crossing_bonds)
{
}


template <int dim>
void Tips<dim>::look_at(const TrackedPaths &paths)
{
  softening.clear();
  for (const SofteningBond &bond : softening_bonds)
  {
    const BondAcross<dim> *const across = crossing_bonds.find(bond.view.first, bond.view.second);
    softening.push_back({});
    if (!across)
      continue;
    softening.back() = {paths.end_at(across->crossing), across->cohesive, across->share};
  }
}


template <int dim>
typename Tips<dim>::OfEnds Tips<dim>::energy(const TrackedPaths &paths) const
{
  if (lattice.softening.brittle())
  {
    OfEnds energy(paths.n_paths(), {{0., 0.}}); // of those that have broken
    for (const BondAcross<dim> &bond : crossing_bonds)
      if (const auto end = is_broken(bond) ? paths.end_at(bond.crossing) : std::nullopt)
        energy[end->path][end->side] += energy_of_bond(bond);
    return energy;
  }
  OfEnds energy = committed_energy;
  energy.resize(paths.n_paths(), {{0., 0.}});
  for (unsigned int n = 0; n < softening.size(); ++n)
    if (const auto &end = softening[n].end)
    {
      const SofteningBond &bond = softening_bonds[n];
      energy[end->path][end->side] +=
        softening[n].share * lattice.energy_at_unit_stretch(bond.view) *
        (lattice.softening.dissipated(bond.trial) - lattice.softening.dissipated(bond.committed));
    }
  return energy;
}


template <int dim>
bool Tips<dim>::is_untouched(const TrackedPaths::End &end, const OfEnds &energy) const
{
  if (energy[end.path][end.side] != 0.)
    return false;
  return std::none_of(softening.begin(), softening.end(),
                      [&](const Softening &bond)
                      {
                        // Those across a cohesive crack are there from the start.
                        return bond.end && bond.end->path == end.path &&
                               bond.end->side == end.side && !bond.cohesive;
                      });
}


template <int dim>
void Tips<dim>::commit(const TrackedPaths &paths)
{
  committed_energy = energy(paths);
}


template <int dim>
double Tips<dim>::half_process_zones(const TrackedPaths &paths) const
{
  std::map<std::pair<unsigned int, unsigned int>, double> ahead; // by end
  for (unsigned int n = 0; n < softening.size(); ++n)
    if (const auto &end = softening[n].end; end && damage_of_rock(n) > 0.)
    {
      const auto crossing =
        crossing_bonds.crossing(softening_bonds[n].view.first, softening_bonds[n].view.second);
      double &farthest = ahead[{end->path, end->side}];
      farthest = std::max(farthest, paths.along_way(*crossing, *end) - paths.advance(*end));
    }
  double sum = 0.;
  for (const auto &end : ahead)
    sum += end.second;
  return sum;
}


template <int dim>
double Tips<dim>::damage_of_rock(const unsigned int bond) const
{
  const auto &[end, cohesive, share] = softening[bond];
  const double damage = lattice.softening.damage(std::sqrt(share) * softening_bonds[bond].trial);
  return cohesive && damage <= SofteningLaw::damage_at_start * (1. + same_stretch) ? 0. : damage;
}


template <int dim>
typename Tips<dim>::OfEnds Tips<dim>::energy_to_come(const TrackedPaths &paths) const
{
  OfEnds result(paths.n_paths(), {{0., 0.}});
  if (!lattice.softening.brittle())
    for (unsigned int n = 0; n < softening.size(); ++n)
      if (const auto &end = softening[n].end)
      {
        const SofteningBond &bond = softening_bonds[n];
        result[end->path][end->side] +=
          softening[n].share * lattice.energy_at_unit_stretch(bond.view) *
          (lattice.softening.separation(bond.trial) - lattice.softening.dissipated(bond.trial));
      }
  return result;
}


/// In porous rock the elements' strain across what softens is opening: the pores around must not
/// feel it, so the fluid of the piece that is there takes it, and leaks into them.
template <int dim>
typename Tips<dim>::OfEnds
Tips<dim>::fluid_ahead(const TrackedPaths &paths,
                       const std::vector<BondView> &about_to_soften) const
{
  OfEnds farthest(paths.n_paths(), {{0., 0.}});
  const auto reach = [&](const BondView &view)
  {
    const BondAcross<dim> *const across = crossing_bonds.find(view.first, view.second);
    const auto end = across ? paths.end_at(across->crossing) : std::nullopt;
    // What begins beyond another path, or by itself, is dry at first, see TrackedPaths.
    if (!end || (paths.is_all_way(end->path) && !paths.is_wet(end->path)))
      return;
    double &fluid = farthest[end->path][end->side];
    fluid = std::max(fluid, paths.along_way(across->crossing, *end));
  };
  if (lattice.scene.has_pore_pressure)
  {
    for (unsigned int n = 0; n < softening.size(); ++n)
      if (rounded(damage_of_rock(n)) > 0.)
        reach(softening_bonds[n].view);
    // Cement softens before rock does: its bonds count once rock would have, see above.
    for (const BondView &view : about_to_soften)
      if (const auto *across = crossing_bonds.find(view.first, view.second);
          across && !across->cohesive)
        reach(view);
    if (lattice.softening.brittle())
      for (const BondAcross<dim> &bond : crossing_bonds)
        if (!bond.was_cut && is_broken(bond))
          reach(bond.view);
  }
  return farthest;
}


/// In elastic rock fluid is in pieces most of which lie in the process zone. If the force falls
/// linearly over a zone of length L, the energy dissipated puts the tip at L/2, and that of the
/// elastic crack that is the same from afar is L/6 ahead of it: the end of the zone three times as
/// far. It goes not much farther than that elastic crack, which has all of the pressure in it.
///
/// Where a way meets another path, the bonds across both belong to that one, so its last part takes
/// less than G_c; the less, the smaller the angle is. A tip is at the end when all of what there is
/// has broken.
template <int dim>
bool Tips<dim>::advance(TrackedPaths &paths, const std::vector<BondView> &about_to_soften) const
{
  const OfEnds dissipated = energy(paths);
  const double h = lattice.zone.spacing(), unit = h * lattice.energy_across;
  const OfEnds fluid = fluid_ahead(paths, about_to_soften), to_come = energy_to_come(paths);
  return paths.set_advances(
    [&](const TrackedPaths::End &end)
    {
      const double by_energy = h * rounded(dissipated[end.path][end.side] / unit);
      if (!paths.has_met(end))
        return by_energy;
      const double way = paths.way(end),
                   missing = way - h * rounded(energy_of_way(paths, end) / unit);
      if (missing <= 0.)
        return by_energy;
      const double reach = lattice.parameters.horizon * h,
                   begin = std::max(0., way - reach - missing);
      return by_energy <= begin
               ? by_energy
               : begin + (by_energy - begin) * (way - begin) / std::max(h, way - begin - missing);
    },
    [&](const TrackedPaths::End &end)
    {
      if (lattice.scene.has_pore_pressure)
        return fluid[end.path][end.side];
      const double tip = paths.advance(end);
      // What begins beyond another path is dry at first; and where two meet, fluid goes with tips.
      // Carter's law takes most from fresh faces, and would suck a process zone shut.
      if (tip == 0. || paths.is_all_way(end.path) || paths.has_met(end) ||
          lattice.scene.leaks_by_carter || lattice.softening.brittle())
        return tip;
      const double elastic_tip = rounded(to_come[end.path][end.side] / unit),
                   of_zone = 3. * elastic_tip - share_in_zone;
      return tip + h * std::clamp(of_zone, least_lead, elastic_tip + most_over_elastic_tip);
    },
    about_to_soften.empty() && !lattice.softening.brittle());
}


template <int dim>
bool Tips<dim>::is_broken(const BondAcross<dim> &bond) const
{
  return softening_bonds.damage(bond.view.first, bond.view.second) >= 1.;
}


template <int dim>
double Tips<dim>::energy_of_bond(const BondAcross<dim> &bond) const
{
  if (bond.was_cut ||
      lattice.bonds.views_of(bond.view.first, bond.view.second).front() != bond.view)
    return 0.;
  return bond.share * lattice.energy_at_unit_stretch(bond.view) *
         lattice.softening.dissipated(lattice.softening.last);
}


template <int dim>
double Tips<dim>::energy_of_way(const TrackedPaths &paths, const TrackedPaths::End &end) const
{
  double energy = 0.;
  for (const BondAcross<dim> &bond : crossing_bonds)
    if (bond.crossing.path == end.path)
      if (const auto of = paths.end_at(bond.crossing); of && of->side == end.side)
        energy += energy_of_bond(bond);
  return energy;
}


template <int dim>
double Tips<dim>::broken_length(const TrackedPaths &paths) const
{
  double energy = 0.;
  for (const BondAcross<dim> &bond : crossing_bonds)
    if (paths.end_at(bond.crossing) && is_broken(bond))
      energy += energy_of_bond(bond);
  return paths.initial_length() + energy / lattice.energy_across;
}

template class Tips<2>;
template class Tips<3>;
} // namespace stockwork::peridynamics
