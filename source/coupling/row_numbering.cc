#include "coupling/row_numbering.h"

#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stockwork
{
using namespace dealii;

template <int dim>
void number_along_rows(DoFHandler<dim> &handler)
{
  // Nodes of a row are in line but for rounding.
  const double unit = 1e-3 * GridTools::minimal_cell_diameter(handler.get_triangulation());
  const IndexSet &own = handler.locally_owned_dofs();
  using Place = std::array<long long, dim>; // the last axis first
  Place elsewhere;
  elsewhere.fill(std::numeric_limits<long long>::max());
  std::vector<std::pair<Place, types::global_dof_index>> order;
  for (types::global_dof_index i = 0; i < own.n_elements(); ++i)
    order.emplace_back(elsewhere, i);
  for (const auto &cell : handler.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int v : cell->vertex_indices())
      {
        Place place;
        for (unsigned int d = 0; d < dim; ++d)
          place[dim - 1 - d] = std::llround(cell->vertex(v)[d] / unit);
        for (unsigned int c = 0; c < handler.get_fe().n_dofs_per_vertex(); ++c)
          if (const auto i = cell->vertex_dof_index(v, c); own.is_element(i))
            order[own.index_within_set(i)].first = place;
      }
  std::sort(order.begin(), order.end());
  std::vector<types::global_dof_index> numbers(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    numbers[order[k].second] = own.nth_index_in_set(k);
  handler.renumber_dofs(numbers);
}


template void number_along_rows(DoFHandler<2> &);
template void number_along_rows(DoFHandler<3> &);
} // namespace stockwork
