#pragma once

#include <deal.II/lac/vector.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace stockwork
{
/// The inverse of a factorised matrix A = L L^T between a few unknowns, by substitutions that visit
/// only what these unknowns reach in the factor. Unknowns count from zero. On one rank.
class LocalInverse
{
public:
  virtual ~LocalInverse() = default;

  /// L^-1 b, in the order of the factor, of a load on all unknowns.
  virtual std::vector<double> forward(const double *b) const = 0;

  /// x = L^-T half, back in the order of the unknowns.
  virtual void backward(std::vector<double> half, double *x) const = 0;

  /// half += L^-1 y, y a load on the few unknowns.
  virtual void add_forward(const dealii::Vector<double> &y, std::vector<double> &half) const = 0;

  /// The few values of L^-T half.
  virtual void backward_to_few(const std::vector<double> &half,
                               dealii::Vector<double> &x) const = 0;

  /// x = A^-1 y between the few unknowns.
  virtual void vmult(dealii::Vector<double> &x, const dealii::Vector<double> &y) const = 0;

  /// What that costs, over a substitution with all unknowns.
  virtual double cost() const = 0;
};

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

  /// See LocalInverse; valid until the factor is another. Null: not with this one.
  virtual std::unique_ptr<LocalInverse> local_inverse(const std::vector<int> & /*unknowns*/) const
  {
    return nullptr;
  }
  virtual bool has_local_inverse() const
  {
    return false;
  }

  virtual int size() const = 0;
};
} // namespace stockwork
