#pragma once

#include "solvers/bordered_solver.h"
#include "solvers/linear_solver.h"

#include <memory>

namespace stockwork
{
/// For an elastic bulk in three dimensions with thousands of mechanical extra unknowns that are
/// each tied to little of it, as bonds that soften: a dense block of them, and a solution for each,
/// would cost far more than the bulk. They are eliminated one by one (LocalElimination), which
/// changes the bulk in every iteration of Newton's, but little. FGMRES then solves, with the bulk
/// of an earlier iteration factorised as preconditioner, and the border as it is now; when that
/// takes too many iterations the present bulk is factorised. Where few of them can be
/// eliminated, BorderedSolver solves.
class LaggedSolver : public LinearSolver
{
public:
  explicit LaggedSolver(MPI_Comm communicator);

  LinearReport solve(const LinearSystem &system,
                     const SystemStamps &stamps,
                     double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra) override;

private:
  /// Take the bulk of a system as the one that preconditions.
  void lag(const LinearSystem &system);

  MPI_Comm communicator;
  bool eliminates = true;                 ///< as far as has been seen
  BorderedSolver whole;                   ///< where nothing is eliminated
  std::unique_ptr<BorderedSolver> inner;  ///< of the earlier bulk
  std::unique_ptr<LinearSystem> earlier;  ///< it, with the present border
  bool has_no_factor = true;              ///< of `earlier`, yet
  SystemStamps inner_stamps, mesh_stamps; ///< of that system; of the present one
};
} // namespace stockwork
