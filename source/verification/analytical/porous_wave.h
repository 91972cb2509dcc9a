#pragma once

#include <complex>
#include <vector>

namespace stockwork::analytical
{
/// A saturated column with the inertia of the mixture (the u-p form), z = 0 at the drained, loaded
/// top and z = length at the fixed, impermeable base:
///   rho u_tt = N u_zz - alpha p_z,   alpha u_zt + p_t/M = (k/mu) p_zz,
/// under the pressure load (1 - exp(-s)(1 + s + s^2/2)), s = t/rise_time, on its top.
struct PorousWaveParameters
{
  double modulus;              ///< N: E of a rod or lambda + 2 G in uniaxial strain, Pa
  double density;              ///< of the mixture, kg/m^3
  double biot_coefficient;     ///< alpha
  double inverse_biot_modulus; ///< 1/M, 1/Pa, positive
  double mobility;             ///< k/mu, m^2/(Pa s)
  double length;               ///< m
  double load;                 ///< Pa, compression positive
  double rise_time;            ///< s, positive
};


/// The fields at one time, a Fourier series with a few thousand terms (up to 1 ms per value).
class PorousWaveAtTime
{
public:
  /// Towards the base positive, m.
  double displacement(double z) const;

  /// Excess pore pressure, compression positive, Pa.
  double pressure(double z) const;

private:
  friend class PorousWave;

  using Complex = std::complex<double>;

  // One frequency: u = sum A_i sinh(q_i y)/cosh(q_i L), p = sum B_i cosh(q_i y)/cosh(q_i L) with
  // y = L - z, the weight of the inversion included in A and B.
  struct Term
  {
    Complex wave_number[2], displacement[2], pressure[2];
  };

  double length = 0.;
  std::vector<Term> terms;
};


/// Laplace transform in time, inverted by a Fourier series (Durbin 1974); exact to 1e-8 of the
/// largest value while t is less than some 100 rise times.
class PorousWave
{
public:
  explicit PorousWave(const PorousWaveParameters &);

  PorousWaveAtTime at(double t) const;

private:
  PorousWaveParameters parameters;
};
} // namespace stockwork::analytical
