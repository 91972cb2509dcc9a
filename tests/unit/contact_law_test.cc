// Contact with friction: the conditions themselves, and the tangent against differences.
#include <doctest/doctest.h>

#include "discontinuity/contact_law.h"

namespace stockwork::contact_law_test
{
using doctest::Approx;

namespace
{
const ContactLaw law{1e12, 0.6};
} // namespace

TEST_CASE("open faces carry nothing, and slip as they move")
{
  const ContactResponse open = law.evaluate(1e-5, 3e-4, 0.);
  CHECK(open.normal == 0.);
  CHECK(open.shear == 0.);
  CHECK(open.slip == 3e-4);
}

TEST_CASE("closed faces stick below the bound and slip at it, either way")
{
  for (const double sign : {-1., 1.})
  {
    const ContactResponse sticks = law.evaluate(-1e-5, sign * 2e-6, 0.);
    CHECK(sticks.normal == Approx(-1e7));
    CHECK(sticks.shear == Approx(sign * 2e6));
    CHECK(sticks.slip == 0.);

    const ContactResponse slips = law.evaluate(-1e-5, sign * 1e-4, 0.);
    CHECK(slips.shear == Approx(sign * 0.6e7));
    CHECK(slips.slip == Approx(sign * (1e-4 - 0.6e-5)));

    // Back a little: it sticks again, with the traction going down along the stiffness.
    const ContactResponse back = law.evaluate(-1e-5, sign * 0.98e-4, slips.slip);
    CHECK(back.slip == slips.slip);
    CHECK(back.shear == Approx(sign * 0.4e7));
  }
}

TEST_CASE("under what they carried before, faces hardly overlap, and part with it")
{
  double carried = 0., gap = -1e-5;
  for (unsigned int step = 0; step < 2; ++step)
  {
    carried = law.evaluate(gap, 0., 0., 1., carried).normal;
    CHECK(carried == Approx(-1e7));
    gap = (-1e7 - carried) / 1e12; // which the same load asks for next
  }
  CHECK(gap == Approx(0.));
  CHECK(law.evaluate(2e-5, 0., 0., 1., carried).normal == 0.);
  CHECK(law.evaluate(0., 1e-4, 0., 1., carried).shear == Approx(0.6e7)); // rubs by all of it
}

TEST_CASE("what still holds does not rub")
{
  CHECK(law.evaluate(-1e-5, 1e-4, 0., 0.25).shear == Approx(0.25 * 0.6e7));
  CHECK(law.evaluate(-1e-5, 1e-4, 0., 0.25).normal == Approx(-1e7));
  CHECK(ContactLaw{1e12, 0.}.evaluate(-1e-5, 1e-4, 0.).shear == 0.);
}

TEST_CASE("friction never gives work")
{
  double slip = 0., work = 0.;
  for (unsigned int i = 1; i <= 200; ++i)
  {
    const auto response =
      law.evaluate(-1e-5 * (1. + std::sin(0.3 * i)), 1e-4 * std::sin(0.1 * i), slip);
    const double done = response.shear * (response.slip - slip);
    CHECK(done >= 0.);
    work += done;
    slip = response.slip;
  }
  CHECK(work > 100.);
}

TEST_CASE("tangent against differences")
{
  const double h = 1e-11;
  for (const double gap : {-2e-5, -1e-6, 1e-6})
    for (const double shear : {-1e-4, -3e-7, 0., 2e-7, 1e-4})
      for (const double broken : {0.3, 1.})
      {
        const auto exact = law.evaluate(gap, shear, 0., broken);
        const auto gap_plus = law.evaluate(gap + h, shear, 0., broken),
                   gap_minus = law.evaluate(gap - h, shear, 0., broken),
                   shear_plus = law.evaluate(gap, shear + h, 0., broken),
                   shear_minus = law.evaluate(gap, shear - h, 0., broken);
        const auto check = [&](const double slope, const double plus, const double minus)
        { CHECK(std::abs(slope - (plus - minus) / (2. * h)) < 1e-4 * law.stiffness); };
        check(exact.tangent[0][0], gap_plus.normal, gap_minus.normal);
        check(exact.tangent[1][0], gap_plus.shear, gap_minus.shear);
        check(exact.tangent[0][1], shear_plus.normal, shear_minus.normal);
        check(exact.tangent[1][1], shear_plus.shear, shear_minus.shear);
      }
}
} // namespace stockwork::contact_law_test
