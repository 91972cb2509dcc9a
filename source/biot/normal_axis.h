#pragma once

#include "stockwork/base/error.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stockwork
{
/// The coordinate axis that a flat side is normal to. Collective.
/// @throws InputError where it is not flat, or normal to none
template <int dim>
unsigned int normal_axis(const dealii::Triangulation<dim> &triangulation,
                         const dealii::types::boundary_id side)
{
  std::vector<double> extent(dim, 0.);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == side)
          for (unsigned int v = 1; v < cell->face(f)->n_vertices(); ++v)
            for (unsigned int d = 0; d < dim; ++d)
              extent[d] = std::max(
                extent[d], std::abs(cell->face(f)->vertex(v)[d] - cell->face(f)->vertex(0)[d]) /
                             cell->face(f)->diameter());
  dealii::Utilities::MPI::max(extent, triangulation.get_communicator(), extent);
  for (unsigned int d = 0; d < dim; ++d)
    if (extent[d] < 1e-10)
      return d;
  throw InputError("a side that is a plane normal to a coordinate axis; give displacement "
                   "components on others");
}
} // namespace stockwork
