// Cholesky's factor by substructures against the known solution and MUMPS, on any number of ranks.

#include <deal.II/base/mpi.h>

#include <doctest/doctest.h>

#include "solvers/mumps.h"
#include "solvers/substructured_cholesky.h"
#include "stockwork/base/error.h"

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


TEST_CASE("Substructures: strips owned from above, so that entries are given by the other rank")
{
  check(Grid([](const int i) { return n_ranks() - 1 - i * n_ranks() / Grid::size(); }));
}


TEST_CASE("Substructures: neighbours on different ranks leave nearly no interior")
{
  check(Grid([](const int i) { return i % n_ranks(); }));
}


TEST_CASE("Substructures: ranks without unknowns, and one with a few apart from one another")
{
  check(Grid([](const int) { return n_ranks() - 1; }));
  check(Grid([](const int i) { return i % 37 == 5 ? n_ranks() - 1 : 0; }));
}


TEST_CASE("Substructures: no interface")
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


TEST_CASE("Substructures: for few ranks and small interfaces")
{
  const Grid strips([](const int i) { return i * n_ranks() / Grid::size(); });
  CHECK(SubstructuredCholesky::suits(comm, Grid::size(), strips.rows, strips.columns));
  // A chain of neighbours on alternating ranks.
  std::vector<int> rows, columns;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i)
    if (i % n_ranks() == rank())
      for (const int j : {i, i - 1})
        if (j >= 0)
        {
          rows.push_back(i + 1);
          columns.push_back(j + 1);
        }
  CHECK(SubstructuredCholesky::suits(comm, n, rows, columns) == (n_ranks() == 1));
}
} // namespace stockwork::sparse_factor_mpi_test
