#pragma once

#include <deal.II/lac/trilinos_precondition.h>

#include "solvers/displacement_multigrid.h"
#include "solvers/linear_solver.h"
#include "solvers/patch_solver.h"
#include "solvers/sparse_fracture_schur.h"

namespace stockwork
{
/// Krylov iteration with multigrid. Elastic rock alone: conjugate gradients. Else FGMRES,
/// preconditioned with the upper block triangle of
///
///   [ K   B     -Q   ]   displacement
///   [ 0   S_a   C_p  ]   extra unknowns,  S_a = D - C K^-1 B
///   [ 0   0     -S_p ]   pore pressure,   S_p = storage + flow + alpha^2 / (lambda + 2 G / dim)
///   M_p
///
/// with one multigrid cycle each for K and for S_p, the fixed-stress approximation of the Schur
/// complement (White, Castelletto & Tchelepi 2016), and a sparse S_a (SparseFractureSchur). Where
/// rock yields, the cycle for K is followed by a factor of the rows that do (PatchSolver).
class BlockAmgSolver : public LinearSolver
{
public:
  BlockAmgSolver(const LinearSolverParameters &, MPI_Comm);

  bool wants_hierarchy(dealii::types::global_dof_index) const override
  {
    return true;
  }

  bool sees_rock_change(const LinearSystem &, const SystemStamps &) const override
  {
    return true;
  }

  LinearReport solve(const LinearSystem &system,
                     const SystemStamps &stamps,
                     double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra) override;

private:
  /// The Schur complement of the extra unknowns.
  void update_extra(const SystemOperator &, bool new_stiffness);

  void build(const LinearSystem &, const SystemStamps &, bool with_displacement);

  LinearSolverParameters parameters;
  MPI_Comm communicator;

  DisplacementMultigrid displacement;
  PatchSolver patch;
  dealii::TrilinosWrappers::PreconditionAMG pressure;
  dealii::TrilinosWrappers::SparseMatrix schur; ///< positive, in units of its largest entry
  double schur_unit = 1.;
  SparseFractureSchur extra;
  const dealii::TrilinosWrappers::SparseMatrix *stiffness = nullptr; ///< during solve()
  SystemStamps built_for;
  dealii::TrilinosWrappers::MPI::BlockVector bulk_scaling; ///< with those stamps
  unsigned int multigrid_values = 0; ///< displacement_values that the multigrid was built for
  bool is_built = false;
  double first_iterations = 0.; ///< per decade of the residual, with it newly built
  double last_iterations = 0.;
};
} // namespace stockwork
