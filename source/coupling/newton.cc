#include "coupling/coupled_system.h"

#include "stockwork/base/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Residual of the linear system that Newton's method is content with, and at first where the rock
/// has left its linear range: there each digit is paid for with back-substitutions.
constexpr double newton_tolerance = 1e-6, first_tolerance = 1e-3;
} // namespace


template <int dim>
typename CoupledSystem<dim>::Norms CoupledSystem<dim>::residual_norms() const
{
  Norms norms;
  norms.momentum = system.residual_bulk.block(0).l2_norm();
  if (elements.has_pore_pressure)
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
  if (elements.has_pore_pressure)
    norms.mass = epsilon * (matrix_norms(1, 0) * values.block(0).l1_norm() +
                            matrix_norms(1, 1) * values.block(1).l1_norm());
  norms.fracture_fluid = in_fractures.fluid;
  return norms;
}


/// Newton's method for one solve.
///
/// Where the rock is linear and all that the fracture does to it goes through cut cells, Newton's
/// method runs in the extra unknowns alone (CondensedSystem). The bulk stays behind meanwhile, and
/// follows in one go when they have converged; the test is then made once more, with everything
/// evaluated as it stands. So nothing hangs on the bulk not being looked at meanwhile but the
/// number of iterations.
template <int dim>
class CoupledSystem<dim>::Newton
{
public:
  Newton(CoupledSystem &all, const StepContext &context, Unknowns &current, const State &state);

  NonlinearReport run();

private:
  using BlockVector = TrilinosWrappers::MPI::BlockVector;

  /// The greatest residuals that count as none.
  Norms allowed();

  bool is_solved(const Norms &allowed) const
  {
    // A bulk that stays behind has no say yet.
    const bool bulk_is = condensed || (norms.momentum <= allowed.momentum && //
                                       norms.mass <= allowed.mass);
    return model_change <= all.tolerance && bulk_is && norms.extra <= allowed.extra &&
           norms.fracture_fluid <= allowed.fracture_fluid;
  }

  /// Of the linear system.
  double linear_tolerance() const;

  /// Fill `dx_bulk` and `dx_extra`. Returns whether they can be used; else the report says why not.
  bool find_increment(NonlinearReport &report);

  /// Eliminate the bulk where that is possible.
  void condense();

  /// The same of a condensed system: `dx_extra` and `linear_change`.
  LinearReport solve_condensed();

  /// Let the bulk follow.
  void recover_bulk();

  /// The factor by which the increment is shortened so that pressures do not leap.
  double pressure_factor() const;

  /// Move by so many increments and evaluate the residual there.
  void move(double step);

  /// Trial quantities and the residual of the unknowns as they are; `update` sees to the linear
  /// part of the latter.
  template <class Update>
  void evaluate(const Update &update);

  /// Move by the increment, or less.
  void take_increment(unsigned int iteration);

  void give_up(NonlinearReport &report, const Norms &allowed) const;

  CoupledSystem &all;
  const StepContext &context;
  Unknowns &current;
  const State &state;
  const bool linear; ///< one iteration does it
  const double injected;
  const std::vector<double> extra_at_start;

  BlockVector values; ///< of the bulk, owned
  Norms norms, greatest;
  double force = 0.; ///< scale of residual forces
  double model_change = 0.;
  unsigned int n_limited = 0, n_halved = 0;
  BlockVector dx_bulk;
  std::vector<double> dx_extra;

  std::unique_ptr<CondensedSystem> condensed; ///< null: the bulk moves along
  unsigned int n_condensed = 0;               ///< times
  std::vector<double> behind;                 ///< change that the bulk has yet to follow
  std::vector<double> start_of_condensed;     ///< the linear residual of the extra rows then
  std::vector<double> linear_change;          ///< of that residual, by the last increment
};


template <int dim>
CoupledSystem<dim>::Newton::Newton(CoupledSystem &all,
                                   const StepContext &context,
                                   Unknowns &current,
                                   const State &state)
  : all(all)
  , context(context)
  , current(current)
  , state(state)
  , linear(!all.nonlinear && all.numbering.size() == 0 && !all.bulk_was_touched)
  , injected(all.network.balance(context, state, all.communication).step.injected)
  , extra_at_start(current.extra)
  , values(all.owned_vector())
  , norms(all.residual_norms())
  , greatest(norms)
  , dx_bulk(all.owned_vector())
{
  values = current.bulk;
}


template <int dim>
typename CoupledSystem<dim>::Norms CoupledSystem<dim>::Newton::allowed()
{
  greatest.keep_greatest(norms);
  // Forces of the bulk and of the fracture balance one another, so they share a scale: what the
  // rock exerts on the fracture, for a solve may start in equilibrium and with no residual.
  const auto begin = all.linear_residual_extra.begin();
  const double rock_on_fracture =
    std::sqrt(std::inner_product(begin, begin + all.n_model_extra, begin, 0.));
  force = std::max({greatest.momentum, greatest.extra, rock_on_fracture});
  const Norms rounding = all.rounding_errors(values, context, state);
  Norms allowed;
  allowed.momentum = allowed.extra = std::max(all.tolerance * force, rounding.momentum);
  allowed.mass = std::max(all.tolerance * greatest.mass, rounding.mass);
  allowed.fracture_fluid =
    std::max(injected > 0. ? 1e-9 * injected : all.tolerance * greatest.fracture_fluid,
             rounding.fracture_fluid);
  return allowed;
}


template <int dim>
void CoupledSystem<dim>::Newton::condense()
{
  // Twice: where the bulk was off at first, or a model reads more of it than its derivatives say.
  constexpr unsigned int most = 2;
  if (condensed || n_condensed == most || all.nonlinear || all.fracture_sees_bulk ||
      all.numbering.size() == 0)
    return;
  condensed = all.solver->condense(all.system, all.stamps, newton_tolerance);
  if (!condensed)
    return;
  ++n_condensed;
  behind.assign(all.numbering.size(), 0.);
  start_of_condensed = all.linear_residual_extra;
}


template <int dim>
LinearReport CoupledSystem<dim>::Newton::solve_condensed()
{
  LinearReport report;
  report.relative_residual =
    condensed->solve(all.system, newton_tolerance, dx_extra, linear_change);
  report.converged = report.relative_residual <= newton_tolerance;
  std::vector<double> change(dx_extra.size(), 0.);
  const Triplets &corner = all.linear_extra_extra;
  for (std::size_t k = 0; k < corner.values.size(); ++k)
    change[corner.rows[k]] += corner.values[k] * dx_extra[corner.columns[k]];
  all.communication.sum(change);
  for (unsigned int i = 0; i < change.size(); ++i)
    linear_change[i] += change[i];
  return report;
}


template <int dim>
double CoupledSystem<dim>::Newton::linear_tolerance() const
{
  if (linear)
    return all.tolerance;
  if (all.system.rock_change == nullptr)
    return newton_tolerance;
  // What an iteration leaves goes with the square of what was left before it: more than two digits
  // beyond that are of no use (Dembo, Eisenstat and Steihaug 1982).
  const auto share = [](const double now, const double most)
  { return most > 0. ? now / most : 0.; };
  const double left = std::max({share(norms.momentum, force), share(norms.extra, force),
                                share(norms.mass, greatest.mass),
                                share(norms.fracture_fluid, greatest.fracture_fluid)});
  return std::clamp(0.01 * left * left, newton_tolerance, first_tolerance);
}


template <int dim>
bool CoupledSystem<dim>::Newton::find_increment(NonlinearReport &report)
{
  try
  {
    const auto scope = all.run.timers.scope("solve");
    condense();
    const LinearReport linear_report =
      condensed ? solve_condensed()
                : all.solver->solve(all.system, all.stamps, linear_tolerance(), dx_bulk, dx_extra);
    report.linear_iterations += linear_report.iterations;
    all.run.timers.move("solve", "preconditioner", linear_report.setup_seconds);
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
void CoupledSystem<dim>::Newton::evaluate(const Update &update)
{
  model_change = all.model.update_iterate(context, state, all.communication);
  if (!all.bulk_was_touched)
    update();
  all.assemble_nonlinear(context, state);
  norms = all.residual_norms();
}


template <int dim>
void CoupledSystem<dim>::Newton::recover_bulk()
{
  const auto of_bulk = std::move(condensed);
  if (all.bulk_was_touched)
  {
    // The factor is not this bulk's any more. All is assembled anew, and the whole system is
    // solved from here on.
    evaluate([]() {});
    return;
  }
  {
    const auto scope = all.run.timers.scope("solve");
    of_bulk->recover_bulk(all.system, behind, dx_bulk);
  }
  values.add(1., dx_bulk);
  all.constraints.distribute(values);
  current.bulk = values;
  all.linear_residual_extra = start_of_condensed;
  evaluate([&]() { all.update_linear_residual(1., dx_bulk, behind); });
}


template <int dim>
void CoupledSystem<dim>::Newton::move(const double step)
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
          all.linear_residual_extra[i] += step * linear_change[i];
      });
    return;
  }
  values.add(step, dx_bulk);
  all.constraints.distribute(values);
  current.bulk = values;
  if (!linear)
    evaluate([&]() { all.update_linear_residual(step, dx_bulk, dx_extra); });
}


template <int dim>
double CoupledSystem<dim>::Newton::pressure_factor() const
{
  // A fracture that is pumped open at once takes, for a moment, many times the pressure that
  // drives it later: the limit must let it come, and only keep it from a single leap.
  double greatest_change = all.network.typical_pressure(), factor = 1.;
  for (unsigned int i = all.n_model_extra; i < all.numbering.size(); ++i)
    greatest_change = std::max(greatest_change, std::abs(current.extra[i] - extra_at_start[i]));
  const double limit = all.pressure_limit.value_or(greatest_change);
  for (unsigned int i = all.n_model_extra; i < all.numbering.size(); ++i)
    if (const double change = std::abs(dx_extra[i]); factor * change > limit)
      factor = limit / change;
  return factor;
}


template <int dim>
void CoupledSystem<dim>::Newton::take_increment(const unsigned int iteration)
{
  double factor = pressure_factor();
  n_limited += factor < 1.;
  // A law that softens sends Newton's method far beyond the solution, and back again. Shorter
  // increments are tried as long as the residual grows too much; how much is too much must not be
  // read too narrowly, for on the way to a good solution the residual may grow as well.
  const auto imbalance = [&](const Norms &n)
  {
    return std::hypot(n.momentum, n.extra) / force +
           (greatest.fracture_fluid > 0. ? n.fracture_fluid / greatest.fracture_fluid : 0.);
  };
  const double before = imbalance(norms);
  // A tangent that is nearly singular, as where rock yields and does not know yet whether it will
  // be unloaded, sends it further still.
  const unsigned int most_halvings = all.nonlinear ? 8 : 4;
  move(factor);
  if ((all.n_model_extra > 0 || all.nonlinear) && iteration > 0)
    for (unsigned int halving = 0;
         halving < most_halvings && !(imbalance(norms) < (iteration < 6 ? 3. : 1.) * before);
         ++halving)
    {
      n_halved += halving == 0;
      factor *= 0.5;
      move(-factor);
    }
}


template <int dim>
void CoupledSystem<dim>::Newton::give_up(NonlinearReport &report, const Norms &allowed) const
{
  report.reason = "no convergence in " + std::to_string(all.max_iterations) + " iterations";
  if (model_change > all.tolerance)
    report.reason += "; the fracture model still changes by " + std::to_string(model_change);
  all.explain(report, norms, allowed, n_limited, n_halved);
  if (all.system.rock_change != nullptr)
    report.advice += " Rock that yields may have come to its limit load; rock that softens, to "
                     "a state from which it jumps to another.";
}


template <int dim>
NonlinearReport CoupledSystem<dim>::Newton::run()
{
  NonlinearReport report;
  for (unsigned int iteration = 0;; ++iteration)
  {
    Norms none_left = allowed();
    // The bulk follows where nothing else is left, and where the fracture begins to look at it.
    if (condensed && (is_solved(none_left) || all.fracture_sees_bulk))
    {
      recover_bulk();
      none_left = allowed();
    }
    if (all.show_iterations)
      all.run.out << "    iteration " << iteration << ": " << norms.momentum << ' ' << norms.extra
                  << ' ' << norms.mass << ' ' << norms.fracture_fluid << std::endl;
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
    if (iteration == all.max_iterations)
    {
      report.iterations = iteration;
      give_up(report, none_left);
      return report;
    }
    if (all.is_interrupted && all.is_interrupted())
    {
      report.reason = "interrupted";
      return report;
    }
    if (!find_increment(report))
      return report;
    take_increment(iteration);
  }
}


template <int dim>
NonlinearReport CoupledSystem<dim>::solve(const StepContext &context,
                                          Unknowns &current,
                                          const Unknowns &committed,
                                          const Unknowns &rate_reference,
                                          const Unknowns &acceleration_reference)
{
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
  return Newton(*this, context, current, state).run();
}


template NonlinearReport CoupledSystem<2>::solve(
  const StepContext &, Unknowns &, const Unknowns &, const Unknowns &, const Unknowns &);
template NonlinearReport CoupledSystem<3>::solve(
  const StepContext &, Unknowns &, const Unknowns &, const Unknowns &, const Unknowns &);
} // namespace stockwork
