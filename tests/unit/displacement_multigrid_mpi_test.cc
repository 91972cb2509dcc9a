// Multigrid for the displacement on locally refined meshes: the interpolation from linear elements,
// and the number of iterations, which must not grow with the mesh.

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/block_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <doctest/doctest.h>

#include "solvers/linear_solver.h"

namespace stockwork::displacement_multigrid_mpi_test
{
using namespace dealii;


namespace
{
const MPI_Comm comm = MPI_COMM_WORLD;

/// A block of rock held at x = 0 and pulled by its own weight, refined around one corner.
template <int dim>
struct Block
{
  parallel::distributed::Triangulation<dim> triangulation{comm};
  FESystem<dim> fe{FE_Q<dim>(2), dim};
  DoFHandler<dim> dof_handler{triangulation};
  AffineConstraints<double> constraints;
  LinearSystem system;

  explicit Block(const unsigned int n_cells)
  {
    GridGenerator::subdivided_hyper_cube(triangulation, n_cells, 0., 1., true);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center().norm() < 0.6)
        cell->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
    dof_handler.distribute_dofs(fe);

    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    constraints.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    VectorTools::interpolate_boundary_values(dof_handler, 0, Functions::ZeroFunction<dim>(dim),
                                             constraints);
    constraints.close();

    const std::vector<IndexSet> owned = {dof_handler.locally_owned_dofs()};
    BlockDynamicSparsityPattern pattern(std::vector<IndexSet>{relevant});
    DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
    SparsityTools::distribute_sparsity_pattern(pattern, owned[0], comm, relevant);
    system.bulk.reinit(owned, pattern, comm);
    system.residual_bulk.reinit(owned, {relevant}, comm, true);
    system.definite = true;
    assemble();
    system.displacement_hierarchy =
      make_displacement_hierarchy(StaticMappingQ1<dim>::mapping, dof_handler, constraints);
  }

  void assemble()
  {
    const double lambda = 4e9, mu = 4e9, weight = 25e3;
    FEValues<dim> fe_values(fe, QGauss<dim>(3),
                            update_values | update_gradients | update_JxW_values);
    const FEValuesExtractors::Vector u(0);
    const unsigned int n = fe.n_dofs_per_cell();
    FullMatrix<double> matrix(n, n);
    Vector<double> residual(n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        fe_values.reinit(cell);
        matrix = 0.;
        residual = 0.;
        for (const auto q : fe_values.quadrature_point_indices())
          for (unsigned int i = 0; i < n; ++i)
          {
            for (unsigned int j = 0; j < n; ++j)
              matrix(i, j) +=
                (lambda * fe_values[u].divergence(i, q) * fe_values[u].divergence(j, q) +
                 2. * mu * fe_values[u].symmetric_gradient(i, q) *
                   fe_values[u].symmetric_gradient(j, q)) *
                fe_values.JxW(q);
            residual(i) += weight * fe_values[u].value(i, q)[dim - 1] * fe_values.JxW(q);
          }
        cell->get_dof_indices(dofs);
        constraints.distribute_local_to_global(matrix, residual, dofs, system.bulk,
                                               system.residual_bulk);
      }
    system.bulk.compress(VectorOperation::add);
    system.residual_bulk.compress(VectorOperation::add);
  }

  LinearReport solve(const LinearSolverParameters::Type type,
                     TrilinosWrappers::MPI::BlockVector &dx)
  {
    LinearSolverParameters parameters;
    parameters.type = type;
    BulkStructure structure;
    structure.dim = dim;
    std::vector<double> extra;
    return make_linear_solver(parameters, structure, comm)->solve(system, {}, 1e-8, dx, extra);
  }
};
} // namespace

TEST_CASE_TEMPLATE("linear fields are interpolated exactly to free dofs",
                   Dim,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = Dim::value;
  Block<dim> block(4);
  const auto &hierarchy = block.system.displacement_hierarchy;
  CHECK(hierarchy.nodes_together);
  REQUIRE(hierarchy.from_linear);
  CHECK(hierarchy.rigid_body_modes.size() == dim * (dim + 1) / 2);

  // Rigid body modes are linear fields, so the interpolation reproduces them away from fixed dofs.
  const auto &P = *hierarchy.from_linear;
  TrilinosWrappers::MPI::Vector coarse(P.locally_owned_domain_indices(), comm),
    fine(P.locally_owned_range_indices(), comm);
  for (unsigned int i = 0; i < coarse.locally_owned_size(); ++i)
    coarse(P.locally_owned_domain_indices().nth_index_in_set(i)) =
      hierarchy.rigid_body_modes.back()[i] + 2. * hierarchy.rigid_body_modes.front()[i];
  coarse.compress(VectorOperation::insert);
  P.vmult(fine, coarse);

  // The same field at the support points: the last rotation is (-y, x) in the plane of the first
  // two axes about the centre, in units of half the size.
  std::map<types::global_dof_index, Point<dim>> points;
  DoFTools::map_dofs_to_support_points(StaticMappingQ1<dim>::mapping, block.dof_handler, points);
  std::vector<types::global_dof_index> dofs(block.fe.n_dofs_per_cell());
  unsigned int n_checked = 0;
  for (const auto &cell : block.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] > 0.4)
    {
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (fine.in_local_range(dofs[i]) && !block.constraints.is_constrained(dofs[i]))
        {
          const unsigned int direction = block.fe.system_to_component_index(i).first;
          const Point<dim> x = points.at(dofs[i]);
          const double exact = (direction == 0 ? 2. - (x[1] - 0.5) / 0.5 : 0.) +
                               (direction == 1 ? (x[0] - 0.5) / 0.5 : 0.);
          REQUIRE(fine(dofs[i]) == doctest::Approx(exact).epsilon(1e-12));
          ++n_checked;
        }
    }
  CHECK(Utilities::MPI::sum(n_checked, comm) > 100);
}

TEST_CASE_TEMPLATE("multigrid and direct solver agree, in iterations that do not grow",
                   Dim,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = Dim::value;
  std::vector<unsigned int> iterations;
  for (const unsigned int n :
       dim == 2 ? std::vector<unsigned int>{8, 32} : std::vector<unsigned int>{3, 6})
  {
    Block<dim> block(n);
    TrilinosWrappers::MPI::BlockVector x(block.system.residual_bulk), exact(x);
    const auto report = block.solve(LinearSolverParameters::Type::iterative, x);
    CHECK(report.converged);
    iterations.push_back(report.iterations);
    block.solve(LinearSolverParameters::Type::direct, exact);
    x -= exact;
    CHECK(x.l2_norm() < 1e-6 * exact.l2_norm());
  }
  MESSAGE("iterations: ", iterations[0], ", ", iterations[1]);
  CHECK(iterations[1] <= 25);
  CHECK(iterations[1] <= 1.5 * iterations[0]);
}
} // namespace stockwork::displacement_multigrid_mpi_test
