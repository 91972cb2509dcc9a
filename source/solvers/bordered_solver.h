#pragma once

#include "solvers/direct_solver.h"
#include "solvers/extra_schur.h"
#include "solvers/linear_solver.h"
#include "solvers/mumps.h"
#include "solvers/system_operator.h"

namespace stockwork
{
/// For elastic rock with a fracture: block elimination of the bulk,
///
///   [ A  B ]
///   [ C  D ],   S = D - C A^-1 B,
///
/// with a sparse factor of A, Cholesky's where A is definite, that outlives Newton iterations,
/// steps and growth of the fracture, and a small dense Schur complement (ExtraSchur). A Newton
/// iteration then takes two back-substitutions and one dense factorisation. Systems whose bulk has
/// pore pressures go to the direct solver.
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
  void factorise(const SystemOperator &, const SystemStamps &);

  /// x_k = A^-1 b_k, or A^-T b_k (scaled), dense, on rank 0.
  std::vector<double> solve_columns(const ExtraSchur::SparseVectors &right_hand_sides,
                                    bool transposed);

  /// See ExtraSchur.
  std::vector<double> multiply(const ExtraSchur::SparseVectors &left,
                               const ExtraSchur::SparseVectors &right,
                               bool transposed);

  /// dx -= J^-1 r by block elimination.
  void
  eliminate(const SystemOperator &op, const SystemVector &r, SystemVector &dx, bool skip_bulk_load);

  MPI_Comm communicator;
  bool is_root;
  DirectSolver direct;

  std::unique_ptr<Mumps> factor;
  SystemStamps factor_stamps;
  SystemVector factor_scaling;

  ExtraSchur schur;
};
} // namespace stockwork
