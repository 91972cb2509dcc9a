#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include "base/kink.h"

#include <algorithm>

namespace stockwork
{
/// Traction between the faces of a crack that touch, on the plus side.
template <int dim>
struct ContactResponse
{
  double normal = 0.;             ///< positive in tension, so never positive [Pa]
  dealii::Tensor<1, dim> shear;   ///< along the crack [Pa]
  dealii::Tensor<2, dim> tangent; ///< of both by the jump [Pa/m]
  dealii::Tensor<1, dim> slip;    ///< trial value of the irreversible shear gap [m]
  double secant = 0.; ///< where faces slide: shear traction over the gap beyond the slip [Pa/m]
  double gap = 0.;    ///< as given [m]
};

/// Unilateral contact with Coulomb's friction, by a penalty K and what the faces carried after the
/// step before, t_0 (augmented Lagrange with one update per step; Wriggers 2006, section 6.3), for
/// the gap g across the crack and s along it,
///
///   t_n = min(t_0 + K g, 0),   t_s = K (s - s_p),   |t_s| <= mu |t_n|,
///
/// so that faces overlap by what a step adds to their pressure and not by all of it. The slip s_p
/// is what it was, unless the bound is reached: then it follows (backward Euler; section 5.2). Open
/// faces slip with no traction, so those that close again stick where they are. As t_n is what the
/// faces carry and not the fluid between them, this is friction by effective stress.
struct ContactLaw
{
  double stiffness; ///< K [Pa/m]
  double friction;  ///< mu

  /// @param n unit, from the minus to the plus side
  /// @param jump of the displacement, plus less minus side [m]
  /// @param slip the committed one [m]
  /// @param broken share of the area that rubs; the rest holds by other laws (Alfano and Sacco
  /// 2006)
  /// @param carried t_0, never positive [Pa]
  template <int dim>
  ContactResponse<dim> evaluate(const dealii::Tensor<1, dim> &n,
                                const dealii::Tensor<1, dim> &jump,
                                const dealii::Tensor<1, dim> &slip,
                                const double broken = 1.,
                                const double carried = 0.) const
  {
    ContactResponse<dim> response;
    response.gap = jump * n;
    response.normal = std::min(carried + stiffness * response.gap, 0.);
    const bool closed = response.normal < 0.;
    const dealii::Tensor<2, dim> across = outer_product(n, n),
                                 along = dealii::unit_symmetric_tensor<dim>() - across;
    if (closed)
      response.tangent = stiffness * across;
    const double bound = -broken * friction * response.normal;
    const dealii::Tensor<1, dim> shear_gap = along * jump, trial = stiffness * (shear_gap - slip);
    if (trial.norm() < (1. - kink_width) * bound)
    {
      response.shear = trial;
      response.tangent += stiffness * along;
      response.slip = slip;
      return response;
    }
    if (const double size = trial.norm(); closed && size > 0.)
    {
      const dealii::Tensor<1, dim> direction = trial / size;
      response.shear = bound * direction;
      response.tangent -= broken * friction * stiffness * outer_product(direction, n);
      response.secant = stiffness * bound / size;
      response.tangent += response.secant * (along - outer_product(direction, direction));
    }
    response.slip = shear_gap - response.shear / stiffness;
    return response;
  }
};
} // namespace stockwork
