#pragma once

#include <cmath>

namespace stockwork::analytical
{
/// f in K_I = P S f(a/W) / W^(3/2) of a beam of depth W with a crack a under a load P in the middle
/// of a span S = 4 W, per thickness (ASTM E399, from Srawley 1976): 0.5 per cent for any a/W.
inline double three_point_bending_factor(const double x)
{
  return 3. * std::sqrt(x) * (1.99 - x * (1. - x) * (2.15 - 3.93 * x + 2.7 * x * x)) /
         (2. * (1. + 2. * x) * std::pow(1. - x, 1.5));
}
} // namespace stockwork::analytical
