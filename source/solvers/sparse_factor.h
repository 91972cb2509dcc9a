#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace stockwork
{
/// A factor of a sparse matrix, whose pattern is ordered once and whose values change. Indices
/// count from one.
class SparseFactor
{
public:
  virtual ~SparseFactor() = default;

  /// Take a new pattern for n unknowns and order it. Keeps the row and column indices. A symmetric
  /// matrix is given by its lower triangle.
  virtual void analyse(int n, std::vector<int> rows, std::vector<int> columns) = 0;

  /// Factorise, the values in the order of the indices given to analyse(). Throws SolveError when
  /// the matrix is singular or memory is short.
  virtual void factorise(std::vector<double> &values) = 0;

  /// Solve for n_right_hand_sides at once; `x` holds them one after another on rank 0 and is
  /// overwritten with the solutions. Not looked at on other ranks.
  virtual void solve(std::vector<double> &x, int n_right_hand_sides = 1) = 0;

  /// A few sparse right-hand sides, column by column as in a compressed column matrix (indices
  /// from one), given on rank 0; the solutions are dense, on rank 0.
  virtual void solve_sparse(std::vector<int> &column_starts,
                            std::vector<int> &rows,
                            std::vector<double> &values,
                            std::vector<double> &x) = 0;

  /// left_i . A^-1 right_j of all pairs, [j * left.size() + i], on every rank, all of which give
  /// the same vectors: entries as index, from zero here, and value. Nothing: solve_sparse() is as
  /// good.
  using SparseVectors = std::vector<const std::vector<std::pair<int, double>> *>;
  virtual std::optional<std::vector<double>> products(const SparseVectors & /*left*/,
                                                      const SparseVectors & /*right*/)
  {
    return {};
  }

  virtual int size() const = 0;
};
} // namespace stockwork
