#include "mesh/partition.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Whether these are coarse cells and each rank has its even part of them, as when they are made.
/// (Of refined ones, p4est keeps those of a parent together.) Collective.
template <int dim>
bool is_even(const parallel::distributed::Triangulation<dim> &triangulation)
{
  const MPI_Comm communicator = triangulation.get_communicator();
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator),
                     rank = Utilities::MPI::this_mpi_process(communicator);
  const auto first = [&](const unsigned int of_rank)
  { return triangulation.n_global_active_cells() * of_rank / n_ranks; };
  const bool mine = triangulation.n_locally_owned_active_cells() == first(rank + 1) - first(rank);
  return triangulation.n_global_levels() == 1 &&
         Utilities::MPI::min(mine ? 1 : 0, communicator) == 1;
}
} // namespace


template <int dim>
void share_out(parallel::distributed::Triangulation<dim> &triangulation, const unsigned int degree)
{
  if (Utilities::MPI::n_mpi_processes(triangulation.get_communicator()) == 1)
    return;
  if (!is_even(triangulation)) // to make the mesh anew takes long
    triangulation.repartition();
  if (dim < 3)
    return;

  // A cell weighs what cells of its rank own on average, of the nodes. Hanging ones cost nothing.
  unsigned int weight;
  {
    DoFHandler<dim> nodes(triangulation);
    nodes.distribute_dofs(FE_Q<dim>(degree));
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(nodes, relevant);
    AffineConstraints<double> hanging(relevant);
    DoFTools::make_hanging_node_constraints(nodes, hanging);
    const IndexSet owned = nodes.locally_owned_dofs();
    const auto n_owned =
      std::count_if(owned.begin(), owned.end(),
                    [&hanging](const auto node) { return !hanging.is_constrained(node); });
    weight = static_cast<unsigned int>(
      std::lround(1000. * n_owned / std::max(1u, triangulation.n_locally_owned_active_cells())));
  }
  const auto connection =
    triangulation.signals.weight.connect([weight](const auto &, const auto) { return weight; });
  triangulation.repartition();
  connection.disconnect();
}

template <int dim>
double greatest_share(const parallel::distributed::Triangulation<dim> &triangulation,
                      const std::vector<unsigned int> &work)
{
  double mine = 0.;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      mine += work[cell->active_cell_index()];
  const auto all = Utilities::MPI::min_max_avg(mine, triangulation.get_communicator());
  return all.max / all.sum;
}


template <int dim>
void share_out(parallel::distributed::Triangulation<dim> &triangulation,
               const std::vector<unsigned int> &work)
{
  const auto connection = triangulation.signals.weight.connect(
    [&work](const auto &cell, const auto) { return work[cell->active_cell_index()]; });
  triangulation.repartition();
  connection.disconnect();
}


template void share_out(parallel::distributed::Triangulation<2> &, unsigned int);
template void share_out(parallel::distributed::Triangulation<3> &, unsigned int);
template double greatest_share(const parallel::distributed::Triangulation<2> &,
                               const std::vector<unsigned int> &);
template double greatest_share(const parallel::distributed::Triangulation<3> &,
                               const std::vector<unsigned int> &);
template void share_out(parallel::distributed::Triangulation<2> &,
                        const std::vector<unsigned int> &);
template void share_out(parallel::distributed::Triangulation<3> &,
                        const std::vector<unsigned int> &);
} // namespace stockwork
