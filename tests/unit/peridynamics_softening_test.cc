// The law of bonds that soften before they break.
#include <doctest/doctest.h>

#include "fracture/peridynamics/softening.h"

namespace stockwork::peridynamics_softening_test
{
using namespace stockwork::peridynamics;

TEST_CASE("a bond that softens dissipates what a brittle one does, and unloads to the origin")
{
  const SofteningLaw law{0.5, 2.}; // critical stretch 1
  CHECK_FALSE(law.brittle());
  const auto force = [&](const double kappa) { return (1. - law.damage(kappa)) * kappa; };

  // Work done up to a stretch, by the trapezoidal rule between the kinks.
  const unsigned int n = 3000;
  double work = 0., separated = 0.;
  const auto lost = [&](const double kappa) { return law.damage(kappa) * kappa; };
  for (unsigned int i = 0; i < n; ++i)
  {
    const double from = law.last * i / n, to = law.last * (i + 1) / n;
    work += 0.5 * (force(from) + force(to)) * (to - from);
    separated += 0.5 * (force(from) + force(to)) * (lost(to) - lost(from));
    CHECK(separated == doctest::Approx(0.5 * law.separation(to)).epsilon(1e-6));
    CHECK(law.damage(to) >= law.damage(from));
    const double kept = 0.5 * force(to) * to; // comes back on unloading
    CHECK(work - kept == doctest::Approx(0.5 * law.dissipated(to)).epsilon(1e-6));
  }
  CHECK(work == doctest::Approx(0.5));
  CHECK(law.damage(law.first) == 0.);
  CHECK(law.damage(law.last) == 1.);
  CHECK(law.dissipated(3. * law.last) == doctest::Approx(1.));
  CHECK(law.separation(3. * law.last) == doctest::Approx(1.));

  for (const double kappa : {0.4, 0.7, 1.5, 2.5})
  {
    const double step = 1e-4 * kappa;
    CHECK(law.slope(kappa) ==
          doctest::Approx((lost(kappa + step) - lost(kappa - step)) / (2. * step)));
  }
}

TEST_CASE("with a pressure in its law, the fluid's work on a bond is that on its volume")
{
  // Of stiffness 1, under a pressure that lengthens it by g: the force is e - x, x = D (e + g), the
  // volume is x times its length over C11 + (d-1) C12. So ends and fluid do the work f de + g dx.
  const SofteningLaw law{0.5, 2.};
  const double g = 0.3;
  const auto lost = [&](const double kappa) { return law.damage(kappa) * kappa; };
  double work = 0.;
  const unsigned int n = 3000;
  for (unsigned int i = 0; i < n; ++i)
  {
    const double from = 1.2 * law.last * i / n, to = 1.2 * law.last * (i + 1) / n;
    const double x0 = lost(from), x1 = lost(to);
    work += (0.5 * (from + to) - g - 0.5 * (x0 + x1)) * (to - from) + g * (x1 - x0);
    // What comes back, and the uniform field of the pressure, of which the bond has had nothing.
    const double back = 0.5 * (to - x1) * to - g * (to - x1);
    CHECK(work - back == doctest::Approx(0.5 * law.dissipated(to)).epsilon(1e-6));
  }
  CHECK(work == doctest::Approx(0.5).epsilon(1e-6));
}

TEST_CASE("one stretch is a brittle bond")
{
  const SofteningLaw law{1e-4, 1e-4};
  CHECK(law.brittle());
  CHECK(law.damage(0.999e-4) == 0.);
  CHECK(law.damage(1.001e-4) == 1.);
}
} // namespace stockwork::peridynamics_softening_test
