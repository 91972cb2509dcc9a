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


BlockRock block_rock(const PoroelasticMedium &medium)
{
  const double c_xx = medium.uniaxial_modulus();
  return {c_xx,
          c_xx - 2. * medium.shear_modulus(),
          c_xx,
          medium.biot_coefficient,
          medium.inverse_biot_modulus,
          medium.permeability / medium.viscosity};
}


Mandel::Mandel(const MandelParameters &parameters)
  : parameters(parameters)
{
  const BlockRock &rock = parameters.rock;
  const double coupled = rock.coupling() * rock.coupling(),
               separate = rock.storage() * rock.stiffness();
  if (coupled <= undrained_limit * separate) // no Biot coupling: nothing happens after the load
    return;

  ratio = 1. + separate / coupled;
  roots.reserve(n_mandel_roots);
  for (int i = 0; i < n_mandel_roots; ++i)
  {
    // f has one root between i pi and (i + 1/2) pi; for i = 0 it is away from the trivial
    // root x = 0 because ratio > 1.
    const auto f = [this](const double x) { return std::sin(x) - ratio * x * std::cos(x); };
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
  const BlockRock &rock = parameters.rock;
  const double a = parameters.half_width, mean_stress = -parameters.force / a,
               p_0 = undrained_pressure();
  const double time = diffusivity() * t / (a * a);

  MandelAtTime now;
  const auto set_strain = [&](const double uniform_pressure)
  {
    now.strain_x =
      (rock.biot_coefficient * uniform_pressure - rock.c_xy * now.strain_y) / rock.c_xx;
  };
  now.uniform_stress = mean_stress;
  if (time <= 0. || roots.empty())
  {
    now.uniform_pressure = p_0;
    now.strain_y = (mean_stress + rock.coupling() * p_0) / rock.stiffness();
    set_strain(p_0);
    return now;
  }

  // p = 2 p_0 sum sin (cos(k x) - cos) exp(...)/(alpha - sin cos), and sin = ratio alpha cos.
  now.pressure_scale = 2. * p_0;
  now.displacement_scale = 2. * p_0 * rock.biot_coefficient / rock.c_xx * ratio * a;
  now.stress_scale = -2. * p_0 * rock.coupling();

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
  now.strain_y = (mean_stress + 2. * p_0 * rock.coupling() * (ratio - 1.) * sum) / rock.stiffness();
  set_strain(-2. * p_0 * sum);
  now.uniform_stress *= 1. - 2. * sum;
  return now;
}


double Mandel::undrained_pressure() const
{
  const BlockRock &rock = parameters.rock;
  const double coupling = rock.coupling();
  return parameters.force / parameters.half_width * coupling /
         (rock.storage() * rock.stiffness() + coupling * coupling);
}


double Mandel::diffusivity() const
{
  return parameters.rock.mobility / parameters.rock.storage();
}
} // namespace stockwork::analytical
