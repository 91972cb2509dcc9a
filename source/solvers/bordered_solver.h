#pragma once

#include "solvers/direct_solver.h"
#include "solvers/linear_solver.h"
#include "solvers/mumps.h"
#include "solvers/system_operator.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <utility>

namespace stockwork
{
/// For elastic rock with a fracture: block elimination of the bulk,
///
///   [ A  B ]
///   [ C  D ],   S = D - C A^-1 B,
///
/// with a sparse Cholesky factor of A that outlives Newton iterations, steps and growth of the
/// fracture, and a small dense Schur complement S. Of C A^-1 B only the rows and columns of new
/// extra unknowns are computed; an unknown is known by the contents of its row and column, so
/// renumbering costs nothing. A Newton iteration then takes two back-substitutions and one dense
/// factorisation. Systems whose bulk is not definite go to the direct solver.
class BorderedSolver : public LinearSolver
{
public:
  explicit BorderedSolver(MPI_Comm communicator);

  LinearReport solve(const LinearSystem &system,
                     const SystemStamps &stamps,
                     double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra) override;

private:
  /// Scaled bulk entries of one row or column of the border: index and value, on every rank.
  using SparseVector = std::vector<std::pair<int, double>>;

  /// The border of one extra unknown.
  struct Border
  {
    SparseVector column; ///< of B
    SparseVector row;    ///< of C
    bool operator==(const Border &other) const
    {
      return column == other.column && row == other.row;
    }
    bool empty() const
    {
      return column.empty() && row.empty();
    }
  };

  void factorise(const SystemOperator &, const SystemStamps &);

  std::vector<Border> gather_borders(const SystemOperator &) const;

  /// Find each border among the known ones, computing what is new. Unknowns without a border get
  /// no place (unsigned -1).
  void update_products(const std::vector<Border> &borders);

  /// Drop known borders that are no longer in use.
  void forget_unused();

  /// x_k = A^-1 b_k (scaled), dense, on rank 0.
  std::vector<double> solve_columns(const std::vector<const SparseVector *> &right_hand_sides);

  /// Products `left` A^-1 `right` of all known borders with those in [begin, end), one of the
  /// latter after another.
  std::vector<double> multiply(SparseVector Border::*left,
                               SparseVector Border::*right,
                               unsigned int begin,
                               unsigned int end);

  /// S, scaled, and its LU factor.
  void factorise_schur(const SystemOperator &);

  /// dx -= J^-1 r by block elimination.
  void
  eliminate(const SystemOperator &op, const SystemVector &r, SystemVector &dx, bool skip_bulk_load);

  MPI_Comm communicator;
  bool is_root;
  DirectSolver direct;

  std::unique_ptr<Mumps> factor;
  SystemStamps factor_stamps;
  SystemVector factor_scaling;

  std::vector<Border> known;
  std::vector<std::vector<double>> products; ///< [i][j] = row_i A^-1 column_j of known borders
  std::vector<unsigned int> place;           ///< of each extra unknown among the known borders

  dealii::LAPACKFullMatrix<double> schur;
  std::vector<double> schur_scaling;
  std::vector<SystemOperator::Entry> schur_corner; ///< D of the factor
  std::vector<unsigned int> schur_place;
  bool has_schur = false;
};
} // namespace stockwork
