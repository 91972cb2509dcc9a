#include "verification/analytical/continuous_source.h"

#include "verification/analytical/constants.h"

#include <boost/math/special_functions/expint.hpp>

#include <cmath>

namespace stockwork::analytical
{
namespace
{
/// E_1(x), zero where it underflows.
double exponential_integral(const double x)
{
  return x > 700. ? 0. : boost::math::expint(1, x);
}
} // namespace


double ContinuousSource::pressure(const double r, const double t) const
{
  if (!(t > 0.))
    return 0.;
  const double resistance = medium.viscosity / (4. * pi * medium.permeability);
  const double reach = std::sqrt(4. * medium.diffusivity() * t);
  return shape == Shape::line ? resistance * exponential_integral(r * r / (reach * reach))
                              : resistance / r * std::erfc(r / reach);
}


double ContinuousSource::displacement(const double r, const double t) const
{
  if (!(t > 0.))
    return 0.;
  const double resistance = medium.viscosity / (4. * pi * medium.permeability);
  const double swelling = medium.biot_coefficient / medium.uniaxial_modulus();
  const double reach = std::sqrt(4. * medium.diffusivity() * t), x = r / reach;
  // The integral of the pressure over the circle or ball within r, by its circumference or surface.
  if (shape == Shape::line)
    return swelling * resistance * 0.5 *
           (r * exponential_integral(x * x) - reach / x * std::expm1(-x * x));
  return swelling * resistance *
         (0.5 * std::erfc(x) - 0.5 / (std::sqrt(pi) * x) * std::exp(-x * x) +
          0.25 / (x * x) * std::erf(x));
}
} // namespace stockwork::analytical
