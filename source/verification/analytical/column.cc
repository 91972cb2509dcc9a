#include "verification/analytical/column.h"
#include "verification/analytical/constants.h"

#include <cmath>

namespace stockwork::analytical
{
namespace
{
// Below this dimensionless time the sum over images converges in four terms, above it the
// Fourier series in seven, both to machine accuracy.
constexpr double early = 0.1;
constexpr int n_images = 4;
constexpr int n_terms = 8;

// Integral of erfc from x to infinity.
double ierfc(const double x)
{
  return std::exp(-x * x) / std::sqrt(pi) - x * std::erfc(x);
}
} // namespace


Column::Column(const ColumnParameters &parameters)
  : length(parameters.length)
  , load(parameters.load)
  , biot_coefficient(parameters.medium.biot_coefficient)
  , compressibility(parameters.kind == ColumnParameters::Kind::rod
                      ? 1. / parameters.medium.youngs_modulus
                      : 1. / parameters.medium.uniaxial_modulus())
{
  const double storage =
    parameters.medium.inverse_biot_modulus + biot_coefficient * biot_coefficient * compressibility;
  p0 = storage > 0. ? biot_coefficient * compressibility * load / storage : 0.;
  c = storage > 0. ? parameters.medium.permeability / (parameters.medium.viscosity * storage) : 0.;
}


// p/p0 at z/L and c t/L^2.
double Column::dimensionless_pressure(const double depth, const double time) const
{
  if (time <= 0.)
    return depth > 0. ? 1. : 0.;

  double sum = 0.;
  if (time < early)
  {
    const double scale = 0.5 / std::sqrt(time);
    for (int n = 0; n < n_images; ++n)
      sum += (n % 2 == 0 ? 1. : -1.) *
             (std::erfc((2. * n + depth) * scale) + std::erfc((2. * (n + 1) - depth) * scale));
    return 1. - sum;
  }
  for (int m = 0; m < n_terms; ++m)
  {
    const double k = (m + 0.5) * pi;
    sum += 2. / k * std::sin(k * depth) * std::exp(-k * k * time);
  }
  return sum;
}


// Integral of p/p0 from z/L to 1.
double Column::dimensionless_pressure_below(const double depth, const double time) const
{
  if (time <= 0.)
    return 1. - depth;

  double sum = 0.;
  if (time < early)
  {
    const double width = 2. * std::sqrt(time);
    for (int n = 0; n < n_images; ++n)
      sum += (n % 2 == 0 ? 1. : -1.) *
             (ierfc((2. * n + depth) / width) - ierfc((2. * (n + 1) - depth) / width));
    return 1. - depth - width * sum;
  }
  for (int m = 0; m < n_terms; ++m)
  {
    const double k = (m + 0.5) * pi;
    sum += 2. / (k * k) * std::cos(k * depth) * std::exp(-k * k * time);
  }
  return sum;
}


double Column::pressure(const double z, const double t) const
{
  return p0 * dimensionless_pressure(z / length, c * t / (length * length));
}


double Column::displacement(const double z, const double t) const
{
  return compressibility * (load * (length - z) -
                            biot_coefficient * p0 * length *
                              dimensionless_pressure_below(z / length, c * t / (length * length)));
}


double Column::base_pressure(const double t) const
{
  return pressure(length, t);
}


double Column::top_displacement(const double t) const
{
  return displacement(0., t);
}


double Column::undrained_pressure() const
{
  return p0;
}


double Column::undrained_top_displacement() const
{
  return compressibility * (load - biot_coefficient * p0) * length;
}


double Column::drained_top_displacement() const
{
  return compressibility * load * length;
}


double Column::diffusivity() const
{
  return c;
}
} // namespace stockwork::analytical
