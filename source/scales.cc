#include "scales.h"

#include "stockwork/base/quantity.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Of the first crack's opening at its middle. The aperture that flow sees where a fracture is
/// closed must be small beside the one near its tip; at a hundredth of the middle's, the point with
/// this aperture is within 1e-4 of the length from an elastic tip.
constexpr double share_of_aperture = 0.01;

/// Of the plane modulus, where nothing in the scene is a pressure.
constexpr double minimum_strain = 1e-4;


template <int dim>
double half_length(const InitialCrack<dim> &crack)
{
  return 0.5 * crack.size();
}


/// The pressure that drives a viscous fluid into a fracture of this length [Pa].
double
viscous_pressure(const unsigned int dim, const double a, const double E, const double mu, double Q)
{
  // The time at which a fracture has this length without toughness, but for a factor near one.
  const double time = std::pow(std::pow(a, dim == 2 ? 6. : 9.) * 12. * mu / (E * Q * Q * Q), 0.25);
  return E * std::cbrt(12. * mu / (E * time));
}


template <int dim>
double maximum_traction(const BoundaryConditions<dim> &boundary_conditions)
{
  double greatest = 0.;
  const auto look = [&greatest](const PrescribedValue<dim> &load)
  {
    if (load.value && load.constant_in_time)
      greatest = std::max(greatest, std::abs(load.value(Point<dim>(), 0.)));
  };
  for (const auto &[side, load] : boundary_conditions.loads().normal_traction)
    look(load);
  for (const auto &[side, components] : boundary_conditions.loads().traction)
    for (const auto &load : components)
      look(load);
  return greatest;
}
} // namespace


namespace
{
/// Compression across a crack, or across the middle one of its pieces, and shear along it.
struct PlaneStress
{
  double closing, shear;
};

template <int dim>
PlaneStress on_plane(const Scene<dim> &scene, const Point<dim> &place, const Tensor<1, dim> &normal)
{
  const Tensor<1, dim> traction = scene.in_situ_stress(place) * normal;
  return {-(traction * normal), (traction - (traction * normal) * normal).norm()};
}

PlaneStress on_crack(const Scene<2> &scene, const InitialCrack<2> &crack)
{
  const unsigned int middle = crack.points.size() / 2;
  const Tensor<1, 2> along = crack.points[middle] - crack.points[middle - 1];
  const Tensor<1, 2> normal = Point<2>(-along[1], along[0]) / along.norm();
  return on_plane<2>(scene, crack.points[middle - 1] + 0.5 * along, normal);
}

PlaneStress on_crack(const Scene<3> &scene, const InitialCrack<3> &crack)
{
  return on_plane<3>(scene, crack.disc->centre, crack.disc->normal);
}
} // namespace


double closing_stress(const Scene<2> &scene, const InitialCrack<2> &crack)
{
  return on_crack(scene, crack).closing;
}

double closing_stress(const Scene<3> &scene, const InitialCrack<3> &crack)
{
  return on_crack(scene, crack).closing;
}

double shear_stress(const Scene<2> &scene, const InitialCrack<2> &crack)
{
  return on_crack(scene, crack).shear;
}

double shear_stress(const Scene<3> &scene, const InitialCrack<3> &crack)
{
  return on_crack(scene, crack).shear;
}


template <int dim>
Scales scales_of(const Scene<dim> &scene,
                 const Network<dim> &network,
                 const BoundaryConditions<dim> &boundary_conditions)
{
  const RockProperties &rock = scene.rock.main();
  const double modulus = rock.plane_modulus(), viscosity = scene.rock.fluid().viscosity;
  const bool cracked = !scene.cracks.empty();
  const double a = cracked ? half_length(scene.cracks[0]) : scene.domain_size;
  const double closing = cracked ? closing_stress(scene, scene.cracks[0]) : 0.;

  Scales scales{a, 0., "", 0.};
  const auto consider = [&scales](const double pressure, const std::string &source)
  {
    if (pressure > scales.pressure)
    {
      scales.pressure = pressure;
      scales.source = source;
    }
  };
  if (rock.energy_release_rate > 0.)
    consider(rock.toughness() / std::sqrt(numbers::PI * a), "toughness");
  if (const double rate = network.maximum_rate(); rate > 0. && std::isfinite(viscosity))
    consider(viscous_pressure(dim, a, modulus, viscosity, rate), "viscosity and rate");
  if (const auto pressure = network.maximum_pressure())
    consider(std::abs(*pressure - closing), "pressure of a well");
  if (scene.crack_pressure - closing != 0.) // not NaN either
    consider(std::abs(scene.crack_pressure - closing), "pressure in the cracks");
  consider(maximum_traction(boundary_conditions), "load on the boundary");
  if (scales.pressure == 0.)
    consider(std::abs(closing), "in-situ stress across the crack");
  if (scales.pressure == 0.)
    consider(minimum_strain * modulus, "the rock's modulus");
  scales.aperture = 4. * scales.pressure * a / modulus;
  return scales;
}


std::vector<ChosenValue> fill_in_flow(ParameterHandler &prm, const Scales &scales)
{
  std::vector<ChosenValue> chosen;
  prm.enter_subsection("Fracture flow");
  if (prm.get("Minimum aperture").empty())
  {
    const double aperture = share_of_aperture * scales.aperture;
    std::ostringstream all_digits;
    all_digits.precision(16);
    all_digits << aperture << " m";
    prm.set("Minimum aperture", all_digits.str());
    chosen.push_back({"Fracture flow/Minimum aperture", to_string(aperture, dimension::length),
                      "a hundredth of what " + to_string(scales.pressure, dimension::pressure) +
                        " (" + scales.source + ") open a crack of half length " +
                        to_string(scales.length, dimension::length) + " by"});
  }
  prm.leave_subsection();
  prm.enter_subsection("Nonlinear solver");
  if (prm.get("Maximum pressure change").empty())
    chosen.push_back(
      {"Nonlinear solver/Maximum pressure change", to_string(scales.pressure, dimension::pressure),
       "the net pressure (" + scales.source + "), more while pressures change by more"});
  prm.leave_subsection();
  return chosen;
}


template Scales scales_of(const Scene<2> &, const Network<2> &, const BoundaryConditions<2> &);
template Scales scales_of(const Scene<3> &, const Network<3> &, const BoundaryConditions<3> &);
} // namespace stockwork
