#pragma once

#include <cmath>
#include <vector>

#include "stockwork/base/scrambled.h"
#include "stockwork/exchange/segment.h"

namespace stockwork
{
/// What every rank knows of a segment: all but the functionals, which stay with the owner.
template <int dim>
struct SegmentNumbers
{
  std::uint64_t key = 0;
  std::uint64_t part_of = 0; ///< see Segment
  dealii::Point<dim> centre;
  dealii::Tensor<1, dim> normal;
  double area = 0.;
  double in_situ_pore_pressure = 0.;
  bool rock_has_pore_pressure = false; ///< as unknowns
  dealii::types::material_id region = 0;
  double pore_distance = 0.;          ///< see Segment [m]
  bool has_pressure_of_pores = false; ///< see Segment
  double share_of_pores = 0.;         ///< see Segment
  double bare_aperture = 0.;          ///< see Segment [m]
  double propped_conductivity = 0.;   ///< see Segment [m^3]
  unsigned int owner = 0;             ///< rank
  bool at_tip = false;
  unsigned int n_neighbours = 0;
};

/// The same, with its neighbours.
template <int dim>
struct NetworkSegment : SegmentNumbers<dim>
{
  std::vector<typename Segment<dim>::Neighbour> neighbours;
  double initial_pressure = 0.; ///< from which an unknown pressure starts [Pa]; not gathered

  /// Length of the segment; in 3-D the side of the square of its area [m].
  double size() const
  {
    return dim == 2 ? this->area : std::sqrt(this->area);
  }
};

/// Keys of the flow's own unknowns. The mixing is one to one (the finaliser of splitmix64), so two
/// pressures never share a key, and one of a fracture model only by an accident of 1 in 2^64.
inline std::uint64_t flow_key(const std::uint64_t key, const std::uint64_t kind)
{
  return scrambled(key + kind * scrambling_step);
}
} // namespace stockwork
