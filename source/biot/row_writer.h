#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <utility>
#include <vector>

namespace stockwork
{
/// Adds matrices of cells to rows of a sparse matrix which this rank owns, in place. The library
/// looks every entry up, its column in a hash table and its place in the row; here each column of
/// the cell is looked up once, and its places are found in one walk along each row.
class RowWriter
{
public:
  /// Rows and columns of a cell's matrix in the numbers of `matrix`. False if a row is not owned;
  /// then add() must not be called.
  bool reinit(const dealii::TrilinosWrappers::SparseMatrix &matrix,
              const std::vector<dealii::types::global_dof_index> &row_dofs,
              const std::vector<dealii::types::global_dof_index> &column_dofs);

  /// Add local(local_rows[i], local_columns[j]) to the entry of row i and column j. The matrix may
  /// be another one with the same pattern.
  void add(const dealii::FullMatrix<double> &local,
           const std::vector<unsigned int> &local_rows,
           const std::vector<unsigned int> &local_columns,
           dealii::TrilinosWrappers::SparseMatrix &matrix) const;

private:
  std::vector<int> rows;                             ///< local to this rank
  std::vector<std::pair<int, unsigned int>> columns; ///< local to this rank, and their place j
};
} // namespace stockwork
