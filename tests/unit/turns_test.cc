#include <doctest/doctest.h>

#include "base/turns.h"
#include "discontinuity/contact_law.h"
#include "fracture/peridynamics/softening.h"
#include "fracture/peridynamics/softening_bonds.h"

#include <cmath>

namespace stockwork::turns_test
{
using namespace peridynamics;

/// A bond of stiffness one in line with a spring, by Newton's method, from rest. The bond softens
/// from a stretch of 1 to 4, so its force falls by a third of its stiffness.
struct Pulled
{
  double spring, distance; ///< by which both are pulled apart

  /// Iterations until the forces balance to 1e-12; 100: they do not.
  unsigned int solve(const bool by_turns, double &stretch) const
  {
    const SofteningLaw law{1., 4.};
    SofteningTurns turns(4, 3, 2);
    stretch = 0.;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
    {
      const double damage = law.damage(stretch),
                   residual = (1. - damage) * stretch - spring * (distance - stretch);
      if (std::abs(residual) < 1e-12)
        return iteration;
      const bool tangent = turns.follows_tangent(stretch >= law.last   ? SofteningLeg::broken
                                                 : stretch > law.first ? SofteningLeg::softens
                                                                       : SofteningLeg::elastic);
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

/// Faces that are pressed together and hold up to a shear traction of 1, with a penalty of 20, in
/// line with a spring of stiffness 1 that wants them at a distance: by Newton's method from there.
struct Rubbed
{
  double distance;

  unsigned int solve(const bool by_turns, double &shear_gap) const
  {
    const ContactLaw law{20., 0.5};
    const dealii::Point<2> along(1., 0.), n(0., 1.);
    Turns<bool> turns(1, 6, 1);
    shear_gap = distance;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
    {
      const ContactResponse<2> response =
        law.evaluate<2>(n, shear_gap * along, dealii::Tensor<1, 2>(), 1., -2.);
      const double residual = response.shear * along + shear_gap - distance;
      if (std::abs(residual) < 1e-12)
        return iteration;
      double slope = along * (response.tangent * along);
      if (by_turns && response.secant > 0. && !turns.follows_tangent(response.shear * along > 0.))
        slope += response.secant;
      shear_gap -= residual / (slope + 1.);
    }
    return 100;
  }
};

TEST_CASE("Faces that ought to stick are not sent from one way of sliding to the other for ever")
{
  double shear_gap;
  for (const double distance : {-0.9, 0.1, 0.5, 0.9})
  {
    CHECK(Rubbed{distance}.solve(false, shear_gap) == 100);
    CHECK(Rubbed{distance}.solve(true, shear_gap) < 10);
    CHECK(shear_gap == doctest::Approx(distance / 21.).epsilon(1e-12));
  }
  // Those that slide do so by the tangent.
  CHECK(Rubbed{3.}.solve(true, shear_gap) == 1);
  CHECK(shear_gap == doctest::Approx(2.).epsilon(1e-12));
}

TEST_CASE("Four turns make a secant, three looks on one leg a tangent, and a turn after that six")
{
  Turns<bool> turns(4, 3, 2);
  bool on = false;
  const auto turn = [&]() { return turns.follows_tangent(on = !on); };
  const auto stay = [&]() { return turns.follows_tangent(on); };
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
} // namespace stockwork::turns_test
