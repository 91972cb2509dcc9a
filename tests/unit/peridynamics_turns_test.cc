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

  // Before its force is at the greatest it is elastic in both.
  const Pulled little{0.05, 20.};
  CHECK(little.solve(true, stretch) < 4);
  CHECK(stretch == doctest::Approx(0.05 * 20. / 1.05).epsilon(1e-12));
}
} // namespace stockwork::peridynamics::turns_test
