#include "verification/analytical/anisotropic_crack.h"

#include <cmath>

namespace stockwork::analytical
{
using namespace dealii;

AnisotropicCrack::AnisotropicCrack(const SymmetricTensor<4, 2> &stiffness,
                                   const Point<2> &centre,
                                   const double half_length,
                                   const double angle,
                                   const double net_pressure,
                                   const double shear)
  : centre(centre)
  , half_length(half_length)
  , along(direction(angle))
  , net_pressure(net_pressure)
  , shear(shear)
  , elasticity(stiffness, along)
{
}


double AnisotropicCrack::opening() const
{
  // The jump is 2 M (t, p) sqrt(a^2 - s^2).
  const auto &M = elasticity.crack_compliance;
  return 2. * half_length * (M[1][1] * net_pressure + M[0][1] * shear);
}


double AnisotropicCrack::volume() const
{
  return 0.5 * numbers::PI * half_length * opening();
}


double AnisotropicCrack::mode_I() const
{
  return net_pressure * std::sqrt(numbers::PI * half_length);
}


double AnisotropicCrack::mode_II() const
{
  return shear * std::sqrt(numbers::PI * half_length);
}


double AnisotropicCrack::energy_release_rate() const
{
  Tensor<1, 2> K;
  K[0] = mode_II();
  K[1] = mode_I();
  return 0.5 * (K * (elasticity.crack_compliance * K));
}


Tensor<1, 2> AnisotropicCrack::displacement(const Point<2> &x) const
{
  const auto across = direction(std::atan2(along[1], along[0]) + 0.5 * numbers::PI);
  const Tensor<1, 2> from_centre = x - centre;
  const double x1 = from_centre * along, x2 = from_centre * across;
  double u = 0., v = 0.;
  for (unsigned int k = 0; k < 2; ++k)
  {
    const auto mu = elasticity.mu[k], other = elasticity.mu[1 - k];
    const auto z = x1 + mu * x2;
    // Behaves like z at infinity, and is cut along the crack.
    const auto root = std::sqrt(z - half_length) * std::sqrt(z + half_length);
    const auto phi = -0.5 * (net_pressure * other + shear) / (mu - other) * (root - z);
    u += 2. * (elasticity.p[k] * phi).real();
    v += 2. * (elasticity.q[k] * phi).real();
  }
  return u * along + v * across;
}
} // namespace stockwork::analytical
