#include "coupling/split_block.h"

#include "solvers/stopwatch.h"
#include "stockwork/base/error.h"

#include <deal.II/base/mpi.h>

namespace stockwork
{
using namespace dealii;

SplitBlock::SplitBlock(const LinearSolverParameters &parameters,
                       const BulkStructure &structure,
                       const MPI_Comm communicator)
  : communicator(communicator)
  , solver(make_linear_solver(parameters, structure, communicator))
{
}


void SplitBlock::take_border(const LinearSystem &whole, const types::global_dof_index offset)
{
  const auto is_in_bulk = [&](const auto i)
  {
    return part.has_bulk && i >= offset &&
           i - offset < whole.residual_bulk.block(part.block).size();
  };
  const auto is_extra = [&](const auto i) { return i >= part.extra_begin && i < part.extra_end; };
  const auto take = [](const Triplets &from, Triplets &to, const auto &row, const auto &column)
  {
    to.clear();
    for (std::size_t k = 0; k < from.values.size(); ++k)
      if (row.first(from.rows[k]) && column.first(from.columns[k]))
        to.add(from.rows[k] - row.second, from.columns[k] - column.second, from.values[k]);
  };
  const std::pair bulk(is_in_bulk, offset);
  const std::pair extra(is_extra, static_cast<types::global_dof_index>(part.extra_begin));
  take(whole.bulk_extra, system.bulk_extra, bulk, extra);
  take(whole.extra_bulk, system.extra_bulk, extra, bulk);
  take(whole.extra_extra, system.extra_extra, extra, extra);
  system.residual_extra.assign(part.extra_end - part.extra_begin, 0.);
}


bool SplitBlock::update(const SystemOperator &whole,
                        const SystemStamps &now,
                        const SplitPart &new_part)
{
  const LinearSystem &from = whole.system();
  part = new_part;
  const bool new_mesh = !has_system || stamps.mesh != now.mesh;
  const bool new_values = new_mesh || stamps.bulk_values != now.bulk_values;
  if (part.has_bulk && new_mesh)
  {
    system.bulk.reinit(1, 1);
    system.bulk.block(0, 0).reinit(from.bulk.block(part.block, part.block));
    system.bulk.collect_sizes();
    system.residual_bulk.reinit(1);
    system.residual_bulk.block(0).reinit(from.residual_bulk.block(part.block));
    system.residual_bulk.collect_sizes();
    if (part.block == 0)
      system.displacement_hierarchy = from.displacement_hierarchy;
  }
  if (part.has_bulk && new_values)
    system.bulk.block(0, 0).copy_from(from.bulk.block(part.block, part.block));
  take_border(from, part.has_bulk ? whole.offset(part.block) : 0);
  system.symmetric = from.symmetric;
  system.elastic = part.block == 0;
  system.definite = system.elastic && from.definite_displacement;
  stamps = now;
  has_system = true;
  has_extra_factor = false;
  return part.has_bulk && new_values;
}


void SplitBlock::factorise_extra()
{
  const unsigned int n = part.extra_end - part.extra_begin;
  std::vector<double> entries(n * n, 0.);
  const Triplets &own = system.extra_extra;
  for (std::size_t k = 0; k < own.values.size(); ++k)
    entries[own.rows[k] * n + own.columns[k]] += own.values[k];
  Utilities::MPI::sum(entries, communicator, entries);
  extra_solver.factorise(FullMatrix<double>(n, n, entries.data()),
                         std::vector<unsigned int>(n, DenseSolver::anonymous));
  has_extra_factor = true;
}


/// The fluid of fractures in rock without pores: few unknowns and no bulk.
double SplitBlock::correct_extra(const SystemVector &residual, SystemVector &x)
{
  const Stopwatch stopwatch;
  if (!has_extra_factor)
    factorise_extra();
  const double setup_seconds = stopwatch.seconds();
  Vector<double> dx(residual.extra.begin() + part.extra_begin,
                    residual.extra.begin() + part.extra_end);
  extra_solver.solve(dx);
  for (unsigned int i = 0; i < dx.size(); ++i)
    x.extra[part.extra_begin + i] -= dx(i);
  return setup_seconds;
}


double SplitBlock::correct(const SystemVector &residual, const double tolerance, SystemVector &x)
{
  if (!part.has_bulk)
    return part.extra_begin == part.extra_end ? 0. : correct_extra(residual, x);
  system.residual_bulk.block(0) = residual.bulk.block(part.block);
  system.residual_extra.assign(residual.extra.begin() + part.extra_begin,
                               residual.extra.begin() + part.extra_end);
  TrilinosWrappers::MPI::BlockVector dx(1);
  dx.block(0).reinit(x.bulk.block(part.block), true);
  dx.collect_sizes();
  std::vector<double> dx_extra;
  const LinearReport report = solver->solve(system, stamps, tolerance, dx, dx_extra);
  if (!report.converged)
    throw SolveError("a block of the split scheme was not solved");
  x.bulk.block(part.block) += dx.block(0);
  for (unsigned int i = 0; i < dx_extra.size(); ++i)
    x.extra[part.extra_begin + i] += dx_extra[i];
  return report.setup_seconds;
}
} // namespace stockwork
