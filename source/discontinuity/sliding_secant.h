#pragma once

namespace stockwork
{
/// Faces that slide, in Newton's method for one solve. What slides has no stiffness along the
/// crack, so the tangent may send faces that ought to stick past all of the range in which they
/// stick, and back, for ever. From a turn on they are given their secant, which leads to where they
/// stick, the more slowly the nearer the load is to the bound; and half of it, a quarter, and so
/// on, whenever they are looked at again and have not turned: so those that are to slide come to
/// the tangent.
class SlidingSecant
{
public:
  /// The share of the secant that belongs to the tangent.
  /// @param forwards the way in which they slide now
  double share(const bool forwards)
  {
    now = asked && forwards != last ? 1. : 0.5 * now;
    last = forwards;
    asked = true;
    return now;
  }

  /// As it was returned last.
  double share() const
  {
    return now;
  }

private:
  bool asked = false, last = false;
  double now = 0.;
};
} // namespace stockwork
