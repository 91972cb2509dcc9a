// Unknowns numbered along the rows of a lattice.
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>

#include <doctest/doctest.h>

#include "coupling/row_numbering.h"

namespace stockwork::row_numbering_test
{
using namespace dealii;

/// Where this rank's unknowns are, in the order of their numbers.
template <int dim>
std::vector<Point<dim>> places_of_own(const DoFHandler<dim> &handler)
{
  std::map<types::global_dof_index, Point<dim>> places;
  DoFTools::map_dofs_to_support_points(MappingQ1<dim>(), handler, places);
  std::vector<Point<dim>> own;
  for (const auto i : handler.locally_owned_dofs())
    own.push_back(places.at(i));
  return own;
}

template <int dim>
void check_rows(const FESystem<dim> &element)
{
  parallel::distributed::Triangulation<dim> triangulation(MPI_COMM_WORLD);
  std::vector<unsigned int> cells(dim, 3);
  cells[0] = 5;
  Point<dim> corner;
  for (unsigned int d = 0; d < dim; ++d)
    corner[d] = 0.1 * cells[d];
  GridGenerator::subdivided_hyper_rectangle(triangulation, cells, Point<dim>(), corner);
  triangulation.refine_global(1);
  DoFHandler<dim> handler(triangulation);
  handler.distribute_dofs(element);
  number_along_rows(handler);
  CHECK(handler.locally_owned_dofs().is_contiguous());
  const auto is_vertex = [](const Point<dim> &p)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(std::remainder(p[d], 0.05)) > 1e-9)
        return false;
    return true;
  };
  const std::vector<Point<dim>> own = places_of_own(handler);
  unsigned int n_out_of_order = 0, n_apart = 0, n_at_vertices = 0;
  while (n_at_vertices < own.size() && is_vertex(own[n_at_vertices]))
    ++n_at_vertices;
  for (unsigned int k = n_at_vertices; k < own.size(); ++k)
    n_out_of_order += is_vertex(own[k]);
  for (unsigned int k = 0; k + 1 < n_at_vertices; ++k)
  {
    if (k % dim == 0)
      n_apart += own[k].distance(own[k + 1]) > 1e-9;
    int d = dim - 1;
    while (d > 0 && std::abs(own[k + 1][d] - own[k][d]) < 1e-9)
      --d;
    n_out_of_order += own[k + 1][d] < own[k][d] - 1e-9;
  }
  CHECK(n_at_vertices > 0);
  CHECK(n_apart == 0);
  CHECK(n_out_of_order == 0);
}

TEST_CASE("nodes follow one another along x, rows along y, and their components stay together")
{
  check_rows(FESystem<2>(FE_Q<2>(1), 2));
  check_rows(FESystem<3>(FE_Q<3>(1), 3));
}

TEST_CASE("unknowns that are not at vertices come after those that are")
{
  check_rows(FESystem<2>(FE_Q<2>(2), 2));
}
} // namespace stockwork::row_numbering_test
