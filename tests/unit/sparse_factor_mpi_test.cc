// Cholesky's factor by substructures against the known solution and MUMPS, on any number of ranks.

#include <deal.II/base/mpi.h>

#include <doctest/doctest.h>

#include "solvers/mumps.h"
#include "solvers/substructured_cholesky.h"
#include "stockwork/base/error.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace stockwork::sparse_factor_mpi_test
{
namespace
{
const MPI_Comm comm = MPI_COMM_WORLD;

int rank()
{
  return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(comm));
}

int n_ranks()
{
  return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(comm));
}

/// Nine-point stencil on a square of nodes, positive definite, the lower triangle; each rank has
/// the rows that are its own. Where `cut` says so, nodes of different ranks are not coupled.
struct Grid
{
  static constexpr int side = 14;
  std::function<int(int)> owner;
  bool cut = false;
  std::vector<int> rows, columns;

  static int size()
  {
    return side * side;
  }

  static double entry(const int i, const int j, const double shift)
  {
    return i == j ? 9. + shift : -1. + 0.3 * std::sin(3. * i + 5. * j);
  }

  template <class Function>
  void for_each_entry(const Function &use) const
  {
    for (int i = 0; i < size(); ++i)
      for (int j = 0; j <= i; ++j)
        if (std::abs(i / side - j / side) <= 1 && std::abs(i % side - j % side) <= 1 &&
            !(cut && owner(i) != owner(j)))
          use(i, j);
  }

  Grid(std::function<int(int)> owner, const bool cut = false)
    : owner(std::move(owner))
    , cut(cut)
  {
    for_each_entry(
      [&](const int i, const int j)
      {
        if (this->owner(i) != rank())
          return;
        rows.push_back(i + 1);
        columns.push_back(j + 1);
      });
  }

  std::vector<double> values(const double shift) const
  {
    std::vector<double> result;
    for (std::size_t k = 0; k < rows.size(); ++k)
      result.push_back(entry(rows[k] - 1, columns[k] - 1, shift));
    return result;
  }

  /// A times known solutions, on rank 0.
  std::vector<double> right_hand_sides(const int n_columns, const double shift) const
  {
    std::vector<double> b(rank() == 0 ? size() * n_columns : 0, 0.);
    if (rank() == 0)
      for (int c = 0; c < n_columns; ++c)
        for_each_entry(
          [&](const int i, const int j)
          {
            b[c * size() + i] += entry(i, j, shift) * solution(j, c);
            if (i != j)
              b[c * size() + j] += entry(i, j, shift) * solution(i, c);
          });
    return b;
  }

  static double solution(const int i, const int c)
  {
    return std::cos(i + 2. * c) + c;
  }
};

double error(const std::vector<double> &x)
{
  double worst = 0.;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    const double wrong = std::abs(x[k] - Grid::solution(static_cast<int>(k) % Grid::size(),
                                                        static_cast<int>(k) / Grid::size()));
    worst = wrong <= worst ? worst : wrong; // takes what is not a number
  }
  return dealii::Utilities::MPI::max(worst, comm);
}

void check(const Grid &grid)
{
  SubstructuredCholesky factor(comm);
  factor.analyse(Grid::size(), grid.rows, grid.columns);
  CHECK(factor.size() == Grid::size());
  // The ordering is kept for other values.
  for (const double shift : {0., 2.5})
  {
    std::vector<double> values = grid.values(shift);
    factor.factorise(values);
    for (const int n_columns : {1, 3})
    {
      std::vector<double> x = grid.right_hand_sides(n_columns, shift);
      factor.solve(x, n_columns);
      CHECK(error(x) < 1e-12);
    }
    // Not the solution of another matrix.
    std::vector<double> x = grid.right_hand_sides(1, shift + 0.1);
    factor.solve(x);
    CHECK(error(x) > 1e-4);
  }
  // And for another pattern anew.
  const Grid other([](int) { return 0; });
  factor.analyse(Grid::size(), other.rows, other.columns);
  std::vector<double> values = other.values(1.), x = other.right_hand_sides(1, 1.);
  factor.factorise(values);
  factor.solve(x);
  CHECK(error(x) < 1e-12);
}
} // namespace


TEST_CASE("Substructures: strips of nodes")
{
  check(Grid([](const int i) { return i * n_ranks() / Grid::size(); }));
}


TEST_CASE("Substructures: strips given from above")
{
  check(Grid([](const int i) { return n_ranks() - 1 - i * n_ranks() / Grid::size(); }));
}


TEST_CASE("Substructures: neighbours given by different ranks")
{
  check(Grid([](const int i) { return i % n_ranks(); }));
}


TEST_CASE("Substructures: ranks that give nothing, or little")
{
  check(Grid([](const int) { return n_ranks() - 1; }));
  check(Grid([](const int i) { return i % 37 == 5 ? n_ranks() - 1 : 0; }));
}


TEST_CASE("Substructures: parts that are not coupled")
{
  check(Grid([](const int i) { return i * n_ranks() / Grid::size(); }, true));
}


TEST_CASE("Substructures: columns with few entries, beside MUMPS")
{
  const Grid grid([](const int i) { return i * n_ranks() / Grid::size(); });
  std::vector<int> starts{1}, rows;
  std::vector<double> sparse_values;
  for (int c = 0; c < 5; ++c)
  {
    for (int k = 0; k <= c; ++k)
    {
      rows.push_back((c * 41 + k * 17) % Grid::size() + 1);
      sparse_values.push_back(1. + k);
    }
    starts.push_back(static_cast<int>(rows.size()) + 1);
  }
  std::vector<std::vector<double>> solutions;
  SubstructuredCholesky substructured(comm);
  Mumps mumps(comm, Mumps::Kind::definite);
  for (SparseFactor *factor :
       {static_cast<SparseFactor *>(&substructured), static_cast<SparseFactor *>(&mumps)})
  {
    std::vector<double> values = grid.values(0.);
    factor->analyse(Grid::size(), grid.rows, grid.columns);
    factor->factorise(values);
    solutions.emplace_back(rank() == 0 ? 5 * Grid::size() : 0, 7.);
    factor->solve_sparse(starts, rows, sparse_values, solutions.back());
  }
  double worst = 0., greatest = 0.;
  for (std::size_t k = 0; k < solutions[0].size(); ++k)
  {
    worst = std::max(worst, std::abs(solutions[0][k] - solutions[1][k]));
    greatest = std::max(greatest, std::abs(solutions[0][k]));
  }
  CHECK(worst <= 1e-13 * greatest);
}


TEST_CASE("Substructures: where one rank's part is not definite, all ranks are told")
{
  const Grid grid([](const int i) { return i * n_ranks() / Grid::size(); });
  SubstructuredCholesky factor(comm);
  factor.analyse(Grid::size(), grid.rows, grid.columns);
  std::vector<double> values = grid.values(rank() == 0 ? -20. : 0.);
  CHECK_THROWS_AS(factor.factorise(values), SolveError);
  values = grid.values(0.);
  factor.factorise(values);
  std::vector<double> x = grid.right_hand_sides(1, 0.);
  factor.solve(x);
  CHECK(error(x) < 1e-12);
}


TEST_CASE("Substructures: fewer unknowns than ranks")
{
  for (const int n : {1, 2, 3})
  {
    std::vector<int> rows, columns;
    std::vector<double> values, x(rank() == 0 ? n : 0, 1.);
    if (rank() == n_ranks() - 1)
      for (int i = 1; i <= n; ++i)
        for (int j = 1; j <= i; ++j)
        {
          rows.push_back(i);
          columns.push_back(j);
          values.push_back(i == j ? 2. : -0.5);
        }
    SubstructuredCholesky factor(comm);
    factor.analyse(n, rows, columns);
    factor.factorise(values);
    factor.solve(x);
    for (const double value : x)
      CHECK(value == doctest::Approx(1. / (2. - 0.5 * (n - 1))));
  }
}


TEST_CASE("Substructures: products of columns with few entries")
{
  const Grid grid([](const int i) { return i * n_ranks() / Grid::size(); });
  SubstructuredCholesky factor(comm);
  factor.analyse(Grid::size(), grid.rows, grid.columns);
  std::vector<double> values = grid.values(0.);
  factor.factorise(values);
  std::vector<std::vector<std::pair<int, double>>> vectors(70);
  SparseFactor::SparseVectors left, right;
  for (std::size_t k = 0; k < vectors.size(); ++k)
  {
    for (std::size_t m = 0; m < k % 5; ++m)
      vectors[k].emplace_back((k * 31 + m * 13) % Grid::size(), 1. + 0.1 * k - m);
    right.push_back(&vectors[k]);
    if (k < 9)
      left.push_back(&vectors[k]);
  }
  const auto products = factor.products(left, right);
  REQUIRE(products);
  for (std::size_t j = 0; j < right.size(); ++j)
  {
    std::vector<double> x(rank() == 0 ? Grid::size() : 0, 0.);
    if (rank() == 0)
      for (const auto &[i, value] : vectors[j])
        x[i] += value;
    factor.solve(x);
    x.resize(Grid::size());
    MPI_Bcast(x.data(), Grid::size(), MPI_DOUBLE, 0, comm);
    for (std::size_t l = 0; l < left.size(); ++l)
    {
      double expected = 0.;
      for (const auto &[i, value] : vectors[l])
        expected += value * x[i];
      CHECK(std::abs((*products)[j * left.size() + l] - expected) < 1e-12);
    }
  }
}


TEST_CASE("Substructures: suit what can be cut in two along few unknowns")
{
  const Grid strips([](const int i) { return i * n_ranks() / Grid::size(); });
  CHECK(SubstructuredCholesky(comm).suits(Grid::size(), strips.rows, strips.columns));
  // Each coupled to some anywhere.
  std::vector<int> rows, columns;
  constexpr unsigned int n = 12000;
  for (unsigned int i = 0; i < n; ++i)
    if (static_cast<int>(i) % n_ranks() == rank())
    {
      std::vector<int> some = {static_cast<int>(i) + 1};
      for (unsigned int k = 1; k < 6; ++k)
        if (const unsigned int j = (i * 7919u + k * 104729u + i * i % 10007u * k) % n; j < i)
          some.push_back(static_cast<int>(j) + 1);
      std::sort(some.begin(), some.end());
      some.erase(std::unique(some.begin(), some.end()), some.end());
      for (const int j : some)
      {
        rows.push_back(static_cast<int>(i) + 1);
        columns.push_back(j);
      }
    }
  CHECK(SubstructuredCholesky(comm).suits(n, rows, columns) == (n_ranks() == 1));
}
} // namespace stockwork::sparse_factor_mpi_test
