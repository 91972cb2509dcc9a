#include "coupling/stepper.h"

#include "rock/wave_speeds.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace stockwork
{
using namespace dealii;

void StepControl::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Time");
  prm.declare_entry("Start time", "0 s", Quantity(dimension::time), "");
  prm.declare_entry("End time", "", Quantity(dimension::time, Range::finite(), ""),
                    "After the start time. Required.");
  prm.declare_entry(
    "Initial step", "", Patterns::Anything(),
    "Length of the first step, and at most of that with which a well that has rested "
    "begins to inject [s]; empty: a hundredth of the run.");
  prm.declare_entry("Minimum step", "", Patterns::Anything(),
                    "A solve that fails with this step ends the run [s]; empty: 1e-6 of the "
                    "initial step.");
  prm.declare_entry("Maximum step", "inf",
                    Quantity(dimension::time, Range{0., INFINITY, true, false}), "");
  prm.declare_entry("Step growth", "", Patterns::Anything(),
                    "Greatest ratio of successive steps, at least 1; empty: 1.3 where the fracture "
                    "model or the error tolerance chooses the step, else 1 (constant steps).");
  prm.declare_entry("Error tolerance", "inf",
                    Quantity(dimension::number, Range{0., INFINITY, true, false}),
                    "Of the local error of a step, relative to the solution; 'inf': steps are not "
                    "chosen by error. BDF2 only.");
  prm.declare_entry(
    "Reject first attempt of step", "0", Patterns::Integer(0),
    "For tests: the first attempt at the step of this number is thrown away and the "
    "step taken again with half its length. 0: none.");
  prm.leave_subsection();
  WaveSteps::declare_parameters(prm);
}


void StepControl::parse_parameters(ParameterHandler &prm)
{
  const auto optional = [&](const std::string &entry, const Dimension &dimension,
                            const Range &range, const double otherwise)
  {
    const std::string text = prm.get(entry);
    if (text.empty())
      return otherwise;
    try
    {
      const double value = parse_quantity(text, dimension);
      if (range.contains(value))
        return value;
    }
    catch (const InputError &error)
    {
      throw EntryError("Time/" + entry, text, range.text(dimension) + " (" + error.what() + ")");
    }
    throw EntryError("Time/" + entry, text, range.text(dimension));
  };
  prm.enter_subsection("Time");
  start_time = get_quantity(prm, "Start time", dimension::time);
  if (prm.get("End time").empty())
    throw EntryError("Time/End time", "", "a time after the start time, such as '10 min'");
  end_time = get_quantity(prm, "End time", dimension::time);
  if (!(end_time > start_time))
    throw EntryError("Time/End time", prm.get("End time"),
                     "a time after the start time, " + prm.get("Start time"));
  initial_step =
    optional("Initial step", dimension::time, Range::positive(), (end_time - start_time) / 100.);
  minimum_step = optional("Minimum step", dimension::time, Range::positive(), 1e-6 * initial_step);
  maximum_step = get_quantity(prm, "Maximum step", dimension::time);
  if (!(minimum_step <= initial_step))
    throw EntryError("Time/Minimum step", prm.get("Minimum step"),
                     "at most the initial step, " + to_string(initial_step, dimension::time));
  if (!(initial_step <= maximum_step))
    throw EntryError("Time/Initial step", prm.get("Initial step"),
                     "at most 'Time/Maximum step', " + prm.get("Maximum step") +
                       (prm.get("Initial step").empty()
                          ? "; empty, it is " + to_string(initial_step, dimension::time)
                          : ""));
  error_tolerance = get_quantity(prm, "Error tolerance", dimension::number);
  growth = optional("Step growth", dimension::number, Range{1., 10., false, false},
                    std::isfinite(error_tolerance) ? 2. : -1.);
  rejected_step = prm.get_integer("Reject first attempt of step");
  prm.leave_subsection();
  waves.parse_parameters(prm);
}


namespace
{
/// A step is taken again if it is longer than what resolves waves, by this factor: a solve is dear.
constexpr double too_long = 1.5;
} // namespace


double step_limit(const Verdict &verdict, const double dt, const double first_dt)
{
  if (verdict.length_is_right)
    return first_dt;
  if (verdict.held_back)
    return 0.5 * dt;
  if (!verdict.advances)
    return std::numeric_limits<double>::infinity();
  // In the end, a tip advances in every other step: with an advance in each, the error in time of a
  // fracture driven through viscous fluid is as large as that in space.
  return dt * (*verdict.advances > 1 ? 0.6 : *verdict.advances == 1 ? 0.8 : 1.25);
}


template <int dim>
Stepper<dim>::Stepper(RunContext &run,
                      CoupledSystem<dim> &system,
                      FractureModel<dim> &model,
                      Network<dim> &network,
                      const Rock &rock,
                      TimeScheme &scheme,
                      const StepControl &control)
  : run(run)
  , system(system)
  , model(model)
  , network(network)
  , rock(rock)
  , scheme(scheme)
  , control(control)
{
}


template <int dim>
void Stepper<dim>::set_references()
{
  before = system.restarts() ? system.start() : committed;
  scheme.references(context, before, rate_reference, acceleration_reference);
}


template <int dim>
StepContext Stepper<dim>::make_context(const double time,
                                       const double dt,
                                       const unsigned int step,
                                       const unsigned int attempt) const
{
  if (!system.restarts())
    return scheme.context(time, dt, step, attempt);
  StepContext result =
    scheme.context(control.start_time, time + dt - control.start_time, step, attempt);
  system.adapt(result);
  return result;
}


template <int dim>
typename Stepper<dim>::Outcome
Stepper<dim>::attempt(StepReport &report, std::string &advice, Verdict &verdict)
{
  // More passes than any model's own limit: a model that never stops growing must not hang the run.
  constexpr unsigned int max_passes = 100;

  current = committed;
  if (system.restarts())
    network.forget();
  else
    scheme.predict(context, current);
  set_references();
  system.begin_step(context);
  model.begin_step(context);
  network.begin_step(context);
  if (system.restarts()) // segments may store more than in the last step
    system.renumber_extra({&current.extra});

  // A fracture that grows is solved for again at once: a rough solution is enough to see that it
  // does. That it has come to rest is said of a full one.
  const Accuracy of_looks = model.requirements().may_grow && system.gains_by_rough_solutions()
                              ? Accuracy::rough
                              : Accuracy::full;
  Accuracy accuracy = of_looks;
  for (unsigned int pass = 0; pass < max_passes; ++pass)
  {
    NonlinearReport solve;
    try
    {
      solve =
        system.solve(context, current, before, rate_reference, acceleration_reference, accuracy);
    }
    catch (const MemoryError &error)
    {
      verdict.reason = error.what();
      return Outcome::hopeless;
    }
    report.nonlinear_iterations += solve.iterations;
    report.linear_iterations += solve.linear_iterations;
    if (!solve.converged)
    {
      verdict.reason = solve.reason;
      advice = solve.advice;
      return Outcome::rejected;
    }
    const auto scope = run.timers.scope("growth");
    const State state = system.state(current, before, rate_reference, acceleration_reference);
    verdict = model.advance(context, state, system.collectives());
    const bool has_grown = verdict.kind == Verdict::Kind::topology_changed;
    if (accuracy == Accuracy::rough && !has_grown)
    {
      accuracy = Accuracy::full;
      continue;
    }
    accuracy = of_looks;
    switch (verdict.kind)
    {
    case Verdict::Kind::accept:
      return Outcome::accepted;
    case Verdict::Kind::reject:
      return Outcome::rejected;
    case Verdict::Kind::stop:
      return Outcome::hopeless;
    case Verdict::Kind::topology_changed:
      system.renumber_extra(
        {&current.extra, &before.extra, &rate_reference.extra, &acceleration_reference.extra});
      if (system.restarts())
      {
        set_references();
        return Outcome::accepted;
      }
    }
  }
  verdict.reason = "the fracture has not come to rest in " + std::to_string(max_passes) + " solves";
  return Outcome::rejected;
}


template <int dim>
void Stepper<dim>::make_explicit_march()
{
  if (march || !scheme.is_explicit())
    return;
  if (model.explicit_rock() == nullptr)
    throw EntryError("Time/Scheme", "explicit",
                     "Newmark, or 'Fracture/Model = peridynamics' with bonds in all of the domain");
  march = std::make_unique<ExplicitMarch<dim>>(run, system, model, scheme.newmark_gamma());
  march->n_parts(std::min(control.initial_step, control.end_time - control.start_time));
}


template <int dim>
void Stepper<dim>::start(const double time)
{
  if (march)
    march->begin();
  if (scheme.starts_in_equilibrium())
    march->find_equilibrium(time, committed);
}


template <int dim>
StepReport
Stepper<dim>::advance_explicitly(const double time, const double dt, const unsigned int step)
{
  make_explicit_march();
  StepReport report;
  const ExtraNumbering committed_numbering = system.extra_numbering();
  context = scheme.context(time, dt, step, 0);
  current = before = committed;
  model.begin_step(context);
  network.begin_step(context);
  report.nonlinear_iterations =
    march->advance(time, dt, current, scheme.bulk_velocity(), scheme.bulk_acceleration());
  scheme.references(context, current, rate_reference, acceleration_reference);
  const State state = last_state();
  const Verdict verdict = model.advance(context, state, system.collectives());
  if (verdict.kind == Verdict::Kind::topology_changed)
    system.renumber_extra(
      {&current.extra, &before.extra, &rate_reference.extra, &acceleration_reference.extra});
  commit(state);
  for (std::vector<double> *history : scheme.extra_history())
    *history = system.extra_numbering().transfer(committed_numbering, *history, 0.);
  committed = current;
  report.dt = dt;
  report.next_dt = std::min(dt * std::max(1., control.growth), control.maximum_step);
  return report;
}


template <int dim>
void Stepper<dim>::commit(const State &state)
{
  balance = network.balance(context, state, system.collectives());
  system.commit(context, state);
  network.commit(context, state, system.collectives());
  model_wants_setup = model.commit(context, state);
}


template <int dim>
double Stepper<dim>::wave_step()
{
  const Requirements requirements = model.requirements();
  if (scheme.kind() != TimeScheme::Kind::newmark || scheme.is_explicit() ||
      !requirements.has_fracture || !requirements.may_grow)
    return std::numeric_limits<double>::infinity();
  control.waves.set_segments(network.segments(), rock);
  return control.waves.longest();
}


template <int dim>
double Stepper<dim>::speed_of_tips(const Verdict &verdict, const double dt)
{
  const bool runs_in_waves = verdict.advances && std::isfinite(wave_step());
  return runs_in_waves ? control.waves.tip_speed(dt, *verdict.advances) : 0.;
}


template <int dim>
StepReport Stepper<dim>::advance(const double time, double dt, const unsigned int step)
{
  if (scheme.is_explicit())
    return advance_explicitly(time, dt, step);
  StepReport report;
  const ExtraNumbering committed_numbering = system.extra_numbering();
  const double first_dt = dt;
  for (unsigned int attempt_number = 0;; ++attempt_number)
  {
    context = make_context(time, dt, step, attempt_number);
    Verdict verdict;
    std::string advice;
    const Outcome outcome = attempt(report, advice, verdict);
    std::string &reason = verdict.reason;
    bool accepted = outcome == Outcome::accepted;

    // A smooth run may also be judged by its local error.
    const double error = accepted && std::isfinite(control.error_tolerance)
                           ? scheme.error_estimate(context, before, current)
                           : -1.;
    if (error > 2. * control.error_tolerance && dt > control.minimum_step)
    {
      accepted = false;
      reason = "the local error is " + std::to_string(error);
    }

    if (accepted && step == control.rejected_step && attempt_number == 0)
    {
      accepted = false;
      reason = "rejected as the deck demands ('Time/Reject first attempt of step')";
    }

    double shorter = 0.5 * dt;
    const double speed = accepted ? speed_of_tips(verdict, dt) : 0.,
                 by_waves = control.waves.is_fast(speed)
                              ? std::max(control.waves.longest(), control.minimum_step)
                              : std::numeric_limits<double>::infinity();
    if (too_long * by_waves < dt)
    {
      accepted = false;
      std::ostringstream what;
      what << std::setprecision(2) << "a tip runs at " << speed
           << " of the speed of Rayleigh waves, for which the step is too long";
      reason = what.str();
      shorter = by_waves;
    }

    if (accepted)
    {
      // Those who ask for waves have been told of a least step that is too long for them.
      if (!control.waves.are_wanted() && speed > speed_of_fast_tips &&
          dt > too_long * control.waves.longest())
        run.warn("A tip runs at more than " + to_string(speed_of_fast_tips, dimension::number) +
                 " of the speed of Rayleigh waves, in steps that filter the waves. 'Time/Waves "
                 "resolved above = 0.1' has steps resolve them.");
      if (verdict.advances && scheme.kind() == TimeScheme::Kind::newmark)
        control.waves.accept(dt, *verdict.advances);
      commit(last_state());
      // The history follows the numbering that has come out of the step.
      for (std::vector<double> *history : scheme.extra_history())
        *history = system.extra_numbering().transfer(committed_numbering, *history, 0.);
      scheme.accept(context, before, current,
                    !system.extra_numbering().is_within(committed_numbering));
      committed = current;

      const double dt_limit = step_limit(verdict, dt, first_dt);
      double growth = control.growth;
      if (growth < 0.)
        growth = std::isfinite(dt_limit) ? growth_beside_fractures : 1.;
      if (error > 0. && std::isfinite(control.error_tolerance))
      {
        // A new step costs a new factor of the matrix: it must be worth it.
        double wanted = 0.9 * std::pow(control.error_tolerance / error, 1. / (scheme.order() + 1.));
        // The estimate is a difference of nearly equal numbers and so carries their rounding
        // errors, enlarged; steps must not depend on these, nor on the number of ranks.
        wanted = std::floor(20. * std::min(wanted, 100.)) / 20.;
        growth = wanted < 1. ? std::max(wanted, 0.3) : wanted < 1.5 ? 1. : std::min(wanted, growth);
      }
      else if (std::isfinite(control.error_tolerance))
        growth = 1.; // not enough history for an estimate
      report.dt = dt;
      report.held_back = verdict.held_back;
      report.next_dt = std::min({dt * growth, dt_limit, by_waves, control.maximum_step});
      report.next_dt = std::max(report.next_dt, control.minimum_step);
      return report;
    }

    ++report.rejected;
    model.rollback();
    network.rollback();
    current.extra = committed.extra;
    system.adopt_extra(committed_numbering, {&current.extra});
    if (outcome == Outcome::hopeless)
      throw SolveError("Step " + std::to_string(step) + " at t = " + std::to_string(time) +
                       " s: " + reason);
    if (system.is_interrupted && system.is_interrupted())
      throw SolveError("Step " + std::to_string(step) + " was interrupted by a signal.");
    if (dt <= control.minimum_step * (1. + 1e-10))
      throw SolveError("Step " + std::to_string(step) + " at t = " + std::to_string(time) +
                       " s fails even with the shortest step allowed, " +
                       to_string(dt, dimension::time) + ": " + reason +
                       (advice.empty() ? "" : ". " + advice));
    shorter = std::max(shorter, control.minimum_step);
    run.out << "  step " << step << ": " << reason << "; dt " << dt << " -> " << shorter << " s"
            << std::endl;
    dt = shorter;
  }
}


template <int dim>
State Stepper<dim>::last_state() const
{
  return system.state(current, before, rate_reference, acceleration_reference);
}


template <int dim>
std::vector<TrilinosWrappers::MPI::BlockVector *> Stepper<dim>::bulk_vectors()
{
  auto vectors = scheme.bulk_history();
  vectors.insert(vectors.begin(), &committed.bulk);
  return vectors;
}


template <int dim>
std::vector<std::vector<double> *> Stepper<dim>::extra_vectors()
{
  auto vectors = scheme.extra_history();
  vectors.insert(vectors.begin(), &committed.extra);
  return vectors;
}


template class Stepper<2>;
template class Stepper<3>;
} // namespace stockwork
