#pragma once

#include "fracture/peridynamics/fracture_cells.h"
#include "stockwork/exchange/segment.h"
#include "stockwork/exchange/state.h"

#include <vector>

namespace stockwork::peridynamics
{
/// The fracture that fluid may be in, as it is now: cells of the lattice, or pieces of tracked
/// paths, each with its segment.
template <int dim>
struct Fracture
{
  std::vector<FractureCell<dim>> cells;
  std::vector<Segment<dim>> segments; ///< of all ranks
  std::vector<bool> at_front;         ///< which of them the fracture ends at

  // Of this rank.
  std::vector<unsigned int> owned_cells;    ///< indices among `cells`
  std::vector<Segment<dim>> owned_segments; ///< the same; their openings are known here only

  /// Of an owned segment [m].
  double aperture(const unsigned int owned, const State &state) const
  {
    return value(owned_segments[owned].opening, state.current);
  }
};
} // namespace stockwork::peridynamics
