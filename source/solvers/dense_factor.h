#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cstddef>
#include <vector>

namespace stockwork
{
/// A factor of a dense matrix that has been scaled from both sides so that pivoting compares like
/// with like (Ruiz 2001). Rows and columns with few entries, as a fluid has, are
/// eliminated first, each at the price of its entries: a dense factorisation is for what is left.
class DenseFactor
{
public:
  /// @throws SolveError when the matrix is singular
  void reinit(dealii::FullMatrix<double>);

  /// x := A^-1 x
  void solve(dealii::Vector<double> &x) const;

  /// Each column.
  void solve(dealii::LAPACKFullMatrix<double> &columns) const;

  /// So many unknowns were eliminated by their few entries.
  unsigned int n_sparse() const
  {
    return pivots.size();
  }

private:
  /// Fill `scaling`.
  void scale(const dealii::FullMatrix<double> &);

  /// Eliminate by rows and columns of the scaled matrix that have few entries; fills all but `lu`.
  void eliminate(dealii::FullMatrix<double> &scaled);

  class ShortColumns;

  /// Eliminate the unknown of a column by a row.
  void eliminate(dealii::FullMatrix<double> &scaled,
                 ShortColumns &,
                 unsigned int row,
                 unsigned int column);

  /// Scale a right-hand side and take the pivots' rows off what is left.
  void forward(double *x, double *of_left) const;

  /// From what forward() has made of x, and a solution of what is left, the whole solution.
  void backward(const double *of_left, double *x) const;

  struct Entry
  {
    unsigned int index;
    double value;
  };

  struct Pivot
  {
    unsigned int row, column;
    std::size_t begin_lower, begin_upper; ///< its entries, up to the next one's
    double reciprocal;
  };

  std::vector<double> scaling;
  std::vector<Pivot> pivots; ///< in their order
  std::vector<Entry> lower;  ///< by rows, multiples of the pivots' rows that were taken off
  std::vector<Entry> upper;  ///< by columns, of the pivots' rows
  std::vector<bool> row_is_left, column_is_left;
  std::vector<unsigned int> rows_left, columns_left; ///< of the dense factor
  dealii::LAPACKFullMatrix<double> lu;
};
} // namespace stockwork
