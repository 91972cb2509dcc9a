#pragma once

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include "solvers/mumps.h"

#include <memory>
#include <vector>

namespace stockwork
{
/// Solves a matrix K + dK in the rows in which dK has entries, the patch, by a factor of these rows
/// alone: the part of the sum that a preconditioner made for K does not see.
class PatchSolver
{
public:
  explicit PatchSolver(MPI_Comm communicator);

  /// Factorise; keeps a reference to the matrix. Nothing is solved where the patch is singular, or
  /// has more than `most_rows`.
  void build(const dealii::TrilinosWrappers::SparseMatrix &matrix,
             const dealii::TrilinosWrappers::SparseMatrix &change,
             dealii::types::global_dof_index most_rows);

  void clear()
  {
    n_patch = 0;
  }

  /// Make the residual b - (K + dK) x zero in the patch.
  void correct(dealii::TrilinosWrappers::MPI::Vector &x,
               const dealii::TrilinosWrappers::MPI::Vector &b) const;

private:
  struct Row
  {
    int local;      ///< of this rank's rows of K
    int number;     ///< in the patch
    double scaling; ///< 1/sqrt(K_ii)
    std::size_t end;
  };

  MPI_Comm communicator;
  const dealii::TrilinosWrappers::SparseMatrix *matrix = nullptr;
  unsigned int n_patch = 0; ///< rows, of all ranks; 0: none to be solved
  std::vector<int> patch;   ///< their global indices, sorted
  std::vector<Row> rows;    ///< of this rank
  std::vector<int> columns; ///< local columns of these rows of K + dK, and values
  std::vector<double> values;
  std::unique_ptr<Mumps> factor;
  std::vector<int> factor_rows, factor_columns; ///< the pattern that it was ordered for
};
} // namespace stockwork
