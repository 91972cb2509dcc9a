#include <doctest/doctest.h>

#include <random>

#include "solvers/dense_factor.h"
#include "stockwork/base/error.h"

namespace stockwork::dense_factor_test
{
using dealii::FullMatrix;
using dealii::LAPACKFullMatrix;
using dealii::Vector;

namespace
{
/// The unknowns of a fracture: first `n_forces` of bonds, each of which acts on all, then of each
/// piece its volume w (1e-4), its traction q and its pressure p (1e6): w = what all q and forces
/// do, q + p = 0, and flow between neighbours.
FullMatrix<double> fracture(const unsigned int n_forces, const unsigned int n_pieces)
{
  std::mt19937 engine(7);
  const auto number = [&]() { return engine() / 4294967296. - 0.5; };
  const auto w = [&](const unsigned int i) { return n_forces + 3 * i; };
  FullMatrix<double> a(n_forces + 3 * n_pieces, n_forces + 3 * n_pieces);
  const auto act = [&](const unsigned int row, const double size)
  {
    for (unsigned int j = 0; j < n_forces; ++j)
      a(row, j) = size * 1e-5 * number();
    for (unsigned int j = 0; j < n_pieces; ++j)
      a(row, w(j) + 1) = size * 1e-10 * number();
  };
  for (unsigned int i = 0; i < n_forces; ++i)
  {
    act(i, 1e5);
    a(i, i) += n_forces + n_pieces;
  }
  for (unsigned int i = 0; i < n_pieces; ++i)
  {
    act(w(i), 1.);
    a(w(i), w(i)) = 1.;
    a(w(i), w(i) + 1) += 1e-9;
    a(w(i) + 1, w(i) + 1) = a(w(i) + 1, w(i) + 2) = 1.;
    a(w(i) + 2, w(i)) = 1.;
    for (const int side : {-1, 1})
      if (i + side < n_pieces)
      {
        a(w(i) + 2, w(i) + 2) += 2e-10;
        a(w(i) + 2, w(i + side) + 2) = -2e-10;
      }
  }
  return a;
}

double size_of(const unsigned int i, const unsigned int n_forces)
{
  return i < n_forces ? 1. : (i - n_forces) % 3 == 0 ? 1e-4 : 1e6;
}
} // namespace


TEST_CASE("Of a fracture with fluid, volumes and tractions are eliminated by their few entries")
{
  constexpr unsigned int n_forces = 240, n_pieces = 20;
  const FullMatrix<double> a = fracture(n_forces, n_pieces);
  DenseFactor factor;
  factor.reinit(a);
  CHECK(factor.n_sparse() == 2 * n_pieces);

  // One and several right-hand sides with known solutions.
  const unsigned int n = a.m();
  Vector<double> x(n), b(n);
  LAPACKFullMatrix<double> columns(n, 3);
  for (unsigned int c = 0; c < 3; ++c)
  {
    for (unsigned int i = 0; i < n; ++i)
      x(i) = (1. + 0.01 * i + c) * size_of(i, n_forces);
    a.vmult(b, x);
    for (unsigned int i = 0; i < n; ++i)
      columns(i, c) = b(i);
    factor.solve(b);
    for (unsigned int i = 0; i < n; ++i)
      CHECK(b(i) == doctest::Approx(x(i)).epsilon(1e-10));
  }
  factor.solve(columns);
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int i = 0; i < n; ++i)
      CHECK(columns(i, c) ==
            doctest::Approx((1. + 0.01 * i + c) * size_of(i, n_forces)).epsilon(1e-10));
}


TEST_CASE("A diagonal entry may vanish")
{
  // The last two are known only by each other.
  constexpr unsigned int n = 262;
  FullMatrix<double> more(n, n);
  more.fill(fracture(n - 2, 0));
  more(n - 2, n - 1) = more(n - 1, n - 2) = 2.;
  more(n - 2, 0) = 3.;
  DenseFactor factor;
  factor.reinit(more);
  CHECK(factor.n_sparse() == 2);
  Vector<double> x(n), b(n);
  for (unsigned int i = 0; i < n; ++i)
    x(i) = 1. + i;
  more.vmult(b, x);
  factor.solve(b);
  for (unsigned int i = 0; i < n; ++i)
    CHECK(b(i) == doctest::Approx(x(i)).epsilon(1e-12));

  // All by few entries: nothing is left.
  FullMatrix<double> pairs(n, n);
  for (unsigned int i = 0; i < n; i += 2)
  {
    pairs(i, i) = 2.;
    pairs(i, i + 1) = 1.;
    pairs(i + 1, i) = -4.;
    pairs(i + 1, i + 1) = 3.;
  }
  factor.reinit(pairs);
  CHECK(factor.n_sparse() == n);
  pairs.vmult(b, x);
  LAPACKFullMatrix<double> column(n, 1);
  for (unsigned int i = 0; i < n; ++i)
    column(i, 0) = b(i);
  factor.solve(b);
  factor.solve(column);
  for (unsigned int i = 0; i < n; ++i)
  {
    CHECK(b(i) == doctest::Approx(x(i)).epsilon(1e-13));
    CHECK(column(i, 0) == doctest::Approx(x(i)).epsilon(1e-13));
  }
}


TEST_CASE("A matrix that is singular by its few entries is refused")
{
  FullMatrix<double> a = fracture(260, 4);
  for (unsigned int j = 0; j < a.n(); ++j)
    a(261, j) = 2. * a(264, j); // two tractions
  DenseFactor factor;
  CHECK_THROWS_AS(factor.reinit(a), SolveError);
}
} // namespace stockwork::dense_factor_test
