#include "verification/analytical/cryer.h"
#include "verification/analytical/constants.h"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/tools/roots.hpp>

#include <cmath>

namespace stockwork::analytical
{
namespace
{
using Shape = CryerParameters::Shape;

constexpr int n_roots = 2000;
constexpr double negligible = 40.; // exp(-40) = 4e-18

// phi(y), regular at the centre. POSIX's Bessel functions are many times faster than general ones.
double wave(const Shape shape, const double y)
{
  if (shape == Shape::cylinder)
    return ::j0(y);
  return y < 1e-4 ? 1. - y * y / 6. : std::sin(y) / y;
}


// Mean of phi over the ball or disc of radius y.
double mean_wave(const Shape shape, const double y)
{
  if (y < 1e-3)
    return 1. - y * y / (shape == Shape::cylinder ? 8. : 10.);
  if (shape == Shape::cylinder)
    return 2. * ::j1(y) / y;
  return 3. * (std::sin(y) - y * std::cos(y)) / (y * y * y);
}


// x m'(x) with m = mean_wave/wave.
double mean_slope(const Shape shape, const double x)
{
  const double m = mean_wave(shape, x) / wave(shape, x);
  if (shape == Shape::cylinder)
    return 2. + 0.5 * x * x * m * m - 2. * m;
  const double r = 1. - x * x * m / 3.; // x cot x
  return 3. * (x * x + r * r - r) / (x * x) - 2. * m;
}
} // namespace


double CryerAtTime::pressure(const double r) const
{
  double sum = uniform_pressure;
  for (const Term &term : terms)
    sum += term.amplitude * (wave(shape, term.root * r / radius) * term.reciprocal - 1.);
  return sum;
}


double CryerAtTime::displacement(const double r) const
{
  double sum = 0.;
  for (const Term &term : terms)
    sum += term.amplitude *
           (swelling_offset + mean_wave(shape, term.root * r / radius) * term.reciprocal);
  return r * (uniform_strain + swelling * sum);
}


Cryer::Cryer(const CryerParameters &parameters)
  : parameters(parameters)
{
  const PoroelasticMedium &medium = parameters.medium;
  const double modulus = medium.uniaxial_modulus();
  const double target = 1. + (modulus / restraint() - 1.) * modulus * medium.uniaxial_storage() /
                               (medium.biot_coefficient * medium.biot_coefficient);
  const Shape shape = parameters.shape;
  // m rises from minus to plus infinity between any two zeros of phi, from 1 at the centre.
  const auto f = [shape, target](const double x)
  { return mean_wave(shape, x) - target * wave(shape, x); };
  double lower = 1e-2;
  roots.reserve(n_roots);
  for (int i = 1; i <= n_roots; ++i)
  {
    const double upper = shape == Shape::sphere ? i * pi : boost::math::cyl_bessel_j_zero(0., i);
    std::uintmax_t iterations = 100;
    const auto bracket = boost::math::tools::toms748_solve(
      f, lower, upper, boost::math::tools::eps_tolerance<double>(51), iterations);
    roots.push_back(0.5 * (bracket.first + bracket.second));
    lower = upper;
  }
}


CryerAtTime Cryer::at(const double t) const
{
  const PoroelasticMedium &medium = parameters.medium;
  const double modulus = medium.uniaxial_modulus();
  const double alpha = medium.biot_coefficient;
  const double coupling = alpha * alpha / (modulus * medium.uniaxial_storage());
  const double dimension = parameters.shape == Shape::sphere ? 3. : 2.;
  const double time = medium.diffusivity() * t / (parameters.radius * parameters.radius);

  CryerAtTime now;
  now.shape = parameters.shape;
  now.radius = parameters.radius;
  if (time <= 0.)
  {
    now.uniform_pressure = undrained_pressure();
    now.uniform_strain =
      -now.uniform_pressure * (1. - coupling) * alpha / (coupling * modulus * dimension);
    return now;
  }

  now.uniform_strain = -parameters.load / ((modulus - restraint()) * dimension);
  now.swelling = alpha / (modulus * dimension);
  now.swelling_offset = (1. - coupling) / coupling;
  for (const double root : roots)
  {
    const double decay = root * root * time;
    if (decay > negligible)
      break;
    const double amplitude =
      2. * parameters.load * modulus / (restraint() * alpha * mean_slope(parameters.shape, root));
    now.terms.push_back({root, amplitude * std::exp(-decay), 1. / wave(parameters.shape, root)});
  }
  return now;
}


double Cryer::undrained_pressure() const
{
  const PoroelasticMedium &medium = parameters.medium;
  const double modulus = medium.uniaxial_modulus();
  const double alpha = medium.biot_coefficient;
  const double coupling = alpha * alpha / (modulus * medium.uniaxial_storage());
  return parameters.load * coupling / (alpha * (1. - restraint() * (1. - coupling) / modulus));
}


double Cryer::diffusivity() const
{
  return parameters.medium.diffusivity();
}


double Cryer::restraint() const
{
  return parameters.medium.shear_modulus() * (parameters.shape == Shape::sphere ? 4. / 3. : 1.);
}
} // namespace stockwork::analytical
