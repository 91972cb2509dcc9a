// Bonds that soften in a bulk whose factor is an earlier one's, against a dense solve.

#include "dense_system.h"

#include <doctest/doctest.h>

#include "solvers/lagged_solver.h"

namespace stockwork::lagged_solver_mpi_test
{
using namespace dense_system;

namespace
{
constexpr unsigned int n_bulk = 60;

/// A chain of springs, some of them bonds that have lost a share of their force, and a pressure
/// that opens a part of the chain. Each bond's unknown is what it has lost of its elongation.
DenseSystem make_chain(const unsigned int first_bond, const unsigned int n_bonds, const double lost)
{
  DenseSystem d = make_dense(n_bulk, 0, n_bonds + 1, 0., 0.2);
  d.n_mechanical = n_bonds;
  for (unsigned int e = n_bulk; e < d.J.m(); ++e)
    for (unsigned int i = 0; i < d.J.m(); ++i)
      d.J(e, i) = d.J(i, e) = 0.;
  constexpr double stiffness = 2.;
  for (unsigned int b = 0; b < n_bonds; ++b)
  {
    const unsigned int row = n_bulk + b, near = first_bond + 2 * b, far = near + 3;
    const double slope = lost * (1. + 0.3 * noise(b, b));
    d.J(near, near) += stiffness;
    d.J(near, far) -= stiffness;
    d.J(far, near) -= stiffness;
    d.J(far, far) += stiffness;
    d.J(near, row) = stiffness;
    d.J(far, row) = -stiffness;
    d.J(row, row) = stiffness;
    d.J(row, near) = stiffness * slope;
    d.J(row, far) = -stiffness * slope;
  }
  const unsigned int pressure = n_bulk + n_bonds;
  d.J(pressure, pressure) = -1e-3;
  d.J(20, pressure) = -0.7;
  d.J(22, pressure) = 0.7;
  d.J(pressure, 20) = -0.7;
  d.J(pressure, 22) = 0.7;
  return d;
}
} // namespace

TEST_CASE("bonds that soften are eliminated, and the factor of an earlier bulk will do")
{
  LaggedSolver solver(comm);
  SystemStamps stamps;
  std::vector<Run> runs;
  const auto check = [&](const DenseSystem &d, const bool is_new)
  {
    ++stamps.bulk_values;
    ++stamps.extra;
    runs.push_back(solve(solver, d, stamps));
    const Run &run = runs.back();
    CHECK(run.report.converged);
    CHECK(run.report.factorised == is_new);
    CHECK(run.report.iterations <= 30);
    CHECK((is_new || run.report.iterations > 1));
    CHECK(run.error < 1e-9);
  };
  check(make_chain(3, 10, 0.2), true);
  check(make_chain(3, 10, 0.4), false);
  check(make_chain(3, 14, 0.4), false); // more of them
  check(make_chain(9, 8, 0.3), false);  // others
  ++stamps.mesh;
  check(make_chain(9, 8, 0.3), true);
}

TEST_CASE("what the pattern of the bulk has no room for is not eliminated")
{
  LaggedSolver solver(comm);
  DenseSystem d = make_dense(31, 0, 10, 0., 0.4);
  d.n_mechanical = 10;
  const Run run = solve(solver, d, {});
  CHECK(run.report.converged);
  CHECK(run.error < 1e-10);
}
} // namespace stockwork::lagged_solver_mpi_test
