#include "verification/analytical/porous_wave.h"
#include "verification/analytical/constants.h"

#include <cmath>

namespace stockwork::analytical
{
namespace
{
using Complex = std::complex<double>;

constexpr double damping = 25.;           // exp(-25) is the error by periodic continuation
constexpr double highest_frequency = 200; // times the rise time: the load has fallen to 1e-7

// sinh(q y)/cosh(q L) and cosh(q y)/cosh(q L) for Re q > 0 without overflow.
Complex ratio(const Complex q, const double y, const double length, const double sign)
{
  return (std::exp(q * (y - length)) + sign * std::exp(-q * (y + length))) /
         (1. + std::exp(-2. * q * length));
}
} // namespace


double PorousWaveAtTime::displacement(const double z) const
{
  double sum = 0.;
  for (const Term &term : terms)
    for (int i = 0; i < 2; ++i)
      sum += (term.displacement[i] * ratio(term.wave_number[i], length - z, length, -1.)).real();
  return sum;
}


double PorousWaveAtTime::pressure(const double z) const
{
  double sum = 0.;
  for (const Term &term : terms)
    for (int i = 0; i < 2; ++i)
      sum += (term.pressure[i] * ratio(term.wave_number[i], length - z, length, 1.)).real();
  return sum;
}


PorousWave::PorousWave(const PorousWaveParameters &parameters)
  : parameters(parameters)
{
}


PorousWaveAtTime PorousWave::at(const double t) const
{
  PorousWaveAtTime now;
  now.length = parameters.length;
  if (t <= 0.)
    return now;

  const double N = parameters.modulus, alpha = parameters.biot_coefficient;
  const double half_period = 2. * t;
  const double shift = damping / (2. * half_period);
  const int n_terms =
    static_cast<int>(highest_frequency / parameters.rise_time * half_period / pi) + 1;
  for (int k = 0; k < n_terms; ++k)
  {
    const Complex s(shift, k * pi / half_period);
    const Complex load = parameters.load / (s * std::pow(1. + parameters.rise_time * s, 3));
    const Complex weight =
      std::exp(s * t) / half_period * (k == 0 ? 0.5 : 1.); // of the Fourier series

    // (N q^2 - rho s^2)(kappa q^2 - s/M) = alpha^2 s q^2, a quadratic in q^2.
    const Complex inertia = parameters.density * s * s;
    const Complex storage = s * parameters.inverse_biot_modulus;
    const Complex a = N * parameters.mobility;
    const Complex half_b = -0.5 * (N * storage + inertia * parameters.mobility + alpha * alpha * s);
    const Complex c = inertia * storage;
    Complex discriminant = std::sqrt(half_b * half_b - a * c);
    if ((std::conj(half_b) * discriminant).real() > 0.)
      discriminant = -discriminant;
    const Complex squares[2] = {(discriminant - half_b) / a, c / (discriminant - half_b)};

    PorousWaveAtTime::Term term;
    Complex stiffness[2]; // B per A
    for (int i = 0; i < 2; ++i)
    {
      term.wave_number[i] = std::sqrt(squares[i]);
      stiffness[i] = (inertia - N * squares[i]) / (alpha * term.wave_number[i]);
    }
    // At the top p = 0 and N u_z = -load.
    const Complex q0 = term.wave_number[0], q1 = term.wave_number[1];
    const Complex A0 = weight * load * stiffness[1] / (N * (q0 * stiffness[1] - q1 * stiffness[0]));
    const Complex A1 = -A0 * stiffness[0] / stiffness[1];
    term.displacement[0] = A0;
    term.displacement[1] = A1;
    term.pressure[0] = A0 * stiffness[0];
    term.pressure[1] = A1 * stiffness[1];
    now.terms.push_back(term);
  }
  return now;
}
} // namespace stockwork::analytical
