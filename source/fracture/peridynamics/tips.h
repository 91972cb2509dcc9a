#pragma once

#include "fracture/peridynamics/crossing_bonds.h"
#include "fracture/peridynamics/softening_bonds.h"
#include "fracture/peridynamics/tracked_paths.h"

#include <array>
#include <optional>
#include <vector>

namespace stockwork::peridynamics
{
/// `Tracking = path`: how far tips have come, by the energy that the bonds across their ways have
/// dissipated, and fluid with them.
template <int dim>
class Tips
{
public:
  /// Of both ends of each path.
  using OfEnds = std::vector<std::array<double, 2>>;

  Tips(const Lattice<dim> &lattice,
       const SofteningBonds<dim> &softening_bonds,
       const CrossingBonds<dim> &crossing_bonds);

  /// Find whose ways the softening bonds cross, by the bonds that cross these paths.
  void look_at(const TrackedPaths &paths);

  /// What bonds across the way of each end have dissipated [J/m].
  OfEnds energy(const TrackedPaths &paths) const;

  /// What they have stored besides while they part, which would come back if they were unloaded
  /// [J/m]. Over G_c, by so much the tip of the elastic crack that is the same from afar is ahead.
  OfEnds energy_to_come(const TrackedPaths &paths) const;

  /// Whether nothing has softened across the way of an end. @param energy see above
  bool is_untouched(const TrackedPaths::End &end, const OfEnds &energy) const;

  /// From tips, as far as they have come by the energy dissipated, to the farthest bonds that have
  /// softened; all tips together. By as much process zones reach back [m].
  double half_process_zones(const TrackedPaths &paths) const;

  /// What was there from the start, and of the ways as much as the energy of the bonds that have
  /// broken across them makes up for [m].
  double broken_length(const TrackedPaths &paths) const;

  /// Tips go on, and the fluid with them.
  /// @param about_to_soften bonds besides those that have begun to
  /// @return whether fluid has reached another piece
  bool advance(TrackedPaths &paths, const std::vector<BondView> &about_to_soften) const;

  void commit(const TrackedPaths &paths);

  OfEnds committed_energy; ///< at the last step [J/m]

private:
  /// What all bonds take across the way of an end [J/m].
  double energy_of_way(const TrackedPaths &paths, const TrackedPaths::End &end) const;

  bool is_broken(const BondAcross<dim> &bond) const;

  /// Of a softening bond by its number, if it crossed rock and were stretched as much; nil if it
  /// crosses a cohesive crack and has lost what all of those have lost at the start.
  double damage_of_rock(unsigned int bond) const;

  /// What a bond takes that crosses the way of an end; nil if an open crack of the deck has cut it,
  /// and as seen from its other ends [J/m].
  double energy_of_bond(const BondAcross<dim> &bond) const;

  /// Of each end of a path in porous rock, how far along its way fluid is [m]: in all of the
  /// process zone, with what is about to soften.
  OfEnds fluid_ahead(const TrackedPaths &paths, const std::vector<BondView> &about_to_soften) const;

  const Lattice<dim> &lattice;
  const SofteningBonds<dim> &softening_bonds;
  const CrossingBonds<dim> &crossing_bonds;
  /// Of a softening bond.
  struct Softening
  {
    std::optional<TrackedPaths::End> end; ///< whose way it crosses
    bool cohesive = false;                ///< see BondAcross
    double share = 1.;                    ///< likewise
  };
  std::vector<Softening> softening; ///< by their numbers
};
} // namespace stockwork::peridynamics
