#pragma once

#include "fracture/peridynamics/lattice.h"
#include "stockwork/exchange/scene.h"

#include <string>
#include <vector>

namespace stockwork::peridynamics
{
// Nodes on a crack belong to its left side, as seen from its first point. Where a fracture comes
// from there and meets a tracked path, the opening at the place would be read far too small (with a
// pressure at the well 30 % too high).

/// The cracks of the scene. On a tracked path, one with legs along rows of nodes has its points
/// in the order that puts these on the side away from the other cracks, if there is one.
/// @param lattice with its zone
template <int dim>
std::vector<InitialCrack<dim>> oriented_cracks(const Lattice<dim> &lattice);

/// Sentences for cracks along a row of nodes that may be met from both sides.
template <int dim>
std::vector<std::string> foresee_rows_of_nodes(const Lattice<dim> &lattice);
} // namespace stockwork::peridynamics
