#include "solvers/block_amg.h"

#include "solvers/aggregation.h"
#include "solvers/stopwatch.h"
#include "solvers/system_operator.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Rounding makes the residual of the recurrence drift from the true one; then start afresh.
constexpr unsigned int max_cycles = 4;

using BlockVector = TrilinosWrappers::MPI::BlockVector;
using AMG = TrilinosWrappers::PreconditionAMG;

/// Of the products in the Schur complement of the extra unknowns, which preconditions only.
constexpr double product_tolerance = 1e-6;

/// All unknowns as one block vector, for the library's Krylov methods. The extra ones, if any, are
/// its last block, on rank 0.
class Joined
{
public:
  Joined(const SystemOperator &op, const MPI_Comm communicator)
    : n_extra(op.n_extra())
    , communicator(communicator)
    , is_root(Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    const auto &bulk = op.scaling().bulk;
    const unsigned int n_bulk = bulk.n_blocks();
    zero.reinit(n_bulk + (n_extra > 0 ? 1 : 0));
    for (unsigned int b = 0; b < n_bulk; ++b)
      zero.block(b).reinit(bulk.block(b).locally_owned_elements(), communicator);
    if (n_extra > 0)
    {
      IndexSet owned(n_extra);
      if (is_root)
        owned.add_range(0, n_extra);
      zero.block(n_bulk).reinit(owned, communicator);
    }
    zero.collect_sizes();
  }

  BlockVector join(const SystemVector &from) const
  {
    BlockVector to(zero);
    join(to, from);
    return to;
  }

  void join(BlockVector &to, const SystemVector &from) const
  {
    for (unsigned int b = 0; b < from.bulk.n_blocks(); ++b)
      to.block(b) = from.bulk.block(b);
    if (n_extra > 0 && is_root)
      std::copy(from.extra.begin(), from.extra.end(),
                to.block(to.n_blocks() - 1).trilinos_vector()[0]);
  }

  void split(SystemVector &to, const BlockVector &from) const
  {
    for (unsigned int b = 0; b < to.bulk.n_blocks(); ++b)
      to.bulk.block(b) = from.block(b);
    if (n_extra == 0)
      return;
    if (is_root)
    {
      const double *extra = from.block(from.n_blocks() - 1).trilinos_vector()[0];
      to.extra.assign(extra, extra + n_extra);
    }
    MPI_Bcast(to.extra.data(), static_cast<int>(n_extra), MPI_DOUBLE, 0, communicator);
  }

private:
  unsigned int n_extra;
  MPI_Comm communicator;
  bool is_root;
  BlockVector zero;
};

/// The matrix between diagonal scalings, so that the Krylov method sees the norm of LinearReport.
class ScaledSystem
{
public:
  ScaledSystem(const SystemOperator &op, const Joined &joined)
    : op(op)
    , joined(joined)
    , scaling(joined.join(op.scaling()))
    , unscaled(scaling)
    , in(op.make_vector())
    , out(op.make_vector())
  {
  }

  void vmult(BlockVector &dst, const BlockVector &src) const
  {
    unscaled = src;
    unscaled.scale(scaling);
    joined.split(in, unscaled);
    op.vmult(out, in);
    joined.join(dst, out);
    dst.scale(scaling);
  }

private:
  const SystemOperator &op;
  const Joined &joined;
  const BlockVector scaling;
  mutable BlockVector unscaled;
  mutable SystemVector in, out;
};

/// One application of the block triangular preconditioner, between inverse scalings.
class BlockTriangular
{
public:
  BlockTriangular(const SystemOperator &op,
                  const Joined &joined,
                  const MPI_Comm communicator,
                  const DisplacementMultigrid &displacement,
                  const ExtraSchur &extra,
                  const AMG &pressure,
                  const double pressure_unit)
    : op(op)
    , joined(joined)
    , communicator(communicator)
    , displacement(displacement)
    , extra(extra)
    , pressure(pressure)
    , pressure_unit(pressure_unit)
    , inverse_scaling(joined.join(op.scaling()))
    , unscaled(inverse_scaling)
    , r(op.make_vector())
    , z(op.make_vector())
    , coupling(r.bulk.block(0))
  {
    for (unsigned int b = 0; b < inverse_scaling.n_blocks(); ++b)
    {
      auto &v = inverse_scaling.block(b).trilinos_vector();
      v.Reciprocal(v);
    }
  }

  void vmult(BlockVector &dst, const BlockVector &src) const
  {
    unscaled = src;
    unscaled.scale(inverse_scaling);
    joined.split(r, unscaled);
    if (r.bulk.n_blocks() > 1)
    {
      pressure.vmult(z.bulk.block(1), r.bulk.block(1));
      z.bulk.block(1) *= -1. / pressure_unit;
      op.system().bulk.block(0, 1).vmult(coupling, z.bulk.block(1));
      r.bulk.block(0) -= coupling;
    }
    if (op.n_extra() > 0)
    {
      std::vector<double> drained(op.n_extra(), 0.);
      for (const auto &e : op.extra_bulk())
      {
        const auto [block, local] = op.locate(e.column);
        if (block > 0)
          drained[e.row] += e.value * SystemOperator::entry(z.bulk, block, local);
      }
      Utilities::MPI::sum(drained, communicator, drained);
      for (unsigned int i = 0; i < op.n_extra(); ++i)
        z.extra[i] = r.extra[i] - drained[i];
      extra.solve(z.extra);
      for (const auto &e : op.bulk_extra())
      {
        const auto [block, local] = op.locate(e.row);
        if (block == 0)
          SystemOperator::entry(r.bulk, block, local) -= e.value * z.extra[e.column];
      }
    }
    displacement.vmult(z.bulk.block(0), r.bulk.block(0));
    joined.join(dst, z);
    dst.scale(inverse_scaling);
  }

private:
  const SystemOperator &op;
  const Joined &joined;
  MPI_Comm communicator;
  const DisplacementMultigrid &displacement;
  const ExtraSchur &extra;
  const AMG &pressure;
  double pressure_unit;
  BlockVector inverse_scaling;
  mutable BlockVector unscaled;
  mutable SystemVector r, z;
  mutable TrilinosWrappers::MPI::Vector coupling;
};
} // namespace

BlockAmgSolver::BlockAmgSolver(const LinearSolverParameters &parameters,
                               const MPI_Comm communicator)
  : parameters(parameters)
  , communicator(communicator)
  , extra(communicator,
          [this](const auto &left, const auto &right) { return multiply(left, right); })
{
}

std::vector<double> BlockAmgSolver::multiply(const ExtraSchur::SparseVectors &left,
                                             const ExtraSchur::SparseVectors &right) const
{
  TrilinosWrappers::MPI::Vector x(stiffness->locally_owned_range_indices(), communicator), b(x);
  const auto [begin, end] = b.local_range();
  std::vector<double> result;
  for (const auto *column : right)
  {
    b = 0.;
    for (const auto &[i, value] : *column)
      if (begin <= static_cast<unsigned int>(i) && static_cast<unsigned int>(i) < end)
        b.trilinos_vector()[0][i - begin] += value;
    x = 0.;
    ReductionControl control(parameters.max_iterations, 0., product_tolerance);
    try
    {
      if (b.l2_norm() > 0.)
        SolverCG<TrilinosWrappers::MPI::Vector>(control).solve(*stiffness, x, b, displacement);
    }
    catch (const SolverControl::NoConvergence &)
    {
      // A worse preconditioner, and FGMRES will tell.
    }
    for (const auto *row : left)
    {
      double sum = 0.;
      for (const auto &[i, value] : *row)
        if (begin <= static_cast<unsigned int>(i) && static_cast<unsigned int>(i) < end)
          sum += value * x.trilinos_vector()[0][i - begin];
      result.push_back(sum);
    }
  }
  Utilities::MPI::sum(result, communicator, result);
  return result;
}

void BlockAmgSolver::build(const LinearSystem &system,
                           const SystemStamps &stamps,
                           const bool with_displacement)
{
  if (with_displacement)
  {
    displacement.build(system.bulk.block(0, 0), system.displacement_hierarchy);
    multigrid_values = stamps.displacement_values;
  }
  if (system.bulk.n_block_rows() > 1)
  {
    // In SI its entries may be so small that ML takes them for zeros.
    schur_unit = system.bulk.block(1, 1).linfty_norm();
    schur.copy_from(system.bulk.block(1, 1));
    schur *= -1. / schur_unit;
    schur.add(1. / schur_unit, system.fixed_stress_mass);
    pressure.initialize(schur, aggregation_parameters());
  }
  is_built = true;
}

LinearReport BlockAmgSolver::solve(const LinearSystem &system,
                                   const SystemStamps &stamps,
                                   const double tolerance,
                                   TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                   std::vector<double> &dx_extra)
{
  LinearReport report;
  const SystemOperator op(system, communicator);
  const bool poroelastic = system.bulk.n_block_rows() > 1;
  Stopwatch stopwatch;
  // The displacement part is dear and tolerates a matrix that has changed a little; the pressure
  // part is cheap and depends on the time step.
  const bool new_mesh = !is_built || stamps.mesh != built_for.mesh;
  const bool worn_out = last_iterations > first_iterations + first_iterations / 2;
  report.factorised = new_mesh || (worn_out && stamps.displacement_values != multigrid_values);
  if (new_mesh || stamps.bulk_values != built_for.bulk_values)
    build(system, stamps, report.factorised);
  stiffness = &system.bulk.block(0, 0);
  if (new_mesh || stamps.displacement_values != built_for.displacement_values)
    extra.forget();
  if (op.n_extra() > 0)
    // A preconditioner may take the rock for symmetric where rows of bonds are not quite.
    extra.update(op, op.border(), stiffness->m(), true);
  built_for = stamps;
  report.setup_seconds = stopwatch.seconds();

  const Joined joined(op, communicator);
  const ScaledSystem matrix(op, joined);
  const BlockTriangular preconditioner(op, joined, communicator, displacement, extra, pressure,
                                       schur_unit);
  SystemVector load = op.make_vector();
  load.bulk = system.residual_bulk;
  load.extra = system.residual_extra;
  const BlockVector scaling = joined.join(op.scaling());
  BlockVector b = joined.join(load), x(scaling), r(scaling);
  x = 0.;
  b.scale(scaling);
  b *= -1.;
  const double size = b.l2_norm();

  const auto iterate = [&]()
  {
    SolverControl control(parameters.max_iterations, tolerance * size);
    try
    {
      if (system.definite && !poroelastic && op.n_extra() == 0)
        SolverCG<BlockVector>(control).solve(matrix, x, b, preconditioner);
      else
        SolverFGMRES<BlockVector>(control,
                                  SolverFGMRES<BlockVector>::AdditionalData(parameters.restart))
          .solve(matrix, x, b, preconditioner);
    }
    catch (const SolverControl::NoConvergence &)
    {
    }
    report.iterations += control.last_step();
    // Not what the recurrence believes, but what is.
    matrix.vmult(r, x);
    r -= b;
    report.relative_residual = r.l2_norm() / size;
    report.converged = report.relative_residual <= 1.01 * tolerance;
  };
  if (size == 0.)
    report.converged = true;
  else
    for (unsigned int cycle = 0;
         cycle < max_cycles && !report.converged && report.iterations < parameters.max_iterations;
         ++cycle)
      iterate();
  if (!report.converged && !report.factorised)
  {
    stopwatch = Stopwatch();
    build(system, stamps, true);
    report.setup_seconds += stopwatch.seconds();
    report.factorised = true;
    x = 0.;
    iterate();
  }
  last_iterations = report.iterations;
  if (report.factorised)
    first_iterations = report.iterations;
  x.scale(scaling);
  joined.split(load, x);
  dx_bulk = load.bulk;
  dx_extra = load.extra;
  return report;
}
} // namespace stockwork
