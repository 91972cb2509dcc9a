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
  /// C_L / sqrt(t - t_0), with t_0 the time at which the face was exposed: one-dimensional loss
  /// into rock beyond the model (Carter 1957). The fluid leaves the model. Nothing leaks where the
  /// fracture is closed.
  carter,
  /// c_l (p_f - p_m), p_m the rock's pore pressure at the face. The fluid enters the rock.
  filter_cake,
  /// p_f = p_m, as a filter cake so permeable that its pressure drop cannot be seen.
  resolved
};

/// What passes through one face between two times, exactly integrated [m]: the audit of the fluid
/// volume closes for any step.
/// @param coefficient C_L [m/s^(1/2)]
/// @param exposed t_0 [s]
inline double
carter_volume(const double coefficient, const double exposed, const double begin, const double end)
{
  return 2. * coefficient *
         (std::sqrt(std::max(end - exposed, 0.)) - std::sqrt(std::max(begin - exposed, 0.)));
}

/// Share of Carter's leak-off that finds fluid to take: all of it where the fracture is open by
/// more than the minimum aperture, nothing where it is closed. Without it, the law would draw from
/// an empty notch more than is injected, and suck it shut.
inline ValueAndSlope wetted_share(const double w, const double w_min)
{
  const double x = std::clamp(w / w_min, 0., 1.);
  return {x * x * (3. - 2. * x), 6. * x * (1. - x) / w_min};
}

/// Coefficient of the filter cake that stands for p_f = p_m: a thousand times what a cell of size h
/// conducts, k/(mu h), so that the drop across the face is a thousandth of that across the cell.
/// @param mobility k/mu of the rock [m^2/(Pa s)]
inline double resolved_coefficient(const double mobility, const double h)
{
  return 1e3 * mobility / h;
}
} // namespace stockwork
