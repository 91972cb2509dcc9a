#pragma once

#include "stockwork/base/run_context.h"

#include "case.h"

#include <algorithm>
#include <string>
#include <vector>

namespace stockwork
{
/// What a run has shown of the assumptions it was made with. Collected step by step.
struct Outcome
{
  double length = 0.;            ///< of all cracks at the end [m]
  double process_zone = 0.;      ///< part of it that still has strength [m]
  unsigned int n_tips = 0;       ///< at the end
  bool held_back = false;        ///< in the last step a tip would have grown on
  double maximum_tip_speed = 0.; ///< of one tip, averaged over a hundredth of the run [m/s]
  double injected = 0.;          ///< [m^2]
  double leaked = 0.;            ///< [m^2]
  double inlet_pressure = 0.;    ///< total, at the end [Pa]
  double minimum_pressure = 0.;  ///< total, of all segments at the end [Pa]
  double least_pressure = 0.;    ///< the same at any step, if below zero [Pa]
  double last_suction = 0.;      ///< when it was less than vacuum for the last time [s]

  double least_opening = 0., greatest_opening = 0.; ///< of faces of cracks, at any step [m]
  double energy_error = 0.; ///< of the balance of energy, over the work done, at the end; zero
                            ///< where there is none

  // Of what 'Physics = auto' has left out, the greatest of those that were looked at.
  double kinetic_share = 0.; ///< energy that the rock's motion would have, over what it stores
  double strength_used = 0.; ///< share of the strength that the rock would have

  /// The cracks had this length at this time.
  void grown_to(double new_length, double time, double window)
  {
    if (time - last_time < window)
      return;
    if (n_tips > 0 && last_time > 0.)
      maximum_tip_speed =
        std::max(maximum_tip_speed, (new_length - last_length) / (time - last_time) / n_tips);
    last_length = new_length;
    last_time = time;
  }

  /// This was the minimum pressure at this time.
  void has_pressure(double pressure, double time);

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &maximum_tip_speed &last_length &last_time &kinetic_share &strength_used &least_opening
      &greatest_opening &least_pressure &last_suction;
  }

private:
  double last_length = 0., last_time = 0.;
};

/// An assumption held against the outcome.
struct Assumption
{
  std::string name;
  double value;
  bool holds;
  std::string judgement; ///< what the number means
};

/// The assumptions that only the outcome can confirm, as far as the case makes them: those of
/// 'Physics = auto', and of a fluid-driven fracture in two dimensions no inertia, walls far away, a
/// process zone and a fluid lag that are short, a fluid and a rock that take up no fluid.
template <int dim>
std::vector<Assumption> check_assumptions(const Case<dim> &the_case, const Outcome &outcome);

/// Print them; those that do not hold are warnings of the run.
template <int dim>
void audit_outcome(RunContext &run, const Case<dim> &the_case, const Outcome &outcome);
} // namespace stockwork
