#include "solvers/direct_solver.h"

#include "solvers/bulk_transfer.h"
#include "solvers/stopwatch.h"
#include "stockwork/base/error.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace stockwork
{
namespace
{
constexpr unsigned int max_direct_refinements = 6;

bool same_indices(const std::vector<SystemOperator::Entry> &a,
                  const std::vector<SystemOperator::Entry> &b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto &x, const auto &y)
                    { return x.row == y.row && x.column == y.column; });
}

bool same_entries(const std::vector<SystemOperator::Entry> &a,
                  const std::vector<SystemOperator::Entry> &b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto &x, const auto &y)
                    { return x.row == y.row && x.column == y.column && x.value == y.value; });
}

/// True where it is true on all ranks.
bool everywhere(const bool mine, const MPI_Comm communicator)
{
  return dealii::Utilities::MPI::min(mine ? 1 : 0, communicator) == 1;
}

bool lower_triangle_only(const LinearSystem &system)
{
  return system.symmetric;
}
} // namespace

DirectSolver::DirectSolver(const MPI_Comm communicator)
  : communicator(communicator)
{
}

bool DirectSolver::same_pattern(const SystemOperator &op, const SystemStamps &stamps) const
{
  const auto &system = op.system();
  return everywhere(factor && stamps.mesh == seen.stamps.mesh && op.n_extra() == seen.n_extra &&
                      op.n_bulk() + op.n_extra() == static_cast<unsigned int>(factor->size()) &&
                      system.symmetric == seen.symmetric && system.definite == seen.definite &&
                      same_indices(op.bulk_extra(), seen.bulk_extra) &&
                      same_indices(op.extra_bulk(), seen.extra_bulk) &&
                      same_indices(op.extra_extra(), seen.extra_extra),
                    communicator);
}

bool DirectSolver::same_values(const SystemOperator &op, const SystemStamps &stamps) const
{
  return everywhere(has_factor && stamps.bulk_values == seen.stamps.bulk_values &&
                      same_entries(op.bulk_extra(), seen.bulk_extra) &&
                      same_entries(op.extra_bulk(), seen.extra_bulk) &&
                      same_entries(op.extra_extra(), seen.extra_extra),
                    communicator);
}

void DirectSolver::analyse(const SystemOperator &op)
{
  const LinearSystem &system = op.system();
  const bool lower = lower_triangle_only(system);
  const bool root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  const auto kind = system.definite && op.n_extra() == 0 ? Mumps::Kind::definite
                    : system.symmetric                   ? Mumps::Kind::symmetric
                                                         : Mumps::Kind::unsymmetric;
  has_factor = false;
  factor = std::make_unique<Mumps>(communicator, kind);

  std::vector<int> rows, columns;
  append_bulk_indices(op, lower, rows, columns);
  const auto add = [&](const auto row, const auto column)
  {
    rows.push_back(static_cast<int>(row + 1));
    columns.push_back(static_cast<int>(column + 1));
  };
  const auto n = op.n_bulk();
  for (const auto &e : op.extra_bulk())
    add(n + e.row, e.column);
  if (!lower)
    for (const auto &e : op.bulk_extra())
      add(e.row, n + e.column);
  if (root)
    for (const auto &e : op.extra_extra())
      if (!lower || e.column <= e.row)
        add(n + e.row, n + e.column);
  factor->analyse(static_cast<int>(n + op.n_extra()), std::move(rows), std::move(columns));
}

void DirectSolver::factorise(const SystemOperator &op)
{
  const bool lower = lower_triangle_only(op.system());
  const bool root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  const auto &scale = op.scaling();

  std::vector<double> values;
  append_bulk_values(op, lower, values);
  const auto bulk_scale = [&](const auto i)
  {
    const auto [block, local] = op.locate(i);
    return SystemOperator::entry(scale.bulk, block, local);
  };
  for (const auto &e : op.extra_bulk())
    values.push_back(scale.extra[e.row] * e.value * bulk_scale(e.column));
  if (!lower)
    for (const auto &e : op.bulk_extra())
      values.push_back(bulk_scale(e.row) * e.value * scale.extra[e.column]);
  if (root)
    for (const auto &e : op.extra_extra())
      if (!lower || e.column <= e.row)
        values.push_back(scale.extra[e.row] * e.value * scale.extra[e.column]);
  has_factor = false;
  factor->factorise(values);
  has_factor = true;
  factor_scaling.copy_from(scale);
}

LinearReport DirectSolver::solve(const LinearSystem &system,
                                 const SystemStamps &stamps,
                                 const double tolerance,
                                 dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                 std::vector<double> &dx_extra)
{
  const bool same_bulk =
    has_factor && stamps.mesh == seen.stamps.mesh && stamps.bulk_values == seen.stamps.bulk_values;
  const SystemOperator op(system, communicator, same_bulk ? &factor_scaling.bulk : nullptr);
  LinearReport report;
  const Stopwatch stopwatch;
  if (!same_pattern(op, stamps))
    analyse(op);
  if (!same_values(op, stamps))
  {
    factorise(op);
    report.factorised = true;
  }
  report.setup_seconds = stopwatch.seconds();
  seen = {stamps,       op.bulk_extra(),  op.extra_bulk(), op.extra_extra(),
          op.n_extra(), system.symmetric, system.definite};

  const BulkTransfer transfer(system.residual_bulk, communicator);
  const bool root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  std::vector<double> x(root ? factor->size() : 0);
  SystemVector dx = op.make_vector(), r = op.load(), correction = op.make_vector();
  const double size = op.scaled_norm(r);
  double last = size;
  if (size > 0.)
    for (unsigned int k = 0; k <= max_direct_refinements; ++k)
    {
      transfer.to_root(r.bulk, factor_scaling.bulk, x.data());
      if (root)
        for (unsigned int i = 0; i < op.n_extra(); ++i)
          x[op.n_bulk() + i] = r.extra[i] * factor_scaling.extra[i];
      factor->solve(x);
      transfer.from_root(x.data(), factor_scaling.bulk, correction.bulk);
      if (root)
        for (unsigned int i = 0; i < op.n_extra(); ++i)
          correction.extra[i] = x[op.n_bulk() + i] * factor_scaling.extra[i];
      MPI_Bcast(correction.extra.data(), op.n_extra(), MPI_DOUBLE, 0, communicator);
      dx.bulk -= correction.bulk;
      for (unsigned int i = 0; i < op.n_extra(); ++i)
        dx.extra[i] -= correction.extra[i];

      op.residual(r, dx);
      const double now = op.scaled_norm(r);
      report.iterations = k;
      report.relative_residual = now / size;
      report.converged = now <= tolerance * size;
      if (report.converged)
        break;
      // The values have changed behind the stamps' back, or refinement has stalled.
      if (!report.factorised)
      {
        factorise(op);
        report.factorised = true;
        dx = op.make_vector();
        r = op.load();
        last = size;
        continue;
      }
      if (!(now < 0.5 * last))
        break;
      last = now;
    }
  else
    report.converged = true;
  if (!(report.relative_residual < 1e-3))
    throw SolveError("The linear system is singular to working precision: the direct solver left " +
                     std::to_string(100. * report.relative_residual) +
                     " per cent of the residual. Usual causes: a body that no boundary condition "
                     "holds, a fracture that cuts a piece off, a pressure without storage, "
                     "conductivity or boundary value.");
  dx_bulk = dx.bulk;
  dx_extra = dx.extra;
  return report;
}
} // namespace stockwork
