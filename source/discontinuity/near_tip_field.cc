#include "discontinuity/near_tip_field.h"

#include <cmath>

namespace stockwork
{
using dealii::Tensor;

namespace
{
NearTipField::Angular williams(const unsigned int mode, const double theta, const double kappa)
{
  const double c = std::cos(0.5 * theta), s = std::sin(0.5 * theta);
  NearTipField::Angular result;
  auto &[f, df] = result;
  if (mode == 0)
  {
    f[0] = c * (kappa - 1. + 2. * s * s);
    f[1] = s * (kappa + 1. - 2. * c * c);
    df[0] = -0.5 * s * (kappa - 1. + 2. * s * s) + 2. * s * c * c;
    df[1] = 0.5 * c * (kappa + 1. - 2. * c * c) + 2. * s * s * c;
  }
  else
  {
    f[0] = s * (kappa + 1. + 2. * c * c);
    f[1] = -c * (kappa - 1. - 2. * s * s);
    df[0] = 0.5 * c * (kappa + 1. + 2. * c * c) - 2. * s * s * c;
    df[1] = 0.5 * s * (kappa - 1. - 2. * s * s) + 2. * s * c * c;
  }
  const double jump = 2. * (kappa + 1.);
  f /= jump;
  df /= jump;
  return result;
}
} // namespace


NearTipField::NearTipField(const LinearStiffness<2> &rock, const Tensor<1, 2> &along)
{
  const auto stiffness = rock.tensor();
  if (!rock.is_isotropic())
    elasticity.emplace(stiffness, along);
  if (!elasticity || elasticity->is_degenerate())
  {
    elasticity.reset();
    const double mu = rock.shear_modulus(), lambda = rock.bulk_modulus() - mu;
    kolosov = (lambda + 3. * mu) / (lambda + mu);
    return;
  }
  // phi_k of a unit K_I is -mu_j / (mu_k - mu_j) sqrt(z_k / (2 pi)), of a unit K_II
  // -1 / (mu_k - mu_j) sqrt(z_k / (2 pi)). The jump is 2 M K sqrt(2 r / pi), so
  // K = M^-1 e sqrt(pi / 2) / 2 makes it e sqrt(r).
  const auto &mu = elasticity->mu;
  const auto inverse = invert(elasticity->crack_compliance);
  for (unsigned int mode = 0; mode < 2; ++mode)
  {
    const double K_II = inverse[0][1 - mode], K_I = inverse[1][1 - mode];
    for (unsigned int k = 0; k < 2; ++k)
      weights[mode][k] = -0.25 * (K_I * mu[1 - k] + K_II) / (mu[k] - mu[1 - k]);
  }
}


NearTipField::Angular NearTipField::operator()(const unsigned int mode, const double theta) const
{
  if (!elasticity)
    return williams(mode, theta, kolosov);
  Angular result;
  for (unsigned int k = 0; k < 2; ++k)
  {
    const auto mu = elasticity->mu[k];
    const auto z = std::cos(theta) + mu * std::sin(theta);
    const auto root = std::sqrt(z); // cut along the crack, for mu has a positive imaginary part
    const auto phi = weights[mode][k] * root,
               by_theta = weights[mode][k] * 0.5 / root * (-std::sin(theta) + mu * std::cos(theta));
    result.value[0] += 2. * (elasticity->p[k] * phi).real();
    result.value[1] += 2. * (elasticity->q[k] * phi).real();
    result.derivative[0] += 2. * (elasticity->p[k] * by_theta).real();
    result.derivative[1] += 2. * (elasticity->q[k] * by_theta).real();
  }
  return result;
}
} // namespace stockwork
