#include <doctest/doctest.h>

#include <random>

#include "solvers/dense_solver.h"
#include "stockwork/base/error.h"

namespace stockwork::dense_solver_test
{
using dealii::FullMatrix;
using dealii::Vector;

namespace
{
using Identities = std::vector<unsigned int>;

/// A fracture of forces (1e9 Pa) and volumes (1e-6), as unsymmetric as a flowing one. The entry
/// between two unknowns depends on who they are and on `version`, where one of them is among those
/// that change (100 and above).
FullMatrix<double> matrix_of(const Identities &identities, const unsigned int version)
{
  const auto number = [](const unsigned int a, const unsigned int b, const unsigned int c)
  {
    std::mt19937 engine(a + 1000 * b + 1000000 * c);
    engine.discard(3);
    return -1. + 2. * (engine() / 4294967296.);
  };
  const auto size = [](const unsigned int i) { return i % 3 == 2 ? 1e-3 : 3e4; };
  const unsigned int n = identities.size();
  FullMatrix<double> matrix(n, n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
    {
      const unsigned int a = identities[i], b = identities[j];
      const double entry = number(a, b, std::max(a, b) >= 100 ? version : 0) + (a == b ? 12. : 0.);
      matrix(i, j) = entry * size(a) * size(b);
    }
  return matrix;
}

/// Greatest relative error of the solution of a system whose solution is known.
double error_of(const DenseSolver &solver, const FullMatrix<double> &matrix)
{
  Vector<double> x(matrix.m()), b(matrix.m());
  for (unsigned int i = 0; i < x.size(); ++i)
    x(i) = (1. + 0.1 * i) / std::sqrt(matrix(i, i));
  matrix.vmult(b, x);
  solver.solve(b);
  double error = 0.;
  for (unsigned int i = 0; i < x.size(); ++i)
    error = std::max(error, std::abs(b(i) - x(i)) / x(i));
  return error;
}

Identities range(const unsigned int begin, const unsigned int end)
{
  Identities result;
  for (unsigned int i = begin; i < end; ++i)
    result.push_back(i);
  return result;
}
} // namespace


TEST_CASE("A system with a known solution")
{
  const Identities all = range(0, 120);
  const FullMatrix<double> matrix = matrix_of(all, 1);
  DenseSolver solver;
  solver.factorise(matrix, all);
  CHECK(solver.n_kept() == 0);
  CHECK(error_of(solver, matrix) < 1e-12);

  FullMatrix<double> two(2, 2);
  two(0, 0) = 2.;
  two(0, 1) = 1.;
  two(1, 0) = -4.;
  two(1, 1) = 3.;
  solver.factorise(two, {0, 1});
  Vector<double> x(2);
  x(0) = 4.; // 2 * 1 + 2
  x(1) = 2.; // -4 * 1 + 3 * 2
  solver.solve(x);
  CHECK(x(0) == doctest::Approx(1.).epsilon(1e-14));
  CHECK(x(1) == doctest::Approx(2.).epsilon(1e-14));
}


TEST_CASE("What has not changed keeps its factor, and the solution is that of a fresh one")
{
  DenseSolver solver;
  solver.factorise(matrix_of(range(0, 120), 1), range(0, 120));
  // The second matrix shows which part stays as it is, from the third on its factor is used.
  for (unsigned int version = 2; version < 5; ++version)
  {
    // Meanwhile the fracture grows, and its unknowns change places.
    Identities identities = range(0, 118 + version);
    std::rotate(identities.begin(), identities.begin() + 5 * version, identities.end());
    const FullMatrix<double> matrix = matrix_of(identities, version);
    solver.factorise(matrix, identities);
    CHECK(solver.n_kept() == 100);
    CHECK(error_of(solver, matrix) < 1e-12);

    DenseSolver fresh;
    fresh.factorise(matrix, identities);
    CHECK(fresh.n_kept() == 0);
    Vector<double> x(matrix.m()), y(matrix.m());
    for (unsigned int i = 0; i < x.size(); ++i)
      x(i) = y(i) = std::sqrt(matrix(i, i)) * std::cos(3. * i);
    solver.solve(x);
    fresh.solve(y);
    for (unsigned int i = 0; i < x.size(); ++i)
      CHECK(x(i) == doctest::Approx(y(i)).epsilon(1e-10));
  }

  // A kept unknown is gone, another has changed.
  for (const auto &identities : {range(1, 121), range(2, 122)})
  {
    FullMatrix<double> matrix = matrix_of(identities, 7 + identities[0]);
    matrix(3, 4) *= 1.5;
    solver.factorise(matrix, identities);
    CHECK(solver.n_kept() < 100);
    CHECK(error_of(solver, matrix) < 1e-12);
  }
  solver.forget();
  const FullMatrix<double> matrix = matrix_of(range(0, 120), 8);
  solver.factorise(matrix, range(0, 120));
  CHECK(solver.n_kept() == 0);
  CHECK(error_of(solver, matrix) < 1e-12);
}


TEST_CASE("Where a kept factor was of no use, the next is waited for")
{
  const Identities all = range(0, 120);
  DenseSolver solver;
  const auto n_kept = [&](const double factor)
  {
    FullMatrix<double> matrix = matrix_of(all, 1);
    matrix *= factor;
    solver.factorise(matrix, all);
    CHECK(error_of(solver, matrix) < 1e-12);
    return solver.n_kept();
  };
  n_kept(1.);
  CHECK(n_kept(1.) > 0);  // chosen,
  CHECK(n_kept(2.) == 0); // of no use:
  CHECK(n_kept(2.) == 0); // wait for one,
  CHECK(n_kept(2.) > 0);  // chosen,
  CHECK(n_kept(3.) == 0); // of no use: wait for two,
  CHECK(n_kept(3.) == 0);
  CHECK(n_kept(3.) == 0);
  CHECK(n_kept(3.) > 0);  // chosen,
  CHECK(n_kept(3.) > 0);  // of use:
  CHECK(n_kept(4.) == 0); // nothing is the same as in the last,
  CHECK(n_kept(4.) == 0); // which was of no use: wait for one
  CHECK(n_kept(4.) == 0);
  CHECK(n_kept(4.) > 0);
  CHECK(n_kept(5.) == 0); // of no use: wait for two, also where all is forgotten.
  solver.forget();
  CHECK(n_kept(5.) == 0);
  CHECK(n_kept(5.) == 0);
  CHECK(n_kept(5.) > 0);
}


TEST_CASE("Unknowns without identity are not kept")
{
  const Identities nobody(120, DenseSolver::anonymous);
  const FullMatrix<double> matrix = matrix_of(range(0, 120), 1);
  DenseSolver solver;
  for (unsigned int time = 0; time < 3; ++time)
  {
    solver.factorise(matrix, nobody);
    CHECK(solver.n_kept() == 0);
    CHECK(error_of(solver, matrix) < 1e-12);
  }
}


TEST_CASE("A singular matrix is refused, and forgotten")
{
  const Identities all = range(0, 120);
  const FullMatrix<double> good = matrix_of(all, 1);
  DenseSolver solver;

  FullMatrix<double> bad = good;
  for (unsigned int j = 0; j < bad.m(); ++j)
    bad(7, j) = 0.;
  CHECK_THROWS_AS(solver.factorise(bad, all), SolveError);

  // Two rows in proportion: rounding errors stand where the pivot should be zero.
  bad = good;
  for (unsigned int j = 0; j < bad.m(); ++j)
    bad(110, j) = bad(113, j) / 3.;
  CHECK_THROWS_AS(solver.factorise(bad, all), SolveError);
  CHECK_THROWS_AS(solver.factorise(bad, all), SolveError);

  bad = good;
  bad(3, 4) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(solver.factorise(bad, all), SolveError);

  for (unsigned int time = 0; time < 2; ++time)
  {
    solver.factorise(good, all);
    CHECK(error_of(solver, good) < 1e-12);
  }
}


TEST_CASE("The part that stays may be singular by itself")
{
  // As a force that nothing resists but one of the unknowns that change.
  const Identities all = range(0, 120);
  DenseSolver solver;
  for (unsigned int version = 1; version < 4; ++version)
  {
    FullMatrix<double> matrix = matrix_of(all, version);
    for (unsigned int j = 0; j < 100; ++j)
      matrix(8, j) = matrix(j, 8) = 0.;
    matrix(8, 117) = matrix(117, 8) = 12. * 3e4 * 3e4;
    solver.factorise(matrix, all);
    CHECK(solver.n_kept() < 100);

    Vector<double> x(120), b(120);
    for (unsigned int i = 0; i < 120; ++i)
      x(i) = all[i] % 3 == 2 ? 1e3 : 1. / 3e4;
    matrix.vmult(b, x);
    solver.solve(b);
    for (unsigned int i = 0; i < 120; ++i)
      CHECK(b(i) == doctest::Approx(x(i)).epsilon(1e-9));
  }
}
} // namespace stockwork::dense_solver_test
