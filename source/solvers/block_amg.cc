#include "solvers/block_amg.h"

#include "solvers/aggregation.h"
#include "solvers/krylov.h"
#include "solvers/stopwatch.h"
#include "solvers/system_operator.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace stockwork
{
using namespace dealii;

namespace
{
using AMG = TrilinosWrappers::PreconditionAMG;

/// One application of the block triangular preconditioner.
class BlockTriangular
{
public:
  BlockTriangular(const SystemOperator &op,
                  const DisplacementMultigrid &displacement,
                  const PatchSolver &patch,
                  const SparseFractureSchur &extra,
                  const AMG &pressure,
                  const double pressure_unit)
    : op(op)
    , displacement(displacement)
    , patch(patch)
    , extra(extra)
    , pressure(pressure)
    , pressure_unit(pressure_unit)
    , coupling(op.scaling().bulk.block(0))
  {
  }

  /// z = P^-1 r; r is working space.
  void operator()(SystemVector &z, SystemVector &r)
  {
    if (r.bulk.n_blocks() > 1)
    {
      pressure.vmult(z.bulk.block(1), r.bulk.block(1));
      z.bulk.block(1) *= -1. / pressure_unit;
      op.system().bulk.block(0, 1).vmult(coupling, z.bulk.block(1));
      r.bulk.block(0) -= coupling;
    }
    if (op.n_extra() > 0)
    {
      std::vector<double> drained(z.extra.size(), 0.);
      for (const auto &e : op.extra_bulk())
      {
        const auto [block, local] = op.locate(e.column);
        if (block > 0)
          drained[e.row] += e.value * SystemOperator::entry(z.bulk, block, local);
      }
      op.extra_layout().combine(drained);
      for (std::size_t i = 0; i < drained.size(); ++i)
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
    patch.correct(z.bulk.block(0), r.bulk.block(0));
  }

private:
  const SystemOperator &op;
  const DisplacementMultigrid &displacement;
  const PatchSolver &patch;
  const SparseFractureSchur &extra;
  const AMG &pressure;
  double pressure_unit;
  TrilinosWrappers::MPI::Vector coupling;
};
} // namespace

BlockAmgSolver::BlockAmgSolver(const LinearSolverParameters &parameters,
                               const MPI_Comm communicator)
  : parameters(parameters)
  , communicator(communicator)
  , patch(communicator)
  , extra(communicator)
{
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

void BlockAmgSolver::update_extra(const SystemOperator &op, const bool new_stiffness)
{
  if (new_stiffness)
    extra.forget();
  if (op.n_extra() > 0)
    extra.update(op, stiffness->trilinos_matrix());
}

LinearReport BlockAmgSolver::solve(const LinearSystem &system,
                                   const SystemStamps &stamps,
                                   const double tolerance,
                                   TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                   std::vector<double> &dx_extra)
{
  LinearReport report;
  const bool new_mesh =
    !is_built || stamps.mesh != built_for.mesh || stamps.matrix != built_for.matrix;
  const bool same_bulk = !new_mesh && stamps.bulk_values == built_for.bulk_values;
  const SystemOperator op(system, communicator, same_bulk ? &bulk_scaling : nullptr,
                          SystemOperator::Extra::shared_out);
  if (!same_bulk)
  {
    bulk_scaling.reinit(op.scaling().bulk, true);
    bulk_scaling = op.scaling().bulk;
  }
  const bool poroelastic = system.bulk.n_block_rows() > 1;
  Stopwatch stopwatch;
  // The displacement part is dear and tolerates a matrix that has changed a little; the pressure
  // part is cheap and depends on the time step.
  const bool worn_out = last_iterations > 1.5 * first_iterations;
  report.factorised = new_mesh || (worn_out && stamps.displacement_values != multigrid_values);
  if (!same_bulk)
    build(system, stamps, report.factorised);
  stiffness = &system.bulk.block(0, 0);
  update_extra(op, new_mesh || stamps.displacement_values != built_for.displacement_values);
  if (system.rock_change != nullptr)
    // In two dimensions a factor is never too dear.
    patch.build(system.bulk.block(0, 0), system.rock_change->block(0, 0),
                system.displacement_hierarchy.dim == 3 ? parameters.direct_below.value_or(30000)
                                                       : system.bulk.m());
  else
    patch.clear();
  built_for = stamps;
  report.setup_seconds = stopwatch.seconds();

  const KrylovLimits limits{tolerance, parameters.max_iterations, parameters.restart,
                            system.definite && !poroelastic && op.n_extra() == 0 &&
                              system.rock_change == nullptr};
  SystemVector dx = op.make_vector();
  const auto iterate = [&]()
  {
    BlockTriangular preconditioner(op, displacement, patch, extra, pressure, schur_unit);
    solve_by_krylov(op, communicator, std::ref(preconditioner), limits, dx, report);
  };
  iterate();
  if (!report.converged && !report.factorised)
  {
    stopwatch = Stopwatch();
    build(system, stamps, true);
    report.setup_seconds += stopwatch.seconds();
    report.factorised = true;
    iterate();
  }
  last_iterations = report.iterations / -std::log10(std::min(tolerance, 0.1));
  if (report.factorised)
    first_iterations = last_iterations;
  dx_bulk = dx.bulk;
  dx_extra = op.extra_layout().to_all(dx.extra);
  return report;
}
} // namespace stockwork
