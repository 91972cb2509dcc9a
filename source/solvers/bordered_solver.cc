#include "solvers/bordered_solver.h"

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
constexpr unsigned int max_refinements = 4;
} // namespace

BorderedSolver::BorderedSolver(const MPI_Comm communicator)
  : communicator(communicator)
  , is_root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  , direct(communicator)
  , schur(communicator,
          [this](const auto &left, const auto &right, const bool transposed)
          { return multiply(left, right, transposed); })
{
}

void BorderedSolver::factorise(const SystemOperator &op, const SystemStamps &stamps)
{
  // The products belong to the old factor, whatever happens below.
  schur.forget();
  const bool definite = op.system().definite;
  if (!factor || stamps.mesh != factor_stamps.mesh ||
      static_cast<unsigned int>(factor->size()) != op.n_bulk())
  {
    factor = std::make_unique<Mumps>(communicator,
                                     definite ? Mumps::Kind::definite : Mumps::Kind::unsymmetric);
    std::vector<int> rows, columns;
    append_bulk_indices(op, definite, rows, columns);
    factor->analyse(static_cast<int>(op.n_bulk()), std::move(rows), std::move(columns));
  }
  std::vector<double> values;
  append_bulk_values(op, definite, values);
  factor->factorise(values);
  factor_scaling = op.scaling();
  factor_stamps = stamps;
}

std::vector<double> BorderedSolver::solve_columns(const ExtraSchur::SparseVectors &right_hand_sides,
                                                  const bool transposed)
{
  std::vector<int> starts = {1}, rows;
  std::vector<double> values;
  for (const auto *b : right_hand_sides)
  {
    for (const auto &[i, value] : *b)
    {
      rows.push_back(i + 1);
      values.push_back(value);
    }
    starts.push_back(static_cast<int>(rows.size()) + 1);
  }
  std::vector<double> x(is_root ? right_hand_sides.size() * factor->size() : 0);
  factor->solve_sparse(starts, rows, values, x, transposed);
  return x;
}

std::vector<double> BorderedSolver::multiply(const ExtraSchur::SparseVectors &left,
                                             const ExtraSchur::SparseVectors &right,
                                             const bool transposed)
{
  const std::vector<double> x = solve_columns(right, transposed);
  std::vector<double> result;
  result.reserve(left.size() * right.size());
  if (is_root)
    for (std::size_t j = 0; j < right.size(); ++j)
      for (const auto *vector : left)
      {
        const double *solution = x.data() + j * factor->size();
        double sum = 0.;
        for (const auto &[i, value] : *vector)
          sum += value * solution[i];
        result.push_back(sum);
      }
  result.resize(left.size() * right.size());
  MPI_Bcast(result.data(), static_cast<int>(result.size()), MPI_DOUBLE, 0, communicator);
  return result;
}

void BorderedSolver::eliminate(const SystemOperator &op,
                               const SystemVector &r,
                               SystemVector &dx,
                               const bool skip_bulk_load)
{
  const BulkTransfer transfer(op.system().residual_bulk, communicator);
  std::vector<double> x(is_root ? factor->size() : 0);
  SystemVector y = op.make_vector();
  const auto solve_bulk = [&](const SystemVector &load)
  {
    transfer.to_root(load.bulk, factor_scaling.bulk, x.data());
    factor->solve(x);
    transfer.from_root(x.data(), factor_scaling.bulk, y.bulk);
  };

  SystemVector load = r;
  if (op.n_extra() > 0)
  {
    // S z = r_extra - C A^-1 r_bulk
    std::vector<double> z(op.n_extra(), 0.);
    if (!skip_bulk_load)
    {
      solve_bulk(r);
      for (const auto &e : op.extra_bulk())
      {
        const auto [block, local] = op.locate(e.column);
        z[e.row] -= e.value * SystemOperator::entry(y.bulk, block, local);
      }
      dealii::Utilities::MPI::sum(z, communicator, z);
    }
    for (unsigned int i = 0; i < op.n_extra(); ++i)
      z[i] += r.extra[i];
    schur.solve(z);
    for (unsigned int i = 0; i < op.n_extra(); ++i)
      dx.extra[i] -= z[i];
    for (const auto &e : op.bulk_extra())
    {
      const auto [block, local] = op.locate(e.row);
      SystemOperator::entry(load.bulk, block, local) -= e.value * z[e.column];
    }
  }
  solve_bulk(load);
  dx.bulk -= y.bulk;
}

LinearReport BorderedSolver::solve(const LinearSystem &system,
                                   const SystemStamps &stamps,
                                   const double tolerance,
                                   dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                   std::vector<double> &dx_extra)
{
  if (!system.elastic)
    return direct.solve(system, stamps, tolerance, dx_bulk, dx_extra);

  const bool same_bulk =
    factor && stamps.mesh == factor_stamps.mesh && stamps.bulk_values == factor_stamps.bulk_values;
  const SystemOperator op(system, communicator, same_bulk ? &factor_scaling.bulk : nullptr);
  LinearReport report;
  const auto prepare = [&](const bool anew)
  {
    if (anew)
      factorise(op, stamps);
    report.factorised |= anew;
    if (op.n_extra() == 0)
      return;
    schur.update(op, op.n_bulk(), &factor_scaling.bulk);
  };
  const Stopwatch stopwatch;
  prepare(!same_bulk);
  report.setup_seconds = stopwatch.seconds();

  SystemVector dx = op.make_vector(), r = op.make_vector();
  r.bulk = system.residual_bulk;
  r.extra = system.residual_extra;
  const double size = op.scaled_norm(r);
  double last = size;
  if (size == 0.)
    report.converged = true;
  for (unsigned int k = 0; k <= max_refinements && !report.converged; ++k)
  {
    // In a Newton iteration after the first, the bulk is in equilibrium already: its load would
    // be rounding errors.
    SystemVector bulk_only = op.make_vector();
    bulk_only.bulk = r.bulk;
    const bool in_balance = op.scaled_norm(bulk_only) <= 1e-2 * tolerance * size;
    eliminate(op, r, dx, in_balance);

    op.residual(r, dx);
    const double now = op.scaled_norm(r);
    report.iterations = k;
    report.relative_residual = now / size;
    report.converged = now <= tolerance * size;
    if (!report.converged && !(now < 0.5 * last))
    {
      if (report.factorised)
        break;
      prepare(true); // the values have changed behind the stamps' back
      dx = op.make_vector();
      r.bulk = system.residual_bulk;
      r.extra = system.residual_extra;
      last = size;
      continue;
    }
    last = now;
  }
  if (!(report.relative_residual < 1e-3))
    ExtraSchur::throw_singular();
  dx_bulk = dx.bulk;
  dx_extra = dx.extra;
  return report;
}
} // namespace stockwork
