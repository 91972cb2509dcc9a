#pragma once

#include "solvers/extra_schur.h"
#include "solvers/linear_solver.h"
#include "solvers/sparse_factor.h"
#include "solvers/system_operator.h"

#include <map>
#include <memory>

namespace stockwork
{
/// For rock with a fracture: block elimination of the bulk,
///
///   [ A  B ]
///   [ C  D ],   S = D - C A^-1 B,
///
/// with a sparse factor of A, Cholesky's where A is definite, that outlives Newton iterations,
/// steps and growth of the fracture, and a small dense Schur complement (ExtraSchur). A Newton
/// iteration then takes two back-substitutions and one dense factorisation; where A is not
/// symmetric, the solutions for the columns of B are kept, and take the place of the second, or of
/// both if the bulk is in balance. Where few rows of A
/// have changed since it was factorised (bonds broke), the factor is kept as well (Woodbury):
/// A + E dA is A with one more extra unknown f = dA u per changed row. In porous rock A changes
/// with the time step. Of rock that yields, the change is taken along by iterations between the
/// unknowns that it touches, with the same factor.
class BorderedSolver : public LinearSolver
{
public:
  explicit BorderedSolver(MPI_Comm communicator);

  LinearReport solve(const LinearSystem &system,
                     const SystemStamps &stamps,
                     double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra) override;

  /// Where the bulk is definite, and its factor at hand has a LocalInverse.
  bool sees_rock_change(const LinearSystem &system, const SystemStamps &stamps) const override;

  /// Where the bulk is definite and unchanged since it was factorised.
  std::unique_ptr<CondensedSystem>
  condense(const LinearSystem &system, const SystemStamps &stamps, double tolerance) override;

private:
  class Condensed;
  class LocalTangent;

  /// Whether there is a factor, of this bulk or of an earlier one on the same mesh.
  bool has_factor(const LinearSystem &system, const SystemStamps &stamps) const;

  /// Whether solve() may take the residual of the bulk for rounding errors.
  static bool in_balance(const SystemOperator &op, const SystemVector &r, double allowed);

  /// A^-1 load
  void solve_bulk(const LinearSystem &system,
                  const dealii::TrilinosWrappers::MPI::BlockVector &load,
                  dealii::TrilinosWrappers::MPI::BlockVector &solution);

  void factorise(const SystemOperator &, const SystemStamps &);

  void forget_solutions();

  /// Find the rows of A that have changed since it was factorised.
  /// @return false: too many have
  bool find_changes(const SystemOperator &);

  /// The border of the system, and of the changed rows of A.
  SystemOperator::Border border_with_changes(const SystemOperator &) const;

  /// A^-1 b_k (scaled), one after another, dense, on rank 0.
  std::vector<double> solve_columns(const ExtraSchur::SparseVectors &right_hand_sides);

  /// See ExtraSchur.
  std::vector<double> multiply(const ExtraSchur::SparseVectors &left,
                               const ExtraSchur::SparseVectors &right);

  /// solution -= A^-1 B z, by the solutions that are kept.
  /// @return false: not all of them are, and nothing was done
  bool subtract_answer(const SystemOperator &op,
                       const std::vector<double> &z,
                       dealii::TrilinosWrappers::MPI::BlockVector &solution) const;

  /// dx -= J^-1 r by block elimination.
  void eliminate(const SystemOperator &op,
                 const SystemOperator::Border &border,
                 const SystemVector &r,
                 SystemVector &dx,
                 bool skip_bulk_load);

  /// dx -= (J + rock change)^-1 r, up to a residual of that size, by iterations between the
  /// unknowns that the change touches. Returns how many.
  unsigned int eliminate_tangent(const SystemOperator &op,
                                 const SystemOperator::Border &border,
                                 const SystemVector &r,
                                 double allowed,
                                 SystemVector &dx);

  MPI_Comm communicator;
  bool is_root;

  std::unique_ptr<SparseFactor> factor;
  SystemStamps factor_stamps;
  SystemVector factor_scaling;
  bool keeps_values = false; ///< A is not definite; the same on every rank, with rows or without
  std::vector<double> factor_values; ///< then, of this rank's rows

  unsigned int values_with_changes = 0; ///< stamp of the values that `changes` belong to
  unsigned int n_changes = 0;           ///< rows, of all ranks
  Triplets change_columns, change_rows; ///< E/d and -d dA, d the scaling; rows numbered from zero

  /// A^-1 of columns of the border, where A is not symmetric. Dense, on rank 0, null elsewhere; the
  /// same keys on every rank.
  std::map<ExtraSchur::SparseVector, const double *> solutions;
  std::vector<std::vector<double>> batches; ///< in which they are
  std::size_t most_solutions = 0;

  ExtraSchur schur;
};
} // namespace stockwork
