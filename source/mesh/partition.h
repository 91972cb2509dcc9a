#pragma once

#include <deal.II/distributed/tria.h>

namespace stockwork
{
/// Share the cells out among the ranks so that all have as many unknowns. Equal numbers of cells
/// are not enough in 3-D: the unknowns between two ranks all belong to the lower one. Collective.
template <int dim>
void share_out(dealii::parallel::distributed::Triangulation<dim> &triangulation);
} // namespace stockwork
