#include "verification/analytical/kgd.h"

#include "verification/analytical/constants.h"
#include "verification/analytical/fracture_front.h"

#include <boost/math/interpolators/cardinal_quintic_b_spline.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stockwork::analytical
{
namespace
{
constexpr double step = 0.2;

// Below this toughness the solution has not changed to 2e-7 and its tip layer only costs points.
constexpr double minimum_kgd_toughness = 0.02;

// The tip layer in which toughness governs, 1 - xi < O(K_m^6), must be resolved.
double depth_of_kgd_grid(const double toughness)
{
  return toughness < 0.3 ? 50. : 36.;
}

std::vector<double> logarithm_of_shape(const HalfCrackGrid &grid, const FractureFront &front)
{
  std::vector<double> values(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i)
    values[i] = std::log(front.omega[i] / grid.root()[i]);
  return values;
}
} // namespace


struct KgdSimilarity::Profiles
{
  Profiles(const HalfCrackGrid &grid, const FractureFront &front, const double toughness)
    : grid(grid)
    , gamma(front.gamma)
    , log_shape(logarithm_of_shape(grid, front), grid.first_parameter(), grid.step())
    , pressure(front.pressure(grid, toughness), grid.first_parameter(), grid.step())
  {
  }

  using Spline = boost::math::interpolators::cardinal_quintic_b_spline<double>;

  HalfCrackGrid grid;
  double gamma;
  Spline log_shape; // ln(omega / sqrt(1 - xi^2))
  Spline pressure;
};


KgdSimilarity::KgdSimilarity(const double dimensionless_toughness)
{
  const double toughness = std::max(dimensionless_toughness, minimum_kgd_toughness);
  const HalfCrackGrid grid(CrackShape::line, step, depth_of_kgd_grid(toughness));
  FractureFront front = estimate_front(grid, toughness);
  solve_front(grid, toughness, FrontMemory(), front);
  profiles = std::make_unique<Profiles>(grid, front, toughness);
}


KgdSimilarity::~KgdSimilarity() = default;
KgdSimilarity::KgdSimilarity(KgdSimilarity &&) noexcept = default;
KgdSimilarity &KgdSimilarity::operator=(KgdSimilarity &&) noexcept = default;


double KgdSimilarity::gamma() const
{
  return profiles->gamma;
}


double KgdSimilarity::Omega(const double xi) const
{
  if (xi >= 1.)
    return 0.;
  return profiles->gamma * std::exp(profiles->log_shape(profiles->grid.parameter(xi))) *
         std::sqrt((1. - xi) * (1. + xi));
}


double KgdSimilarity::Pi(const double xi) const
{
  return profiles->pressure(profiles->grid.parameter(xi));
}


double KgdParameters::plane_strain_modulus() const
{
  return youngs_modulus / (1. - poisson_ratio * poisson_ratio);
}


double KgdParameters::dimensionless_toughness() const
{
  return 4. * std::sqrt(2. / pi) * toughness /
         std::pow(std::pow(plane_strain_modulus(), 3) * 12. * viscosity * rate, 0.25);
}


Kgd::Kgd(const KgdParameters &parameters)
  : parameters(parameters)
  , modulus(parameters.plane_strain_modulus())
  , profiles(parameters.dimensionless_toughness())
{
}


double Kgd::length_scale(const double t) const
{
  return std::pow(modulus * std::pow(parameters.rate, 3) * std::pow(t, 4) /
                    (12. * parameters.viscosity),
                  1. / 6.);
}


double Kgd::small_number(const double t) const
{
  return std::cbrt(12. * parameters.viscosity / (modulus * t));
}


double Kgd::half_length(const double t) const
{
  return profiles.gamma() * length_scale(t);
}


double Kgd::tip_speed(const double t) const
{
  return 2. / 3. * half_length(t) / t;
}


double Kgd::inlet_opening(const double t) const
{
  return opening(0., t);
}


double Kgd::inlet_pressure(const double t) const
{
  return pressure(0., t);
}


double Kgd::opening(const double x, const double t) const
{
  return small_number(t) * length_scale(t) * profiles.Omega(std::abs(x) / half_length(t));
}


double Kgd::pressure(const double x, const double t) const
{
  return small_number(t) * modulus * profiles.Pi(std::abs(x) / half_length(t));
}


double Kgd::volume(const double t) const
{
  return parameters.rate * t;
}


KgdToughnessVertex::KgdToughnessVertex(const KgdParameters &parameters)
  : parameters(parameters)
  , modulus(parameters.plane_strain_modulus())
{
}


double KgdToughnessVertex::half_length(const double t) const
{
  return std::pow(modulus * parameters.rate * t / (2. * std::sqrt(pi) * parameters.toughness),
                  2. / 3.);
}


double KgdToughnessVertex::pressure(const double t) const
{
  return parameters.toughness / std::sqrt(pi * half_length(t));
}


double KgdToughnessVertex::opening(const double x, const double t) const
{
  const double l = half_length(t);
  return 4. * pressure(t) / modulus * std::sqrt(std::max(0., (l - x) * (l + x)));
}


double KgdToughnessVertex::inlet_opening(const double t) const
{
  return opening(0., t);
}
} // namespace stockwork::analytical
