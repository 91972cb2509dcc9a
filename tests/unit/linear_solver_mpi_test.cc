// The linear solvers against a dense solve of the same small system, on any number of ranks.

#include "dense_system.h"

#include <doctest/doctest.h>

#include "stockwork/base/error.h"

#include <cmath>

namespace stockwork::linear_solver_mpi_test
{
using namespace dense_system;

namespace
{
std::unique_ptr<LinearSolver> make(const LinearSolverParameters::Type type)
{
  LinearSolverParameters parameters;
  parameters.type = type;
  return make_linear_solver(parameters, {}, comm);
}

using Type = LinearSolverParameters::Type;
} // namespace

TEST_CASE("the direct solver agrees with a dense solve")
{
  for (const unsigned int n_p : {0u, 13u})
    for (const unsigned int n_extra : {0u, 6u})
      for (const double decades : {0., 10.})
        for (const double asymmetry : {0., 0.4})
        {
          CAPTURE(n_p);
          CAPTURE(n_extra);
          CAPTURE(decades);
          CAPTURE(asymmetry);
          auto solver = make(Type::direct);
          const auto d = make_dense(31, n_p, n_extra, decades, asymmetry);
          const auto run = solve(*solver, d, {});
          CHECK(run.report.converged);
          CHECK(run.report.factorised);
          CHECK(run.error < 1e-10);
        }
}

TEST_CASE("a factor is reused when nothing has changed, and never when something has")
{
  auto solver = make(Type::direct);
  auto d = make_dense(31, 13, 6);
  SystemStamps stamps;
  CHECK(solve(*solver, d, stamps).report.factorised);

  SUBCASE("only the right-hand side is new")
  {
    d.R *= -2.;
    const auto run = solve(*solver, d, stamps);
    CHECK_FALSE(run.report.factorised);
    CHECK(run.error < 1e-10);
  }
  SUBCASE("a value is new and the stamp says so")
  {
    d.J(3, 3) *= 1.5;
    ++stamps.bulk_values;
    const auto run = solve(*solver, d, stamps);
    CHECK(run.report.factorised);
    CHECK(run.error < 1e-10);
  }
  SUBCASE("a value is new and the stamp does not say so")
  {
    d.J(3, 3) *= 1.5;
    CHECK(solve(*solver, d, stamps).error < 1e-10);
  }
  SUBCASE("an extra entry is new")
  {
    d.J(45, 45) += 0.7;
    const auto run = solve(*solver, d, stamps);
    CHECK(run.error < 1e-10);
  }
  SUBCASE("the fracture has grown")
  {
    ++stamps.extra;
    CHECK(solve(*solver, make_dense(31, 13, 10), stamps).error < 1e-10);
  }
  SUBCASE("the mesh is new")
  {
    ++stamps.mesh;
    ++stamps.bulk_values;
    CHECK(solve(*solver, make_dense(40, 11, 6), stamps).error < 1e-10);
  }
}

/// Of the bulk and of the border: bonds of peridynamics take rows over, flow has no potential.
const std::vector<std::pair<double, double>> asymmetries = {{0., 0.}, {0., 0.4}, {0.4, 0.4}};

TEST_CASE("the bordered solver agrees with a dense solve")
{
  for (const unsigned int n_p : {0u, 13u})
    for (const unsigned int n_extra : {0u, 6u})
      for (const auto &[bulk, border] : asymmetries)
      {
        CAPTURE(n_p);
        CAPTURE(n_extra);
        CAPTURE(bulk);
        CAPTURE(border);
        auto solver = make(Type::bordered);
        const auto run = solve(*solver, make_dense(31, n_p, n_extra, 0., bulk, border), {});
        CHECK(run.report.converged);
        CHECK(run.report.factorised);
        CHECK(run.error < 1e-10);
      }
}

TEST_CASE("the bordered solver keeps the rock's factor while the fracture changes")
{
  for (const auto &[bulk, border] : asymmetries)
  {
    CAPTURE(bulk);
    CAPTURE(border);
    auto solver = make(Type::bordered);
    auto d = make_dense(31, 0, 6, 0., bulk, border);
    SystemStamps stamps;
    CHECK(solve(*solver, d, stamps).report.factorised);

    // Cohesive stiffness and flow change in every iteration.
    d.J(31, 31) += 2.;
    d.J(33, 32) = d.J(32, 33) = 0.3;
    d.R *= -0.5;
    auto run = solve(*solver, d, stamps);
    CHECK_FALSE(run.report.factorised);
    CHECK(run.error < 1e-10);

    // The load of the rock is in balance after the first iteration.
    for (unsigned int i = 0; i < 31; ++i)
      d.R(i) = 0.;
    CHECK(solve(*solver, d, stamps).error < 1e-10);

    // The fracture grows, its unknowns renumbered.
    ++stamps.extra;
    auto grown = make_dense(31, 0, 10, 0., bulk, border);
    std::swap(grown.R(31), grown.R(37));
    for (unsigned int i = 0; i < 41; ++i)
      std::swap(grown.J(i, 31), grown.J(i, 37));
    for (unsigned int i = 0; i < 41; ++i)
      std::swap(grown.J(31, i), grown.J(37, i));
    run = solve(*solver, grown, stamps);
    CHECK_FALSE(run.report.factorised);
    CHECK(run.error < 1e-10);

    // And shrinks again, as after a rejected step.
    CHECK(solve(*solver, d, stamps).error < 1e-10);

    // A border entry changes without notice, and so does the rock.
    for (unsigned int i = 0; i < 31; ++i)
      if (d.J(31, i) != 0.)
      {
        d.J(31, i) *= 1.2;
        d.J(i, 31) *= 1.2;
      }
    CHECK(solve(*solver, d, stamps).error < 1e-10);
    // The tangent stiffness of a bond: its row alone, of another one, and but for one entry.
    for (unsigned int i = 0, n_seen = 0; i < 31; ++i)
    {
      d.J(32, i) *= -3.;
      d.J(33, i) *= n_seen == 0 ? 2. : 0.7;
      n_seen += d.J(33, i) != 0.;
    }
    run = solve(*solver, d, stamps);
    CHECK_FALSE(run.report.factorised);
    CHECK(run.error < 1e-10);
    d.J(3, 3) *= 1.5;
    CHECK(solve(*solver, d, stamps).error < 1e-10);
    ++stamps.mesh;
    CHECK(solve(*solver, make_dense(40, 0, 6, 0., bulk, border), stamps).error < 1e-10);
  }
}

TEST_CASE(
  "the bordered solver keeps the factor of an unsymmetric rock while a few of its rows change")
{
  auto solver = make(Type::bordered);
  auto d = make_dense(400, 0, 6, 0., 0.3);
  SystemStamps stamps;
  CHECK(solve(*solver, d, stamps).report.factorised);
  const auto check = [&](const bool factorised)
  {
    const auto run = solve(*solver, d, stamps);
    CHECK(run.report.factorised == factorised);
    CHECK(run.error < 1e-10);
  };

  // Bonds break; with an iteration in which nothing but the fracture changes; and again.
  ++stamps.bulk_values;
  for (const unsigned int i : {3, 4, 30})
    for (const unsigned int j : {i - 1, i, i + 1})
      d.J(i, j) *= 0.7;
  check(false);
  d.J(400, 400) += 2.;
  check(false);
  ++stamps.bulk_values;
  d.J(4, 5) *= 1.5;
  d.J(60, 60) += 1.;
  check(false);

  // The fracture has no unknowns any more, the rock is as it was, too many rows change.
  auto dry = make_dense(400, 0, 0, 0., 0.3);
  d = dry;
  ++stamps.bulk_values;
  check(false);
  d.J(7, 7) += 1.;
  ++stamps.bulk_values;
  check(false);
  for (unsigned int i = 0; i < 400; ++i)
    d.J(i, i) += 1.;
  ++stamps.bulk_values;
  check(true);
}

TEST_CASE("the bordered solver condenses a rock in equilibrium, and the rock follows in one go")
{
  auto solver = make(Type::bordered);
  auto d = make_dense(31, 0, 6, 0., 0., 0.4);
  SystemStamps stamps;
  const auto condense = [&](const LinearSystem &system)
  { return solver->condense(system, stamps, 1e-6); };
  CHECK(condense(*distribute(d)) == nullptr); // there is no factor
  solve(*solver, d, stamps);
  CHECK(condense(*distribute(d)) == nullptr); // the rock is not in equilibrium
  for (unsigned int i = 0; i < 31; ++i)
    d.R(i) = 0.;

  // Newton's method: all of the first system's solution, and half of the second's.
  const auto system = distribute(d);
  const auto condensed = condense(*system);
  REQUIRE(condensed != nullptr);
  std::vector<double> dx, reaction, sum(6, 0.);
  Vector<double> x(37), r(d.R);
  for (const double step : {1., 0.5})
  {
    CAPTURE(step);
    const auto now = distribute(d);
    now->residual_extra.assign(r.begin() + 31, r.end());
    CHECK(condensed->solve(*now, 1e-12, dx, reaction) <= 1e-12);
    DenseSystem same = d;
    same.R = r;
    const Vector<double> exact = same.solution();
    for (unsigned int e = 0; e < 6; ++e)
    {
      CHECK(std::abs(dx[e] - exact(31 + e)) < 1e-10 * exact.linfty_norm());
      double of_rock = 0.;
      for (unsigned int i = 0; i < 31; ++i)
        of_rock += d.J(31 + e, i) * exact(i);
      CHECK(std::abs(reaction[e] - of_rock) < 1e-10 * exact.linfty_norm());
      sum[e] += step * dx[e];
    }
    x.add(step, exact);
    // A law of the fracture: D is another in the next iteration.
    d.J(31, 31) += 2.;
    d.J(33, 32) = d.J(32, 33) = 0.3;
    d.J.vmult(r, x);
    r += d.R;
    for (unsigned int i = 0; i < 31; ++i)
      r(i) = 0.;
  }
  TrilinosWrappers::MPI::BlockVector bulk(system->residual_bulk);
  condensed->recover_bulk(*system, sum, bulk);
  for (unsigned int i = 0; i < 31; ++i)
    if (bulk.block(0).in_local_range(i))
      CHECK(std::abs(bulk.block(0)(i) - x(i)) < 1e-10 * x.linfty_norm());

  // Another rock, and one that is not definite, are not condensed.
  ++stamps.bulk_values;
  CHECK(condense(*system) == nullptr);
  d = make_dense(31, 0, 6, 0., 0.4, 0.4);
  ++stamps.mesh;
  solve(*solver, d, stamps);
  for (unsigned int i = 0; i < 31; ++i)
    d.R(i) = 0.;
  CHECK(condense(*distribute(d)) == nullptr);
}

TEST_CASE("auto takes what is there")
{
  auto solver = make(Type::automatic);
  SystemStamps stamps;
  CHECK(solve(*solver, make_dense(31, 0, 0), stamps).error < 1e-10);
  ++stamps.extra;
  CHECK_FALSE(solve(*solver, make_dense(31, 0, 6), stamps).report.factorised);
  ++stamps.mesh;
  CHECK(solve(*solver, make_dense(31, 13, 6), stamps).error < 1e-10);
  CHECK(solver->choices() == "3 by a lasting factor of the rock (bordered)");
}

TEST_CASE("auto tries the rock's factor again after one rock that has none")
{
  auto solver = make(Type::automatic);
  SystemStamps stamps;
  auto d = make_dense(31, 13, 6);
  const auto good = d;
  // Nothing but the fracture, unknown 46, holds the last pressure.
  for (unsigned int i = 0; i < 50; ++i)
    d.J(i, 43) = d.J(43, i) = 0.;
  d.J(43, 46) = d.J(46, 43) = 1.;
  const auto bad = d;
  const auto solve_twice = [&](const DenseSystem &system)
  {
    ++stamps.mesh; // or a few rows that change would be borne
    ++stamps.bulk_values;
    auto changed = system;
    CHECK(solve(*solver, changed, stamps).error < 1e-10);
    changed.J(44, 44) += 2.;
    const auto run = solve(*solver, changed, stamps);
    CHECK(run.error < 1e-10);
    return run.report.factorised; // all of it, not the rock alone
  };
  CHECK_FALSE(solve_twice(good));
  CHECK(solve_twice(bad));
  CHECK_FALSE(solve_twice(good));

  // Where all together is singular, nothing can be said about the rock.
  auto singular = bad;
  singular.J(43, 46) = singular.J(46, 43) = 0.;
  for (unsigned int k = 0; k < 4; ++k)
  {
    ++stamps.mesh;
    ++stamps.bulk_values;
    CHECK_THROWS_AS(solve(*solver, singular, stamps), SolveError);
  }
  CHECK_FALSE(solve_twice(good));

  for (unsigned int k = 0; k < 3; ++k)
    CHECK(solve_twice(bad));
  CHECK(solve_twice(good)); // it is not tried any more
}

TEST_CASE("the iterative solver converges, with a fracture and where units differ")
{
  for (const unsigned int n_p : {0u, 13u})
    for (const double decades : {0., 10.})
    {
      CAPTURE(n_p);
      CAPTURE(decades);
      std::vector<Run> runs;
      auto solver = make(Type::iterative);
      SystemStamps stamps;
      for (const unsigned int n_extra : {0u, 6u, 10u})
      {
        CAPTURE(n_extra);
        ++stamps.extra;
        runs.push_back(solve(*solver, make_dense(31, n_p, n_extra, decades), stamps));
        const Run &run = runs.back();
        CHECK(run.report.converged);
        CHECK(run.report.factorised == (n_extra == 0));
        CHECK(run.error < 1e-10);
      }
    }
}

TEST_CASE("many extra unknowns: the sparse block follows a fracture that grows and changes")
{
  auto solver = make(Type::iterative);
  SystemStamps stamps;
  auto d = make_dense(400, 0, 60, 0., 0., 0.4);
  std::vector<Run> runs; // multigrid refers to the matrix of the first
  const auto check = [&]()
  {
    runs.push_back(solve(*solver, d, stamps));
    const Run &run = runs.back();
    CHECK(run.report.converged);
    CHECK(run.report.iterations <= 30); // of 460 or 480, to twelve digits
    CHECK(run.error < 1e-9);
  };
  check();
  d.J(400, 400) += 2.;
  d.J(403, 402) = d.J(402, 403) = 0.3;
  check();
  ++stamps.extra;
  d = make_dense(400, 0, 80, 0., 0., 0.4);
  check();
  // A border changes without notice, then the rock with notice.
  for (unsigned int i = 0; i < 400; ++i)
    d.J(402, i) *= 1.2;
  check();
  ++stamps.displacement_values;
  ++stamps.bulk_values;
  for (unsigned int i = 0; i < 400; ++i)
    d.J(i, i) *= 1.5;
  check();
}

TEST_CASE("patches that hold all of the rock make the sparse block exact, but for small entries")
{
  SystemStamps stamps;
  const auto run = solve(*make(Type::iterative), make_dense(7, 0, 10, 0., 0., 0.4), stamps),
             rock = solve(*make(Type::iterative), make_dense(7, 0, 0), stamps);
  CHECK(run.error < 1e-10);
  CHECK(run.report.iterations <= rock.report.iterations + 6);
}

TEST_CASE("a fracture that is large beside its rock has no dense block")
{
  for (const unsigned int n_extra : {6u, 60u})
  {
    CAPTURE(n_extra);
    auto solver = make(Type::automatic);
    auto d = make_dense(31, 0, n_extra, 0., 0., 0.4);
    const SystemStamps stamps;
    const auto run = solve(*solver, d, stamps);
    CHECK(run.report.converged);
    CHECK(run.error < 1e-10);
    for (unsigned int i = 0; i < d.n_u; ++i)
      d.R(i) = 0.;
    CHECK((solver->condense(*distribute(d), stamps, 1e-6) != nullptr) == (n_extra == 6));
    CHECK(solver->choices() == (n_extra == 6 ? "2 by a lasting factor of the rock (bordered)"
                                             : "1 by a factor of everything (direct)"));
  }
}

TEST_CASE("a singular matrix is an error that helps")
{
  auto solver = make(Type::direct);
  auto d = make_dense(31, 0, 0);
  // A body that nothing holds: rows sum to zero.
  for (unsigned int i = 0; i < 31; ++i)
  {
    d.J(i, i) = 0.;
    for (unsigned int j = 0; j < 31; ++j)
      if (j != i && d.J(i, j) != 0.)
      {
        d.J(i, j) = -std::abs(d.J(i, j));
        d.J(i, i) -= d.J(i, j);
      }
  }
  const auto system = distribute(d);
  TrilinosWrappers::MPI::BlockVector bulk(system->residual_bulk);
  std::vector<double> extra;
  CHECK_THROWS_WITH_AS(solver->solve(*system, {}, 1e-10, bulk, extra),
                       doctest::Contains("boundary condition"), SolveError);
}
} // namespace stockwork::linear_solver_mpi_test
