#pragma once

#include "solvers/dense_solver.h"
#include "solvers/linear_solver.h"
#include "solvers/system_operator.h"

#include <memory>

namespace stockwork
{
/// What belongs to one half of a system that is solved by turns: a block of the bulk, if any, and
/// a range of the extra unknowns.
struct SplitPart
{
  bool has_bulk = true;
  unsigned int block = 0;
  unsigned int extra_begin = 0, extra_end = 0;
};


/// One half of such a system as a linear system of its own, with a solver that keeps its factors.
class SplitBlock
{
public:
  SplitBlock(const LinearSolverParameters &parameters,
             const BulkStructure &structure,
             MPI_Comm communicator);

  bool wants_hierarchy(const dealii::types::global_dof_index n_dofs) const
  {
    return solver->wants_hierarchy(n_dofs);
  }

  /// Take the matrix of a part of the whole. Returns whether the block of the bulk is new, so that
  /// whoever changes it must change it again.
  bool update(const SystemOperator &whole, const SystemStamps &stamps, const SplitPart &part);

  /// x += A^-1 (-residual) for the unknowns of the part; returns the seconds that factors took.
  /// Throws SolveError where that fails.
  double correct(const SystemVector &residual, double tolerance, SystemVector &x);

  dealii::TrilinosWrappers::SparseMatrix &bulk()
  {
    return system.bulk.block(0, 0);
  }

  /// Add to the diagonal entry of an extra unknown of the part. By one rank.
  void add_to_diagonal(const unsigned int extra, const double value)
  {
    system.extra_extra.add(extra - part.extra_begin, extra - part.extra_begin, value);
  }

private:
  void take_border(const LinearSystem &whole, dealii::types::global_dof_index offset);

  double correct_extra(const SystemVector &residual, SystemVector &x);

  void factorise_extra();

  MPI_Comm communicator;
  SplitPart part;
  LinearSystem system;
  SystemStamps stamps;
  bool has_system = false;
  std::unique_ptr<LinearSolver> solver;
  DenseSolver extra_solver; ///< of a part without bulk
  bool has_extra_factor = false;
};
} // namespace stockwork
