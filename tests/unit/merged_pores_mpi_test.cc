// Runs on one and on two ranks.
#include <deal.II/base/function_parser.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/numerics/vector_tools.h>

#include <doctest/doctest.h>

#include "biot/merged_pores.h"

namespace stockwork::merged_pores_mpi_test
{
using namespace dealii;

namespace
{
/// A unit cube of sixteen cells to a side, with a displacement and a pore pressure.
template <int dim>
struct Body
{
  using Vector = TrilinosWrappers::MPI::BlockVector;

  Body()
    : triangulation(MPI_COMM_WORLD,
                    Triangulation<dim>::limit_level_difference_at_vertices,
                    parallel::distributed::Triangulation<dim>::no_automatic_repartitioning)
    , fe(FE_Q<dim>(1), dim, FE_Q<dim>(1), 1)
    , handler(triangulation)
    , pores(rock)
  {
    ParameterHandler prm;
    Rock::declare_parameters(prm);
    prm.enter_subsection("Rock");
    prm.set("Young modulus", "10 GPa");
    prm.set("Poisson ratio", "0.2");
    prm.set("Biot coefficient", "0.7");
    prm.set("Permeability", "1e-15 m^2");
    prm.set("Biot modulus", "15 GPa");
    prm.leave_subsection();
    prm.enter_subsection("Fluid");
    prm.set("Viscosity", "1 mPa s");
    prm.leave_subsection();
    rock.parse_parameters(prm);
    GridGenerator::subdivided_hyper_cube(triangulation, 4);
    triangulation.refine_global(2);
    triangulation.repartition();
    number();
  }

  void number()
  {
    handler.distribute_dofs(fe);
    std::vector<unsigned int> blocks(dim + 1);
    blocks[dim] = 1;
    DoFRenumbering::component_wise(handler, blocks);
    const auto sizes = DoFTools::count_dofs_per_fe_block(handler, blocks);
    IndexSet seen;
    DoFTools::extract_locally_relevant_dofs(handler, seen);
    owned.reinit(handler.locally_owned_dofs().split_by_block(sizes), MPI_COMM_WORLD);
    ghosted.reinit(handler.locally_owned_dofs().split_by_block(sizes), seen.split_by_block(sizes),
                   MPI_COMM_WORLD);
    constraints.reinit(seen);
    DoFTools::make_hanging_node_constraints(handler, constraints);
    constraints.close();
  }

  void set(const std::string &pressure)
  {
    FunctionParser<dim> field(dim + 1);
    const std::string u = "1e-5*sin(3*x)*cos(2*y)", v = "1e-5*x*y*y";
    field.initialize(FunctionParser<dim>::default_variable_names(),
                     dim == 2 ? u + ";" + v + ";" + pressure : u + ";" + v + ";0;" + pressure, {});
    VectorTools::interpolate(mapping, handler, field, owned);
    ghosted = owned;
  }

  MeshView<dim> view() const
  {
    return {triangulation, handler, mapping, constraints, true};
  }

  double content() const
  {
    FEValues<dim> values(mapping, fe, QGauss<dim>(3),
                         update_values | update_gradients | update_JxW_values);
    std::vector<double> p(values.n_quadrature_points), div(p.size());
    double sum = 0.;
    for (const auto &cell : handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        values.reinit(cell);
        values[FEValuesExtractors::Scalar(dim)].get_function_values(ghosted, p);
        values[FEValuesExtractors::Vector(0)].get_function_divergences(ghosted, div);
        for (unsigned int q = 0; q < p.size(); ++q)
          sum += (0.7 * div[q] + p[q] / 15e9) * values.JxW(q);
      }
    return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }

  double greatest_pressure() const
  {
    return owned.block(1).linfty_norm();
  }

  /// Merge the cells beyond x = 1/2, and split those at x = 0.
  /// @param gives_back what their pores hold
  void merge(const bool gives_back)
  {
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      if (cell->is_locally_owned() && cell->center()[0] > 0.5)
        cell->set_coarsen_flag();
      if (cell->is_locally_owned() && cell->center()[0] < 0.25)
        cell->set_refine_flag();
    }
    triangulation.prepare_coarsening_and_refinement();
    parallel::distributed::SolutionTransfer<dim, Vector> transfer(handler);
    transfer.prepare_for_coarsening_and_refinement(ghosted);
    if (gives_back)
      pores.prepare(triangulation, view(), ghosted);
    triangulation.execute_coarsening_and_refinement();
    number();
    transfer.interpolate(owned);
    ghosted = owned;
    const Vector carried_over = ghosted;
    constraints.distribute(owned);
    ghosted = owned;
    if (!gives_back)
      return;
    pores.finish(view(), carried_over, ghosted, owned,
                 [](const auto &parent) { return parent->material_id(); });
    constraints.distribute(owned);
    ghosted = owned;
  }

  parallel::distributed::Triangulation<dim> triangulation;
  FESystem<dim> fe;
  DoFHandler<dim> handler;
  MappingQ1<dim> mapping;
  AffineConstraints<double> constraints;
  Vector owned, ghosted;
  Rock rock;
  MergedPores<dim> pores;
};

const std::string curved = "1e6*exp(-3*x)*(1+y*y)";
} // namespace

TEST_CASE_TEMPLATE("cells that are merged keep the fluid in their pores",
                   Dimension,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = Dimension::value;
  Body<dim> lost, kept;
  CHECK(kept.pores.can_take_up(kept.view()));
  lost.set(curved);
  kept.set(curved);
  const double before = kept.content(), greatest = kept.greatest_pressure();
  const auto n_before = kept.triangulation.n_global_active_cells();
  lost.merge(false);
  kept.merge(true);
  // Half of them are an eighth (a quarter in the plane) of their number, a quarter eight times
  // (four).
  CHECK(kept.triangulation.n_global_active_cells() ==
        n_before / 2 / (1 << dim) + n_before / 4 * (1 << dim) + n_before / 4);
  // Without, some of it is lost; and the pressures are shifted by little.
  CHECK(std::abs(lost.content() - before) > 1e-3 * before); // 1.6e-3
  CHECK(kept.content() == doctest::Approx(before).epsilon(5e-13));
  auto shift = kept.owned;
  shift -= lost.owned;
  CHECK(shift.block(0).linfty_norm() == 0.);
  CHECK(shift.block(1).linfty_norm() > 0.);
  CHECK(shift.block(1).linfty_norm() < 0.003 * greatest); // 0.0016
}

TEST_CASE("families stay apart where the pore pressure is far from linear")
{
  Body<2> body;
  // A bulge in the upper right corner.
  body.set("1e6*exp(-200*((x-0.8125)^2+(y-0.8125)^2))+1e3*x");
  for (const auto &cell : body.triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      cell->set_coarsen_flag();
  body.pores.keep_uneven(body.triangulation, body.view(), body.ghosted);
  for (const auto &cell : body.triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const double distance = cell->parent()->center().distance(Point<2>(0.8125, 0.8125));
      if (distance < 0.05)
        CHECK_FALSE(cell->coarsen_flag_set());
      else if (distance > 0.3)
        CHECK(cell->coarsen_flag_set());
    }
}
} // namespace stockwork::merged_pores_mpi_test
