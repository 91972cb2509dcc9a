#include "coupling/split_scheme.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "solvers/krylov.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// The passes correct one another, so a block need not be solved better than a pass converges.
constexpr double rough = 1e-3;
/// A single pass is corrected by nothing.
constexpr double exact = 1e-10;

BulkStructure without_pores(BulkStructure structure)
{
  structure.has_pore_pressure = false;
  return structure;
}


LinearSolverParameters direct(LinearSolverParameters parameters)
{
  parameters.type = LinearSolverParameters::Type::direct;
  return parameters;
}
} // namespace


void CouplingParameters::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Coupling");
  prm.declare_entry("Scheme", "monolithic",
                    Patterns::Selection("monolithic|fixed stress|undrained|drained|fixed strain|as "
                                        "published"),
                    "Rock and fluid together, or by turns until both agree. In rock without a "
                    "fracture fixed stress and undrained converge always, drained and fixed strain "
                    "only while alpha^2 M / K < 1. With a fracture: fixed stress. All give the "
                    "same answer. as published is none of these: the sequence of Zhang et al. "
                    "(2022) for damage, which starts from zero in every step and injects for a "
                    "longer and longer time; one solve for the flow with the apertures of the step "
                    "before, one for the rock with its damage, no iteration. It loses fluid, and "
                    "fluid_balance_error says how much.");
  prm.declare_entry(
    "Stabilisation factor", "1", Quantity(dimension::number, Range::positive()),
    "fixed stress: times alpha^2/K_dr, K_dr = lambda + 2G/dim, is the compressibility "
    "added to the flow in pores, at least 1/2 is safe there; and times what a segment of a "
    "fracture opens by as the pressure grows in all of them, is that of the fracture.");
  prm.declare_entry("Maximum passes", "500", Patterns::Integer(1), "In one solve.");
  prm.declare_entry(
    "Acceleration", "auto", Patterns::Selection("auto|none|GMRES"),
    "How passes are combined. none: one after another, which shows what the scheme can "
    "do. GMRES: so that the residual is least, which ends where many a scheme alone "
    "diverges. auto: GMRES where there is fluid in a fracture.");
  prm.declare_entry("Time of full rate", "0 s", Quantity(dimension::time, Range::non_negative()),
                    "as published: T_0 of Eq. 39. Before, wells have the share t/T_0 of their "
                    "rate.");
  prm.declare_entry(
    "Storage", "1/(1-D)", Patterns::Selection("1/(1-D)|compliance"),
    "as published: what takes up the fluid while apertures are held. 1/(1-D): pores "
    "of the damaged rock, Eqs. 23 and 24; what they take never comes to the crack. "
    "compliance: what the crack opens by with the pressure, and no fluid is lost.");
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
           : name == "as published" ? Scheme::as_published
                                    : Scheme::monolithic;
  stabilisation = get_quantity(prm, "Stabilisation factor", dimension::number);
  maximum_passes = prm.get_integer("Maximum passes");
  acceleration = prm.get("Acceleration") == "auto"   ? Acceleration::automatic
                 : prm.get("Acceleration") == "none" ? Acceleration::none
                                                     : Acceleration::gmres;
  force = prm.get_bool("Force");
  full_rate_time = get_quantity(prm, "Time of full rate", dimension::time);
  damaged_pores = prm.get("Storage") == "1/(1-D)";
  if (!damaged_pores && !restarts())
    throw EntryError("Coupling/Storage", prm.get("Storage"),
                     "1/(1-D) without 'Coupling/Scheme = as published': it has no meaning there");
  if (full_rate_time > 0. && !restarts())
    throw EntryError("Coupling/Time of full rate", prm.get("Time of full rate"),
                     "0 s without 'Coupling/Scheme = as published': give 'Wells/Well 1/Rate' a "
                     "course in time");
  for (const char *entry : {"Maximum passes", "Acceleration"})
    if (const std::string passes_alone = entry == std::string("Acceleration") ? "auto" : "500";
        restarts() && prm.get(entry) != passes_alone)
      throw EntryError(std::string("Coupling/") + entry, prm.get(entry),
                       passes_alone + " with 'Coupling/Scheme = as published', which has one pass");
  prm.leave_subsection();
}


void CouplingParameters::check(const RockProperties &rock,
                               const bool has_pore_pressure,
                               const bool has_fracture,
                               const bool has_wells) const
{
  if (scheme == Scheme::monolithic)
    return;
  if (has_fracture && !adds_compliance() && !restarts() && !force)
    throw EntryError("Coupling/Scheme", name,
                     "monolithic or fixed stress with a fracture: while its opening is held, what "
                     "is injected has no place to go");
  if (!has_pore_pressure && !(has_fracture && has_wells))
    throw EntryError("Coupling/Scheme", name,
                     "monolithic, because there is no fluid: the rock has no pore pressure and "
                     "nothing is injected");
  if (scheme == Scheme::undrained && has_pore_pressure && rock.inverse_biot_modulus <= 0.)
    throw EntryError("Coupling/Scheme", name,
                     "monolithic or fixed stress, because nothing in this rock can be compressed "
                     "(1/M = 0) and its undrained stiffness is infinite");
  if (has_fracture)
    return;
  if (scheme == Scheme::drained || scheme == Scheme::fixed_strain)
  {
    const double bulk_modulus = rock.bulk_modulus();
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
  , has_pore_pressure(structure.has_pore_pressure)
  , undrained_term(std::move(undrained_term))
  , communicator(communicator)
  , mechanics(solver_parameters, without_pores(structure), communicator)
  // Multigrid for the rock knows displacements; the flow's block is small and gets a factor.
  , flow(direct(solver_parameters), without_pores(structure), communicator)
  , restart(solver_parameters.restart)
{
}


double SplitScheme::update_blocks(const SystemOperator &whole, const SystemStamps &stamps)
{
  using Scheme = CouplingParameters::Scheme;
  const unsigned int n_mechanical = whole.system().n_mechanical_extra;
  SystemStamps mechanics_stamps = stamps;
  mechanics_stamps.bulk_values = stamps.displacement_values;
  if (mechanics.update(whole, mechanics_stamps, {true, 0, 0, n_mechanical}) &&
      parameters.scheme == Scheme::undrained && has_pore_pressure)
    undrained_term(mechanics.bulk());
  if (flow.update(whole, stamps, {has_pore_pressure, 1, n_mechanical, whole.n_extra()}) &&
      (parameters.adds_compliance() || parameters.restarts()))
    flow.bulk().add(-parameters.stabilisation, whole.system().fixed_stress_mass);
  return parameters.adds_compliance() && whole.n_extra() > n_mechanical ? stabilise_fracture(whole)
                                                                        : 0.;
}


double SplitScheme::stabilise_fracture(const SystemOperator &whole)
{
  // The load of unit pressure in all segments, and what it opens: the load once more, transposed,
  // for the rows of the fluid have the slopes of its conductivity in them.
  const LinearSystem &system = whole.system();
  const unsigned int n_mechanical = system.n_mechanical_extra;
  const auto is_fluid = [&](const auto i) { return i >= n_mechanical; };
  SystemVector load = whole.make_vector(), response = whole.make_vector();
  for (const auto &e : whole.bulk_extra())
    if (is_fluid(e.column))
    {
      const auto [block, local] = whole.locate(e.row);
      if (block == 0)
        SystemOperator::entry(load.bulk, block, local) += e.value;
    }
  for (const auto &e : whole.extra_extra())
    if (is_fluid(e.column) && !is_fluid(e.row))
      load.extra[e.row] += e.value;
  const double seconds = mechanics.correct(load, parameters.restarts() ? exact : rough, response);

  // Fractures side by side may close one another; a negative L would take storage away.
  std::vector<double> opening(whole.n_extra(), 0.), has_storage(whole.n_extra(), 0.);
  for (const auto &e : whole.bulk_extra())
    if (is_fluid(e.column))
    {
      const auto [block, local] = whole.locate(e.row);
      if (block == 0)
        opening[e.column] += e.value * SystemOperator::entry(response.bulk, block, local);
    }
  // A segment that cavitates has a row without its aperture.
  for (const auto &e : whole.extra_bulk())
    if (is_fluid(e.row) && whole.locate(e.column).first == 0)
      has_storage[e.row] = 1.;
  Utilities::MPI::sum(opening, communicator, opening);
  Utilities::MPI::sum(has_storage, communicator, has_storage);
  for (const auto &e : whole.extra_extra())
    if (is_fluid(e.column) && !is_fluid(e.row))
      opening[e.column] += e.value * response.extra[e.row];
    else if (is_fluid(e.row) && !is_fluid(e.column))
      has_storage[e.row] = 1.;
  if (Utilities::MPI::this_mpi_process(communicator) == 0)
    for (unsigned int i = n_mechanical; i < opening.size(); ++i)
      if (has_storage[i] > 0.)
        flow.add_to_diagonal(i, -parameters.stabilisation * std::abs(opening[i]));
  return seconds;
}


double SplitScheme::pass(const SystemOperator &whole,
                         const double block_tolerance,
                         SystemVector &z,
                         const SystemVector &r)
{
  using Scheme = CouplingParameters::Scheme;
  const bool flow_first = parameters.adds_compliance() || parameters.restarts() ||
                          parameters.scheme == Scheme::fixed_strain;
  SplitBlock &one = flow_first ? flow : mechanics, &other = flow_first ? mechanics : flow;
  z.bulk = 0.;
  std::fill(z.extra.begin(), z.extra.end(), 0.);
  SystemVector rest = r;
  rest.bulk *= -1.;
  for (double &value : rest.extra)
    value *= -1.;
  double seconds = one.correct(rest, block_tolerance, z);
  whole.vmult(rest, z);
  rest.bulk -= r.bulk;
  for (unsigned int i = 0; i < r.extra.size(); ++i)
    rest.extra[i] -= r.extra[i];
  seconds += other.correct(rest, block_tolerance, z);
  return seconds;
}


void SplitScheme::iterate(const SystemOperator &whole,
                          const double tolerance,
                          SystemVector &x,
                          LinearReport &report)
{
  SystemVector r = whole.make_vector(), z = whole.make_vector();
  whole.residual(r, x);
  const double first = whole.scaled_norm(r);
  double norm = first, before = first;
  while (norm > tolerance * first && norm < 1e10 * first &&
         report.iterations < parameters.maximum_passes)
  {
    report.setup_seconds += pass(whole, rough, z, r);
    x.bulk -= z.bulk;
    for (unsigned int i = 0; i < z.extra.size(); ++i)
      x.extra[i] -= z.extra[i];
    whole.residual(r, x);
    before = norm;
    norm = whole.scaled_norm(r);
    ++report.iterations;
  }
  report.relative_residual = first > 0. ? norm / first : 0.;
  report.converged = norm <= tolerance * first;
  if (!report.converged)
    throw SolveError(
      "the " + parameters.name + " split " + (norm < before ? "has not converged" : "diverges") +
      ": after " + std::to_string(report.iterations) +
      " passes the residual changes by a factor of " + std::to_string(norm / before) +
      " per pass. 'Coupling/Scheme = monolithic' has no such limit");
}


LinearReport SplitScheme::solve(const LinearSystem &system,
                                const SystemStamps &stamps,
                                const double tolerance,
                                TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                std::vector<double> &dx_extra)
{
  // Residuals are those of the whole system, so that whatever matrix a block is solved with, the
  // end is the solution of the coupled system.
  const SystemOperator whole(system, communicator);
  SystemVector x = whole.make_vector();
  LinearReport report;
  report.setup_seconds = update_blocks(whole, stamps);
  using Acceleration = CouplingParameters::Acceleration;
  const bool has_fracture_fluid = whole.n_extra() > system.n_mechanical_extra;
  if (parameters.restarts())
  {
    SystemVector residual = whole.make_vector(), z = whole.make_vector();
    whole.residual(residual, x);
    report.setup_seconds += pass(whole, exact, z, residual);
    x.bulk -= z.bulk;
    for (unsigned int i = 0; i < z.extra.size(); ++i)
      x.extra[i] -= z.extra[i];
    report.iterations = 1;
    report.converged = true; // no more is asked for
  }
  else if (parameters.acceleration == Acceleration::gmres ||
           (parameters.acceleration == Acceleration::automatic && has_fracture_fluid))
  {
    const auto precondition = [&](SystemVector &z, const SystemVector &r)
    { report.setup_seconds += pass(whole, rough, z, r); };
    solve_by_krylov(whole, communicator, precondition,
                    {tolerance, parameters.maximum_passes, restart}, x, report);
    if (!report.is_good_enough())
      throw SolveError("the " + parameters.name +
                       " split has not converged: " + std::to_string(report.iterations) +
                       " passes. 'Coupling/Scheme = monolithic' has no such limit");
  }
  else
    iterate(whole, tolerance, x, report);
  dx_bulk = x.bulk;
  dx_extra = x.extra;
  return report;
}
} // namespace stockwork
