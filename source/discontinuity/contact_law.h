#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace stockwork
{
/// Traction between the faces of a crack that touch, on the plus side, positive in tension and
/// along the crack.
struct ContactResponse
{
  double normal = 0.;                           ///< never positive [Pa]
  double shear = 0.;                            ///< [Pa]
  std::array<std::array<double, 2>, 2> tangent; ///< d(normal, shear)/d(gap, shear gap) [Pa/m]
  double slip = 0.;                             ///< trial value of the irreversible shear gap [m]
  double gap = 0.;                              ///< as given [m]
};

/// Unilateral contact with Coulomb's friction, by a penalty K and what the faces carried after the
/// step before, t_0 (augmented Lagrange with one update per step; Wriggers 2006, section 6.3),
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

  /// @param gap, shear_gap of the faces [m]
  /// @param slip the committed one [m]
  /// @param carried t_0, never positive [Pa]
  /// @param broken share of the area that rubs; the rest holds by other laws (Alfano and Sacco
  /// 2006)
  ContactResponse evaluate(const double gap,
                           const double shear_gap,
                           const double slip,
                           const double broken = 1.,
                           const double carried = 0.) const
  {
    ContactResponse response;
    response.gap = gap;
    response.normal = std::min(carried + stiffness * gap, 0.);
    const bool closed = response.normal < 0.;
    response.tangent = {{{{closed ? stiffness : 0., 0.}}, {{0., 0.}}}};
    const double bound = -broken * friction * response.normal;
    const double trial = stiffness * (shear_gap - slip);
    if (std::abs(trial) < bound)
    {
      response.shear = trial;
      response.tangent[1][1] = stiffness;
      response.slip = slip;
    }
    else
    {
      response.shear = std::copysign(bound, trial);
      if (closed)
        response.tangent[1][0] = -std::copysign(broken * friction * stiffness, trial);
      response.slip = shear_gap - response.shear / stiffness;
    }
    return response;
  }
};
} // namespace stockwork
