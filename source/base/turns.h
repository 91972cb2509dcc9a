#pragma once

namespace stockwork
{
/// A law that is made of legs, at one point, in Newton's method for one solve. On each of two legs
/// the tangent may lead to the other one, and from there back, without end; the secant leads to
/// where the law is at rest, slowly. So a point that comes and goes is given the secant, until it
/// stays.
template <class Leg>
class Turns
{
public:
  /// @param most of them before the secant is used: fewer than one that goes on for ever, and not
  /// fewer than a point makes that comes to rest by itself
  /// @param rest iterations on one leg, after which the tangent is tried again
  /// @param growth of the rest, whenever the tangent has led back once more
  Turns(const unsigned int most, const unsigned int rest, const unsigned int growth)
    : most(most)
    , growth(growth)
    , rest(rest)
  {
  }

  /// Whether to use the tangent; else the secant. To be asked whenever the law is assembled, also
  /// for an increment that is taken back.
  bool follows_tangent(const Leg now)
  {
    if (asked && now != leg)
    {
      if (n_turns >= most && since >= rest)
        rest *= growth; // the tangent has led back once more
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
    return n_turns < most || since >= rest;
  }

private:
  unsigned int most, growth, rest;
  bool asked = false;
  Leg leg = Leg();
  unsigned int n_turns = 0, since = 0;
};
} // namespace stockwork
