#include <doctest/doctest.h>

#include "flow/conductivity.h"
#include "flow/leak_off.h"
#include "flow/time_history.h"
#include "stockwork/base/error.h"

namespace stockwork::flow_laws_test
{
using doctest::Approx;

TEST_CASE("the hydraulic aperture is a smooth maximum")
{
  const double w_min = 10e-6;
  CHECK(hydraulic_aperture_cubed(-1e-3, w_min).value == Approx(1e-15));
  CHECK(hydraulic_aperture_cubed(0., w_min).value == Approx(1e-15));
  CHECK(hydraulic_aperture_cubed(w_min, w_min).value == Approx(1e-15 * std::pow(2., 0.75)));
  // wide open: the cubic law itself, up to (w_min/w)^4 * 3/4
  CHECK(hydraulic_aperture_cubed(1e-3, w_min).value == Approx(1e-9).epsilon(1e-8));
  CHECK(std::cbrt(hydraulic_aperture_cubed(3. * w_min, w_min).value) / (3. * w_min) ==
        Approx(1.003).epsilon(1e-3));

  for (const double w : {1e-7, 5e-6, 1e-5, 2e-5, 1e-4, 1e-2})
  {
    const double h = 1e-5 * w;
    const double difference = (hydraulic_aperture_cubed(w + h, w_min).value -
                               hydraulic_aperture_cubed(w - h, w_min).value) /
                              (2. * h);
    CHECK(hydraulic_aperture_cubed(w, w_min).slope ==
          Approx(difference).epsilon(w > 1e-6 ? 1e-8 : 1e-2));
  }
  CHECK(hydraulic_aperture_cubed(-1e-4, w_min).slope == 0.);
}

TEST_CASE("transmissibility between two segments")
{
  const double w = 1e-3, mu = 1e-3, length = 2., width = 3.;
  const auto T = [&](const double w_i, const double w_j, const double d_i)
  { return cubic_law(w_i, w_j, d_i, length - d_i, width, mu, 1e-9); };
  CHECK(T(w, w, 0.7).value == Approx(width * w * w * w / (12. * mu * length)));

  // 1.25 mm at an edge that is nearer to the segment of 1 mm
  CHECK(T(1e-3, 2e-3, 0.5).value == Approx(width * std::pow(1.25e-3, 3) / (12. * mu * length)));

  // A closed tip takes in fluid.
  CHECK(T(1e-3, 0., 1.).value == Approx(width * std::pow(0.5e-3, 3) / (12. * mu * length)));

  const double h = 1e-9;
  CHECK(
    T(1e-3, 2e-3, 0.5).slope_i ==
    Approx((T(1e-3 + h, 2e-3, 0.5).value - T(1e-3 - h, 2e-3, 0.5).value) / (2. * h)).epsilon(1e-7));
  CHECK(
    T(1e-3, 2e-3, 0.5).slope_j ==
    Approx((T(1e-3, 2e-3 + h, 0.5).value - T(1e-3, 2e-3 - h, 0.5).value) / (2. * h)).epsilon(1e-7));
}

TEST_CASE("the flow out of the last segment, with the pressure of a viscous tip")
{
  // p = -x^(-1/3), x from the tip; means by Simpson's rule in s, x = s^3
  const auto mean = [](const double from, const double to)
  {
    const auto f = [](const double s) { return -3. * s; }; // p dx/ds, dx = 3 s^2 ds
    const double a = std::cbrt(from), b = std::cbrt(to);
    return (b - a) / 6. * (f(a) + 4. * f(0.5 * (a + b)) + f(b)) / (to - from);
  };
  for (const double next : {0.5, 1., 2.})
  {
    const double tip = 0.8;
    const double quotient = (mean(tip, tip + next) - mean(0., tip)) / (0.5 * (tip + next));
    const double gradient = std::pow(tip, -4. / 3.) / 3.;
    CHECK(tip_gradient_factor(0.5 * tip, 0.5 * next) * quotient == Approx(gradient));
  }
}

TEST_CASE("Carter leak-off is integrated exactly")
{
  const double C = 2e-5, exposed = 3.;
  // midpoint rule on C/sqrt(t - t0), away from the singularity
  double integral = 0.;
  const int n = 100000;
  for (int k = 0; k < n; ++k)
    integral += C / std::sqrt(5. + (k + 0.5) * 2. / n - exposed) * 2. / n;
  CHECK(carter_volume(C, 5. - exposed, 7. - exposed) == Approx(integral).epsilon(1e-9));
  // since the exposure, and not at all
  CHECK(carter_volume(C, 0., 4.) == Approx(2. * C * 2.));
  CHECK(carter_volume(C, 0., 0.) == 0.);
  // steps add up
  CHECK(carter_volume(C, 0., 1.) + carter_volume(C, 1., 4.) == Approx(carter_volume(C, 0., 4.)));
}

TEST_CASE("nothing leaks from a closed fracture")
{
  const double w_min = 10e-6, h = 1e-9;
  CHECK(wetted_share(-1e-5, w_min).value == 0.);
  CHECK(wetted_share(5e-6, w_min).value == Approx(0.5));
  CHECK(wetted_share(2e-5, w_min).value == 1.);
  CHECK(wetted_share(2e-5, w_min).slope == 0.);
  for (const double w : {1e-6, 4e-6, 9e-6})
    CHECK(wetted_share(w, w_min).slope ==
          Approx((wetted_share(w + h, w_min).value - wetted_share(w - h, w_min).value) / (2. * h))
            .epsilon(1e-6));
}

TEST_CASE("histories in time")
{
  const auto history = [](const std::string &text)
  { return TimeHistory(text, dimension::rate_per_thickness, "Wells/Well 1/Rate"); };
  CHECK(history("2e-4 m^2/s")(0., 1.) == 2e-4);
  CHECK(history("2e-4 m^2/s").next_jump(0.) == std::numeric_limits<double>::infinity());

  const auto pieces = history("10 s: 4; 1 min: 0; 2 min: -1");
  CHECK(pieces(0., 10.) == 0.);
  CHECK(pieces(10., 20.) == 4.);
  CHECK(pieces(50., 70.) == Approx(2.)); // the mean: no volume is lost
  CHECK(pieces(5., 130.) == Approx((50. * 4. - 10.) / 125.));
  CHECK(pieces(200., 300.) == -1.);
  CHECK(pieces.next_jump(0.) == 10.);
  CHECK(pieces.next_jump(10.) == 60.);
  CHECK(pieces.next_jump(120.) == std::numeric_limits<double>::infinity());
  CHECK(pieces.rises_from_zero(10.));
  CHECK_FALSE(pieces.rises_from_zero(5.));
  CHECK_FALSE(pieces.rises_from_zero(60.));
  CHECK_FALSE(pieces.rises_from_zero(120.)); // to production
  CHECK(history("0 s: 0; 1 h: 1e-4").rises_from_zero(3600. * (1. + 1e-15)));
  CHECK_FALSE(history("0 s: 1; 1 h: 2").rises_from_zero(3600.));
  CHECK_FALSE(history("f(t) = if(t < 5, 0, 1e-4)").rises_from_zero(5.)); // its jumps are unknown

  const auto ramp = history("f(t) = 1e-4*min(t/10, 1)");
  CHECK(ramp(4., 5.) == Approx(5e-5));
  CHECK(ramp.mean(4., 5.) == Approx(4.5e-5));
  CHECK(pieces.mean(50., 70.) == Approx(2.));
  CHECK(history("f(t) = if(t < 4.5, 2, 0)").mean(4., 5.) == Approx(1.));
  CHECK_THROWS_AS(history("f(t) = sqrt(1 - t)").mean(1., 2.), stockwork::SolveError);

  for (const std::string bad : {"2 MPa", "fast", "0 s: 1; 1", "2 s: 1; 1 s: 0", "f(t) = 2*x", ""})
    CHECK_THROWS_WITH_AS(history(bad), doctest::Contains("Wells/Well 1/Rate"), EntryError);
}
} // namespace stockwork::flow_laws_test
