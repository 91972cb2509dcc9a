#include "scene_estimates.h"

#include "stockwork/rock/linear_stiffness.h"

#include "scales.h"
#include "verification/analytical/radial.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
template <int dim>
analytical::KgdParameters driven_fracture(const Case<dim> &the_case, const Pumping &pumping)
{
  const RockProperties &rock = the_case.rock.main();
  return {rock.plane_modulus(), 0., the_case.rock.fluid().viscosity, rock.toughness(),
          pumping.rate};
}
} // namespace


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
CostlyPhysics costly_physics(const Case<dim> &the_case)
{
  const Requirements requirements = the_case.model->requirements();
  return {is_cracked(the_case),
          the_case.elements.has_pore_pressure,
          the_case.scheme.kind() == TimeScheme::Kind::newmark,
          the_case.laws.may_yield(),
          requirements.time_of_step,
          requirements.memory_per_unknown};
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


template <int dim>
double distance_to_walls(const Case<dim> &the_case)
{
  const Point<dim> lower = the_case.geometry.lower(), upper = the_case.geometry.upper();
  const InitialCrack<dim> &crack = the_case.scene.cracks[0];
  const std::vector<Point<dim>> corners =
    crack.disc ? std::vector<Point<dim>>{crack.disc->centre} : crack.points;
  double distance = std::numeric_limits<double>::infinity();
  for (unsigned int d = 0; d < dim; ++d)
    for (const double wall : {lower[d], upper[d]})
    {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto &corner : corners)
        nearest = std::min(nearest, std::abs(corner[d] - wall));
      if (nearest >
          1e-9 * (upper[d] - lower[d])) // a crack that starts on a side is cut by symmetry
        distance = std::min(distance, nearest);
    }
  return distance;
}


double storage_coefficient(const RockProperties &rock)
{
  const LinearStiffness<2> stiffness(rock);
  const double uniaxial = stiffness.bulk_modulus() + stiffness.shear_modulus();
  return rock.inverse_biot_modulus + rock.biot_coefficient * rock.biot_coefficient / uniaxial;
}


namespace
{
/// Of a rate that changes all the time: its mean over the run.
template <int dim>
Pumping all_pumping(const Case<dim> &the_case)
{
  constexpr unsigned int samples = 1000;
  Pumping pumping;
  pumping.duration = duration_of(the_case);
  for (unsigned int i = 0; i < samples; ++i)
    pumping.rate += the_case.network.rate_of_first_well(the_case.control.start_time +
                                                        (i + 0.5) / samples * pumping.duration) /
                    samples;
  return pumping;
}
} // namespace


template <int dim>
Pumping first_pumping(const Case<dim> &the_case)
{
  const Network<dim> &network = the_case.network;
  const StepControl &control = the_case.control;
  if (!network.wells_are_in_pieces())
    return all_pumping(the_case);
  Pumping pumping;
  double volume = 0., start = control.start_time;
  for (double t = control.start_time; t < control.end_time && !pumping.is_shut_in;)
  {
    const double next = std::min(network.next_jump(t), control.end_time);
    const double rate = network.rate_of_first_well(next); // a piece holds until its end
    if (volume == 0.)
      start = t; // a rest before it is no part of it
    if (rate > 0.)
    {
      volume += rate * (next - t);
      pumping.duration = next - start;
    }
    pumping.is_shut_in = volume > 0. && rate <= 0.;
    t = next;
  }
  if (volume > 0.)
    pumping.rate = volume / pumping.duration;
  return pumping;
}


template <int dim>
bool wells_are_constant(const Case<dim> &the_case)
{
  return the_case.network.wells_are_in_pieces() &&
         std::isinf(the_case.network.next_jump(the_case.control.start_time));
}


analytical::LeakOffCoefficient leak_off_coefficient(const Case<2> &the_case)
{
  if (the_case.network.leak_off_law() == LeakOff::carter)
    return {the_case.network.carter(), 0.};
  if (the_case.network.leak_off_law() != LeakOff::resolved)
    return {};
  const RockProperties &rock = the_case.rock.main();
  const double per_pressure = std::sqrt(rock.permeability * storage_coefficient(rock) /
                                        (numbers::PI * the_case.rock.fluid().viscosity));
  const InitialCrack<2> &crack = the_case.scene.cracks[0];
  return {per_pressure * (closing_stress(the_case.scene, crack) -
                          the_case.in_situ.pore_pressure(crack.points.front())),
          per_pressure};
}


LeakedShare leaked_share(const Case<2> &the_case, const Pumping &pumping)
{
  const analytical::KgdParameters fracture = plane_fracture(the_case, pumping);
  const analytical::LeakOffCoefficient leak_off = leak_off_coefficient(the_case);
  const auto [length, efficiency] = analytical::leaking_kgd(fracture, leak_off, pumping.duration);
  const double least = 1. - efficiency;
  if (the_case.network.leak_off_law() != LeakOff::resolved)
    return {least, least};
  // Rock that swells presses on the fracture by up to eta times the excess pressure, the
  // poroelastic stress coefficient of Detournay & Cheng (1993), and the excess is more by as much.
  const RockProperties &rock = the_case.rock.main();
  const LinearStiffness<2> stiffness(rock);
  const double eta = rock.biot_coefficient * stiffness.shear_modulus() /
                     (stiffness.bulk_modulus() + stiffness.shear_modulus());
  // At early times each side of a strip of width w loses in proportion to w/sqrt(pi c t) + 1 (Aoki
  // et al. 1987, of ions): the 1 is what flows around its edges.
  const double tips =
    std::sqrt(numbers::PI * pressure_diffusivity(the_case) * pumping.duration) / (4. * length);
  const double more = (1. + tips) / (1. - eta);
  return {least, 1. - analytical::leaking_kgd(
                        fracture, {leak_off.at_closure * more, leak_off.per_net_pressure * more},
                        pumping.duration)
                        .efficiency};
}


std::string in_words(const LeakedShare &share)
{
  const auto per_cent = [](const double part)
  {
    std::ostringstream text;
    text << std::setprecision(part < 0.995 ? 2 : 3) << 100. * part << " %";
    return text.str();
  };
  if (share.most - share.least < 0.01)
    return "about " + per_cent(share.least);
  return per_cent(share.least) + " (flow in one dimension) to " + per_cent(share.most) +
         " (around the tips too, and with the stress of the swollen rock)";
}


analytical::KgdParameters plane_fracture(const Case<2> &the_case, const Pumping &pumping)
{
  return driven_fracture(the_case, pumping);
}


analytical::KgdParameters radial_fracture(const Case<3> &the_case, const Pumping &pumping)
{
  return driven_fracture(the_case, pumping);
}


template <int dim>
double pressure_diffusivity(const Case<dim> &the_case, const types::material_id region)
{
  const RockProperties &rock = the_case.rock(region);
  return rock.permeability / (the_case.rock.fluid().viscosity * storage_coefficient(rock));
}


template <int dim>
double half_length(const Case<dim> &the_case, const InitialCrack<dim> &crack)
{
  const bool is_half =
    std::any_of(crack.points.begin(), crack.points.end(),
                [&](const Point<dim> &point) { return the_case.geometry.on_side(point); });
  return (is_half ? 1. : 0.5) * crack.size();
}


template <int dim>
double half_length_at_start(const Case<dim> &the_case)
{
  return half_length(the_case, the_case.scene.cracks[0]);
}


template <int dim>
bool begins_on_an_edge(const Case<dim> &the_case)
{
  if (the_case.scene.cracks.empty())
    return false;
  const std::vector<std::array<std::string, 2>> names =
    dim == 2 ? std::vector<std::array<std::string, 2>>{{{"left", "right"}}, {{"bottom", "top"}}}
             : std::vector<std::array<std::string, 2>>{
                 {{"left", "right"}}, {{"front", "back"}}, {{"bottom", "top"}}};
  const InitialCrack<dim> &crack = the_case.scene.cracks[0];
  const std::vector<Point<dim>> mouths =
    crack.disc ? std::vector<Point<dim>>{crack.disc->centre}
               : std::vector<Point<dim>>{crack.points.front(), crack.points.back()};
  const Point<dim> lower = the_case.geometry.lower(), upper = the_case.geometry.upper();
  const double small = 1e-8 * lower.distance(upper);
  const std::vector<std::string> there = the_case.geometry.side_names();
  for (const Point<dim> &mouth : mouths)
    for (unsigned int d = 0; d < dim; ++d)
      for (const unsigned int high : {0u, 1u})
        if (std::abs(mouth[d] - (high ? upper[d] : lower[d])) < small &&
            std::find(there.begin(), there.end(), names[d][high]) != there.end() &&
            !the_case.boundary_conditions.is_plane_of_symmetry(
              the_case.geometry.side(names[d][high]), d))
          return true;
  return false;
}


template <int dim>
bool is_driven_on(const Case<dim> &the_case)
{
  return !the_case.scene.cracks.empty() && the_case.model->requirements().may_grow &&
         the_case.rock.main().energy_release_rate > 0. && first_pumping(the_case).rate > 0.;
}


template <int dim>
double half_length_at_end(const Case<dim> &the_case)
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (the_case.scene.cracks.empty())
    return unknown;
  const double start = half_length_at_start(the_case);
  if (!the_case.network.has_wells() || !the_case.model->requirements().may_grow)
    return start;
  if (!is_driven_on(the_case))
    return unknown;
  const Pumping pumping = first_pumping(the_case);
  if constexpr (dim == 2)
    return std::max(start, analytical::leaking_kgd(plane_fracture(the_case, pumping),
                                                   leak_off_coefficient(the_case), pumping.duration)
                             .half_length);
  else if (the_case.network.leak_off_law() == LeakOff::none)
    return std::max(
      start, analytical::radial_radius(radial_fracture(the_case, pumping), pumping.duration));
  else
    return unknown;
}


template <int dim>
double effect_of_walls(const double distance, const double half_length)
{
  return 1.5 * std::pow(half_length / distance, dim);
}


template <int dim>
double effect_of_walls(const Case<dim> &the_case)
{
  const double reach = half_length_at_end(the_case);
  return std::isnan(reach) ? 0. : effect_of_walls<dim>(distance_to_walls(the_case), reach);
}


template double duration_of<2>(const Case<2> &);
template double duration_of<3>(const Case<3> &);
template bool is_cracked<2>(const Case<2> &);
template bool is_cracked<3>(const Case<3> &);
template CostlyPhysics costly_physics<2>(const Case<2> &);
template CostlyPhysics costly_physics<3>(const Case<3> &);
template double smallest_extent<2>(const Case<2> &);
template double smallest_extent<3>(const Case<3> &);
template double distance_to_walls<2>(const Case<2> &);
template double distance_to_walls<3>(const Case<3> &);
template Pumping first_pumping<2>(const Case<2> &);
template Pumping first_pumping<3>(const Case<3> &);
template double pressure_diffusivity<2>(const Case<2> &, types::material_id);
template double pressure_diffusivity<3>(const Case<3> &, types::material_id);
template bool wells_are_constant<2>(const Case<2> &);
template bool wells_are_constant<3>(const Case<3> &);
template double half_length<2>(const Case<2> &, const InitialCrack<2> &);
template double half_length<3>(const Case<3> &, const InitialCrack<3> &);
template double half_length_at_start<2>(const Case<2> &);
template double half_length_at_start<3>(const Case<3> &);
template bool begins_on_an_edge<2>(const Case<2> &);
template bool begins_on_an_edge<3>(const Case<3> &);
template bool is_driven_on<2>(const Case<2> &);
template bool is_driven_on<3>(const Case<3> &);
template double effect_of_walls<2>(double, double);
template double effect_of_walls<3>(double, double);
template double effect_of_walls<2>(const Case<2> &);
template double effect_of_walls<3>(const Case<3> &);
template double half_length_at_end<2>(const Case<2> &);
template double half_length_at_end<3>(const Case<3> &);
} // namespace stockwork
