#include "physics_choice.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/rock/linear_stiffness.h"

#include "base/parameter_tree.h"
#include "outcome_audit.h"
#include "scales.h"
#include "scene_estimates.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <memory>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
std::string with_digits(const double value, const int digits)
{
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string as_percentage(const double share)
{
  return with_digits(100. * share, share < 0.1 ? 2 : 3) + " %";
}

PhysicsDecision kept(const std::string &name, const std::string &why)
{
  PhysicsDecision decision;
  decision.name = name;
  decision.why = why;
  return decision;
}

template <int dim>
double duration_of(const Case<dim> &the_case)
{
  return the_case.control.end_time - the_case.control.start_time;
}

template <int dim>
bool is_cracked(const Case<dim> &the_case)
{
  return !the_case.scene.cracks.empty() && the_case.model->requirements().has_fracture;
}

template <int dim>
double smallest_extent(const Case<dim> &the_case)
{
  const Tensor<1, dim> extent = the_case.geometry.upper() - the_case.geometry.lower();
  double smallest = std::numeric_limits<double>::infinity();
  for (unsigned int d = 0; d < dim; ++d)
    smallest = std::min(smallest, extent[d]);
  return smallest;
}


// Inertia
// -------------------------------------------------------------------------------------------

/// All loads on the boundary and the greatest displacement given there, at a time; of what varies
/// along the boundary, at the corners and the middle of the domain.
template <int dim>
std::vector<double> loads_at(const Case<dim> &the_case, const double time)
{
  const Point<dim> lower = the_case.geometry.lower(), upper = the_case.geometry.upper();
  std::vector<double> values{the_case.boundary_conditions.maximum_displacement(time)};
  const auto add = [&](const PrescribedValue<dim> &load)
  {
    if (load.value)
      for (const Point<dim> &point : {lower, lower + 0.5 * (upper - lower), upper})
        values.push_back(load.value(point, time));
  };
  for (const auto &[side, load] : the_case.boundary_conditions.loads().normal_traction)
    add(load);
  for (const auto &[side, components] : the_case.boundary_conditions.loads().traction)
    for (const auto &load : components)
      add(load);
  return values;
}


/// By how much loads change at most within a time, over their greatest value. Before the run there
/// are none.
template <int dim>
double greatest_change(const Case<dim> &the_case, const double within)
{
  // At the run's own steps: what a load does between two of them no run sees. Of a run of more
  // steps than `most`, a pulse shorter than that share of it may be missed.
  constexpr double fewest = 1e3, most = 2e5;
  const double start = the_case.control.start_time, duration = duration_of(the_case);
  const unsigned int n = static_cast<unsigned int>(
    std::clamp(std::ceil(duration / the_case.control.initial_step), fewest, most));
  std::vector<std::vector<double>> samples;
  for (unsigned int i = 0; i <= n; ++i)
    samples.push_back(loads_at(the_case, start + duration * i / n));

  double greatest = 0.;
  for (unsigned int k = 0; k < samples[0].size(); ++k)
  {
    double scale = 0.;
    for (const auto &sample : samples)
      scale = std::max(scale, std::abs(sample[k]));
    if (scale == 0.)
      continue;
    greatest = std::max(greatest, std::abs(samples[0][k]) / scale);
    for (unsigned int i = 0; i < n; ++i)
    {
      // Into the half where it changes more, until the rest is as short as the time.
      double from = start + duration * i / n, to = start + duration * (i + 1) / n;
      double before = samples[i][k], after = samples[i + 1][k];
      while (to - from > within && std::abs(after - before) > 1e-6 * scale)
      {
        const double middle = 0.5 * (from + to), value = loads_at(the_case, middle)[k];
        if (std::abs(value - before) > std::abs(after - value))
        {
          to = middle;
          after = value;
        }
        else
        {
          from = middle;
          before = value;
        }
      }
      const double intervals = std::max(1., within / (to - from));
      greatest = std::max(greatest, std::min(1., intervals * std::abs(after - before) / scale));
    }
  }
  return greatest;
}


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


/// Loads that begin to grow, or a rate that begins, set the rock swinging by what they bring within
/// one period; of a fracture that runs, elasticity errs by the square of its speed over that of
/// waves (Freund 1990).
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


// Plasticity
// ----------------------------------------------------------------------------------------

/// Share of its strength that rock uses under a stress added to that in situ.
template <int dim>
double strength_used(const Case<dim> &the_case,
                     const types::material_id region,
                     const Point<dim> &place,
                     const SymmetricTensor<2, 3> &added)
{
  RockState state;
  state.in_situ_stress = the_case.scene.in_situ_tensor(place, the_case.rock(region)) + added;
  state.in_situ_pressure = the_case.scene.in_situ_pore_pressure(place);
  return the_case.laws(region).used(state);
}


/// The greatest stress that the loads on the boundary bring into rock without a hole [Pa].
template <int dim>
double stress_of_loads(const Case<dim> &the_case)
{
  double greatest = 0.;
  for (unsigned int i = 0; i <= 100; ++i)
  {
    std::vector<double> loads =
      loads_at(the_case, the_case.control.start_time + 0.01 * i * duration_of(the_case));
    loads[0] *= the_case.rock.main().plane_modulus() / smallest_extent(the_case);
    for (const double load : loads)
      greatest = std::max(greatest, std::abs(load));
  }
  return greatest;
}


/// Everywhere the stress in situ, that of the loads, three times as great beside holes and corners,
/// in any direction; beside the tips of cracks the tensile strength, and on their faces the
/// pressure that drives them.
template <int dim>
PhysicsDecision decide_plasticity(const std::shared_ptr<const Case<dim>> &asked_for,
                                  const ParameterHandler &prm)
{
  const Case<dim> &the_case = *asked_for;
  const std::string name = "plasticity";
  constexpr double concentration = 3., greatest_share = 0.5;
  const bool cracked = is_cracked(the_case);
  if (the_case.network.opens_into_rock())
    return kept(name, "a well opens into the rock, whose pore pressure nothing bounds beforehand");
  if (!the_case.boundary_conditions.entry_with_reference().empty())
    return kept(name, "the boundary follows a reference solution");
  if (cracked && !the_case.network.has_wells())
    return kept(name, "no well drives the cracks: nothing bounds the stress at their tips");
  if (cracked && (dim == 3 || !std::isnan(the_case.scene.crack_pressure)))
    return kept(name, "nothing bounds the stress at the tips of these cracks beforehand");

  const Scales scales = scales_of(the_case.scene, the_case.network, the_case.boundary_conditions);
  const double load = concentration * stress_of_loads(the_case);
  const Point<dim> middle =
    the_case.geometry.lower() + 0.5 * (the_case.geometry.upper() - the_case.geometry.lower());
  double used = 0.;
  for (const auto &[region, law] : the_case.laws.all())
  {
    if (law->n_history() == 0)
      continue;
    const RockProperties &rock = the_case.rock(region);
    if (cracked && std::isnan(rock.tensile_strength))
      return kept(name, "the deck gives no 'Rock/Tensile strength', which bounds the stress at the "
                        "tips");
    std::vector<Point<dim>> places{the_case.geometry.lower(), middle, the_case.geometry.upper()};
    for (const Point<dim> &place : places)
    {
      const auto principal = eigenvectors(the_case.scene.in_situ_tensor(place, rock));
      std::vector<double> added{load};
      if (cracked)
        added.push_back(concentration * scales.pressure);
      for (const auto &[value, axis] : principal)
      {
        const SymmetricTensor<2, 3> across = symmetrize(outer_product(axis, axis));
        for (const double stress : added)
          for (const double sign : {-1., 1.})
            used = std::max(used, strength_used(the_case, region, place, sign * stress * across));
      }
      // The process zone, into which the fluid comes or not.
      if (cracked)
      {
        const SymmetricTensor<2, 3> across =
          symmetrize(outer_product(principal[0].second, principal[0].second));
        const double effective = the_case.scene.in_situ_pore_pressure(place) + principal[0].first;
        for (const double relief : {0., effective})
          used = std::max(used, strength_used(the_case, region, place,
                                              (rock.tensile_strength - relief) * across));
      }
    }
  }
  std::ostringstream why;
  why << std::setprecision(2) << "stress in situ"
      << (cracked ? ", three times the net pressure and the tensile strength beside the tips" : "")
      << (load > 0. ? ", and three times the loads" : "") << " take " << used
      << " of the rock's strength; " << greatest_share << " at most are taken for safe";
  PhysicsDecision decision = kept(name, why.str());
  if (used > greatest_share)
    return decision;
  decision.left_out = true;
  decision.error = 0.;
  for (const auto &[region, law] : the_case.laws.all())
    if (law->n_history() > 0)
    {
      const std::string section = region == 0 ? "Rock" : "Rock/Region " + std::to_string(region);
      decision.settings.emplace_back(section + "/Law", "elastic");
      // What is said of a law that no rock has is refused.
      for (const DeclaredEntry &entry : declared_entries(prm))
        if (entry.section == section + "/" + the_case.laws.name(region) &&
            entry.value != entry.default_value)
          decision.settings.emplace_back(entry.path(), entry.default_value);
    }
  decision.strength_used = [asked_for](const types::material_id region, const Point<3> &place,
                                       const SymmetricTensor<2, 3> &stress)
  {
    Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = place[d];
    return strength_used(*asked_for, region, point, stress);
  };
  decision.judge = [](const Outcome &outcome)
  {
    const double share = outcome.strength_used;
    return Assumption{"plasticity left out: greatest share of strength used", share, share < 1.,
                      share < 1. ? "the rock would have stayed linear (cells that no crack cuts)"
                                 : "the rock would have yielded: set Physics = as the deck says"};
  };
  return decision;
}


// Pore pressure
// -------------------------------------------------------------------------------------

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
  if (is_cracked(the_case) && std::isnan(half_length_at_end(the_case)))
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
  const double leaked =
    1. - analytical::leaking_kgd(plane_fracture(the_case, pumping), leak_off_coefficient(the_case),
                                 pumping.duration)
           .efficiency;
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


/// Where the pore fluid hardly moves, rock is elastic with its undrained constants. In a rim
/// sqrt(c t) deep it does move, and there the rock is softer.
template <int dim>
PhysicsDecision decide_pores(const Case<dim> &the_case, const Deck &deck)
{
  const std::string name = "pore pressure and its diffusion";
  if (const std::string why = why_pores_matter(the_case, deck); !why.empty())
    return kept(name, why);
  const RockProperties &rock = the_case.rock.main();
  if (!(rock.inverse_biot_modulus > 0.))
    return kept(name, "neither grains nor fluid can be compressed, and elements without a pressure "
                      "cannot be of such rock ('Fluid/Bulk modulus')");
  const UndrainedRock elastic = undrained(rock);
  if (elastic.poisson_ratio > 0.49)
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
  decision.why = why.str();
  decision.settings = {
    {"Rock/Bulk model", "elastic"},
    {"Rock/Young modulus", with_digits(elastic.young_modulus, 12) + " Pa"},
    {"Rock/Poisson ratio", with_digits(elastic.poisson_ratio, 12)},
    {"Boundary conditions/Drained", ""},
  };
  if (the_case.network.leak_off_law() == LeakOff::resolved)
    decision.settings.emplace_back("Fracture flow/Leak-off", "none");
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


// Lubrication
// ---------------------------------------------------------------------------------------

PhysicsDecision decide_lubrication(const Case<2> &the_case)
{
  const double K_m = plane_fracture(the_case, first_pumping(the_case)).dimensionless_toughness();
  return kept("pressure gradients along the fracture",
              "K_m = " + with_digits(K_m, 2) +
                (K_m > 4. ? ": the pressure is nearly uniform, and yet nothing is gained, for the "
                            "program has no form of the flow with one pressure per fracture"
                          : ": the flow along the fracture decides"));
}


// All
// -----------------------------------------------------------------------------------------------

void set_entry(ParameterHandler &prm, const std::string &path, const std::string &value)
{
  std::istringstream in(path);
  std::vector<std::string> parts;
  for (std::string part; std::getline(in, part, '/');)
    parts.push_back(part);
  for (unsigned int i = 0; i + 1 < parts.size(); ++i)
    prm.enter_subsection(parts[i]);
  prm.set(parts.back(), value);
  for (unsigned int i = 0; i + 1 < parts.size(); ++i)
    prm.leave_subsection();
}


using Settings = std::vector<std::pair<std::string, std::string>>;

/// The case of a deck with some entries set.
template <int dim>
std::shared_ptr<const Case<dim>>
case_with(const Deck &deck, const PlugIns &plug_ins, const Settings &settings)
{
  ParameterHandler prm;
  declare_all_parameters(prm, plug_ins);
  deck.parse_into(prm);
  for (const auto &[entry, value] : settings)
    set_entry(prm, entry, value);
  return std::make_shared<const Case<dim>>(deck, prm, plug_ins);
}


template <int dim>
bool has_inertia(const Case<dim> &the_case)
{
  return the_case.scheme.kind() == TimeScheme::Kind::newmark;
}
} // namespace


template <int dim>
std::vector<PhysicsDecision>
leave_out_physics(const Deck &deck, ParameterHandler &prm, const PlugIns &plug_ins)
{
  const double accuracy = get_quantity(prm, "Accuracy", dimension::number);
  std::shared_ptr<const Case<dim>> the_case = case_with<dim>(deck, plug_ins, {});
  std::vector<PhysicsDecision> decisions;
  Settings settings;
  double error = 0.;
  const auto take = [&](PhysicsDecision decision)
  {
    if (decision.left_out && !(error + decision.error <= accuracy))
    {
      decision.left_out = false;
      decision.why += (error > 0. ? ": with what is left out already, " : ": ") +
                      as_percentage(error + decision.error) + " is more than 'Accuracy'";
    }
    if (decision.left_out)
      try
      {
        Settings all = settings;
        all.insert(all.end(), decision.settings.begin(), decision.settings.end());
        the_case = case_with<dim>(deck, plug_ins, all);
        settings = all;
        error += decision.error;
      }
      catch (const InputError &refusal)
      {
        decision.left_out = false;
        decision.why +=
          "; but without it the deck would be refused: " + std::string(refusal.what());
      }
    decisions.push_back(decision);
  };
  // In this order, for what is left out decides what the next may be.
  if (has_inertia(*the_case))
    take(decide_inertia(*the_case));
  if (the_case->laws.may_yield())
    take(decide_plasticity(the_case, prm));
  if (the_case->elements.has_pore_pressure)
    take(decide_pores(*the_case, deck));
  if constexpr (dim == 2)
    if (is_cracked(*the_case) && first_pumping(*the_case).rate > 0. &&
        the_case->rock.main().energy_release_rate > 0.)
      take(decide_lubrication(*the_case));
  for (const auto &[entry, value] : settings)
    set_entry(prm, entry, value);
  return decisions;
}


template std::vector<PhysicsDecision>
leave_out_physics<2>(const Deck &, ParameterHandler &, const PlugIns &);
template std::vector<PhysicsDecision>
leave_out_physics<3>(const Deck &, ParameterHandler &, const PlugIns &);
} // namespace stockwork
