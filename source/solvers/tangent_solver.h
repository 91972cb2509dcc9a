#pragma once

#include "solvers/linear_solver.h"
#include "solvers/system_operator.h"

#include <functional>
#include <memory>
#include <string>

namespace stockwork
{
/// For rock that may leave its linear range. LinearSystem::bulk is that of linear rock, whose
/// factor or hierarchy lasts; LinearSystem::rock_change, where there is one, is what the tangent of
/// a few cells adds to it. The sum is solved by the solver of the linear system, if that takes the
/// change along, else by FGMRES with it as preconditioner: as many iterations as the change asks
/// for, a back-substitution each. Where that takes too many, the tangent is factorised and
/// preconditions the solves that follow.
class TangentSolver
{
public:
  using Make = std::function<std::unique_ptr<LinearSolver>()>;

  TangentSolver(const Make &make, MPI_Comm communicator);

  bool wants_hierarchy(const dealii::types::global_dof_index n_dofs) const
  {
    return linear->wants_hierarchy(n_dofs);
  }

  /// Of the solver of the linear system.
  std::string choices() const
  {
    return linear->choices();
  }

  /// See LinearSolver. `system` is used as working space and comes back as it was.
  LinearReport solve(LinearSystem &system,
                     const SystemStamps &stamps,
                     double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra);

  /// See LinearSolver.
  std::unique_ptr<CondensedSystem>
  condense(const LinearSystem &system, const SystemStamps &stamps, const double tolerance)
  {
    return system.rock_change == nullptr ? linear->condense(system, stamps, tolerance) : nullptr;
  }

private:
  /// Make `tangent` the sum of both matrices.
  void form_tangent(const LinearSystem &system, const SystemStamps &stamps);

  /// FGMRES with one of the two as preconditioner.
  LinearReport
  iterate(LinearSystem &system,
          const std::function<LinearReport(SystemVector &z, SystemVector &r)> &precondition,
          double tolerance,
          unsigned int max_iterations,
          SystemVector &dx);

  Make make;
  MPI_Comm communicator;
  std::unique_ptr<LinearSolver> linear, of_tangent;
  LinearSystem tangent;
  SystemStamps tangent_stamps;
  SystemStamps formed_at; ///< the stamps of the system when `tangent` was formed
  bool has_tangent = false;
};
} // namespace stockwork
