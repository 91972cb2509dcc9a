#pragma once

#include <deal.II/distributed/tria.h>

#include <string>
#include <vector>

#include "mesh/geometry.h"

namespace stockwork
{
/// Set the flags of a mesh so that no owned cell is larger than wanted, and, if asked to, that
/// cells much smaller than wanted are merged again where the initial mesh allows it and no border
/// of a region passes between them. Neighbours differ by one level at most. Call
/// Triangulation::execute_coarsening_and_refinement() afterwards, with the transfer of unknowns
/// around it. Collective.
///
/// One call asks for one level: repeat until it returns false, and coarsen in the first call only,
/// since cells on the rim of what is wanted could be split and merged by turns forever.
///
/// @param wanted_size longest edge [m] by active cell index; those of other ranks' cells are
/// ignored, and infinity means that a cell does not matter
/// @param holds_fracture by active cell index: these cells keep their size; empty: none
/// @return whether the mesh will change
/// @throws SolveError if a cell that holds a fracture would have to be split because its
/// neighbours are wanted much smaller
template <int dim>
bool flag_cells(dealii::parallel::distributed::Triangulation<dim> &triangulation,
                const Geometry<dim> &geometry,
                const std::vector<float> &wanted_size,
                const std::vector<bool> &holds_fracture = {},
                bool coarsen = false);

/// Of a mesh with flags set, before memory is taken for its new cells. Collective.
/// @throws EntryError if it would have more than `most` cells, or cells smaller than p4est can
/// number; @p unless ends the sentence "allowed is more, ..."
template <int dim>
void refuse_too_many_cells(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                           unsigned int most,
                           const std::string &unless);
} // namespace stockwork
