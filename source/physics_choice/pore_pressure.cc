#include "physics_choice/decisions.h"

#include "stockwork/rock/linear_stiffness.h"

#include "outcome_audit.h"
#include "scene_estimates.h"

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
/// What the pores would do that an estimate does not know; empty: nothing.
template <int dim>
std::string why_pores_matter(const Case<dim> &the_case, const Deck &deck)
{
  const auto &conditions = the_case.boundary_conditions;
  const RockProperties &rock = the_case.rock.main();
  const Requirements requirements = the_case.model->requirements();
  const LeakOff law = the_case.network.leak_off_law();
  if (the_case.network.opens_into_rock())
    return "a well opens into the rock";
  if (!the_case.network.wells_are_in_pieces())
    return "a well's rate is an expression, and nothing tells how much leaks off meanwhile";
  if (requirements.pore_pressure || requirements.fluid_in_pores)
    return "the fracture model needs them";
  if (!conditions.loads().flux.empty() ||
      !deck.peek("Boundary conditions/Pore pressure").value_or("").empty())
    return "pore pressures or fluxes on the boundary drive a flow";
  if (!conditions.entry_with_reference().empty())
    return "the boundary follows a reference solution";
  if (!the_case.laws.are_linear())
    return "the law of the rock hangs on the effective stress";
  if (rock.stiffness || rock.is_random() || the_case.laws.all().size() > 1 || rock.plane_stress)
    return "undrained constants are there for uniform, isotropic rock in plane strain alone";
  if (the_case.scheme.kind() == TimeScheme::Kind::newmark)
    return "inertia is kept, and moves rock and fluid together";
  if (law != LeakOff::none && law != LeakOff::carter && law != LeakOff::resolved)
    return "there is no estimate for this law of leak-off";
  if (law == LeakOff::resolved && (dim == 3 || !(first_pumping(the_case).rate > 0.)))
    return "there is no estimate of what leaks off without a plane fracture and a rate";
  if (is_cracked(the_case) &&
      (std::isnan(half_length_at_end(the_case)) || (dim == 3 && the_case.network.has_wells())))
    return "there is no estimate of how long the fracture will be";
  if (law == LeakOff::resolved && first_pumping(the_case).is_shut_in)
    return "after shut-in the leak-off decides";
  return "";
}


/// Constants of rock whose pore fluid stays where it is (Cheng 2016).
struct UndrainedRock
{
  double young_modulus; ///< [Pa]
  double poisson_ratio;
  double plane_modulus; ///< [Pa]
};

UndrainedRock undrained(const RockProperties &rock)
{
  const double bulk =
    rock.bulk_modulus() + rock.biot_coefficient * rock.biot_coefficient / rock.inverse_biot_modulus;
  const double shear = rock.shear_modulus();
  const double ratio = (3. * bulk - 2. * shear) / (2. * (3. * bulk + shear));
  const double young = 2. * shear * (1. + ratio);
  return {young, ratio, young / (1. - ratio * ratio)};
}


/// Share of the opening that the pressure of leaked fluid, sqrt(c t) deep, takes from a plane
/// fracture, and the share of the fluid that leaks.
double error_of_leak_off(const Case<2> &the_case, const double reach, std::ostringstream &why)
{
  const RockProperties &rock = the_case.rock.main();
  const Pumping pumping = first_pumping(the_case);
  const double leaked = leaked_share(the_case, pumping).least;
  const analytical::Kgd fracture(plane_fracture(the_case, pumping));
  const InitialCrack<2> &crack = the_case.scene.cracks[0];
  const double excess = closing_stress(the_case.scene, crack) +
                        fracture.inlet_pressure(pumping.duration) -
                        the_case.in_situ.pore_pressure(crack.points.front());
  const LinearStiffness<2> stiffness(rock);
  // Both faces rise by the strain of rock held sideways, integrated over the error function.
  const double depth = 2. * 2. / std::sqrt(numbers::PI) * reach;
  const double swelling = rock.biot_coefficient * std::max(excess, 0.) /
                          (stiffness.bulk_modulus() + stiffness.shear_modulus()) * depth /
                          fracture.inlet_opening(pumping.duration);
  why << "; " << as_percentage(leaked) << " of the fluid would leak off, and swell the rock by "
      << as_percentage(swelling) << " of the opening";
  return leaked + swelling;
}


/// The estimate again, with the length and the pressure that the fracture has come to have.
template <int dim>
std::function<Assumption(const Outcome &)>
judge_of_pores(const Case<dim> &the_case, const double reach, const double stiffer)
{
  double carter = 0., pore_pressure = 0.; // of one face, per pressure over that of the pores
  if constexpr (dim == 2)
  {
    carter = leak_off_coefficient(the_case).per_net_pressure;
    pore_pressure = the_case.in_situ.pore_pressure(the_case.scene.cracks[0].points.front());
  }
  const double duration = duration_of(the_case);
  return [=](const Outcome &outcome)
  {
    const double wing = outcome.length / std::max(outcome.n_tips, 1u);
    double share = wing > 0. ? stiffer * std::min(1., reach / wing) : 0.;
    if (carter > 0. && outcome.injected > 0.)
      share += 4. * carter * (outcome.inlet_pressure - pore_pressure) * std::sqrt(duration) *
               outcome.length / outcome.injected;
    return Assumption{
      "pores left out: stiffness lost in a rim of sqrt(c t), and share leaked", share, share < 0.05,
      share < 0.05 ? "they would have done next to nothing"
                   : "they would have done a good deal: set Physics = as the deck says"};
  };
}
} // namespace


template <int dim>
PhysicsDecision
decide_pores(const Case<dim> &the_case, const Deck &deck, const std::function<double()> &strength)
{
  const std::string name = "pore pressure and its diffusion";
  if (const std::string why = why_pores_matter(the_case, deck); !why.empty())
    return kept(name, why);
  const RockProperties &rock = the_case.rock.main();
  if (!(rock.inverse_biot_modulus > 0.))
    return kept(name, "neither grains nor fluid can be compressed, and elements without a pressure "
                      "cannot be of such rock ('Fluid/Bulk modulus')");
  const UndrainedRock elastic = undrained(rock);
  // Bilinear cells lock before: at 0.4885 the pressure of a fracture is 3.3 % off.
  if (elastic.poisson_ratio > 0.45)
    return kept(name, "undrained, Poisson's ratio is " + with_digits(elastic.poisson_ratio, 3) +
                        ", too near 1/2 for elements without a pressure");

  const double reach = std::sqrt(pressure_diffusivity(the_case) * duration_of(the_case));
  const bool cracked = is_cracked(the_case);
  const double length = cracked ? half_length_at_end(the_case) : smallest_extent(the_case);
  const double stiffer = elastic.plane_modulus / rock.plane_modulus() - 1.;

  PhysicsDecision decision;
  decision.name = name;
  decision.error = stiffer * std::min(1., reach / length);
  std::ostringstream why;
  why << std::setprecision(2) << "pore pressure comes sqrt(c t) = " << reach
      << " m far, beside the " << length << " m of "
      << (cracked ? "a wing of the fracture" : "the domain") << "; the undrained rock is "
      << as_percentage(stiffer) << " stiffer";
  if constexpr (dim == 2)
    if (the_case.network.leak_off_law() == LeakOff::resolved)
      decision.error += error_of_leak_off(the_case, reach, why);
  decision.left_out = true;
  decision.cost = &CostlyPhysics::pore_pressure;
  decision.why = why.str();
  decision.settings = {
    {"Rock/Bulk model", "elastic"},
    {"Rock/Young modulus", with_digits(elastic.young_modulus, 12) + " Pa"},
    {"Rock/Poisson ratio", with_digits(elastic.poisson_ratio, 12)},
    {"Boundary conditions/Drained", ""},
  };
  if (the_case.network.leak_off_law() == LeakOff::resolved)
    decision.settings.emplace_back("Fracture flow/Leak-off", "none");
  if (cracked && std::isnan(rock.tensile_strength))
    if (const double taken = strength(); !std::isnan(taken))
      decision.settings.emplace_back("Rock/Tensile strength", with_digits(taken, 12) + " Pa");
  if (!std::isnan(rock.energy_release_rate))
  {
    decision.settings.emplace_back("Rock/Fracture toughness", "");
    decision.settings.emplace_back("Rock/Critical energy release rate",
                                   with_digits(rock.energy_release_rate, 12) + " J/m^2");
  }
  if (cracked)
    decision.judge = judge_of_pores(the_case, reach, stiffer);
  return decision;
}


template PhysicsDecision
decide_pores<2>(const Case<2> &, const Deck &, const std::function<double()> &);
template PhysicsDecision
decide_pores<3>(const Case<3> &, const Deck &, const std::function<double()> &);
} // namespace stockwork
