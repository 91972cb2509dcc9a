#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include "stockwork/rock/linear_stiffness.h"

#include "rock/plane_elasticity.h"

#include <optional>

namespace stockwork
{
/// The leading displacement around the tip of a traction-free crack along theta = +-pi in an
/// elastic body, in the frame of the tip and for a unit jump: u = sqrt(r) f(theta), where f jumps
/// by one across the crack in opening (mode 0), along it in shear (1), and not in the other
/// direction. Williams (1957) in isotropic rock, Sih, Paris and Irwin (1965) in any other.
class NearTipField
{
public:
  /// @param along unit vector out of the crack
  NearTipField(const LinearStiffness<2> &rock, const dealii::Tensor<1, 2> &along);

  struct Angular
  {
    dealii::Tensor<1, 2> value, derivative; ///< f and df/dtheta
  };

  Angular operator()(const unsigned int mode, const double theta) const;

private:
  double kolosov = 2.;                       ///< kappa of isotropic rock
  std::optional<PlaneElasticity> elasticity; ///< of any other

  /// By mode: phi_k = weights[mode][k] sqrt(z_k).
  std::array<std::array<std::complex<double>, 2>, 2> weights;
};
} // namespace stockwork
