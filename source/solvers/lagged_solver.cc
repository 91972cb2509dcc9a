#include "solvers/lagged_solver.h"

#include "solvers/krylov.h"
#include "solvers/local_elimination.h"
#include "solvers/stopwatch.h"
#include "stockwork/base/error.h"

namespace stockwork
{
namespace
{
/// Iterations that cost about as much as a factor.
constexpr unsigned int most_lagged_iterations = 60;
/// Of a solve after which the next one is begun with a new factor.
constexpr unsigned int many_lagged_iterations = 30;
/// Extra unknowns that cannot be eliminated. With more, as of state-based bonds, there would be a
/// large dense block after all.
constexpr unsigned int most_left = 1000;
/// Of the preconditioner: one elimination is exact but for rounding errors.
constexpr double tolerance_of_earlier = 1e-3;
} // namespace

LaggedSolver::LaggedSolver(const MPI_Comm communicator)
  : communicator(communicator)
  , whole(communicator)
{
}

void LaggedSolver::lag(const LinearSystem &system)
{
  if (!earlier)
  {
    inner = std::make_unique<BorderedSolver>(communicator);
    earlier = std::make_unique<LinearSystem>();
    earlier->symmetric = false;
    earlier->elastic = true;
    earlier->bulk.reinit(1, 1);
    ++inner_stamps.mesh;
  }
  earlier->bulk.block(0, 0).copy_from(system.bulk.block(0, 0));
  earlier->bulk.collect_sizes();
  ++inner_stamps.bulk_values;
  has_no_factor = true;
}

LinearReport LaggedSolver::solve(const LinearSystem &system,
                                 const SystemStamps &stamps,
                                 const double tolerance,
                                 dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                 std::vector<double> &dx_extra)
{
  const auto solve_whole = [&]()
  { return whole.solve(system, stamps, tolerance, dx_bulk, dx_extra); };
  if (!eliminates)
    return solve_whole();
  const Stopwatch stopwatch;
  const LocalElimination elimination(system, communicator);
  const LinearSystem &reduced = elimination.reduced();
  eliminates = elimination.fits() && reduced.residual_extra.size() <= most_left;
  if (!eliminates)
  {
    earlier.reset();
    inner.reset();
    return solve_whole();
  }
  if (stamps.mesh != mesh_stamps.mesh || stamps.matrix != mesh_stamps.matrix)
    earlier.reset();
  mesh_stamps = stamps;
  bool is_present = !earlier; // what preconditions is what is solved
  if (is_present)
    lag(reduced);

  LinearReport report;
  const SystemOperator op(reduced, communicator);
  SystemVector dx = op.make_vector();
  report.setup_seconds = stopwatch.seconds();
  for (;; is_present = true)
  {
    report.factorised |= has_no_factor;
    earlier->bulk_extra = reduced.bulk_extra;
    earlier->extra_bulk = reduced.extra_bulk;
    earlier->extra_extra = reduced.extra_extra;
    earlier->n_mechanical_extra = reduced.n_mechanical_extra;
    try
    {
      solve_by_krylov(
        op, communicator,
        [&](SystemVector &z, SystemVector &r)
        {
          const Stopwatch of_factor;
          earlier->residual_bulk = r.bulk;
          earlier->residual_extra = r.extra;
          inner->solve(*earlier, inner_stamps, tolerance_of_earlier, z.bulk, z.extra);
          z.bulk *= -1.;
          for (double &value : z.extra)
            value = -value;
          if (has_no_factor)
            report.setup_seconds += of_factor.seconds();
          has_no_factor = false;
        },
        {tolerance, most_lagged_iterations, most_lagged_iterations}, dx, report);
    }
    catch (const SolveError &)
    {
      if (is_present)
      {
        earlier.reset();
        throw;
      }
    }
    if (report.converged || is_present)
      break;
    lag(reduced);
  }
  if (!(report.relative_residual < 1e-3))
  {
    earlier.reset();
    ExtraSchur::throw_singular();
  }
  if (!report.factorised && report.iterations > many_lagged_iterations)
    lag(reduced);
  dx_bulk = dx.bulk;
  dx_extra = elimination.recover(dx.bulk, dx.extra);
  return report;
}
} // namespace stockwork
