#include "physics_choice/decisions.h"

#include "outcome_audit.h"
#include "physics_choice/loads.h"
#include "rock/wave_speeds.h"
#include "scene_estimates.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// The shortest time for which a well keeps its rate [s].
template <int dim>
double shortest_piece(const Case<dim> &the_case)
{
  double shortest = duration_of(the_case);
  for (double t = the_case.control.start_time; t < the_case.control.end_time;)
  {
    const double next = std::min(the_case.network.next_jump(t), the_case.control.end_time);
    shortest = std::min(shortest, next - t);
    t = next;
  }
  return shortest;
}


/// What cannot be estimated of the waves in a scene; empty: nothing.
template <int dim>
std::string why_waves_matter(const Case<dim> &the_case)
{
  const auto &conditions = the_case.boundary_conditions;
  const bool pumps = the_case.network.has_wells();
  if (!conditions.entry_with_reference().empty())
    return "the boundary follows a reference solution, whose waves nobody knows beforehand";
  if (conditions.controlled_load())
    return "a controlled load may snap back, as fast as waves";
  if (conditions.mentions_pore_pressure() && !conditions.constant_in_time())
    return "pore pressures or fluxes on the boundary change in time";
  if (the_case.network.maximum_pressure())
    return "a well with a given pressure acts at once";
  if (!the_case.network.wells_are_in_pieces())
    return "a well's rate is an expression, and nothing tells how fast it changes";
  if (!is_cracked(the_case))
    return "";
  if (!std::isnan(the_case.scene.crack_pressure))
    return "the pressure in the cracks is given, and acts at once";
  if (!pumps)
    return "no well drives the cracks: nothing tells how fast they run under loads of the boundary";
  if (dim == 3)
    return "there is no estimate of how fast a fracture runs in three dimensions";
  if (!(the_case.rock.main().energy_release_rate > 0.) || !(first_pumping(the_case).rate > 0.))
    return "without a toughness and a rate that the deck gives, nothing tells how fast the "
           "fracture runs";
  return "";
}
} // namespace


template <int dim>
PhysicsDecision decide_inertia(const Case<dim> &the_case)
{
  const std::string name = "inertia";
  if (const std::string why = why_waves_matter(the_case); !why.empty())
    return kept(name, why);
  const double speed = rayleigh_speed(the_case.rock.main());
  const bool cracked = is_cracked(the_case);
  const double length = cracked ? 2. * half_length_at_end(the_case) : the_case.geometry.diameter();
  const double period = (cracked ? 2. : 4.) * length / speed;

  PhysicsDecision decision;
  decision.name = name;
  const double change = greatest_change(the_case, period);
  decision.error = change;
  std::ostringstream why;
  why << std::setprecision(2) << "waves settle within " << period << " s (" << length << " m at "
      << speed << " m/s)";
  if (the_case.network.has_wells())
  {
    decision.error += period / shortest_piece(the_case);
    why << ", wells keep their rates for " << shortest_piece(the_case) << " s";
  }
  if constexpr (dim == 2)
    if (cracked)
    {
      const Pumping pumping = first_pumping(the_case);
      const double tip =
        analytical::Kgd(plane_fracture(the_case, pumping)).tip_speed(0.01 * pumping.duration) /
        speed;
      decision.error += tip * tip;
      why << ", the tips run at " << tip << " of their speed at 1 % of the time";
    }
  if (change > 0.)
    why << ", in which loads change by " << as_percentage(change) << " at most";
  decision.left_out = true;
  decision.cost = &CostlyPhysics::inertia;
  decision.why = why.str();
  decision.settings = {{"Time/Inertia", "off"}, {"Time/Scheme", "auto"}};
  decision.judge = [](const Outcome &outcome)
  {
    const double share = outcome.kinetic_share;
    return Assumption{"inertia left out: kinetic / stored energy", share, share < 0.01,
                      share < 0.01 ? "next to nothing of the energy was motion"
                                   : "set Time/Inertia = on and Physics = as the deck says"};
  };
  return decision;
}


template PhysicsDecision decide_inertia<2>(const Case<2> &);
template PhysicsDecision decide_inertia<3>(const Case<3> &);
} // namespace stockwork
