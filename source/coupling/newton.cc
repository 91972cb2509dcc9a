#include "coupling/newton.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stockwork
{
using namespace dealii;

void NewtonParameters::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Nonlinear solver");
  prm.declare_entry("Tolerance", "1e-8", Quantity(dimension::number, Range::open(0., 1.)),
                    "Reduction of the residual of each field against its greatest in the solve.");
  prm.declare_entry("Maximum iterations", "25", Patterns::Integer(1),
                    "A solve that takes more has failed, and the step is cut.");
  prm.declare_entry("Maximum pressure change", "",
                    Quantity(dimension::pressure, Range::positive(), ""),
                    "An iteration that would change a fracture pressure by more is shortened. "
                    "Empty: the net pressure with which the first crack sets out, by "
                    "toughness or viscosity, or what pressures have changed by so far in the "
                    "solve, if that is more.");
  prm.declare_entry("Show iterations", "false", Patterns::Bool(),
                    "Print the residuals of every iteration: forces of the bulk and of the "
                    "fracture, mass in pores and in the fracture; and the linear iterations.");
  prm.leave_subsection();
}


void NewtonParameters::parse_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Nonlinear solver");
  tolerance = get_quantity(prm, "Tolerance", dimension::number);
  max_iterations = prm.get_integer("Maximum iterations");
  pressure_limit = get_optional_quantity(prm, "Maximum pressure change", dimension::pressure);
  show_iterations = prm.get_bool("Show iterations");
  prm.leave_subsection();
}


NewtonParameters NewtonParameters::rough() const
{
  // A growth criterion is a difference of pressure and stress next to a strength: a per cent of it
  // is 1e-3 to 1e-4 of these.
  constexpr double enough = 1e-4;
  NewtonParameters result = *this;
  result.accuracy = Accuracy::rough;
  result.tolerance = std::max(tolerance, enough);
  result.fluid_tolerance = std::max(fluid_tolerance, enough);
  return result;
}


template <int dim>
Newton<dim>::Newton(const NewtonTools<dim> &tools,
                    const StepContext &context,
                    Unknowns &current,
                    const State &state)
  : Tools(tools)
  , context(context)
  , current(current)
  , state(state)
  , linear(assembly.is_linear())
  , injected(network.balance(context, state, unknowns.communication).step.injected)
  , extra_at_start(current.extra)
  , values(unknowns.owned_vector())
  , norms(assembly.residual_norms())
  , greatest(norms)
  , dx_bulk(unknowns.owned_vector())
{
  copy_owned(values, current.bulk);
}


template <int dim>
ResidualNorms Newton<dim>::allowed()
{
  greatest.keep_maximum(norms);
  // Forces of the bulk and of the fracture balance one another, so they share a scale: what the
  // rock exerts on the fracture, for a solve may start in equilibrium and with no residual.
  const auto begin = assembly.linear_residual_of_extra().begin();
  const double rock_on_fracture =
    std::sqrt(std::inner_product(begin, begin + unknowns.n_mechanical_extra(), begin, 0.));
  force = std::max({greatest.momentum, greatest.extra, rock_on_fracture});
  const ResidualNorms rounding = assembly.rounding_errors(values, context, state);
  ResidualNorms allowed;
  allowed.momentum = allowed.extra = std::max(parameters.tolerance * force, rounding.momentum);
  allowed.mass = std::max(parameters.tolerance * mass_scale(), rounding.mass);
  allowed.fracture_fluid = std::max(injected > 0. ? parameters.fluid_tolerance * injected
                                                  : parameters.tolerance * greatest.fracture_fluid,
                                    rounding.fracture_fluid);
  return allowed;
}


template <int dim>
void Newton<dim>::condense()
{
  // Twice: where the bulk was off at first, or a model reads more of it than its derivatives say.
  constexpr unsigned int most = 2;
  if (condensed || n_condensed == most || assembly.nonlinear_rock() != nullptr ||
      assembly.fracture_sees_bulk() || unknowns.n_extra() == 0)
    return;
  condensed = solver.condense(assembly.linear_system(), assembly.stamps(), ForcingTerm::exact);
  if (!condensed)
    return;
  ++n_condensed;
  behind.assign(unknowns.n_extra(), 0.);
  start_of_condensed = assembly.linear_residual_of_extra();
}


template <int dim>
LinearReport Newton<dim>::solve_condensed()
{
  LinearReport report;
  report.relative_residual =
    condensed->solve(assembly.linear_system(), ForcingTerm::exact, dx_extra, linear_change);
  report.converged = report.relative_residual <= ForcingTerm::exact;
  const std::vector<double> change = assembly.linear_change_by_extra(dx_extra);
  for (unsigned int i = 0; i < change.size(); ++i)
    linear_change[i] += change[i];
  return report;
}


template <int dim>
double Newton<dim>::linear_tolerance(const ResidualNorms &allowed)
{
  if (linear)
    return parameters.tolerance;
  // Where the rock's factor solves the system, a looser one would save nothing.
  const LinearSystem &system = assembly.linear_system();
  if (system.rock_change == nullptr && !solver.wants_hierarchy(system.residual_bulk.size()))
    return ForcingTerm::exact;
  double residual = 0., excess = 0.;
  const auto add = [&](const double norm, const double scale, const double allowed)
  {
    if (scale > 0.)
      residual += norm / scale;
    if (norm > allowed)
      excess = std::max(excess, norm / allowed);
  };
  add(norms.momentum, force, allowed.momentum);
  add(norms.extra, force, allowed.extra);
  add(norms.mass, mass_scale(), allowed.mass);
  add(norms.fracture_fluid, greatest.fracture_fluid, allowed.fracture_fluid);
  return forcing_term.next(residual, excess, n_halved > 0);
}


template <int dim>
void Newton<dim>::stiffen_slow_rock()
{
  if (assembly.linear_system().rock_change == nullptr)
    return;
  constexpr double too_slow = 0.8, share = 1e-3;
  if (last_force > 0. && norms.momentum > too_slow * last_force)
    assembly.stiffen_rock(share);
  last_force = norms.momentum;
}


template <int dim>
bool Newton<dim>::find_increment(NonlinearReport &report, const ResidualNorms &allowed)
{
  try
  {
    const auto scope = run.timers.scope("solve");
    condense();
    stiffen_slow_rock();
    const LinearReport linear_report =
      condensed ? solve_condensed()
                : solver.solve(assembly.linear_system(), assembly.stamps(),
                               linear_tolerance(allowed), dx_bulk, dx_extra);
    report.linear_iterations += linear_report.iterations;
    run.timers.move("solve", "preconditioner", linear_report.setup_seconds);
    if (linear_report.is_good_enough())
      return true;
    report.reason = "the linear solver has not converged";
    report.advice = "Try 'Linear solver/Type = direct', or more of its iterations.";
  }
  catch (const SolveError &error)
  {
    report.reason = error.what();
  }
  return false;
}


template <int dim>
template <class Update>
void Newton<dim>::evaluate(const Update &update)
{
  if (!assembly.bulk_is_touched())
    update();
  assembly.assemble_nonlinear(context, state);
  norms = assembly.residual_norms();
}


template <int dim>
void Newton<dim>::recover_bulk()
{
  const auto of_bulk = std::move(condensed);
  if (assembly.bulk_is_touched())
  {
    // The factor is not this bulk's any more. All is assembled anew, and the whole system is
    // solved from here on.
    evaluate([]() {});
    return;
  }
  {
    const auto scope = run.timers.scope("solve");
    of_bulk->recover_bulk(assembly.linear_system(), behind, dx_bulk);
  }
  values.add(1., dx_bulk);
  unknowns.constrain(values, current.bulk);
  assembly.linear_residual_of_extra() = start_of_condensed;
  evaluate([&]() { assembly.update_linear(1., dx_bulk, behind); });
}


template <int dim>
void Newton<dim>::move(const double step)
{
  for (unsigned int i = 0; i < dx_extra.size(); ++i)
    current.extra[i] += step * dx_extra[i];
  if (condensed)
  {
    for (unsigned int i = 0; i < dx_extra.size(); ++i)
      behind[i] += step * dx_extra[i];
    evaluate(
      [&]()
      {
        for (unsigned int i = 0; i < linear_change.size(); ++i)
          assembly.linear_residual_of_extra()[i] += step * linear_change[i];
      });
    return;
  }
  values.add(step, dx_bulk);
  unknowns.constrain(values, current.bulk);
  if (!linear)
    evaluate([&]() { assembly.update_linear(step, dx_bulk, dx_extra); });
}


template <int dim>
double Newton<dim>::pressure_factor() const
{
  // A fracture that is pumped open at once takes, for a moment, many times the pressure that
  // drives it later: the limit must let it come, and only keep it from a single leap.
  double maximum_change = network.typical_pressure(), factor = 1.;
  for (unsigned int i = unknowns.n_mechanical_extra(); i < unknowns.n_extra(); ++i)
    if (!network.is_of_rock(i))
      maximum_change = std::max(maximum_change, std::abs(current.extra[i] - extra_at_start[i]));
  const double limit = parameters.pressure_limit.value_or(maximum_change);
  for (unsigned int i = unknowns.n_mechanical_extra(); i < unknowns.n_extra(); ++i)
    if (const double change = std::abs(dx_extra[i]);
        factor * change > limit && !network.is_of_rock(i))
      factor = limit / change;
  return factor;
}


template <int dim>
void Newton<dim>::take_increment(const unsigned int iteration)
{
  double factor = pressure_factor();
  n_limited += factor < 1.;
  // A law that softens sends Newton's method far beyond the solution, and back again. Shorter
  // increments are tried as long as the residual grows too much; how much is too much must not be
  // read too narrowly, for on the way to a good solution the residual may grow as well.
  // Fluid that passes through a closed fracture from pore to pore leaves rounding errors in it, and
  // no more: what is next to nothing of the pores' is nothing.
  const double of_pores = network.leaks_into_pores() ? parameters.tolerance * greatest.mass : 0.;
  // Where rock is not linear, pores may ask for an increment that changes forces by next to
  // nothing.
  const double of_mass =
    assembly.nonlinear_rock() != nullptr && greatest.mass > 0. ? 1. / mass_scale() : 0.;
  const auto of_fluid = [&](const ResidualNorms &n)
  {
    const bool has_fluid = n.fracture_fluid > of_pores && greatest.fracture_fluid > 0.;
    return has_fluid ? n.fracture_fluid / greatest.fracture_fluid : 0.;
  };
  const auto imbalance = [&](const ResidualNorms &n)
  { return std::hypot(n.momentum, n.extra) / force + of_mass * n.mass + of_fluid(n); };
  // What is below the tolerance is none, and may grow.
  const double before = std::max(imbalance(norms), parameters.tolerance);
  // A tangent that is nearly singular, as where rock yields and does not know yet whether it will
  // be unloaded, sends it further still.
  const unsigned int most_halvings = assembly.nonlinear_rock() != nullptr ? 8 : 4;
  // Where secants are used, forces have to grow on the way, but not where they go to and fro; the
  // fluid's imbalance must not come to more than all was.
  constexpr double same_again = 1e-3;
  constexpr unsigned int many_returns = 2; // once may be by chance
  n_returns += std::abs(before - last_but_one) < same_again * before;
  last_but_one = last_imbalance;
  last_imbalance = before;
  const double of_all = iteration < 6 ? 3. : 1.,
               of_forces = assembly.uses_secants() && n_returns < many_returns ? 2. : 1.;
  const auto is_near = [&]()
  {
    return imbalance(norms) < std::max(of_all, of_forces) * before &&
           of_fluid(norms) < of_all * before;
  };
  move(factor);
  if ((unknowns.n_mechanical_extra() > 0 || assembly.nonlinear_rock() != nullptr) && iteration > 0)
    for (unsigned int halving = 0; halving < most_halvings && !is_near(); ++halving)
    {
      n_halved += halving == 0;
      factor *= 0.5;
      move(-factor);
    }
}


template <int dim>
void Newton<dim>::give_up(NonlinearReport &report, const ResidualNorms &allowed) const
{
  report.reason = "no convergence in " + std::to_string(parameters.max_iterations) + " iterations";
  explain(report, allowed);
  if (assembly.linear_system().rock_change != nullptr)
    report.advice += " Rock that yields may have come to its limit load; rock that softens, to "
                     "a state from which it jumps to another.";
}


template <int dim>
NonlinearReport Newton<dim>::solve()
{
  NonlinearReport report;
  for (unsigned int iteration = 0;; ++iteration)
  {
    ResidualNorms none_left = allowed();
    // The bulk follows where nothing else is left, and where the fracture begins to look at it.
    if (condensed && (is_solved(none_left) || assembly.fracture_sees_bulk()))
    {
      recover_bulk();
      none_left = allowed();
    }
    if (parameters.show_iterations)
      run.out << "    iteration " << iteration << ": " << norms.momentum << ' ' << norms.extra
              << ' ' << norms.mass << ' ' << norms.fracture_fluid << ", "
              << report.linear_iterations << " linear so far" << std::endl;
    if (!std::isfinite(norms.momentum + norms.mass + norms.extra + norms.fracture_fluid))
    {
      report.reason = "the residual is not a number";
      return report;
    }
    if (iteration > 0 && (is_solved(none_left) || linear))
    {
      report.converged = true;
      report.iterations = iteration;
      return report;
    }
    if (force + greatest.mass + greatest.fracture_fluid == 0.)
    {
      report.converged = true; // nothing happens in this step
      return report;
    }
    if (iteration == parameters.max_iterations)
    {
      report.iterations = iteration;
      give_up(report, none_left);
      return report;
    }
    if (is_interrupted && is_interrupted())
    {
      report.reason = "interrupted";
      return report;
    }
    if (!find_increment(report, none_left))
      return report;
    take_increment(iteration);
  }
}


template class Newton<2>;
template class Newton<3>;
} // namespace stockwork
