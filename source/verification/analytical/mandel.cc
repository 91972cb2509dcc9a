#include "verification/analytical/mandel.h"
#include "verification/analytical/constants.h"

#include <boost/math/tools/roots.hpp>

#include <cmath>

namespace stockwork::analytical
{
namespace
{
constexpr int n_mandel_roots = 2000;
constexpr double negligible_exponent = 40.; // exp(-40) = 4e-18
constexpr double undrained_limit = 1e-12;
} // namespace


double MandelAtTime::pressure(const double x) const
{
  double sum = 0.;
  for (const Term &term : terms)
    sum += term.even * (std::cos(term.wave_number * x) - term.cosine);
  return uniform_pressure + pressure_scale * sum;
}


double MandelAtTime::displacement_x(const double x) const
{
  double sum = 0.;
  for (const Term &term : terms)
    sum += term.odd * std::sin(term.wave_number * x);
  return strain_x * x + displacement_scale * sum;
}


double MandelAtTime::displacement_y(const double y) const
{
  return strain_y * y;
}


double MandelAtTime::stress_yy(const double x) const
{
  double sum = 0.;
  for (const Term &term : terms)
    sum += term.even * std::cos(term.wave_number * x);
  return uniform_stress + stress_scale * sum;
}


Mandel::Mandel(const MandelParameters &parameters)
  : parameters(parameters)
{
  const double nu = parameters.medium.poisson_ratio;
  const double nu_u = parameters.medium.undrained_poisson_ratio();
  if (nu_u - nu < undrained_limit) // no Biot coupling: nothing happens after the load
    return;

  const double ratio = (1. - nu) / (nu_u - nu);
  roots.reserve(n_mandel_roots);
  for (int i = 0; i < n_mandel_roots; ++i)
  {
    // f has one root between i pi and (i + 1/2) pi; for i = 0 it is away from the trivial
    // root x = 0 because ratio > 1.
    const auto f = [ratio](const double x) { return std::sin(x) - ratio * x * std::cos(x); };
    const double lower = i == 0 ? 1e-6 : i * pi;
    const double upper = (i + 0.5) * pi;
    std::uintmax_t iterations = 100;
    const auto bracket = boost::math::tools::toms748_solve(
      f, lower, upper, boost::math::tools::eps_tolerance<double>(51), iterations);
    roots.push_back(0.5 * (bracket.first + bracket.second));
  }
}


MandelAtTime Mandel::at(const double t) const
{
  const PoroelasticMedium &medium = parameters.medium;
  const double a = parameters.half_width;
  const double force = parameters.force;
  const double shear = medium.shear_modulus();
  const double nu = medium.poisson_ratio;
  const double nu_u = medium.undrained_poisson_ratio();
  const double time = medium.diffusivity() * t / (a * a);

  MandelAtTime now;
  now.uniform_stress = -force / a;
  if (time <= 0. || roots.empty())
  {
    now.uniform_pressure = undrained_pressure();
    now.strain_x = force * nu_u / (2. * shear * a);
    now.strain_y = -force * (1. - nu_u) / (2. * shear * a);
    return now;
  }

  now.pressure_scale = 2. * undrained_pressure();
  now.displacement_scale = force / shear;
  now.stress_scale = -2. * force * (nu_u - nu) / (a * (1. - nu));

  double sum = 0.;
  for (const double root : roots)
  {
    const double decay = root * root * time;
    if (decay > negligible_exponent)
      break;
    const double sine = std::sin(root);
    const double cosine = std::cos(root);
    const double factor = std::exp(-decay) / (root - sine * cosine);
    now.terms.push_back({root / a, cosine, factor * sine, factor * cosine});
    sum += factor * sine * cosine;
  }
  now.strain_x = force / (shear * a) * (0.5 * nu - nu_u * sum);
  now.strain_y = force / (shear * a) * (-0.5 * (1. - nu) + (1. - nu_u) * sum);
  now.uniform_stress += 2. * force / a * sum;
  return now;
}


double Mandel::undrained_pressure() const
{
  return parameters.force * parameters.medium.skempton_coefficient() *
         (1. + parameters.medium.undrained_poisson_ratio()) / (3. * parameters.half_width);
}


double Mandel::diffusivity() const
{
  return parameters.medium.diffusivity();
}
} // namespace stockwork::analytical
