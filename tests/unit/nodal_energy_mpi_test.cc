// Runs on one and on two ranks.
#include <doctest/doctest.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>

#include <cmath>

#include "stockwork/mesh/nodal_energy.h"

namespace stockwork::nodal_energy_mpi_test
{
using namespace dealii;

namespace
{
/// A string between x = -1 and 1 that is held at 1 at its ends, is pulled down by a load and lies
/// on the ground d = 0 where it comes to it; the same at all heights.
struct String
{
  explicit String(const double load)
    : triangulation(MPI_COMM_WORLD)
    , fields({"height"})
  {
    GridGenerator::subdivided_hyper_rectangle(triangulation, {16, 3}, Point<2>(-1., 0.),
                                              Point<2>(1., 0.5));
    fields.follow_mesh(triangulation);
    energy.reinit(fields);
    const auto &handler = fields.dof_handler();
    FEValues<2> values(handler.get_fe(), QGauss<2>(2),
                       update_values | update_gradients | update_JxW_values);
    std::vector<types::global_dof_index> nodes(values.dofs_per_cell);
    FullMatrix<double> A(nodes.size());
    Vector<double> b(nodes.size());
    lower = fields.owned_vector();
    for (const auto &cell : handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        values.reinit(cell);
        A = 0.;
        b = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (const unsigned int i : values.dof_indices())
          {
            b(i) -= load * values.shape_value(i, q) * values.JxW(q);
            for (const unsigned int j : values.dof_indices())
              A(i, j) += values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
          }
        cell->get_dof_indices(nodes);
        energy.add(A, b, nodes);
        for (const unsigned int v : cell->vertex_indices())
          if (std::abs(cell->vertex(v)[0]) > 0.999)
            lower(cell->vertex_dof_index(v, 0)) = 1.;
      }
    lower.compress(VectorOperation::insert);
    fields.set(0, energy.minimum(lower, 1., lower));
  }

  /// Of all nodes from a curve d(x).
  template <class Curve>
  double greatest_error(const Curve &curve) const
  {
    double greatest = 0.;
    for (const auto &cell : fields.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          greatest = std::max(greatest, std::abs(fields[0](cell->vertex_dof_index(v, 0)) -
                                                 curve(cell->vertex(v)[0])));
    return Utilities::MPI::max(greatest, MPI_COMM_WORLD);
  }

  parallel::distributed::Triangulation<2> triangulation;
  NodalFields<2> fields;
  NodalEnergy<2> energy;
  NodalFields<2>::Vector lower;
};
} // namespace

// Linear elements have the exact values at their nodes where d'' is constant between them.
TEST_CASE("a string that hangs free")
{
  const double load = 1.5;
  const String string(load);
  CHECK(string.greatest_error([&](const double x) { return 1. - 0.5 * load * (1. - x * x); }) <
        1e-9);
}


TEST_CASE("a string that lies on the ground in the middle")
{
  const double load = 8.; // it comes to the ground at 1 - sqrt(2 / load) = 1/2, which is a node
  const String string(load);
  CHECK(string.greatest_error(
          [&](const double x)
          { return std::abs(x) < 0.5 ? 0. : 0.5 * load * std::pow(std::abs(x) - 0.5, 2); }) < 1e-9);
}


// Pulled upwards it is held at the upper bound; pushed down again, with the field as a lower bound,
// it does not come down: damage that never heals.
TEST_CASE("a string at the upper bound, and one that stays")
{
  String string(-1.);
  CHECK(string.greatest_error([](const double) { return 1.; }) < 1e-9);

  String low(8.), high(1.5);
  low.fields.set(0, low.energy.minimum(high.fields[0], 1., high.fields[0]));
  CHECK(low.greatest_error([](const double x) { return 1. - 0.75 * (1. - x * x); }) < 1e-9);
}
} // namespace stockwork::nodal_energy_mpi_test
