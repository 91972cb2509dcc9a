#include <doctest/doctest.h>

#include "fracture/peridynamics/softening.h"
#include "fracture/peridynamics/turns.h"

#include <cmath>

namespace stockwork::peridynamics::turns_test
{
/// A bond of stiffness one in line with a spring, by Newton's method, from rest. The bond softens
/// from a stretch of 1 to 4, so its force falls by a third of its stiffness.
struct Pulled
{
  double spring, distance; ///< by which both are pulled apart

  /// Iterations until the forces balance to 1e-12; 100: they do not.
  unsigned int solve(const bool by_turns, double &stretch) const
  {
    const SofteningLaw law{1., 4.};
    Turns turns;
    stretch = 0.;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
    {
      const double damage = law.damage(stretch),
                   residual = (1. - damage) * stretch - spring * (distance - stretch);
      if (std::abs(residual) < 1e-12)
        return iteration;
      const bool tangent = turns.follows_tangent(stretch >= law.last   ? Turns::Leg::broken
                                                 : stretch > law.first ? Turns::Leg::softens
                                                                       : Turns::Leg::elastic);
      const double slope = !by_turns || tangent ? 1. - law.slope(stretch) : 1. - damage;
      stretch -= residual / (slope + spring);
    }
    return 100;
  }
};

TEST_CASE("A bond whose force falls faster than the rock gives way comes to rest by its secant")
{
  // In a stiff spring the bond comes to rest while it softens: (4 - s)/3 = k (d - s).
  double stretch;
  const Pulled stiff{1., 2.5};
  CHECK(stiff.solve(false, stretch) < 5);
  const unsigned int by_tangent = stiff.solve(false, stretch);
  CHECK(stiff.solve(true, stretch) == by_tangent);
  CHECK(stretch == doctest::Approx(1.75).epsilon(1e-12));

  // In a soft one it cannot: it breaks, and the spring is at rest.
  const Pulled soft{0.05, 21.5};
  CHECK(soft.solve(false, stretch) == 100);
  CHECK(soft.solve(true, stretch) < 60);
  CHECK(stretch == doctest::Approx(21.5).epsilon(1e-12));
}

TEST_CASE("Four turns make a secant, three looks on one leg a tangent, and a turn after that six")
{
  using Leg = Turns::Leg;
  Turns turns;
  bool on = false;
  const auto turn = [&]()
  { return turns.follows_tangent((on = !on) ? Leg::softens : Leg::elastic); };
  const auto stay = [&]() { return turns.follows_tangent(on ? Leg::softens : Leg::elastic); };
  CHECK(turn()); // on its first leg
  for (unsigned int n = 1; n <= 3; ++n)
    CHECK(turn());
  CHECK_FALSE(turn());
  for (const unsigned int rests : {3u, 6u, 12u})
  {
    for (unsigned int n = 1; n < rests; ++n)
      CHECK_FALSE(stay());
    CHECK(stay());
    CHECK(stay());
    CHECK_FALSE(turn());
  }
}
} // namespace stockwork::peridynamics::turns_test
