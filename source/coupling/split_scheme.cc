#include "coupling/split_scheme.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "solvers/system_operator.h"

#include <cmath>
#include <sstream>

namespace stockwork
{
using namespace dealii;

void CouplingParameters::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Coupling");
  prm.declare_entry("Scheme", "monolithic",
                    Patterns::Selection("monolithic|fixed stress|undrained|drained|fixed strain"),
                    "Rock and pore fluid together, or by turns until both agree. Fixed stress and "
                    "undrained converge always; drained and fixed strain only while "
                    "alpha^2 M / K < 1. All give the same answer.");
  prm.declare_entry(
    "Stabilisation factor", "1", Quantity(dimension::number, Range::positive()),
    "fixed stress: times alpha^2/K_dr, K_dr = lambda + 2G/dim, is the compressibility "
    "added to the flow. At least 1/2 is safe.");
  prm.declare_entry("Maximum passes", "500", Patterns::Integer(1), "In one solve.");
  prm.declare_entry("Force", "false", Patterns::Bool(),
                    "Run a scheme that is known to diverge in this rock all the same.");
  prm.leave_subsection();
}


void CouplingParameters::parse_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Coupling");
  name = prm.get("Scheme");
  scheme = name == "fixed stress"   ? Scheme::fixed_stress
           : name == "undrained"    ? Scheme::undrained
           : name == "drained"      ? Scheme::drained
           : name == "fixed strain" ? Scheme::fixed_strain
                                    : Scheme::monolithic;
  stabilisation = get_quantity(prm, "Stabilisation factor", dimension::number);
  maximum_passes = prm.get_integer("Maximum passes");
  force = prm.get_bool("Force");
  prm.leave_subsection();
}


void CouplingParameters::check(const RockProperties &rock,
                               const bool has_pore_pressure,
                               const bool has_fracture) const
{
  if (scheme == Scheme::monolithic)
    return;
  if (has_fracture)
    throw EntryError("Coupling/Scheme", name,
                     "monolithic with a fracture: its opening couples rock and fluid far more "
                     "strongly than the pores do");
  if (!has_pore_pressure)
    throw EntryError("Coupling/Scheme", name, "monolithic, because the rock has no pore pressure");
  if (scheme == Scheme::undrained && rock.inverse_biot_modulus <= 0.)
    throw EntryError("Coupling/Scheme", name,
                     "monolithic or fixed stress, because nothing in this rock can be compressed "
                     "(1/M = 0) and its undrained stiffness is infinite");
  if (scheme == Scheme::drained || scheme == Scheme::fixed_strain)
  {
    const double bulk_modulus = rock.young_modulus / (3. * (1. - 2. * rock.poisson_ratio));
    const double alpha = rock.biot_coefficient;
    const double strength = alpha * alpha / (rock.inverse_biot_modulus * bulk_modulus);
    if (strength >= 1. && !force)
    {
      std::ostringstream value;
      value.precision(3);
      value << strength;
      throw EntryError("Coupling/Scheme", name,
                       "monolithic, fixed stress or undrained, because the coupling strength "
                       "alpha^2 M/K is " +
                         value.str() +
                         " and this split diverges above 1 ('Coupling/Force = true' runs it all "
                         "the same)");
    }
  }
}


SplitScheme::SplitScheme(const CouplingParameters &parameters,
                         const LinearSolverParameters &solver_parameters,
                         const BulkStructure &structure,
                         const MPI_Comm communicator,
                         UndrainedTerm undrained_term)
  : parameters(parameters)
  , communicator(communicator)
  , undrained_term(std::move(undrained_term))
{
  BulkStructure alone = structure;
  alone.has_pore_pressure = false;
  mechanics.solver = make_linear_solver(solver_parameters, alone, communicator);
  // Multigrid for the rock knows displacements; the flow's block is small and gets a factor.
  LinearSolverParameters direct = solver_parameters;
  direct.type = LinearSolverParameters::Type::direct;
  flow.solver = make_linear_solver(direct, alone, communicator);
}


double SplitScheme::Block::correct(const TrilinosWrappers::MPI::Vector &residual,
                                   const double tolerance,
                                   TrilinosWrappers::MPI::Vector &x)
{
  system.residual_bulk.block(0) = residual;
  TrilinosWrappers::MPI::BlockVector dx(1);
  dx.block(0).reinit(x, true);
  dx.collect_sizes();
  std::vector<double> none;
  const LinearReport report = solver->solve(system, stamps, tolerance, dx, none);
  if (!report.converged)
    throw SolveError("a block of the split scheme was not solved");
  x += dx.block(0);
  return report.setup_seconds;
}


void SplitScheme::update_blocks(const LinearSystem &system, const SystemStamps &stamps)
{
  const bool new_mesh = !has_seen || stamps.mesh != seen.mesh;
  const bool new_values = new_mesh || stamps.bulk_values != seen.bulk_values;
  for (unsigned int k = 0; k < 2; ++k)
  {
    Block &block = k == 0 ? mechanics : flow;
    block.stamps.mesh = stamps.mesh;
    block.stamps.bulk_values = k == 0 ? stamps.displacement_values : stamps.bulk_values;
    block.stamps.displacement_values = block.stamps.bulk_values;
    if (new_mesh)
    {
      block.system.bulk.reinit(1, 1);
      block.system.bulk.block(0, 0).reinit(system.bulk.block(k, k));
      block.system.bulk.collect_sizes();
      block.system.residual_bulk.reinit(1);
      block.system.residual_bulk.block(0).reinit(system.residual_bulk.block(k));
      block.system.residual_bulk.collect_sizes();
      block.system.symmetric = system.symmetric;
      block.system.elastic = k == 0;
      block.system.definite = k == 0 && system.symmetric;
    }
    if (new_values)
      block.system.bulk.block(0, 0).copy_from(system.bulk.block(k, k));
  }
  if (new_values && parameters.scheme == CouplingParameters::Scheme::undrained)
    undrained_term(mechanics.system.bulk.block(0, 0));
  if (new_values && parameters.scheme == CouplingParameters::Scheme::fixed_stress)
    flow.system.bulk.block(0, 0).add(-parameters.stabilisation, system.fixed_stress_mass);
  seen = stamps;
  has_seen = true;
}


LinearReport SplitScheme::solve(const LinearSystem &system,
                                const SystemStamps &stamps,
                                const double tolerance,
                                TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                std::vector<double> &dx_extra)
{
  using Scheme = CouplingParameters::Scheme;
  Assert(system.residual_extra.empty(), ExcNotImplemented());
  update_blocks(system, stamps);

  // Every pass corrects with the residual of the whole system, so that whatever matrix a block is
  // solved with, the end is the solution of the coupled system.
  const SystemOperator system_operator(system, communicator);
  SystemVector x = system_operator.make_vector(), r = system_operator.make_vector();
  dx_extra.clear();
  system_operator.residual(r, x);
  const double first = system_operator.scaled_norm(r);
  const bool flow_first =
    parameters.scheme == Scheme::fixed_stress || parameters.scheme == Scheme::fixed_strain;

  // The passes correct one another, so a block need not be solved better than a pass converges.
  constexpr double block_tolerance = 1e-3;
  LinearReport report;
  double norm = first, before = first;
  for (report.iterations = 0;
       norm > tolerance * first && report.iterations < parameters.maximum_passes;
       ++report.iterations)
  {
    for (const unsigned int k : {flow_first ? 1u : 0u, flow_first ? 0u : 1u})
    {
      report.setup_seconds +=
        (k == 0 ? mechanics : flow).correct(r.bulk.block(k), block_tolerance, x.bulk.block(k));
      system_operator.residual(r, x);
    }
    before = norm;
    norm = system_operator.scaled_norm(r);
    if (!(norm < 1e10 * first))
      break;
  }
  report.relative_residual = first > 0. ? norm / first : 0.;
  report.converged = norm <= tolerance * first;
  if (!report.converged)
    throw SolveError(
      "the " + parameters.name + " split " + (norm < before ? "has not converged" : "diverges") +
      ": after " + std::to_string(report.iterations) +
      " passes the residual changes by a factor of " + std::to_string(norm / before) +
      " per pass. 'Coupling/Scheme = monolithic' has no such limit");
  dx_bulk = x.bulk;
  return report;
}
} // namespace stockwork
