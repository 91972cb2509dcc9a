// A hole in Mohr-Coulomb rock, against tables that were found by other means: an ordinary
// differential equation of the raw equations, and incremental finite elements that know no zones.
#include <doctest/doctest.h>

#include "reference_table.h"
#include "verification/analytical/mohr_coulomb_cavity.h"

#include <cmath>

namespace stockwork::analytical_cavity_test
{
namespace
{
constexpr double degree = 3.14159265358979323846 / 180.;

/// Of plastic radius and wall displacement, relative.
double maximum_difference(const std::string &name, const double cohesion)
{
  const test::ReferenceTable table(name);
  REQUIRE(table.rows() > 20);
  double worst = 0.;
  for (std::size_t row = 0; row < table.rows(); ++row)
  {
    analytical::MohrCoulombCavity cavity(
      {1e10, 0.25, cohesion, 27. * degree, table(row, "psi_deg") * degree, 30e6, 0.1});
    cavity.set_wall_pressure(table(row, "p_wall_Pa"));
    const double u = table(row, "u_wall_m");
    worst = std::max({worst,
                      std::abs(cavity.plastic_radius() / 0.1 / table(row, "R_plastic_over_a") - 1.),
                      std::abs(cavity.displacement(0.1) - u) / std::max(std::abs(u), 1e-4)});
  }
  return worst;
}
} // namespace


TEST_CASE("Mohr-Coulomb cavity: plastic radius and wall displacement as tabled")
{
  for (const char *name : {"cavity_mc_convergence", "cavity_mc_expansion"})
  {
    CHECK(maximum_difference(name, 3e6) < 2e-7);
    CHECK(maximum_difference(name, 3.1e6) > 1e-3);
  }
}


namespace
{
struct Ball
{
  double plastic_radius, wall_stress, wall_displacement;
};

/// The equations of a ball, integrated inwards from an elastic field that is on the verge of
/// yielding at a given radius: equilibrium, yield and the flow of two planes at once, step by step
/// (Runge-Kutta), from the principal stresses alone. Compression positive, displacement outwards.
Ball integrated(const analytical::MohrCoulombCavity::Parameters &p,
                const bool converges,
                const double plastic_radius)
{
  const double sine = std::sin(p.friction_angle), cosine = std::cos(p.friction_angle);
  // f of strength.h for compression-positive s_r and s_theta
  const auto excess = [&](const double radial, const double hoop)
  { return std::abs(hoop - radial) - (hoop + radial) * sine - 2. * p.cohesion * cosine; };
  // Elastic: s_r = p0 + d, s_theta = p0 - d/2. The d with which it yields, by halving.
  double low = 0., high = (converges ? -1. : 10.) * p.in_situ;
  for (int i = 0; i < 200; ++i)
  {
    const double d = 0.5 * (low + high);
    (excess(p.in_situ + d, p.in_situ - 0.5 * d) < 0. ? low : high) = d;
  }
  const double shear = p.young_modulus / (2. * (1. + p.poisson_ratio));
  double radial = p.in_situ + low, u = low * plastic_radius / (4. * shear);

  const auto hoop_at_yield = [&](const double s)
  {
    double inside = s, outside = converges ? 100. * (s + p.in_situ) : -100. * p.in_situ;
    for (int i = 0; i < 100; ++i)
    {
      const double middle = 0.5 * (inside + outside);
      (excess(s, middle) < 0. ? inside : outside) = middle;
    }
    return inside;
  };
  const double sine_psi = std::sin(p.dilation_angle);
  const auto slopes = [&](const double r, const double s, const double moved)
  {
    const double hoop = hoop_at_yield(s), nu = p.poisson_ratio;
    const double elastic_r = -((s - p.in_situ) - 2. * nu * (hoop - p.in_situ)) / p.young_modulus,
                 elastic_t =
                   -((1. - nu) * (hoop - p.in_situ) - nu * (s - p.in_situ)) / p.young_modulus;
    // Either plane flows by (1 + sin psi) across the greater tension, -(1 - sin psi) across the
    // lesser.
    const double plastic_t = moved / r - elastic_t;
    const double per_hoop =
      converges ? -2. * (1. + sine_psi) / (1. - sine_psi) : -2. * (1. - sine_psi) / (1. + sine_psi);
    return std::make_pair(2. * (hoop - s) / r, elastic_r + per_hoop * plastic_t);
  };
  constexpr int n = 2000;
  const double h = -(plastic_radius - p.radius) / n;
  for (int i = 0; i < n; ++i)
  {
    const double r = plastic_radius + i * h;
    const auto [s1, u1] = slopes(r, radial, u);
    const auto [s2, u2] = slopes(r + 0.5 * h, radial + 0.5 * h * s1, u + 0.5 * h * u1);
    const auto [s3, u3] = slopes(r + 0.5 * h, radial + 0.5 * h * s2, u + 0.5 * h * u2);
    const auto [s4, u4] = slopes(r + h, radial + h * s3, u + h * u3);
    radial += h / 6. * (s1 + 2. * s2 + 2. * s3 + s4);
    u += h / 6. * (u1 + 2. * u2 + 2. * u3 + u4);
  }
  return {plastic_radius, radial, u};
}
} // namespace


TEST_CASE("Mohr-Coulomb cavity: a ball as its equations, integrated")
{
  for (const bool converges : {true, false})
    for (const double psi : {0., 8., 27.})
      for (const double share : {1.05, 1.3})
      {
        CAPTURE(converges);
        CAPTURE(psi);
        analytical::MohrCoulombCavity::Parameters p{1e10,         0.25, 3e6, 27. * degree,
                                                    psi * degree, 30e6, 0.1, 2};
        const Ball ball = integrated(p, converges, share * p.radius);
        REQUIRE(ball.wall_stress > 0.);
        analytical::MohrCoulombCavity cavity(p);
        cavity.set_wall_pressure(ball.wall_stress);
        CHECK(cavity.plastic_radius() == doctest::Approx(ball.plastic_radius).epsilon(1e-9));
        CHECK(cavity.displacement(p.radius) ==
              doctest::Approx(ball.wall_displacement).epsilon(1e-9));
        p.n_hoop = 1;
        analytical::MohrCoulombCavity other(p);
        other.set_wall_pressure(ball.wall_stress);
        CHECK(std::abs(other.displacement(p.radius) / ball.wall_displacement - 1.) > 0.05);
      }
}
} // namespace stockwork::analytical_cavity_test
