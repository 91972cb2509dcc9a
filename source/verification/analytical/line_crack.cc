#include "verification/analytical/line_crack.h"
#include "verification/analytical/constants.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace stockwork::analytical
{
namespace
{
double plane_strain_modulus(const double youngs_modulus, const double poisson_ratio)
{
  return youngs_modulus / (1. - poisson_ratio * poisson_ratio);
}

double half_chord(const double radius, const double s)
{
  return std::sqrt(std::max(0., (radius - s) * (radius + s)));
}
} // namespace


double StressIntensity::kink_angle() const
{
  // tan(theta/2) = (K_I - sqrt(K_I^2 + 8 K_II^2)) / (4 K_II), without the cancellation.
  return 2. * std::atan2(-2. * mode_II, mode_I + std::hypot(mode_I, std::sqrt(8.) * mode_II));
}


double StressIntensity::energy_release_rate(const double plane_strain_modulus) const
{
  return (mode_I * mode_I + mode_II * mode_II) / plane_strain_modulus;
}


PlaneTraction traction_on_plane(const double stress_xx,
                                const double stress_yy,
                                const double stress_xy,
                                const double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  return {stress_xx * s * s + stress_yy * c * c - 2. * stress_xy * s * c,
          (stress_yy - stress_xx) * s * c + stress_xy * (c * c - s * s)};
}


LineCrack::LineCrack(const LineCrackParameters &parameters)
  : parameters(parameters)
  , modulus(plane_strain_modulus(parameters.youngs_modulus, parameters.poisson_ratio))
{
}


double LineCrack::opening(const double s) const
{
  return 4. * parameters.net_pressure / modulus * half_chord(parameters.half_length, s);
}


double LineCrack::slip(const double s) const
{
  return 4. * parameters.shear / modulus * half_chord(parameters.half_length, s);
}


double LineCrack::volume() const
{
  return 2. * pi * parameters.net_pressure * parameters.half_length * parameters.half_length /
         modulus;
}


StressIntensity LineCrack::stress_intensity() const
{
  const double root = std::sqrt(pi * parameters.half_length);
  return {parameters.net_pressure * root, parameters.shear * root};
}


double LineCrack::energy_release_rate() const
{
  return stress_intensity().energy_release_rate(modulus);
}


std::array<double, 2> LineCrack::displacement(const double x, const double y) const
{
  using Complex = std::complex<double>;

  // Westergaard's functions in the crack's own axes: the load's share of the stress function and
  // its integral, both decaying at infinity; z/root - 1 and root - z are written so that they do
  // not cancel far away. The branch cut of the root lies on the crack.
  const Complex axis = std::polar(1., parameters.angle);
  const double a = parameters.half_length;
  const Complex z = Complex(x - parameters.centre_x, y - parameters.centre_y) / axis;
  const Complex root = std::sqrt(z - a) * std::sqrt(z + a);
  const Complex bar = -a * a / (root + z); // root - z
  const Complex Z = -bar / root;           // z/root - 1
  const double kolosov = 3. - 4. * parameters.poisson_ratio;
  const double shear_modulus = parameters.youngs_modulus / (2. * (1. + parameters.poisson_ratio));

  const Complex mode_I(0.5 * (kolosov - 1.) * bar.real() - z.imag() * Z.imag(),
                       0.5 * (kolosov + 1.) * bar.imag() - z.imag() * Z.real());
  const Complex mode_II(0.5 * (kolosov + 1.) * bar.imag() + z.imag() * Z.real(),
                        -0.5 * (kolosov - 1.) * bar.real() - z.imag() * Z.imag());
  const Complex u =
    axis * (parameters.net_pressure * mode_I + parameters.shear * mode_II) / (2. * shear_modulus);
  return {{u.real(), u.imag()}};
}


PennyCrack::PennyCrack(const PennyCrackParameters &parameters)
  : parameters(parameters)
  , modulus(plane_strain_modulus(parameters.youngs_modulus, parameters.poisson_ratio))
{
}


double PennyCrack::opening(const double r) const
{
  return 8. * parameters.net_pressure / (pi * modulus) * half_chord(parameters.radius, r);
}


double PennyCrack::volume() const
{
  return 16. * parameters.net_pressure * std::pow(parameters.radius, 3) / (3. * modulus);
}


double PennyCrack::stress_intensity() const
{
  return 2. * parameters.net_pressure * std::sqrt(parameters.radius / pi);
}


double PennyCrack::energy_release_rate() const
{
  return std::pow(stress_intensity(), 2) / modulus;
}


std::array<double, 2> PennyCrack::displacement(const double r, const double z) const
{
  // With a harmonic function phi, 2 G u_r = (1 - 2 nu) phi_r + z phi_rz and
  // 2 G u_z = -2 (1 - nu) phi_z + z phi_zz leave no shear on z = 0, where sigma_zz = -phi_zz. On it
  // phi_z = -(2 p/pi) sqrt(a^2 - r^2) inside the crack and zero outside: its Hankel transform is
  // (sin(s a) - s a cos(s a))/s^3, and the integrals are those of exp(-s (z - i a)) J(s r) s^-n
  // (Sneddon 1946), written so that they do not cancel at the axis.
  using Complex = std::complex<double>;
  const double a = parameters.radius, height = std::abs(z);
  const Complex zeta(height, -a);
  // zeta^2 + r^2 has a negative imaginary part, or is negative on the crack; so must be the root's.
  Complex root = std::sqrt(zeta * zeta + r * r);
  if (root.imag() > 0.)
    root = -root;
  const Complex sum = root + zeta;
  const double angle = std::arg(sum);
  const double phi_z = height * angle - root.imag();
  const double phi_zz = -angle - a * (1. / root).real();
  const double phi_r = r * (-0.5 * (zeta / sum).imag() - 0.5 * angle - a * (1. / sum).real());
  const double phi_rz = r * (height / (root * sum) - 1. / root).imag();
  const double nu = parameters.poisson_ratio;
  const double shear_modulus = parameters.youngs_modulus / (2. * (1. + nu));
  const double factor = 2. * parameters.net_pressure / pi / (2. * shear_modulus);
  return {{factor * (-(1. - 2. * nu) * phi_r - height * phi_rz),
           std::copysign(factor * (2. * (1. - nu) * phi_z + height * phi_zz), z)}};
}
} // namespace stockwork::analytical
