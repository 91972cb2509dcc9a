#include "verification/analytical/pkn.h"
#include "verification/analytical/constants.h"

#include <algorithm>
#include <cmath>

namespace stockwork::analytical
{
namespace
{
constexpr int n_steps = 400;

// With s = 1 - theta the similarity equation (W^3 W')' = W/5 - (4/5) theta W' is regular at the tip
// in y = W^3 and j, the mean velocity W^2 |W'|: y_s = 3 j, j_s = 1/5 + j (4/5 theta - j)/y.
double acceleration(const double s, const double y, const double j)
{
  if (s <= 0.)
    return -0.05; // the limit: y = 12/5 s, j = 4/5 - s/20
  return 0.2 + j * (0.8 * (1. - s) - j) / y;
}
} // namespace


Pkn::Pkn(const PknParameters &parameters)
  : parameters(parameters)
  , modulus(parameters.youngs_modulus / (1. - parameters.poisson_ratio * parameters.poisson_ratio))
{
  // Runge and Kutta's method from the tip to the inlet.
  const double h = 1. / n_steps;
  double y = 0., j = 0.8;
  for (int i = 0; i <= n_steps; ++i)
  {
    cube.push_back(y);
    slope.push_back(3. * j);
    const double s = i * h;
    const double a1 = acceleration(s, y, j);
    const double j2 = j + 0.5 * h * a1;
    const double a2 = acceleration(s + 0.5 * h, y + 1.5 * h * j, j2);
    const double j3 = j + 0.5 * h * a2;
    const double a3 = acceleration(s + 0.5 * h, y + 1.5 * h * j2, j3);
    const double j4 = j + h * a3;
    const double a4 = acceleration(s + h, y + 3. * h * j3, j4);
    y += 0.5 * h * (j + 2. * j2 + 2. * j3 + j4);
    j += h / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
  }

  // The volume, the integral of W, is what flows in: W^3 |W'| = W j at the inlet.
  const double volume = std::cbrt(cube.back()) * slope.back() / 3.;
  const double diffusion = modulus / (32. * parameters.viscosity * parameters.height);
  length_factor =
    std::pow(4. * parameters.rate * std::cbrt(diffusion) / (pi * parameters.height * volume), 0.6);
  opening_factor = std::cbrt(length_factor * length_factor / diffusion);
}


double Pkn::similarity(const double theta) const
{
  if (theta >= 1.)
    return 0.;
  const double place = (1. - std::max(theta, 0.)) * n_steps;
  const int i = std::min(static_cast<int>(place), n_steps - 1);
  const double a = place - i, b = 1. - a, h = 1. / n_steps;
  return std::cbrt(cube[i] * b * b * (1. + 2. * a) + cube[i + 1] * a * a * (1. + 2. * b) +
                   h * a * b * (slope[i] * b - slope[i + 1] * a));
}


double Pkn::length(const double t) const
{
  return length_factor * std::pow(t, 0.8);
}


double Pkn::opening(const double x, const double t) const
{
  return opening_factor * std::pow(t, 0.2) * similarity(std::abs(x) / length(t));
}


double Pkn::inlet_opening(const double t) const
{
  return opening(0., t);
}


double Pkn::pressure(const double x, const double t) const
{
  return modulus * opening(x, t) / (2. * parameters.height);
}


double Pkn::inlet_pressure(const double t) const
{
  return pressure(0., t);
}


double Pkn::volume(const double t) const
{
  return parameters.rate * t;
}
} // namespace stockwork::analytical
