#pragma once

#include <cmath>

namespace stockwork
{
/// The part that depends on the angle, and its derivative, of the leading displacement around the
/// tip of a traction-free crack along theta = +-pi in an elastic body (Williams 1957):
///
///   u_i = K sqrt(r) / (2 mu sqrt(2 pi)) f_i(theta),
///
/// in the frame of the tip; the jump of f is 2 (kappa + 1), across in opening, along in shear.
struct NearTipField
{
  double f[2], df[2];

  NearTipField(const bool shear, const double theta, const double kappa)
  {
    const double c = std::cos(0.5 * theta), s = std::sin(0.5 * theta);
    if (!shear)
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
  }
};
} // namespace stockwork
