#pragma once

#include <algorithm>
#include <cmath>

#include "flow/conductivity.h"

namespace stockwork
{
/// How fluid passes from a fracture into the rock; rates are per face, and a fracture has two.
enum class LeakOff
{
  none,
  /// C_L / sqrt(t - t_0), with t - t_0 the time for which fluid has been at the face:
  /// one-dimensional loss into rock beyond the model (Carter 1957). The fluid leaves the model.
  carter,
  /// c_l (p_f - p_m), p_m the rock's pore pressure at the face. The fluid enters the rock.
  filter_cake,
  /// p_f is the pore pressure at the face.
  resolved
};

/// What passes through one face while its time of exposure grows, exactly integrated [m]: the audit
/// of the fluid volume closes for any step.
/// @param coefficient C_L [m/s^(1/2)]
/// @param begin, end times for which fluid has been at the face [s]
inline double carter_volume(const double coefficient, const double begin, const double end)
{
  return 2. * coefficient * (std::sqrt(end) - std::sqrt(begin));
}

/// Share of a segment that has fluid at its faces: all of it where the fracture is open by more
/// than w_bare, nothing where it is closed. The time of exposure counts this share only. Otherwise
/// a cell that was cut well before it opened would have the small rate of a face long exposed, and
/// an empty notch would draw more than is injected.
inline ValueAndSlope wetted_share(const double w, const double w_bare)
{
  const double x = std::clamp(w / w_bare, 0., 1.);
  return {x * x * (3. - 2. * x), 6. * x * (1. - x) / w_bare};
}

/// Coefficient c_l that resolved leak-off has: what the rock between the fracture and the nodes of
/// the pore pressure conducts, k/(mu d), which makes the drop across it that of Darcy's flow away
/// from the fracture, exactly where this is steady. Elements that are smooth across the fracture
/// would miss that drop, as a grid block misses the drop towards a well (Peaceman 1978). Where the
/// nodes lie on the fracture: p_f = p_m but for a thousandth of the drop across a cell of size h.
/// @param mobility k/mu of the rock [m^2/(Pa s)]
/// @param distance d, Segment::pore_distance [m]
inline double resolved_coefficient(const double mobility, const double h, const double distance)
{
  return mobility / std::max(distance, 1e-3 * h);
}
} // namespace stockwork
