#include <doctest/doctest.h>

#include "discontinuity/contact_law.h"
#include "discontinuity/sliding_secant.h"

#include <cmath>

namespace stockwork::sliding_secant_test
{
/// Faces that are pressed together and hold up to a shear traction of 1, in line with a spring of
/// stiffness 1 that wants them at a distance, by Newton's method.
struct Rubbed
{
  double penalty, distance;

  /// Iterations from a gap until the forces balance; 100: they do not.
  unsigned int solve(double &shear_gap, const bool with_secant = true) const
  {
    const ContactLaw law{penalty, 0.5};
    const dealii::Point<2> along(1., 0.), n(0., 1.);
    SlidingSecant secant;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
    {
      const ContactResponse<2> response =
        law.evaluate<2>(n, shear_gap * along, dealii::Tensor<1, 2>(), 1., -2.);
      const double residual = response.shear * along + shear_gap - distance;
      if (std::abs(residual) < 1e-12)
        return iteration;
      double slope = along * (response.tangent * along);
      if (with_secant && response.secant > 0.)
        slope += secant.share(response.shear * along > 0.) * response.secant;
      shear_gap -= residual / (slope + 1.);
    }
    return 100;
  }
};

TEST_CASE("Faces that ought to stick are not sent from one way of sliding to the other for ever")
{
  // The penalty of cohesive cracks is 20 times the stiffness of the rock over a cell, and 200 times
  // where they hold, that of given cracks 1000 times.
  for (const double penalty : {20., 200., 1000.})
    for (const double distance : {-0.9, 0.1, 0.5, 0.9})
    {
      double by_tangent = distance, shear_gap = distance;
      CHECK(Rubbed{penalty, distance}.solve(by_tangent, false) == 100);
      CHECK(Rubbed{penalty, distance}.solve(shear_gap) < 15);
      CHECK(shear_gap == doctest::Approx(distance / (penalty + 1.)).epsilon(1e-9));
    }
}

TEST_CASE("Faces that slide do so by the tangent, and soon where they had slid the other way")
{
  for (const double distance : {1.1, 3.})
  {
    const Rubbed rubbed{20., distance};
    double onwards = distance, back = -0.06;
    CHECK(rubbed.solve(onwards) <= 2);
    CHECK(rubbed.solve(back) < 15);
    CHECK(onwards == doctest::Approx(distance - 1.).epsilon(1e-9));
    CHECK(back == doctest::Approx(distance - 1.).epsilon(1e-9));
  }
}
} // namespace stockwork::sliding_secant_test
