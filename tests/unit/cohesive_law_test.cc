// The bilinear law: dissipation, mixed mode, unloading, and the tangent against differences.
#include <doctest/doctest.h>

#include "fracture/cohesive_xfem/law.h"

namespace stockwork::cohesive_law_test
{
using namespace stockwork::cohesive_xfem;

namespace
{
const CohesiveLaw law = CohesiveLaw::with_elastic_share(1e6, 1.5e6, 100., 300., 2., 0.01);

/// Work done on the way from zero to `far` in a straight line, and the damage at the end.
double work(const double normal, const double shear, const double far, double &damage)
{
  const unsigned int n = 200000;
  double sum = 0.;
  NormalShear last;
  damage = 0.;
  for (unsigned int i = 1; i <= n; ++i)
  {
    const double d = far * i / n;
    const auto response = law.evaluate({normal * d, shear * d}, damage);
    sum += 0.5 * far / n *
           ((response.traction.normal + last.normal) * normal +
            (response.traction.shear + last.shear) * shear);
    last = response.traction;
    damage = response.damage;
  }
  return sum;
}
} // namespace

TEST_CASE("peak and end of pure opening")
{
  const double start = law.strength / law.stiffness, end = law.critical_opening();
  CHECK(end == doctest::Approx(2e-4));
  CHECK(start == doctest::Approx(0.01 * end));
  CHECK(law.evaluate({start, 0.}, 0.).traction.normal == doctest::Approx(1e6));
  CHECK(law.evaluate({start, 0.}, 0.).damage == 0.);
  CHECK(law.evaluate({0.5 * (start + end), 0.}, 0.).traction.normal == doctest::Approx(0.5e6));
  CHECK(law.evaluate({end, 0.}, 0.).damage == doctest::Approx(1.));
  CHECK(law.evaluate({2. * end, 0.}, 0.).damage == 1.);
}

TEST_CASE("complete separation dissipates the fracture energy of its mode")
{
  for (const double angle : {0., 0.3, 0.8, 1.2, 0.5 * M_PI})
  {
    const double n = std::cos(angle), s = std::sin(angle);
    double damage;
    const double energy = work(n, s, 2e-3, damage);
    CHECK(damage == 1.);
    CHECK(energy == doctest::Approx(100. + 200. * std::pow(s * s, 2.)).epsilon(1e-4));
    CHECK(law.dissipation({n, s}, 1.) == doctest::Approx(energy).epsilon(1e-4));
  }
}

TEST_CASE("half way, the dissipation is the work that cannot be had back")
{
  double damage;
  const double d = 0.7e-4, energy = work(0.8, 0.6, d, damage);
  const auto t = law.evaluate({0.8 * d, 0.6 * d}, damage).traction;
  CHECK(law.dissipation({0.8, 0.6}, damage) ==
        doctest::Approx(energy - 0.5 * (t.normal * 0.8 * d + t.shear * 0.6 * d)).epsilon(1e-4));
}

TEST_CASE("initiation is quadratic")
{
  // On the ellipse (t_n/T)^2 + (t_s/S)^2 = 1 there is no damage, just beyond there is.
  for (const double angle : {0.1, 0.7, 1.4})
  {
    const double n = 1e6 * std::cos(angle) / law.stiffness,
                 s = 1.5e6 * std::sin(angle) / law.stiffness;
    CHECK(law.evaluate({0.9999 * n, 0.9999 * s}, 0.).damage == 0.);
    CHECK(law.evaluate({1.001 * n, 1.001 * s}, 0.).damage > 0.);
  }
}

TEST_CASE(
  "unloading goes to the origin, broken faces are left to contact, compression does no damage")
{
  const auto loaded = law.evaluate({1e-4, 0.}, 0.);
  const auto half = law.evaluate({0.5e-4, 0.}, loaded.damage);
  CHECK(half.damage == loaded.damage);
  CHECK(half.traction.normal == doctest::Approx(0.5 * loaded.traction.normal));
  CHECK(law.evaluate({-1e-5, 0.}, 1.).traction.normal == 0.);
  CHECK(law.evaluate({-1e-5, 0.}, 1.).tangent[0][0] == 0.);
  CHECK(law.evaluate({-1e-5, 0.}, 0.3).traction.normal == doctest::Approx(-0.7e-5 * law.stiffness));
  CHECK(law.evaluate({-1., 0.}, 0.).damage == 0.);
}

TEST_CASE("damage does not heal when the mode changes")
{
  const double damage = law.evaluate({1.5e-4, 0.}, 0.).damage;
  CHECK(law.evaluate({0., 1.5e-4}, damage).damage >= damage);
  CHECK(law.evaluate({0., 3e-4}, damage).damage > damage);
}

TEST_CASE("the tangent is the derivative")
{
  unsigned int softening = 0;
  for (const double damage : {0., 0.3, 0.95, 0.999, 1.})
    for (const double n : {-3e-5, -1e-6, 1e-6, 1.7e-6, 3e-5, 1.4e-4, 1.9e-4, 4e-4})
      for (const double s : {-2e-4, -1e-6, 1.3e-6, 2.5e-5, 1.1e-4, 2.8e-4})
      {
        const auto at = law.evaluate({n, s}, damage);
        softening += at.damage > damage;
        const double h = 1e-12;
        const auto n_up = law.evaluate({n + h, s}, damage).traction,
                   n_down = law.evaluate({n - h, s}, damage).traction;
        const auto s_up = law.evaluate({n, s + h}, damage).traction,
                   s_down = law.evaluate({n, s - h}, damage).traction;
        const double tolerance = 1e-5 * law.stiffness;
        CHECK(std::abs((n_up.normal - n_down.normal) / (2. * h) - at.tangent[0][0]) < tolerance);
        CHECK(std::abs((n_up.shear - n_down.shear) / (2. * h) - at.tangent[1][0]) < tolerance);
        CHECK(std::abs((s_up.normal - s_down.normal) / (2. * h) - at.tangent[0][1]) < tolerance);
        CHECK(std::abs((s_up.shear - s_down.shear) / (2. * h) - at.tangent[1][1]) < tolerance);
      }
  CHECK(softening > 50); // the sweep does reach the branch that matters
}
} // namespace stockwork::cohesive_law_test
