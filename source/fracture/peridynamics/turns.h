#pragma once

namespace stockwork::peridynamics
{
/// A bond in Newton's method for one solve. Where its force falls faster than the rock around gives
/// way, the tangent of its law leads back to where it does not soften, and from there to where it
/// does, without end; the secant leads on to where the rock holds, slowly. So a bond that comes and
/// goes is given the secant, until it stays. State-based bonds are not: with secants more of their
/// steps failed (three of scenes/state_based_path/*).
class Turns
{
public:
  /// The legs of its law.
  enum class Leg
  {
    elastic, ///< or unloaded
    softens,
    broken
  };

  /// Whether to use the tangent; else the secant. To be asked whenever the law is assembled, also
  /// for an increment that is taken back.
  bool follows_tangent(const Leg now)
  {
    if (asked && now != leg)
    {
      if (n_turns >= most_turns && since >= until_rest)
        until_rest *= 2; // the tangent has led back once more
      ++n_turns;
      since = 0;
    }
    else
      ++since;
    leg = now;
    asked = true;
    return follows_tangent();
  }

  /// What it was told last.
  bool follows_tangent() const
  {
    return n_turns < most_turns || since >= until_rest;
  }

private:
  /// A bond that comes to rest by itself passes from one leg to another less often.
  static constexpr unsigned int most_turns = 4;

  bool asked = false;
  Leg leg = Leg::elastic;
  unsigned int n_turns = 0, since = 0;
  unsigned int until_rest = 3; ///< iterations on one leg, after which the tangent is tried again
};
} // namespace stockwork::peridynamics
