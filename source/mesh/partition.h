#pragma once

#include <deal.II/distributed/tria.h>

#include <vector>

namespace stockwork
{
/// Share the cells out among the ranks so that all have as many unknowns. Equal numbers of cells
/// are not enough in 3-D: the unknowns between two ranks all belong to the lower one. Collective.
/// @param degree of the elements
template <int dim>
void share_out(dealii::parallel::distributed::Triangulation<dim> &triangulation,
               unsigned int degree);

/// Share of the work that the rank with most of it has. Collective.
/// @param work by active cell index, at least 1; those of other ranks' cells are ignored
template <int dim>
double greatest_share(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                      const std::vector<unsigned int> &work);

/// Share the cells out so that all ranks have as much work. Collective.
template <int dim>
void share_out(dealii::parallel::distributed::Triangulation<dim> &triangulation,
               const std::vector<unsigned int> &work);
} // namespace stockwork
