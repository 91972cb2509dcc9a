#include "outcome_audit.h"

#include "rock/wave_speeds.h"
#include "scene_estimates.h"
#include "stockwork/base/quantity.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Below this a gauge pressure is less than that of vacuum [Pa].
constexpr double vacuum = -1e5;

constexpr double compressibility_of_water = 4.5e-10; // 1/Pa

std::string per_cent(const double fraction)
{
  std::ostringstream text;
  text << std::setprecision(2) << 100. * fraction << " %";
  return text.str();
}
} // namespace


void Outcome::has_pressure(const double pressure, const double time)
{
  minimum_pressure = pressure;
  least_pressure = std::min(least_pressure, pressure);
  if (pressure < vacuum)
    last_suction = time;
}


template <int dim>
std::vector<Assumption> check_assumptions(const Case<dim> &the_case, const Outcome &outcome)
{
  std::vector<Assumption> assumptions;
  for (const PhysicsDecision &decision : the_case.decisions)
    if (decision.left_out && decision.judge)
      assumptions.push_back(decision.judge(outcome));
  if (outcome.energy_error > 0.)
  {
    const bool moves = the_case.scheme.kind() == TimeScheme::Kind::newmark;
    const bool holds = outcome.energy_error < (moves ? 0.01 : 0.05);
    assumptions.push_back(
      {"energy is conserved: error of its balance / work done", outcome.energy_error, holds,
       moves ? (holds ? "steps follow the motion"
                      : "look at the motion: the loads may have flung something away, or "
                        "'Time/Newmark gamma' damps it")
             : (holds ? "what was done is stored, or has gone into cracks and rock that yields"
                      : "do not trust what depends on it. A crack that jumps at rest leaves energy "
                        "that only motion could take up ('Time/Inertia = on'); else steps are too "
                        "long, or something holds that should not")});
  }
  if (the_case.scheme.is_explicit() && outcome.least_opening < 0.)
  {
    constexpr double much = 0.05; // of the opening
    const bool holds = outcome.least_opening > -much * outcome.greatest_opening;
    assumptions.push_back(
      {"faces of cracks stay apart: least opening [m]", outcome.least_opening, holds,
       (holds
          ? "hardly any overlap beside the greatest opening, "
          : "nothing keeps faces apart in explicit steps, and they have passed through one "
            "another: where loads press cracks shut, 'Time/Scheme = Newmark' with 'Closure = in "
            "bonds' holds them; the greatest opening is ") +
         to_string(outcome.greatest_opening, dimension::length)});
  }
  // A fluid that is injected keeps tips going; loads that do not give way let them run, and each
  // step only so far.
  if (outcome.held_back && the_case.scene.injection_rate == 0. &&
      the_case.scheme.kind() != TimeScheme::Kind::newmark)
    assumptions.push_back(
      {"cracks are at rest at the end; a tip would have grown on", 1., false,
       "a step lets a tip grow by a few cells only ('Most advances per step'), so this is no "
       "equilibrium: give the run more steps ('Time/Initial step', 'End time')"});
  if (the_case.scene.cracks.empty() || !(outcome.injected > 0.))
    return assumptions;
  const RockProperties &rock = the_case.rock.main();
  const Fluid &fluid = the_case.rock.fluid();
  // A cloud of cracked cells, or a crack through all of the rock, has no tips.
  const bool has_tips = dim == 2 && outcome.n_tips > 0;
  const double wing = has_tips ? outcome.length / outcome.n_tips : 0.;

  if (has_tips && the_case.scheme.kind() != TimeScheme::Kind::newmark)
  {
    const double speed = outcome.maximum_tip_speed / rayleigh_speed(rock);
    assumptions.push_back(
      {"inertia left out: tip speed / Rayleigh speed", speed, speed < speed_of_fast_tips,
       speed < speed_of_fast_tips ? "waves settled long before the tips moved on"
                                  : "the fracture ran as fast as waves: set Time/Inertia = on"});
  }

  if (has_tips && !the_case.walls_follow_reference)
  {
    const double distance = distance_to_walls(the_case), walls = distance / wing,
                 effect = effect_of_walls<dim>(distance, wing);
    assumptions.push_back({"walls far away: distance / length of a wing", walls, effect < 0.05,
                           (effect < 0.05 ? "they change the stress intensity by about "
                                          : "the walls govern the answer; they change the stress "
                                            "intensity by about ") +
                             per_cent(std::min(effect, 1.))});
  }

  if (has_tips && !std::isnan(rock.energy_release_rate) && outcome.process_zone > 0.)
  {
    const double zone = outcome.process_zone / outcome.length;
    assumptions.push_back(
      {"short process zones: their length / that of the fracture", zone, zone < 0.2,
       zone < 0.2 ? "toughness alone decides, not strength"
                  : "strength decides with toughness: linear-elastic fracture mechanics does not "
                    "describe this fracture"});
  }

  // Where the deck lets the fluid cavitate, the lag is part of the model; where it gives the
  // pressure, there is no flow.
  if (!the_case.network.may_cavitate() && std::isnan(the_case.scene.crack_pressure))
  {
    const bool suction = outcome.minimum_pressure < vacuum;
    // Few runs are without at the start, where steps and cells are coarse beside the fracture.
    const double duration = the_case.control.end_time - the_case.control.start_time;
    constexpr double long_time = 0.5;
    const bool was_long = outcome.last_suction - the_case.control.start_time > long_time * duration;
    std::string reason = "the fluid can fill the tips";
    if (suction)
      reason = "less than vacuum: real fluid would lag behind the tip";
    else if (outcome.least_pressure < vacuum)
      reason +=
        " now; until " + to_string(outcome.last_suction, dimension::time) +
        " it was less than vacuum, " + to_string(outcome.least_pressure, dimension::pressure) +
        " at the least" +
        (was_long ? ": real fluid would have lagged behind the tip for most of the run" : "");
    assumptions.push_back({"no fluid lag: minimum pressure in the fracture [Pa]",
                           outcome.minimum_pressure, !suction && !was_long, reason});
  }

  if (fluid.compressibility == 0.)
  {
    const double share = outcome.inlet_pressure * compressibility_of_water;
    assumptions.push_back(
      {"incompressible fluid: pressure / bulk modulus of water", share, share < 0.02,
       share < 0.02 ? "hardly any of the volume is compressed away" : "set Fluid/Bulk modulus"});
  }

  if (dim != 2)
    return assumptions;
  if (outcome.leaked > 0.)
  {
    const double seen = outcome.leaked / outcome.injected;
    constexpr double margin = 0.25; // of the closed form (leaking_kgd()) and of a wall or two
    bool foreseen = true;
    std::string estimate;
    if constexpr (dim == 2)
      if (const Pumping pumping = first_pumping(the_case);
          is_driven_on(the_case) && !pumping.is_shut_in)
      {
        const LeakedShare share = leaked_share(the_case, pumping);
        foreseen =
          seen > (1. - margin) * share.least - 0.01 && seen < (1. + margin) * share.most + 0.01;
        estimate = "; the estimate before the run was " + in_words(share) +
                   (foreseen ? ""
                             : ": either the cells do not resolve the flow into the rock, or what "
                               "was foreseen of length, time and model is of another fracture");
      }
    assumptions.push_back(
      {"leak-off: leaked / injected", seen, foreseen, "as modelled" + estimate});
  }
  else if (!the_case.elements.has_pore_pressure && the_case.rock.bulk_model() == "auto" &&
           rock.permeability > 0.)
  {
    // Carter's coefficient where the pore fluid resists (Howard & Fast 1957), as if the whole
    // fracture had been open all the time.
    const auto &corners = the_case.scene.cracks[0].points;
    const double excess = outcome.inlet_pressure - the_case.in_situ.pore_pressure(corners.front());
    const double carter = excess * std::sqrt(rock.permeability * storage_coefficient(rock) /
                                             (numbers::PI * fluid.viscosity));
    const double duration = the_case.control.end_time - the_case.control.start_time;
    const double share = 4. * carter * std::sqrt(duration) * outcome.length / outcome.injected;
    assumptions.push_back({"impermeable rock: Carter's estimate of leaked / injected", share,
                           share < 0.05,
                           share < 0.05 ? "the rock would take next to nothing"
                                        : "the rock would take a good deal: set Fracture "
                                          "flow/Leak-off, or Rock/Bulk model = elastic if its "
                                          "permeability is meant to be nil"});
  }
  return assumptions;
}


template <int dim>
void audit_outcome(RunContext &run, const Case<dim> &the_case, const Outcome &outcome)
{
  const auto assumptions = check_assumptions(the_case, outcome);
  if (assumptions.empty())
    return;
  run.out << "\nAssumptions after the run\n";
  std::vector<std::string> violated;
  for (const Assumption &assumption : assumptions)
  {
    std::ostringstream text;
    text << assumption.name << " = " << std::setprecision(3) << assumption.value << ": "
         << assumption.judgement;
    run.out << (assumption.holds ? "  holds     " : "  DOES NOT  ") << text.str() << '\n';
    if (!assumption.holds)
      violated.push_back(text.str());
  }
  run.out << std::flush;
  for (const std::string &text : violated)
    run.warn("An assumption does not hold. " + text + ".");
}


template std::vector<Assumption> check_assumptions<2>(const Case<2> &, const Outcome &);
template std::vector<Assumption> check_assumptions<3>(const Case<3> &, const Outcome &);
template void audit_outcome<2>(RunContext &, const Case<2> &, const Outcome &);
template void audit_outcome<3>(RunContext &, const Case<3> &, const Outcome &);
} // namespace stockwork
