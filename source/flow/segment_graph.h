#pragma once

#include "flow/network_segment.h"

namespace stockwork
{
/// The shape of a fracture in the plane: how often it forks, and at which angles.
struct SegmentGraph
{
  unsigned int n_fractures = 0; ///< pieces that hang together
  /// Between ends and forks; one for a fracture without forks, three of a T, four of a crossing.
  unsigned int n_branches = 0;
  /// Of each fork, or crossing, the least between two of its branches [rad].
  std::vector<double> fork_angles;
};

/// Read the graph of segments. A fracture is a band of segments rather than a line where a model
/// breaks more than one row, and a staircase where it is oblique to the mesh; so it is cut into
/// pieces between distances from one of its ends, three segments long, of which those that hang
/// together are a node of a coarser graph. A branch must be two such pieces long to count, and has
/// the direction along which its first four extend furthest.
SegmentGraph segment_graph(const std::vector<NetworkSegment<2>> &network);
} // namespace stockwork
