// Continuous sources in an unbounded body: the equations that define them.
#include <doctest/doctest.h>

#include "verification/analytical/continuous_source.h"

#include "verification/analytical/constants.h"

#include <cmath>

namespace stockwork::analytical_source_test
{
using analytical::ContinuousSource;
using analytical::PoroelasticMedium;
using doctest::Approx;

TEST_CASE("a continuous source diffuses, is fed at its rate and swells the rock by its pressure")
{
  using Shape = ContinuousSource::Shape;
  const PoroelasticMedium medium{20e9, 0.2, 0.8, 1. / 15e9, 1e-14, 1e-3};
  for (const Shape shape : {Shape::line, Shape::point})
  {
    const ContinuousSource source{shape, medium};
    const unsigned int n = shape == Shape::line ? 1 : 2; // powers of r in the circumference
    const double c = medium.diffusivity(), t = 1e4, h = 1e-3;
    for (const double r : {3., 20., 60.})
    {
      const auto p = [&](const double factor_r, const double factor_t)
      { return source.pressure(r * factor_r, t * factor_t); };
      const double rate = (p(1., 1. + h) - p(1., 1. - h)) / (2. * h * t);
      const double slope = (p(1. + h, 1.) - p(1. - h, 1.)) / (2. * h * r);
      const double second = (p(1. + h, 1.) - 2. * p(1., 1.) + p(1. - h, 1.)) / (h * h * r * r);
      CHECK(rate == Approx(c * (second + n * slope / r)).epsilon(1e-4));
      // (lambda + 2G) div u = alpha p
      const auto u = [&](const double factor) { return source.displacement(r * factor, t); };
      const double divergence = (u(1. + h) - u(1. - h)) / (2. * h * r) + n * u(1.) / r;
      CHECK(medium.uniaxial_modulus() * divergence ==
            Approx(medium.biot_coefficient * p(1., 1.)).epsilon(1e-4));
    }
    // What flows out of a small circle or sphere is what is injected.
    const double r = 1e-3;
    const double slope =
      (source.pressure(r * (1. + h), t) - source.pressure(r * (1. - h), t)) / (2. * h * r);
    const double surface = (shape == Shape::line ? 2. : 4. * r) * analytical::pi * r;
    CHECK(-surface * medium.permeability / medium.viscosity * slope == Approx(1.).epsilon(1e-5));
    CHECK(source.pressure(1., 0.) == 0.);
    CHECK(source.displacement(1., -1.) == 0.);
  }
}
} // namespace stockwork::analytical_source_test
