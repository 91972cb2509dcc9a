// Cells shared out among the ranks by the work that they are.
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>

#include <doctest/doctest.h>

#include "mesh/partition.h"

namespace stockwork::partition_test
{
using namespace dealii;

TEST_CASE("Coarse cells stay where they were made, refined ones are shared out anew")
{
  parallel::distributed::Triangulation<2> triangulation(
    MPI_COMM_WORLD, Triangulation<2>::limit_level_difference_at_vertices,
    parallel::distributed::Triangulation<2>::no_automatic_repartitioning);
  GridGenerator::subdivided_hyper_rectangle(triangulation, {7, 9}, {0., 0.}, {7., 9.});
  unsigned int n_times = 0;
  triangulation.signals.post_distributed_repartition.connect([&n_times]() { ++n_times; });
  const auto distance_from_even = [&]()
  {
    const double even = static_cast<double>(triangulation.n_global_active_cells()) /
                        Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    return Utilities::MPI::max(std::abs(triangulation.n_locally_owned_active_cells() - even),
                               MPI_COMM_WORLD);
  };
  share_out(triangulation, 1);
  CHECK(n_times == 0);
  CHECK(distance_from_even() < 1.);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[1] < 3.)
      cell->set_refine_flag();
  triangulation.execute_coarsening_and_refinement();
  share_out(triangulation, 1);
  CHECK(distance_from_even() <= 4.); // children of a parent stay together
}

TEST_CASE("ranks have as many unknowns of the elements at hand in three dimensions")
{
  for (const unsigned int degree : {1, 2})
  {
    parallel::distributed::Triangulation<3> triangulation(
      MPI_COMM_WORLD, Triangulation<3>::limit_level_difference_at_vertices,
      parallel::distributed::Triangulation<3>::no_automatic_repartitioning);
    GridGenerator::subdivided_hyper_cube(triangulation, 8);
    triangulation.refine_global(1);
    share_out(triangulation, degree);
    DoFHandler<3> nodes(triangulation);
    nodes.distribute_dofs(FE_Q<3>(degree));
    const double most = Utilities::MPI::max(nodes.n_locally_owned_dofs(), MPI_COMM_WORLD);
    // On two ranks 1.013 and 1.005 of the even share, for children of a parent stay together; by
    // unknowns of the other elements 1.036 and 1.020, by cells 1.059 and 1.030.
    const double even =
      static_cast<double>(nodes.n_dofs()) / Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    CHECK(most <= 1.016 * even);
  }
}

TEST_CASE("ranks have as much work as one another where some cells are more of it")
{
  parallel::distributed::Triangulation<3> triangulation(
    MPI_COMM_WORLD, Triangulation<3>::limit_level_difference_at_vertices,
    parallel::distributed::Triangulation<3>::no_automatic_repartitioning);
  GridGenerator::subdivided_hyper_cube(triangulation, 4);
  triangulation.refine_global(1);
  triangulation.repartition();
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const auto work = [&triangulation]()
  {
    std::vector<unsigned int> of_cells(triangulation.n_active_cells(), 1);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center()[2] < 0.25)
        of_cells[cell->active_cell_index()] = 9;
    return of_cells;
  };
  // A quarter of the cells is three quarters of the work.
  const double before = greatest_share(triangulation, work());
  share_out(triangulation, work());
  const double after = greatest_share(triangulation, work());
  CHECK(triangulation.n_global_active_cells() == 512);
  CHECK(after >= 1. / n_ranks);
  // Eight cells of one parent stay together.
  CHECK(after - 1. / n_ranks <= 8. * 9. / (128. * 9. + 384.));
  if (n_ranks > 1)
    CHECK(before > 1.2 / n_ranks);
}
} // namespace stockwork::partition_test
