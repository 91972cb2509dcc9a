#include "coupling/coupled_system.h"

#include "stockwork/base/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stockwork
{
using namespace dealii;

template <int dim>
typename CoupledSystem<dim>::Norms CoupledSystem<dim>::residual_norms() const
{
  Norms norms;
  norms.momentum = system.residual_bulk.block(0).l2_norm();
  if (discretisation.has_pore_pressure)
    norms.mass = system.residual_bulk.block(1).l1_norm();
  for (unsigned int i = 0; i < numbering.size(); ++i)
    if (i < n_model_extra)
      norms.extra += system.residual_extra[i] * system.residual_extra[i];
    else
      norms.fracture_fluid += std::abs(system.residual_extra[i]);
  norms.extra = std::sqrt(norms.extra);
  return norms;
}


template <int dim>
typename CoupledSystem<dim>::Norms CoupledSystem<dim>::rounding_errors(
  const TrilinosWrappers::MPI::BlockVector &values, const StepContext &context, const State &state)
{
  if (stamp_of_norms != stamps.bulk_values)
  {
    matrix_norms.reinit(system.bulk.n_block_rows(), system.bulk.n_block_cols());
    for (unsigned int i = 0; i < matrix_norms.m(); ++i)
      for (unsigned int j = 0; j < matrix_norms.n(); ++j)
        matrix_norms(i, j) = system.bulk.block(i, j).l1_norm();
    stamp_of_norms = stamps.bulk_values;
  }
  constexpr double epsilon = 1e-14;
  Norms norms;
  const auto in_fractures = network.rounding(context, state, communication);
  norms.momentum = epsilon * matrix_norms(0, 0) * values.block(0).l2_norm() + in_fractures.force;
  if (discretisation.has_pore_pressure)
    norms.mass = epsilon * (matrix_norms(1, 0) * values.block(0).l1_norm() +
                            matrix_norms(1, 1) * values.block(1).l1_norm());
  norms.fracture_fluid = in_fractures.fluid;
  return norms;
}


template <int dim>
NonlinearReport CoupledSystem<dim>::solve(const StepContext &context,
                                          Unknowns &current,
                                          const Unknowns &committed,
                                          const Unknowns &rate_reference,
                                          const Unknowns &acceleration_reference)
{
  NonlinearReport report;
  // Essential conditions hold from the start, so that increments satisfy them with zero values.
  if (context.time != constraints_time && !boundary_conditions.constant_in_time())
  {
    AffineConstraints<double> unused;
    boundary_conditions.constrain(context.time, mapping, dof_handler, constraints, unused);
    constraints_time = context.time;
  }
  auto values = owned_vector();
  values = current.bulk;
  constraints.distribute(values);
  current.bulk = values;

  const State state = this->state(current, committed, rate_reference, acceleration_reference);
  assemble_linear(context, state);
  assemble_nonlinear(context, state);

  const bool linear = !nonlinear && numbering.size() == 0 && !bulk_was_touched;
  const double injected = network.balance(context, state, communication).step.injected;
  Norms norms = residual_norms(), greatest = norms;
  double model_change = 0.;
  unsigned int n_limited = 0, n_halved = 0;

  auto dx_bulk = owned_vector();
  std::vector<double> dx_extra;
  const std::vector<double> extra_at_start = current.extra;
  for (unsigned int iteration = 0;; ++iteration)
  {
    greatest.keep_greatest(norms);
    if (show_iterations)
      run.out << "    iteration " << iteration << ": " << norms.momentum << ' ' << norms.extra
              << ' ' << norms.mass << ' ' << norms.fracture_fluid << std::endl;
    if (!std::isfinite(norms.momentum + norms.mass + norms.extra + norms.fracture_fluid))
    {
      report.reason = "the residual is not a number";
      return report;
    }
    // Forces of the bulk and of the fracture balance one another, so they share a scale: what the
    // rock exerts on the fracture, for a solve may start in equilibrium and with no residual.
    const double rock_on_fracture = std::sqrt(std::inner_product(
      linear_residual_extra.begin(), linear_residual_extra.begin() + n_model_extra,
      linear_residual_extra.begin(), 0.));
    const double force = std::max({greatest.momentum, greatest.extra, rock_on_fracture});
    const Norms rounding = rounding_errors(values, context, state);
    Norms allowed;
    allowed.momentum = allowed.extra = std::max(tolerance * force, rounding.momentum);
    allowed.mass = std::max(tolerance * greatest.mass, rounding.mass);
    allowed.fracture_fluid =
      std::max(injected > 0. ? 1e-9 * injected : tolerance * greatest.fracture_fluid,
               rounding.fracture_fluid);
    const bool small = model_change <= tolerance && norms.momentum <= allowed.momentum &&
                       norms.extra <= allowed.extra && norms.mass <= allowed.mass &&
                       norms.fracture_fluid <= allowed.fracture_fluid;
    if (iteration > 0 && (small || linear))
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
    if (iteration == max_iterations)
    {
      report.iterations = iteration;
      report.reason = "no convergence in " + std::to_string(max_iterations) + " iterations";
      if (model_change > tolerance)
        report.reason += "; the fracture model still changes by " + std::to_string(model_change);
      explain(report, norms, allowed, n_limited, n_halved);
      if (system.rock_change != nullptr)
        report.advice += " Rock that yields may have come to its limit load; rock that softens, to "
                         "a state from which it jumps to another.";
      return report;
    }

    if (is_interrupted && is_interrupted())
    {
      report.reason = "interrupted";
      return report;
    }

    try
    {
      const auto scope = run.timers.scope("solve");
      const LinearReport linear_report =
        solver->solve(system, stamps, linear ? tolerance : 1e-6, dx_bulk, dx_extra);
      report.linear_iterations += linear_report.iterations;
      run.timers.move("solve", "preconditioner", linear_report.setup_seconds);
      if (!linear_report.is_good_enough())
      {
        report.reason = "the linear solver has not converged";
        report.advice = "Try 'Linear solver/Type = direct', or more of its iterations.";
        return report;
      }
    }
    catch (const SolveError &error)
    {
      report.reason = error.what();
      return report;
    }
    // A fracture that is pumped open at once takes, for a moment, many times the pressure that
    // drives it later: the limit must let it come, and only keep it from a single leap.
    double greatest_change = network.typical_pressure(), factor = 1.;
    for (unsigned int i = n_model_extra; i < numbering.size(); ++i)
      greatest_change = std::max(greatest_change, std::abs(current.extra[i] - extra_at_start[i]));
    const double limit = pressure_limit.value_or(greatest_change);
    for (unsigned int i = n_model_extra; i < numbering.size(); ++i)
      if (const double change = std::abs(dx_extra[i]); factor * change > limit)
        factor = limit / change;
    n_limited += factor < 1.;
    const auto move = [&](const double step)
    {
      values.add(step, dx_bulk);
      constraints.distribute(values);
      current.bulk = values;
      for (unsigned int i = 0; i < numbering.size(); ++i)
        current.extra[i] += step * dx_extra[i];
      if (linear)
        return;
      model_change = model.update_iterate(context, state, communication);
      if (!bulk_was_touched)
        update_linear_residual(step, dx_bulk, dx_extra);
      assemble_nonlinear(context, state);
      norms = residual_norms();
    };
    // A law that softens sends Newton's method far beyond the solution, and back again. Shorter
    // increments are tried as long as the residual grows too much; how much is too much must not be
    // read too narrowly, for on the way to a good solution the residual may grow as well.
    const auto imbalance = [&](const Norms &n)
    {
      return std::hypot(n.momentum, n.extra) / force +
             (greatest.fracture_fluid > 0. ? n.fracture_fluid / greatest.fracture_fluid : 0.);
    };
    const double before = imbalance(norms);
    move(factor);
    if ((n_model_extra > 0 || nonlinear) && iteration > 0)
      for (unsigned int halving = 0;
           halving < 4 && !(imbalance(norms) < (iteration < 6 ? 3. : 1.) * before); ++halving)
      {
        n_halved += halving == 0;
        factor *= 0.5;
        move(-factor);
      }
  }
}


template NonlinearReport CoupledSystem<2>::solve(
  const StepContext &, Unknowns &, const Unknowns &, const Unknowns &, const Unknowns &);
template NonlinearReport CoupledSystem<3>::solve(
  const StepContext &, Unknowns &, const Unknowns &, const Unknowns &, const Unknowns &);
} // namespace stockwork
