#include "verification/analytical/kgd.h"

#include "verification/analytical/half_crack_grid.h"

#include "stockwork/base/error.h"

#include <boost/math/interpolators/cardinal_quintic_b_spline.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stockwork::analytical
{
namespace
{
constexpr double pi = 3.14159265358979323846;
constexpr double step = 0.2;
constexpr double tolerance = 1e-11;
constexpr int max_iterations = 40;

// Below this toughness the solution has not changed to 2e-7 and its tip layer only costs points.
constexpr double least_toughness = 0.02;

// The tip layer in which toughness governs, 1 - xi < O(K_m^6), must be resolved.
double depth_of_grid(const double toughness)
{
  return toughness < 0.3 ? 50. : 36.;
}

// Values at the points of a HalfCrackGrid.
struct Fields
{
  double gamma = 0.;
  double tip_factor = 0.; // lim omega / sqrt(1 - xi^2)
  std::vector<double> omega;
  std::vector<double> gradient; // -dPi/dxi
};


// With Omega = gamma omega the equations lose gamma:
//   omega^3 Pi' = -(int_xi^1 omega + (2/3) xi omega),  2 gamma^2 int_0^1 omega = 1,
//   omega -> K_m gamma^(-1/2) sqrt(1 - xi) at the tip,
// and Pi follows from omega as the pressure from the opening in a crack with E' = 1.
Fields solve(const HalfCrackGrid &grid, const double toughness)
{
  const std::size_t n = grid.size();
  const std::vector<double> &xi = grid.x();
  const std::vector<double> &root = grid.root();
  const DenseMatrix &H = grid.opening_matrix();

  // Start between the two vertices.
  Fields fields;
  std::vector<double> &omega = fields.omega, &gradient = fields.gradient;
  double &gamma = fields.gamma, &tip_factor = fields.tip_factor;
  omega.resize(n);
  gradient.resize(n);
  const double toughness_vertex =
    std::pow(toughness, 4. / 3.) * std::cbrt(pi / std::sqrt(8.)) / std::sqrt(2.);
  for (std::size_t i = 0; i < n; ++i)
    omega[i] =
      std::cbrt(std::pow(1.83, 3) * std::pow(root[i], 4) + std::pow(toughness_vertex * root[i], 3));

  std::vector<double> outside, volume_by_omega, first(n, 0.), row(n), column(n), correction(n);
  first[0] = 1.;
  grid.transpose_integrate(first.data(), volume_by_omega);
  for (int iteration = 0; iteration < max_iterations; ++iteration)
  {
    grid.integrate_to_tip(omega, outside);
    const double volume = outside[0];
    gamma = 1. / std::sqrt(2. * volume);
    tip_factor = toughness / std::sqrt(2. * gamma);
    for (std::size_t j = 0; j < n; ++j)
      gradient[j] = (outside[j] + 2. / 3. * xi[j] * omega[j]) / std::pow(omega[j], 3);

    // Newton's method for ln(omega), so that the opening stays positive.
    DenseMatrix jacobian(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      double residual = omega[i] - tip_factor * root[i];
      for (std::size_t j = 0; j < n; ++j)
      {
        residual -= H[i][j] * gradient[j];
        row[j] = H[i][j] / std::pow(omega[j], 3);
      }
      grid.transpose_integrate(row.data(), column);
      for (std::size_t j = 0; j < n; ++j)
        jacobian[i][j] = omega[j] / omega[i] *
                         (3. * H[i][j] * gradient[j] / omega[j] - 2. / 3. * xi[j] * row[j] -
                          column[j] - root[i] * tip_factor / (4. * volume) * volume_by_omega[j]);
      jacobian[i][i] += 1.;
      correction[i] = -residual / omega[i];
    }
    solve_in_place(jacobian, correction);

    double largest = 0.;
    for (const double c : correction)
      largest = std::max(largest, std::abs(c));
    const double damping = largest > 1. ? 1. / largest : 1.;
    for (std::size_t i = 0; i < n; ++i)
      omega[i] *= std::exp(damping * correction[i]);
    if (largest < tolerance)
      return fields;
  }
  throw SolveError("The similarity solution of the KGD fracture did not converge for K_m = " +
                   std::to_string(toughness) + ".");
}


std::vector<double> logarithm_of_shape(const HalfCrackGrid &grid, const Fields &fields)
{
  std::vector<double> values(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i)
    values[i] = std::log(fields.omega[i] / grid.root()[i]);
  return values;
}
} // namespace


struct KgdSimilarity::Profiles
{
  Profiles(const HalfCrackGrid &grid, const Fields &fields)
    : grid(grid)
    , gamma(fields.gamma)
    , log_shape(logarithm_of_shape(grid, fields), grid.first_parameter(), grid.step())
    , pressure(
        grid.pressure(fields.tip_factor, fields.gradient), grid.first_parameter(), grid.step())
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
  const double toughness = std::max(dimensionless_toughness, least_toughness);
  const HalfCrackGrid grid(step, depth_of_grid(toughness));
  profiles = std::make_unique<Profiles>(grid, solve(grid, toughness));
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
