#pragma once

#include "solvers/linear_solver.h"
#include "solvers/system_operator.h"

#include <functional>

namespace stockwork
{
/// When a Krylov method stops.
struct KrylovLimits
{
  double tolerance;                ///< of |D (R + J dx)| over |D R|, see LinearReport
  unsigned int max_iterations;     ///< then it has not converged
  unsigned int restart;            ///< basis vectors FGMRES keeps
  bool symmetric_definite = false; ///< matrix and preconditioner: conjugate gradients will do
};

/// z = P^-1 r, which may differ from call to call. May use r as working space.
using Preconditioner = std::function<void(SystemVector &z, SystemVector &r)>;

/// Solve J dx = -R for all unknowns, starting from zero, by FGMRES or conjugate gradients between
/// diagonal scalings. The true residual is what counts. Adds to the iterations of @p report and
/// sets whether and how far it has converged.
void solve_by_krylov(const SystemOperator &op,
                     MPI_Comm communicator,
                     const Preconditioner &preconditioner,
                     const KrylovLimits &limits,
                     SystemVector &dx,
                     LinearReport &report);
} // namespace stockwork
