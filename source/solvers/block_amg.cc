#include "solvers/block_amg.h"

#include "solvers/aggregation.h"
#include "solvers/system_operator.h"
#include "stockwork/base/error.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>


namespace stockwork
{
using namespace dealii;

namespace
{
/// Rounding makes the residual of the recurrence drift from the true one; then start afresh.
constexpr unsigned int max_cycles = 4;

using BlockVector = TrilinosWrappers::MPI::BlockVector;
using AMG = TrilinosWrappers::PreconditionAMG;

/// The bulk matrix between diagonal scalings, so that the Krylov method sees the norm of
/// LinearReport.
class ScaledBulk
{
public:
  ScaledBulk(const TrilinosWrappers::BlockSparseMatrix &matrix, const BlockVector &scaling)
    : matrix(matrix)
    , scaling(scaling)
    , unscaled(scaling)
  {
  }

  void vmult(BlockVector &dst, const BlockVector &src) const
  {
    unscaled = src;
    unscaled.scale(scaling);
    matrix.vmult(dst, unscaled);
    dst.scale(scaling);
  }

private:
  const TrilinosWrappers::BlockSparseMatrix &matrix;
  const BlockVector &scaling;
  mutable BlockVector unscaled;
};

/// One application of the block triangular preconditioner, between inverse scalings.
class BlockTriangular
{
public:
  BlockTriangular(const TrilinosWrappers::BlockSparseMatrix &matrix,
                  const BlockVector &scaling,
                  const DisplacementMultigrid &displacement,
                  const AMG *pressure,
                  const double pressure_unit)
    : matrix(matrix)
    , inverse_scaling(scaling)
    , displacement(displacement)
    , pressure(pressure)
    , pressure_unit(pressure_unit)
    , residual(scaling)
    , coupling(scaling.block(0))
  {
    for (unsigned int b = 0; b < scaling.n_blocks(); ++b)
    {
      auto &v = inverse_scaling.block(b).trilinos_vector();
      v.Reciprocal(scaling.block(b).trilinos_vector());
    }
  }

  void vmult(BlockVector &dst, const BlockVector &src) const
  {
    residual = src;
    residual.scale(inverse_scaling);
    if (pressure != nullptr)
    {
      pressure->vmult(dst.block(1), residual.block(1));
      dst.block(1) *= -1. / pressure_unit;
      matrix.block(0, 1).vmult(coupling, dst.block(1));
      residual.block(0) -= coupling;
    }
    displacement.vmult(dst.block(0), residual.block(0));
    dst.scale(inverse_scaling);
  }

private:
  const TrilinosWrappers::BlockSparseMatrix &matrix;
  BlockVector inverse_scaling;
  const DisplacementMultigrid &displacement;
  const AMG *pressure;
  double pressure_unit;
  mutable BlockVector residual;
  mutable TrilinosWrappers::MPI::Vector coupling;
};
} // namespace

BlockAmgSolver::BlockAmgSolver(const LinearSolverParameters &parameters,
                               const MPI_Comm communicator)
  : parameters(parameters)
  , communicator(communicator)
{
}

void BlockAmgSolver::build(const LinearSystem &system, const bool with_displacement)
{
  if (with_displacement)
    displacement.build(system.bulk.block(0, 0), system.displacement_hierarchy);
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
  if (!system.residual_extra.empty())
    throw InputError("The iterative linear solver cannot treat fracture unknowns. Choose "
                     "Linear solver/Type = direct or bordered (or auto).");
  LinearReport report;
  const SystemOperator op(system, communicator);
  // The displacement part is dear and tolerates a matrix that has changed a little; the pressure
  // part is cheap and depends on the time step.
  const bool new_mesh = !is_built || stamps.mesh != built_for.mesh;
  const bool new_values = new_mesh || stamps.bulk_values != built_for.bulk_values;
  const bool worn_out = last_iterations > first_iterations + first_iterations / 2;
  report.factorised = new_mesh || (new_values && worn_out);
  if (new_values)
    build(system, report.factorised);
  built_for = stamps;

  const auto &scaling = op.scaling().bulk;
  const ScaledBulk matrix(system.bulk, scaling);
  const bool poroelastic = system.bulk.n_block_rows() > 1;
  const BlockTriangular preconditioner(system.bulk, scaling, displacement,
                                       poroelastic ? &pressure : nullptr, schur_unit);
  BlockVector x(scaling), b(scaling), r(scaling);
  x = 0.;
  b = system.residual_bulk;
  b.scale(scaling);
  b *= -1.;
  const double size = b.l2_norm();
  dx_extra.clear();

  const auto iterate = [&]()
  {
    SolverControl control(parameters.max_iterations, tolerance * size);
    try
    {
      if (system.definite && !poroelastic)
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
    build(system, true);
    report.factorised = true;
    x = 0.;
    iterate();
  }
  last_iterations = report.iterations;
  if (report.factorised)
    first_iterations = report.iterations;
  x.scale(scaling);
  dx_bulk = x;
  return report;
}
} // namespace stockwork
