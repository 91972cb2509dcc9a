#include "coupling/time_scheme.h"

#include "base/ghost_values.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <Epetra_MultiVector.h>

#include <array>
#include <cmath>
#include <utility>

namespace stockwork
{
using namespace dealii;

namespace
{
/// result = a x + b y, in all unknowns. Ghost values take part, so that none need be fetched again;
/// deal.II's own operators do not write to vectors with ghost values.
void combine(Unknowns &result, const double a, const Unknowns &x, const double b, const Unknowns &y)
{
  if (&result != &x)
    result = x;
  for (unsigned int k = 0; k < result.bulk.n_blocks(); ++k)
  {
    Epetra_MultiVector &block = result.bulk.block(k).trilinos_vector();
    if (b != 0.)
      block.Update(b, y.bulk.block(k).trilinos_vector(), a);
    else if (a != 1.)
      block.Scale(a);
  }
  for (unsigned int i = 0; i < result.extra.size(); ++i)
    result.extra[i] = a * result.extra[i] + (b != 0. ? b * y.extra[i] : 0.);
}
} // namespace


void TimeScheme::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Time");
  prm.declare_entry(
    "Scheme", "auto", Patterns::Selection("auto|backward Euler|BDF2|Newmark|explicit"),
    "auto: Newmark with inertia; BDF2 for consolidation without a fracture; else "
    "backward Euler. explicit: Newmark's with beta = 0 and a mass lumped at the "
    "nodes, for rock all of which is made of bonds, with cracks dry or under a given pressure; "
    "each step is divided into "
    "as many as are stable, which takes no matrix. Loads are those of its beginning "
    "and end, and linear between: a pulse takes steps that are shorter. What is moved "
    "goes on from where it is: if the deck has it jump, it takes the first step.");
  prm.declare_entry("Inertia", "off", Patterns::Selection("off|on"),
                    "Accelerations of rock and fluid together (u-p form).");
  prm.declare_entry("Start", "at rest", Patterns::Selection("at rest|in equilibrium"),
                    "in equilibrium: the loads of the start time have been there for long, and the "
                    "rock has taken them without cracking further; 'Scheme = explicit' only.");
  prm.declare_entry("Newmark beta", "0.25", Quantity(dimension::number, Range::positive()),
                    "Unconditionally stable for 2 beta >= gamma >= 1/2.");
  prm.declare_entry("Newmark gamma", "0.5", Quantity(dimension::number, Range::positive()),
                    "Above 1/2 damps numerically, at the price of second order.");
  prm.declare_entry("Theta", "0.5", Quantity(dimension::number, Range::closed(0.5, 1.)),
                    "Of the pressure, with Newmark.");
  prm.leave_subsection();
}


void TimeScheme::parse_parameters(ParameterHandler &prm, const bool smooth)
{
  prm.enter_subsection("Time");
  const std::string name = prm.get("Scheme");
  const bool inertia = prm.get("Inertia") == "on";
  beta = get_quantity(prm, "Newmark beta", dimension::number);
  gamma = get_quantity(prm, "Newmark gamma", dimension::number);
  theta = get_quantity(prm, "Theta", dimension::number);
  explicit_steps = name == "explicit";
  in_equilibrium = prm.get("Start") == "in equilibrium";
  const std::string beta_text = prm.get("Newmark beta"), gamma_text = prm.get("Newmark gamma");
  prm.leave_subsection();

  if (in_equilibrium && !explicit_steps)
    throw EntryError("Time/Start", "in equilibrium", "at rest, or 'Time/Scheme = explicit'");
  if (name == "Newmark" || explicit_steps || (name == "auto" && inertia))
    scheme = Kind::newmark;
  else if (name == "BDF2" || (name == "auto" && smooth))
    scheme = Kind::bdf2;
  else
    scheme = Kind::backward_euler;

  if (inertia != (scheme == Kind::newmark))
    throw EntryError("Time/Scheme", name,
                     inertia ? "Newmark, explicit or auto when Time/Inertia = on"
                             : "neither Newmark nor explicit when Time/Inertia = off");
  if (scheme == Kind::newmark && !(gamma >= 0.5))
    throw EntryError("Time/Newmark gamma", gamma_text,
                     "at least 1/2 (otherwise the scheme is unstable)");
  if (scheme == Kind::newmark && !explicit_steps && !(2. * beta >= gamma))
    throw EntryError("Time/Newmark beta", beta_text,
                     "at least half of Newmark gamma, which is " + gamma_text +
                       " (otherwise the scheme is unstable)");
}


void TimeScheme::initialise(const Unknowns &unknowns)
{
  if (scheme != Kind::newmark)
    combine(previous, 1., unknowns, 0., unknowns);
  if (scheme == Kind::bdf2)
    combine(earlier, 1., unknowns, 0., unknowns);
  if (scheme == Kind::newmark)
  {
    combine(velocity, 0., unknowns, 0., unknowns);
    combine(acceleration, 0., unknowns, 0., unknowns);
  }
}


unsigned int TimeScheme::order() const
{
  return scheme == Kind::backward_euler ? 1 : 2;
}


StepContext TimeScheme::context(const double time,
                                const double dt,
                                const unsigned int step,
                                const unsigned int attempt) const
{
  StepContext context;
  context.time = time + dt;
  context.dt = dt;
  context.step = step;
  context.attempt = attempt;
  context.rate = context.pressure_rate = 1. / dt;
  if (scheme == Kind::bdf2 && n_accepted > 0)
  {
    const double r = dt / previous_dt;
    context.rate = context.pressure_rate = (1. + 2. * r) / ((1. + r) * dt);
  }
  else if (explicit_steps)
    context.acceleration = 1. / (dt * dt);
  else if (scheme == Kind::newmark)
  {
    context.rate = gamma / (beta * dt);
    context.acceleration = 1. / (beta * dt * dt);
    context.pressure_rate = 1. / (theta * dt);
  }
  return context;
}


void TimeScheme::references(const StepContext &context,
                            const Unknowns &committed,
                            Unknowns &rate_reference,
                            Unknowns &acceleration_reference) const
{
  const double dt = context.dt;
  if (scheme == Kind::bdf2 && n_accepted > 0)
  {
    const double r = dt / previous_dt;
    combine(rate_reference, (1. + r) * (1. + r) / (1. + 2. * r), committed, -r * r / (1. + 2. * r),
            previous);
  }
  else if (explicit_steps)
  {
    // Of the state at the end, for which `committed` stands here.
    combine(rate_reference, 1., committed, -dt, velocity);
    combine(acceleration_reference, 1., committed, -dt * dt, acceleration);
  }
  else if (scheme == Kind::newmark)
  {
    // u'' = (u - u_n - dt v_n)/(beta dt^2) - (1/(2 beta) - 1) a_n, and
    // u'  = v_n + dt ((1-gamma) a_n + gamma u''), solved for the references.
    combine(acceleration_reference, 1., committed, dt, velocity);
    combine(acceleration_reference, 1., acceleration_reference, beta * dt * dt * (0.5 / beta - 1.),
            acceleration);
    Unknowns known;
    combine(known, 1., velocity, dt * (1. - gamma), acceleration);
    combine(rate_reference, 1., acceleration_reference, -beta * dt / gamma, known);
    if (rate_reference.bulk.n_blocks() > 1)
    {
      // p' = (p - p_n)/(theta dt) - (1/theta - 1) p'_n
      auto &pressure = rate_reference.bulk.block(1);
      pressure = committed.bulk.block(1);
      pressure.add((1. - theta) * dt, velocity.bulk.block(1));
    }
  }
  else
    combine(rate_reference, 1., committed, 0., committed);
}


namespace
{
/// Owned entries only, so that norms count no ghost value twice.
TrilinosWrappers::MPI::Vector owned(const TrilinosWrappers::MPI::Vector &vector)
{
  TrilinosWrappers::MPI::Vector result(vector.locally_owned_elements(),
                                       vector.get_mpi_communicator());
  copy_owned(result, vector);
  return result;
}
} // namespace


void TimeScheme::accept(const StepContext &context,
                        const Unknowns &committed,
                        const Unknowns &current,
                        const bool new_unknowns)
{
  has_new_unknowns = new_unknowns;
  if (scheme == Kind::newmark && !explicit_steps)
  {
    Unknowns rate_reference, acceleration_reference;
    references(context, committed, rate_reference, acceleration_reference);
    combine(velocity, context.rate, current, -context.rate, rate_reference);
    if (velocity.bulk.n_blocks() > 1)
      velocity.bulk.block(1) *= context.pressure_rate / context.rate;
    combine(acceleration, context.acceleration, current, -context.acceleration,
            acceleration_reference);
  }
  if (scheme == Kind::bdf2)
    std::swap(earlier, previous);
  if (scheme != Kind::newmark)
    combine(previous, 1., committed, 0., committed);
  if (scheme == Kind::bdf2)
    for (unsigned int k = 0; k < current.bulk.n_blocks(); ++k)
      maximum_size[k] = std::max(maximum_size[k], owned(current.bulk.block(k)).l2_norm());
  earlier_dt = previous_dt;
  previous_dt = context.dt;
  ++n_accepted;
}


double TimeScheme::error_estimate(const StepContext &context,
                                  const Unknowns &committed,
                                  const Unknowns &current) const
{
  // The initial state is not one of the four: loads that act from the start on jump there, which
  // the scheme does not mind (the fluid in the pores does not jump) but a difference of unknowns.
  if (scheme != Kind::bdf2 || n_accepted < 3)
    return -1.;
  // BDF2 differentiates the parabola through three points in time. What it misses of the rate is
  // x[0,1,2,3] h0 (h0 + h1), with the third divided difference over the last four points and the
  // steps h0, h1, h2 between them, latest first (Hairer, Norsett, Wanner, III.5); the local error
  // is that over the leading coefficient.
  const double h0 = context.dt, h1 = previous_dt, h2 = earlier_dt;
  const double missed = h0 * (h0 + h1) / context.rate;
  const std::array<double, 4> weights = {
    {missed / (h0 * (h0 + h1) * (h0 + h1 + h2)), -missed / (h0 * h1 * (h1 + h2)),
     missed / ((h0 + h1) * h1 * h2), -missed / ((h0 + h1 + h2) * (h1 + h2) * h2)}};
  double relative = 0.;
  for (unsigned int k = 0; k < current.bulk.n_blocks(); ++k)
  {
    TrilinosWrappers::MPI::Vector error = owned(current.bulk.block(k)), point(error);
    // Once the pores have drained their pressure is rounding, whose error is as large as itself.
    constexpr double minimum_share = 1e-4;
    const double size = std::max(error.l2_norm(), minimum_share * maximum_size[k]);
    const Unknowns *last[] = {&committed, &previous, &earlier};
    error *= weights[0];
    for (unsigned int i = 0; i < 3; ++i)
    {
      point = last[i]->bulk.block(k);
      error.add(weights[i + 1], point);
    }
    if (size > 0.)
      relative = std::max(relative, error.l2_norm() / size);
  }
  return relative;
}


void TimeScheme::predict(const StepContext &context, Unknowns &unknowns) const
{
  if (scheme == Kind::newmark)
  {
    Unknowns start;
    combine(start, 1., unknowns, context.dt, velocity);
    combine(unknowns, 1., start, 0.5 * context.dt * context.dt, acceleration);
  }
  else if (n_accepted > 1 && (unknowns.bulk.n_blocks() > 1 || !has_new_unknowns))
  {
    // What has appeared in the last step has no past to be extrapolated from, and in elastic rock,
    // where all follows the fracture, neither has the rest.
    const double r = context.dt / previous_dt;
    combine(unknowns, 1. + r, unknowns, -r, previous);
  }
}


std::vector<TrilinosWrappers::MPI::BlockVector *> TimeScheme::bulk_history()
{
  if (scheme == Kind::newmark)
    return {&velocity.bulk, &acceleration.bulk};
  if (scheme == Kind::bdf2)
    return {&previous.bulk, &earlier.bulk};
  return {&previous.bulk};
}


std::vector<std::vector<double> *> TimeScheme::extra_history()
{
  if (scheme == Kind::newmark)
    return {&velocity.extra, &acceleration.extra};
  if (scheme == Kind::bdf2)
    return {&previous.extra, &earlier.extra};
  return {&previous.extra};
}
} // namespace stockwork
