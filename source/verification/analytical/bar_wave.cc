#include "verification/analytical/bar_wave.h"
#include "verification/analytical/constants.h"

#include <cmath>

namespace stockwork::analytical
{
namespace
{
}


BarWave::BarWave(const BarWaveParameters &parameters)
  : parameters(parameters)
{
}


double BarWave::wave_speed() const
{
  return std::sqrt(parameters.modulus / parameters.density);
}


double BarWave::history(const double t) const
{
  if (t < 0.)
    return 0.;
  if (t >= parameters.ramp_time)
    return 1.;
  return std::pow(std::sin(0.5 * pi * t / parameters.ramp_time), 2);
}


double BarWave::impulse(const double t) const
{
  const double T = parameters.ramp_time;
  if (t <= 0.)
    return 0.;
  if (t >= T)
    return t - 0.5 * T;
  return 0.5 * t - 0.5 * T / pi * std::sin(pi * t / T);
}


// A wave is reversed at the fixed base and keeps its sign at the free top.
template <typename Signal>
double
BarWave::arrivals(const double z, const double t, const double sign, const Signal &signal) const
{
  const double L = parameters.length, c = wave_speed();
  double sum = 0.;
  for (int n = 0; 2. * n * L + z <= c * t; ++n)
    sum += (n % 2 == 0 ? 1. : -1.) *
           (signal(t - (2. * n * L + z) / c) + sign * signal(t - (2. * (n + 1) * L - z) / c));
  return sum;
}


double BarWave::displacement(const double z, const double t) const
{
  return parameters.load / (parameters.density * wave_speed()) *
         arrivals(z, t, -1., [this](const double s) { return impulse(s); });
}


double BarWave::velocity(const double z, const double t) const
{
  return parameters.load / (parameters.density * wave_speed()) *
         arrivals(z, t, -1., [this](const double s) { return history(s); });
}


double BarWave::stress(const double z, const double t) const
{
  return -parameters.load * arrivals(z, t, 1., [this](const double s) { return history(s); });
}
} // namespace stockwork::analytical
