#include "scene_numbers.h"

#include "stockwork/base/error.h"
#include "stockwork/rock/linear_stiffness.h"

#include "in_situ_numbers.h"
#include "rock/wave_speeds.h"
#include "scales.h"
#include "scene_estimates.h"
#include "verification/analytical/radial.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// As long as cohesive cracks make their process zone where the deck gives no strength.
constexpr double cells_of_process_zone = 8.;

/// Of a box of rollers, in half lengths: there the stress intensity is 5 % smaller.
constexpr double nearest_walls = 5.;
} // namespace


namespace
{
/// A run ends where its fracture comes to cells that do not resolve the process zone.
void add_cells_ahead(const SizesOfPath &cells,
                     const double process_zone,
                     std::vector<SceneNumber> &numbers)
{
  const double allowed = std::max(cells.at_start, 0.25 * process_zone);
  if (cells.to_the_end <= allowed * (1. + 1e-6))
    return;
  std::ostringstream text;
  text << std::setprecision(3) << "the fracture will stop the run where larger cells than about "
       << allowed
       << " m begin, which do not resolve its process zone; cells alike as far as it shall run: "
          "Mesh/Box/X spacing and Y spacing, 'size from place to place'";
  numbers.push_back(
    {"largest cells ahead / at the start", cells.to_the_end / cells.at_start, text.str(), true});
}


/// At first the fluid opens a short part of a closed crack, as a fracture in rock without toughness
/// (the viscosity vertex of Adachi & Detournay 2002): half length 0.6152 (E' Q^3 t^4/mu')^(1/6).
void add_start(const Case<2> &the_case,
               const analytical::KgdParameters &parameters,
               const double duration,
               const double cell_size,
               std::vector<SceneNumber> &numbers)
{
  constexpr double cells = 3.;
  const double modulus = the_case.rock.main().plane_modulus();
  const double opened = std::min(cells * cell_size, 0.5 * the_case.scene.cracks[0].size());
  const double time =
    std::pow(opened / 0.6152, 1.5) *
    std::pow(12. * parameters.viscosity / (modulus * std::pow(parameters.rate, 3)), 0.25);
  std::ostringstream text;
  text << std::setprecision(2) << "in the first " << time
       << " s the fluid opens less than three cells on either side of the well, and the pressure "
          "there hangs on where the cells lie; smaller cells would resolve it";
  const double share = time / duration;
  numbers.push_back({"time until the start is resolved / pumping", share,
                     share > 1e-3 ? text.str() : "the pressure at the start is resolved"});
}


void add_hydraulic_numbers(const Case<2> &the_case,
                           const Pumping &pumping,
                           const MeshSizes<2> &mesh,
                           std::vector<SceneNumber> &numbers)
{
  const RockProperties &rock = the_case.rock.main();
  const analytical::KgdParameters parameters = plane_fracture(the_case, pumping);
  const double K_m = parameters.dimensionless_toughness();
  numbers.push_back(
    {"dimensionless toughness K_m", K_m,
     K_m > 4.   ? "toughness dominates: the pressure in the fracture is nearly uniform"
     : K_m < 1. ? "viscosity dominates: the flow along the fracture must be resolved"
                : "neither viscosity nor toughness dominates"});

  const analytical::Kgd kgd(parameters);
  const LeakedShare leaked = leaked_share(the_case, pumping);
  const double speed = kgd.tip_speed(0.01 * pumping.duration) / rayleigh_speed(rock);
  numbers.push_back({"tip speed / Rayleigh speed (at 1 % of the time)", speed,
                     speed < speed_of_fast_tips
                       ? "inertia may be left out: waves settle long before the tip moves on"
                     : the_case.scheme.kind() == TimeScheme::Kind::newmark
                       ? "inertia matters; 'Time/Waves resolved above' has steps resolve it"
                       : "inertia matters: set Time/Inertia = on"});

  const std::string when = pumping.is_shut_in ? "at shut-in" : "at the end";
  if (leaked.most > 1e-4) // else rounding
  {
    std::ostringstream text;
    text << in_words(leaked) << " of the fluid has leaked off " << when << ", after "
         << std::setprecision(3) << pumping.duration << " s of pumping";
    if (!pumping.is_shut_in)
      text << " (the well is not shut in)";
    numbers.push_back({"efficiency " + when, 1. - leaked.least, text.str()});
  }

  add_start(the_case, parameters, pumping.duration, mesh.smallest, numbers);
  const double reach = half_length_at_end(the_case);
  const double walls = distance_to_walls(the_case) / reach;
  std::ostringstream text;
  if (reach > half_length_at_start(the_case))
    text << "the fracture grows to about " << std::setprecision(3) << reach << " m per wing; ";
  else
    text << "the fracture hardly grows, for what is pumped leaks off or opens the crack alone; ";
  text << (walls > 12.5 ? "the walls are far enough for 1 %"
           : walls > nearest_walls
             ? "the walls cost some per cent"
             : "the walls govern the answer: enlarge the domain, or compare with a "
               "solution that has them");
  numbers.push_back({"distance to walls / final length", walls, text.str(),
                     walls <= nearest_walls && !the_case.walls_follow_reference});

  const SizesOfPath cells = sizes_of_path(the_case, mesh, reach);
  // A zone a fifth as long as the wing makes the fracture longer by 1 % (kgd/toughness), and in
  // proportion; less where viscosity dominates.
  const double zone =
    std::isnan(rock.tensile_strength)
      ? cells_of_process_zone * cells.at_start
      : rock.plane_modulus() * rock.energy_release_rate / std::pow(rock.tensile_strength, 2);
  std::ostringstream effect;
  effect << std::setprecision(2);
  if (K_m < 0.5)
    effect << "viscosity dominates: the zone matters little";
  else if (zone <= 0.2 * reach)
    effect << "short: it makes the fracture about " << 5. * zone / reach << " % longer";
  else
  {
    effect << "long: it makes the fracture about " << 5. * zone / reach
           << " % longer, earlier more; ";
    if (std::isnan(rock.tensile_strength))
      effect << "cells of " << 0.2 * reach / cells_of_process_zone << " m would do for 1 %";
    else
      effect << "that is the rock's strength, not the mesh's";
  }
  numbers.push_back({"process zone / final length", zone / reach, effect.str()});
  add_cells_ahead(cells, zone, numbers);
}
} // namespace


namespace
{
/// How near the rock of a region is to the end of its linear range, in situ and beside the tip of a
/// crack whose faces carry the tensile strength across it: over the pressure of the fluid that
/// fills the crack, which is then about the in-situ compression across it, or over none beside a
/// tip that is dry.
template <int dim>
void add_strength(const Case<dim> &the_case,
                  const types::material_id region,
                  std::vector<SceneNumber> &numbers)
{
  const RockLaw &law = the_case.laws(region);
  const RockProperties &rock = the_case.rock(region);
  const std::string where = region == 0 ? "" : ", region " + std::to_string(region);
  const Point<dim> place = the_case.scene.cracks.empty() || the_case.scene.cracks[0].points.empty()
                             ? Point<dim>()
                             : the_case.scene.cracks[0].points.front();
  RockState state;
  state.in_situ_stress = the_case.scene.in_situ_tensor(place, rock);
  state.in_situ_pressure = the_case.scene.in_situ_pore_pressure(place);
  numbers.push_back({(region == 0 ? "share of the rock's strength used in situ"
                                  : "share of strength used in situ") +
                       where,
                     law.used(state), law.describe() + "; from 1 on the rock yields"});
  if (the_case.scene.cracks.empty() || std::isnan(rock.tensile_strength))
    return;
  const bool is_full = the_case.network.has_wells() && !the_case.network.may_cavitate();
  const auto principal = eigenvectors(state.in_situ_stress);
  const SymmetricTensor<2, 3> across =
    symmetrize(outer_product(principal[0].second, principal[0].second));
  state.in_situ_stress +=
    (rock.tensile_strength - (is_full ? 0. : state.in_situ_pressure + principal[0].first)) * across;
  const double at_tip = law.used(state);
  numbers.push_back(
    {"the same beside the tip of a crack" + where, at_tip,
     std::string(at_tip < 0.5  ? "nowhere near yield: the rock stays linear"
                 : at_tip < 1. ? "the rock may yield where stresses concentrate"
                               : "the rock yields around the tips") +
       (is_full ? " (where the fluid fills the crack to its tip)" : " (a dry tip)")});
}
} // namespace


namespace
{
/// Share of the permeability that the in-situ stress leaves at a place.
template <int dim>
double permeability_left(const Case<dim> &the_case,
                         const types::material_id region,
                         const Point<dim> &place)
{
  if (!the_case.laws(region).changes_permeability())
    return 1.;
  const RockProperties &rock = the_case.rock(region);
  RockState state;
  state.in_situ_stress = the_case.scene.in_situ_tensor(place, rock);
  state.in_situ_pressure = the_case.scene.in_situ_pore_pressure(place);
  RockResponse response;
  the_case.laws(region).evaluate(ArrayView<const RockState>(&state, 1),
                                 ArrayView<RockResponse>(&response, 1));
  return trace(response.permeability) / trace(rock.template permeability_tensor<3>());
}


template <int dim>
void add_permeability(const Case<dim> &the_case, std::vector<SceneNumber> &numbers)
{
  const Point<dim> centre =
    the_case.geometry.lower() + 0.5 * (the_case.geometry.upper() - the_case.geometry.lower());
  const double left = permeability_left(the_case, 0, centre);
  const bool is_tight = left<1e-6, is_wide = left> 1e3;
  numbers.push_back({"share of the permeability left in situ", left,
                     std::string("in the middle of the domain, by the mean effective stress; ") +
                       (is_tight ? "next to nothing flows: is the unit of 'Rock/Permeability decay "
                                   "stress' right?"
                        : is_wide ? "tension widens the pores: are the signs of the stress and the "
                                    "unit of 'Rock/Permeability decay stress' right?"
                                  : "the numbers of diffusion here are with 'Rock/Permeability' "
                                    "itself, but for fluid in pores"),
                     is_tight || is_wide});
}


/// How far pore pressure comes in the run, and what that asks of steps and splits.
template <int dim>
void add_diffusion(const Case<dim> &the_case,
                   const MeshSizes<dim> &mesh,
                   std::vector<SceneNumber> &numbers)
{
  const RockProperties &rock = the_case.rock.main();
  const double diffusivity = pressure_diffusivity(the_case);
  const double duration = the_case.control.end_time - the_case.control.start_time;
  const double size = the_case.geometry.diameter();
  const double time = diffusivity * duration / (size * size);
  numbers.push_back({"diffusion c_v T / L^2", time,
                     time < 1e-6  ? "nearly undrained throughout; elastic rock may do"
                     : time > 1e2 ? "drained long before the end"
                                  : "diffusion and deformation are solved together"});
  const double safe = mesh.smallest * mesh.smallest / (6. * diffusivity);
  std::ostringstream text;
  text << "the first step is " << std::setprecision(3) << the_case.control.initial_step << " s; "
       << (the_case.control.initial_step < safe
             ? "below this length the pressure may overshoot at a drained side (Vermeer & Verruijt "
               "1981)"
             : "long enough for a monotone pressure");
  numbers.push_back({"shortest safe step h^2 / (6 c_v) [s]", safe, text.str()});
  const double bulk_modulus = rock.bulk_modulus();
  const double strength =
    rock.inverse_biot_modulus > 0.
      ? rock.biot_coefficient * rock.biot_coefficient / (rock.inverse_biot_modulus * bulk_modulus)
      : std::numeric_limits<double>::infinity();
  numbers.push_back({"coupling strength alpha^2 M / K_dr", strength,
                     strength < 1. ? "every split converges where there is no fracture"
                                   : "drained and fixed-strain splits diverge"});
}


/// How far wells in the rock spread their fluid, and what that asks of time.
template <int dim>
void add_sources(const Case<dim> &the_case, std::vector<SceneNumber> &numbers)
{
  const double duration = the_case.control.end_time - the_case.control.start_time;
  for (const auto &source : the_case.network.sources())
  {
    const double time = source.radius * source.radius / (4. * pressure_diffusivity(the_case));
    std::ostringstream text;
    text << std::setprecision(3) << "its fluid enters the pores over this radius";
    if (source.has_borehole)
      text << "; the pressure in the borehole is that of steady radial flow within it, which comes "
              "about in a few times R^2/(4 c) = "
           << time << " s";
    numbers.push_back({"source radius of '" + source.well + "' [m]", source.radius, text.str(),
                       source.has_borehole && time > 0.1 * duration});
  }
}


/// Whether the cells resolve what leaks off into the rock. Into a column
/// (tests/data/porous_column.prm) 1, 11, 32 and 59 % too little leaks with cells of 0.25, 1, 2 and
/// 4 times this length.
template <int dim>
void add_leak_off(const Case<dim> &the_case,
                  const Pumping &pumping,
                  const MeshSizes<dim> &mesh,
                  std::vector<SceneNumber> &numbers)
{
  const double duration = the_case.control.end_time - the_case.control.start_time;
  const double time = pumping.duration > 0. ? pumping.duration : duration;
  const double reach = std::sqrt(pressure_diffusivity(the_case) * time);
  const double cells = mesh.smallest / reach;
  std::ostringstream text;
  text << std::setprecision(3) << "in " << time
       << " s of pumping the fluid comes about sqrt(c t) = " << reach << " m into the rock; ";
  if (cells <= 1.)
    text << "the leak-off is resolved, but for the first " << std::setprecision(2)
         << cells * cells * time << " s";
  else
    text << "cells of " << mesh.smallest
         << " m do not resolve this, and too little leaks off: take smaller cells, or 'Fracture "
            "flow/Leak-off = carter'";
  numbers.push_back({"cell size / sqrt(c t)", cells, text.str(), cells > 1.});
}


/// What pores filled with the fluid of a fracture do to it.
struct Swelling
{
  double excess = 0.; ///< the fluid's pressure over that of the pores, in net pressures
  double share = 0.;
};


/// Share: the opening that pores filled with the fluid of a fracture take from it, as a share of
/// that with which it begins to grow. The pressure falls over one cell, which widens by alpha dp
/// h/(lambda + 2G) (rock held sideways), however little of it the fluid has reached; a fracture of
/// half-length l grows with the net pressure p = K_Ic/sqrt(pi l), which opens it by 4 p l/E'.
template <int dim>
Swelling swelling_beside(const Case<dim> &the_case,
                         const InitialCrack<dim> &crack,
                         const RockProperties &rock,
                         const double cell_size)
{
  const LinearStiffness<2> stiffness(rock);
  const double uniaxial = stiffness.bulk_modulus() + stiffness.shear_modulus();
  const double half_length = stockwork::half_length(the_case, crack);
  const Point<dim> place = crack.disc ? crack.disc->centre : crack.points.front();
  const double net = rock.toughness() / std::sqrt(numbers::PI * half_length);
  const double excess = std::max(
    closing_stress(the_case.scene, crack) - the_case.scene.in_situ_pore_pressure(place) + net, 0.);
  return {excess / net, rock.biot_coefficient * excess * cell_size / uniaxial /
                          (4. * net * half_length / rock.plane_modulus())};
}


/// From this share on, nothing that such a run says is of use: kgd/wang/permeable with pore
/// pressures of 20, 19, 17 and 10 MPa, shares of 0.11, 0.30, 0.67 and 2.0, has after 10 s net
/// pressures 1.1, 1.7, 2.4 and 4.2 times those of the network, and with the last it does not grow.
constexpr double greatest_swelling_share = 0.5;


/// Where the elements of the pore pressure carry the fluid of fractures, whether they are small
/// enough for it, for the crack that suffers most.
template <int dim>
void add_fluid_in_pores(const Case<dim> &the_case,
                        const MeshSizes<dim> &mesh,
                        std::vector<SceneNumber> &numbers)
{
  const double duration = the_case.control.end_time - the_case.control.start_time;
  double diffusivity = std::numeric_limits<double>::infinity();
  Swelling most;
  for (const InitialCrack<dim> &crack : the_case.scene.cracks)
  {
    const Point<dim> place = crack.disc ? crack.disc->centre : crack.points.front();
    const types::material_id region = mesh.region_at(place);
    diffusivity = std::min(diffusivity, permeability_left(the_case, region, place) *
                                          pressure_diffusivity(the_case, region));
    const RockProperties &rock = the_case.rock(region);
    if (!std::isnan(rock.energy_release_rate))
    {
      const Swelling here = swelling_beside(the_case, crack, rock, mesh.smallest);
      most = {std::max(most.excess, here.excess), std::max(most.share, here.share)};
    }
  }
  const double reach = std::sqrt(diffusivity * duration), cells = mesh.smallest / reach;
  const std::string entry = "Fracture/" + the_case.model_name + "/Fluid";
  // Where the pressure that the rock takes up is well above what drives the fracture, cells below
  // sqrt(c t) err still: by 8 to 70 % of the pressure in -23/-17 MPa over 10 MPa in the pores.
  // Where it is not, by 2.8 % with cells of 0.17 of it (kgd/sun/permeable).
  const bool resolved = cells <= 1., fine = cells <= 0.05 || (resolved && most.excess <= 2.);
  if (!resolved && most.share > greatest_swelling_share)
  {
    std::ostringstream allowed;
    allowed << std::setprecision(3) << "'network', or cells of at most "
            << std::max(reach, mesh.smallest * greatest_swelling_share / most.share)
            << " m: those of " << mesh.smallest << " m are larger than sqrt(c t) = " << reach
            << " m, as far as the pore pressure comes with 'Rock/Permeability' until 'Time/End "
               "time'; their pores, full of the fracture's fluid, swell them by "
            << most.share << " times the opening with which it would begin to grow ("
            << greatest_swelling_share
            << " at most), the more, the further 'In situ/Stress' across it is above 'In situ/Pore "
               "pressure'";
    throw EntryError(entry, "permeability tensor", allowed.str());
  }
  std::ostringstream text;
  text << std::setprecision(3) << "with '" << entry
       << " = permeability tensor' and 'Rock/Permeability', until 'Time/End time' the pore "
          "pressure comes sqrt(c t) = "
       << reach << " m into the rock; ";
  if (fine)
    text << "cells of " << mesh.smallest << " m resolve this at the end";
  else if (resolved)
    text << "cells of " << mesh.smallest
         << " m resolve it too little: with 7 MPa more across a fracture than in the pores net "
            "pressures were 8, 25 and 70 % too high with cells of 0.08, 0.3 and 0.7 of that; take "
            "smaller cells, or 'Fluid = network'";
  else
  {
    text << "in cells of " << mesh.smallest
         << " m it falls to the rock's within one of them, whatever the permeability, swells the "
            "rock and closes the fracture";
    if (most.share > 0.)
      text << " by " << most.share << " of the opening with which it begins to grow";
    text << ": take smaller cells, or 'Fluid = network'";
  }
  numbers.push_back({"cell size / sqrt(c t), fluid in pores", cells, text.str(), !fine});
}
} // namespace


namespace
{
/// How rock varies from place to place, and whether the cells follow it.
template <int dim>
void add_random_fields(const Case<dim> &the_case,
                       const MeshSizes<dim> &mesh,
                       std::vector<SceneNumber> &numbers)
{
  for (const auto &[region, law] : the_case.laws.all())
  {
    const RockProperties &rock = the_case.rock(region);
    if (!rock.is_random())
      continue;
    std::ostringstream text;
    text << std::setprecision(3) << "times the deck's value, deviation " << rock.random->deviation()
         << "; " << rock.random->describe();
    const bool skips = mesh.smallest > rock.random->lattice_spacing() * (1. + 1e-6);
    if (skips)
      text << "; the smallest cells, " << mesh.smallest
           << " m, are larger than those of the lattice and take the value at their centre";
    numbers.push_back(
      {"random rock: mean" + (region == 0 ? std::string() : ", region " + std::to_string(region)),
       rock.random->mean_factor(), text.str(), skips});
  }
}
} // namespace


template <int dim>
std::vector<SceneNumber> scene_numbers(const Case<dim> &the_case, const MeshSizes<dim> &mesh)
{
  std::vector<SceneNumber> numbers;
  if constexpr (dim == 2)
    add_principal_stresses(the_case, numbers);
  for (const auto &[region, law] : the_case.laws.all())
    if (law->n_history() > 0)
      add_strength(the_case, region, numbers);
  if (the_case.laws(0).changes_permeability())
    add_permeability(the_case, numbers);
  add_random_fields(the_case, mesh, numbers);
  const RockProperties &rock = the_case.rock.main();

  if (the_case.elements.has_pore_pressure)
  {
    add_pore_pressure(the_case, numbers);
    add_diffusion(the_case, mesh, numbers);
  }
  else
    numbers.push_back({"pore pressure unknowns", 0.,
                       "left out: nothing in the case moves fluid through the pores"});

  if (is_cracked(the_case))
    if (const double cells = cells_in_half_length(the_case, mesh); !std::isnan(cells))
      numbers.push_back(
        {"cells in the final half length", cells,
         "of the largest that the fracture comes to; what 'Resolution = auto' goes by"});

  const Pumping pumping = first_pumping(the_case);
  if (the_case.network.needs_pore_pressure())
    add_leak_off(the_case, pumping, mesh, numbers);
  if (the_case.model->requirements().fluid_in_pores && !the_case.scene.cracks.empty())
    add_fluid_in_pores(the_case, mesh, numbers);

  if (the_case.elements.has_pore_pressure)
    add_sources(the_case, numbers);
  add_given_pressure(the_case, mesh, numbers);
  add_shear_along_cracks(the_case, numbers);
  for (const auto &[well, pressure] : the_case.network.minimum_well_pressures())
    numbers.push_back({"minimum pressure in '" + well + "' [Pa]", pressure,
                       "at it, what the well takes is what flows (Minimum pressure)"});

  if (is_cracked(the_case) && !the_case.model->requirements().may_grow)
    numbers.push_back({"growth", 0., "left out: the cracks stay as long as the deck gives them"});
  else if (!the_case.scene.cracks.empty() && !std::isnan(rock.energy_release_rate))
  {
    if (!std::isnan(rock.tensile_strength))
    {
      const double length =
        rock.plane_modulus() * rock.energy_release_rate / std::pow(rock.tensile_strength, 2);
      const double cells = length / mesh.smallest;
      numbers.push_back({"process zone / cell size", cells,
                         cells >= 4. * (1. - 1e-6)
                           ? "resolved"
                           : "not resolved: pressure and width come out too large"});
    }
    if constexpr (dim == 2)
      if (is_driven_on(the_case))
        add_hydraulic_numbers(the_case, pumping, mesh, numbers);
    if constexpr (dim == 3)
      if (is_driven_on(the_case) && the_case.network.leak_off_law() == LeakOff::none)
      {
        const double toughness =
          analytical::radial_toughness(radial_fracture(the_case, pumping), pumping.duration);
        numbers.push_back(
          {"dimensionless toughness, radial, at the end", toughness,
           toughness > 3.5  ? "toughness dominates: the pressure in the fracture is nearly uniform"
           : toughness < 1. ? "viscosity dominates: the flow along the fracture must be resolved"
                            : "neither viscosity nor toughness dominates"});
      }
  }
  if (is_cracked(the_case) && pumping.rate > 0. &&
      the_case.scheme.kind() == TimeScheme::Kind::newmark && !the_case.scheme.damps())
    numbers.push_back({"Newmark gamma", 0.5,
                       "nothing damps the pressure in the fracture, which swings from step to "
                       "step the more, the shorter these are: try 0.6, and beta = 0.3025"});
  return numbers;
}


template std::vector<SceneNumber> scene_numbers<2>(const Case<2> &, const MeshSizes<2> &);
template std::vector<SceneNumber> scene_numbers<3>(const Case<3> &, const MeshSizes<3> &);
} // namespace stockwork
