#pragma once

namespace stockwork::_template
{
/// The model's law, as a pure function of numbers: no mesh, no clock, no parameters file. Give the
/// derivative too, and compare it with finite differences in tests/unit/<model>_law_test.cc.
///
/// Here: a traction that falls from `strength` [Pa] to zero as the opening grows to `critical` [m].
struct Traction
{
  double value; ///< [Pa]
  double slope; ///< d value / d opening [Pa/m]
};

inline Traction traction(const double opening, const double strength, const double critical)
{
  if (opening >= critical)
    return {0., 0.};
  return {strength * (1. - opening / critical), -strength / critical};
}
} // namespace stockwork::_template
