#include "solvers/tangent_solver.h"

#include "solvers/krylov.h"
#include "stockwork/base/error.h"

#include <utility>

namespace stockwork
{
namespace
{
/// A factor costs ten to thirty back-substitutions; beyond this many it is worth a new one.
constexpr unsigned int most_iterations = 20;
/// A preconditioner need not be exact; a factor is at once.
constexpr double inner_tolerance = 1e-2;

using BlockMatrix = dealii::TrilinosWrappers::BlockSparseMatrix;

void copy(BlockMatrix &to, const BlockMatrix &from, const bool anew)
{
  if (anew)
    to.reinit(from.n_block_rows(), from.n_block_cols());
  for (unsigned int i = 0; i < from.n_block_rows(); ++i)
    for (unsigned int j = 0; j < from.n_block_cols(); ++j)
      to.block(i, j).copy_from(from.block(i, j));
  if (anew)
    to.collect_sizes();
}
} // namespace


TangentSolver::TangentSolver(const Make &make, const MPI_Comm communicator)
  : make(make)
  , communicator(communicator)
  , linear(make())
{
}


void TangentSolver::form_tangent(const LinearSystem &system, const SystemStamps &stamps)
{
  const bool new_mesh = !has_tangent || formed_at.mesh != stamps.mesh;
  copy(tangent.bulk, system.bulk, new_mesh);
  for (unsigned int i = 0; i < system.bulk.n_block_rows(); ++i)
    for (unsigned int j = 0; j < system.bulk.n_block_cols(); ++j)
      tangent.bulk.block(i, j).add(1., system.rock_change->block(i, j));
  if (new_mesh)
  {
    tangent.residual_bulk.reinit(system.residual_bulk);
    if (system.fixed_stress_mass.m() > 0)
      tangent.fixed_stress_mass.copy_from(system.fixed_stress_mass);
    tangent.displacement_hierarchy = system.displacement_hierarchy;
  }
  tangent.n_mechanical_extra = system.n_mechanical_extra;
  tangent.elastic = system.elastic;
  tangent.symmetric = system.symmetric && system.rock_change_is_symmetric;
  tangent.definite = tangent.definite_displacement = false;
  // The old factor is of no use, nor a list of the rows that have changed.
  if (new_mesh)
    ++tangent_stamps.mesh;
  ++tangent_stamps.matrix;
  ++tangent_stamps.bulk_values;
  ++tangent_stamps.displacement_values;
  formed_at = stamps;
  has_tangent = true;
}


LinearReport TangentSolver::iterate(
  LinearSystem &system,
  const std::function<LinearReport(SystemVector &z, SystemVector &r)> &precondition,
  const double tolerance,
  const unsigned int max_iterations,
  SystemVector &dx)
{
  LinearReport report;
  const SystemOperator op(system, communicator);
  dx = op.make_vector();
  const auto action = [&](SystemVector &z, SystemVector &r)
  {
    const LinearReport inner = precondition(z, r);
    report.setup_seconds += inner.setup_seconds;
    report.factorised = report.factorised || inner.factorised;
    // J z = -r is what a solver solves.
    z.bulk *= -1.;
    for (double &value : z.extra)
      value = -value;
  };
  solve_by_krylov(op, communicator, action, {tolerance, max_iterations, max_iterations + 1}, dx,
                  report);
  return report;
}


namespace
{
/// For as long as it lives, the system is that of the linear rock.
class LinearRock
{
public:
  explicit LinearRock(LinearSystem &system)
    : system(system)
    , change(system.rock_change)
  {
    system.rock_change = nullptr;
  }
  ~LinearRock()
  {
    system.rock_change = change;
  }
  LinearRock(const LinearRock &) = delete;
  LinearRock &operator=(const LinearRock &) = delete;

private:
  LinearSystem &system;
  const BlockMatrix *const change;
};

/// For as long as it lives, the system has another residual.
class OtherResidual
{
public:
  OtherResidual(LinearSystem &system, SystemVector &residual)
    : system(system)
    , residual(residual)
  {
    exchange();
  }
  ~OtherResidual()
  {
    exchange();
  }
  OtherResidual(const OtherResidual &) = delete;
  OtherResidual &operator=(const OtherResidual &) = delete;

private:
  void exchange()
  {
    std::swap(system.residual_bulk, residual.bulk);
    std::swap(system.residual_extra, residual.extra);
  }

  LinearSystem &system;
  SystemVector &residual;
};
} // namespace


LinearReport TangentSolver::solve(LinearSystem &system,
                                  const SystemStamps &stamps,
                                  const double tolerance,
                                  dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                  std::vector<double> &dx_extra)
{
  if (system.rock_change == nullptr)
    return linear->solve(system, stamps, tolerance, dx_bulk, dx_extra);

  const auto by_linear = [&](SystemVector &z, SystemVector &r)
  {
    const OtherResidual of_r(system, r);
    const LinearRock only(system);
    return linear->solve(system, stamps, inner_tolerance, z.bulk, z.extra);
  };
  const auto by_tangent = [&](SystemVector &z, SystemVector &r)
  {
    tangent.residual_bulk = r.bulk;
    tangent.residual_extra = r.extra;
    return of_tangent->solve(tangent, tangent_stamps, inner_tolerance, z.bulk, z.extra);
  };
  const auto take_fracture = [&]()
  {
    tangent.bulk_extra = system.bulk_extra;
    tangent.extra_bulk = system.extra_bulk;
    tangent.extra_extra = system.extra_extra;
    ++tangent_stamps.extra;
    ++tangent_stamps.extra_values;
  };

  const bool by_multigrid = linear->wants_hierarchy(system.residual_bulk.size());
  SystemVector dx;
  LinearReport report;
  const auto add_iterations = [&](const LinearReport &now)
  {
    const unsigned int iterations = report.iterations;
    const double seconds = report.setup_seconds;
    report = now;
    report.iterations += iterations;
    report.setup_seconds += seconds;
  };
  const bool tangent_is_good =
    has_tangent && formed_at.mesh == stamps.mesh && formed_at.bulk_values == stamps.bulk_values;
  has_tangent = tangent_is_good;
  if (tangent_is_good)
    take_fracture();
  // Where so much rock yields that the tangent is singular, as it is on the surface before a step
  // has said whether it loads or unloads, the linear rock gives the direction.
  try
  {
    if (!tangent_is_good && linear->sees_rock_change(system, stamps))
    {
      report = linear->solve(system, stamps, tolerance, dx_bulk, dx_extra);
      if (report.converged || (by_multigrid && report.is_good_enough()))
        return report;
    }
    else
      report = tangent_is_good ? iterate(system, by_tangent, tolerance, most_iterations, dx)
                               : iterate(system, by_linear, tolerance, most_iterations, dx);
    if (!report.converged)
    {
      if (!of_tangent)
        of_tangent = make();
      form_tangent(system, stamps);
      take_fracture();
      add_iterations(iterate(system, by_tangent, tolerance, most_iterations, dx));
    }
  }
  catch (const SolveError &)
  {
    report.converged = false;
    report.relative_residual = 1.;
  }
  if (!report.is_good_enough())
  {
    has_tangent = false;
    const LinearRock only(system);
    add_iterations(linear->solve(system, stamps, tolerance, dx_bulk, dx_extra));
    return report;
  }
  dx_bulk = dx.bulk;
  dx_extra = dx.extra;
  return report;
}
} // namespace stockwork
