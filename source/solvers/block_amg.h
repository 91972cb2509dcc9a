#pragma once

#include <deal.II/lac/trilinos_precondition.h>

#include "solvers/displacement_multigrid.h"
#include "solvers/linear_solver.h"

namespace stockwork
{
/// Krylov iteration with algebraic multigrid, for the bulk alone. Elastic rock: conjugate
/// gradients. With pore pressure: FGMRES, preconditioned with the upper block triangle of
///
///   [ K      -Q ]
///   [ 0      -S ],   S = storage + flow + alpha^2 / (lambda + 2 G / dim) M_p,
///
/// one multigrid cycle each for K (smoothed aggregation with the rigid body modes) and for S, the
/// fixed-stress approximation of the Schur complement (White, Castelletto & Tchelepi 2016).
class BlockAmgSolver : public LinearSolver
{
public:
  BlockAmgSolver(const LinearSolverParameters &, MPI_Comm);

  bool wants_hierarchy(dealii::types::global_dof_index) const override
  {
    return true;
  }

  LinearReport solve(const LinearSystem &system,
                     const SystemStamps &stamps,
                     double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra) override;

private:
  void build(const LinearSystem &, bool with_displacement);

  LinearSolverParameters parameters;
  MPI_Comm communicator;

  DisplacementMultigrid displacement;
  dealii::TrilinosWrappers::PreconditionAMG pressure;
  dealii::TrilinosWrappers::SparseMatrix schur; ///< positive, in units of its largest entry
  double schur_unit = 1.;
  SystemStamps built_for;
  bool is_built = false;
  unsigned int first_iterations = 0; ///< with it newly built
  unsigned int last_iterations = 0;
};
} // namespace stockwork
