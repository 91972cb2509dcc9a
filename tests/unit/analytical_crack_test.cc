#include "reference_table.h"
#include "verification/analytical/crack_in_box.h"
#include "verification/analytical/line_crack.h"
#include "verification/analytical/parallel_cracks.h"

#include <doctest/doctest.h>

namespace stockwork::analytical_crack_test
{
using namespace stockwork::analytical;
using stockwork::test::ReferenceTable;
using stockwork::test::RelativeTo;

namespace
{
constexpr double pi = 3.14159265358979323846;

// The tables hold eight digits.
constexpr double digits = 6e-8;

LineCrack line(const ReferenceTable &summary, const std::size_t i)
{
  return LineCrack({summary(i, "E_Pa"), summary(i, "nu"), summary(i, "half_length_or_radius_m"),
                    summary(i, "p_Pa")});
}

PennyCrack penny(const ReferenceTable &summary, const std::size_t i)
{
  return PennyCrack({summary(i, "E_Pa"), summary(i, "nu"), summary(i, "half_length_or_radius_m"),
                     summary(i, "p_Pa")});
}
} // namespace

TEST_CASE("pressurised line and penny cracks")
{
  const ReferenceTable table("crack_pressurised_summary");
  const auto is_line = [&](const auto i) { return table.text(i, "type") == "line"; };
  const auto each = RelativeTo::each;
  CHECK_COLUMN(table, "w0_m", digits, each,
               [&](const auto i)
               { return is_line(i) ? line(table, i).opening(0.) : penny(table, i).opening(0.); });
  CHECK_COLUMN(table, "volume_m2_or_m3", digits, each,
               [&](const auto i)
               { return is_line(i) ? line(table, i).volume() : penny(table, i).volume(); });
  CHECK_COLUMN(table, "KI_Pa_sqrt_m", digits, each,
               [&](const auto i)
               {
                 return is_line(i) ? line(table, i).stress_intensity().mode_I
                                   : penny(table, i).stress_intensity();
               });
  CHECK_COLUMN(table, "G_J_per_m2", digits, each,
               [&](const auto i)
               {
                 return is_line(i) ? line(table, i).energy_release_rate()
                                   : penny(table, i).energy_release_rate();
               });

  const ReferenceTable profiles("crack_pressurised_profiles");
  // Near the tip the eight digits of x cost one or two of w.
  CHECK_COLUMN(profiles, "w_m", 1e-6, RelativeTo::largest,
               [&](const auto i)
               {
                 const int number = static_cast<int>(profiles(i, "case"));
                 const double x = profiles(i, "x_or_r_m");
                 return number > 100 ? penny(table, 3).opening(x)
                                     : line(table, number - 1).opening(x);
               });
}

TEST_CASE("inclined crack: stress intensities and kink")
{
  const double degree = pi / 180.;
  const auto crack = [&](const double angle, const double p, const double sxx, const double syy)
  {
    const PlaneTraction t = traction_on_plane(sxx, syy, 0., angle * degree);
    return LineCrack({1e10, 0.25, 0.5, p + t.normal, t.shear, angle * degree});
  };
  const auto largest = RelativeTo::largest;

  const ReferenceTable tension("crack_inclined_tension");
  const auto stretched = [&](const auto i)
  { return crack(tension(i, "angle_to_x_deg"), 0., 0., 1e7).stress_intensity(); };
  CHECK_COLUMN(tension, "KI_Pa_sqrt_m", digits, largest,
               [&](const auto i) { return stretched(i).mode_I; });
  CHECK_COLUMN(tension, "KII_Pa_sqrt_m", digits, largest,
               [&](const auto i) { return stretched(i).mode_II; });
  CHECK_COLUMN(tension, "kink_max_hoop_deg", digits, largest,
               [&](const auto i) { return stretched(i).kink_angle() / degree; });

  const ReferenceTable pressurised("crack_inclined_pressurised");
  const auto opened = [&](const auto i)
  { return crack(pressurised(i, "angle_to_x_deg"), 1.2e7, -1e7, -5e6).stress_intensity(); };
  CHECK_COLUMN(pressurised, "KI_Pa_sqrt_m", digits, largest,
               [&](const auto i) { return opened(i).mode_I; });
  CHECK_COLUMN(pressurised, "KII_Pa_sqrt_m", digits, largest,
               [&](const auto i) { return opened(i).mode_II; });
  CHECK_COLUMN(pressurised, "kink_max_hoop_deg", digits, largest,
               [&](const auto i) { return opened(i).kink_angle() / degree; });
}

TEST_CASE("line crack: the displacement field jumps by opening and slip and is in equilibrium")
{
  const double angle = 0.4, c = std::cos(angle), s = std::sin(angle);
  const LineCrack crack({1e10, 0.2, 0.7, 2e6, 1e6, angle, 0.3, -0.1});
  for (const double position : {-0.6, 0., 0.45})
  {
    const double tiny = 1e-12;
    const double x = 0.3 + position * c;
    const double y = -0.1 + position * s;
    const auto upper = crack.displacement(x - tiny * s, y + tiny * c);
    const auto lower = crack.displacement(x + tiny * s, y - tiny * c);
    const double jump_x = upper[0] - lower[0], jump_y = upper[1] - lower[1];
    CHECK(-s * jump_x + c * jump_y == doctest::Approx(crack.opening(position)).epsilon(1e-6));
    CHECK(c * jump_x + s * jump_y == doctest::Approx(crack.slip(position)).epsilon(1e-6));
  }

  // Navier's equation, (1/(1 - 2 nu)) grad div u + laplace u = 0, by central differences.
  const double h = 1e-3, x = 0.9, y = 0.4;
  const auto u = [&](const int i, const int j, const int component)
  { return crack.displacement(x + i * h, y + j * h)[component]; };
  const double factor = 1. / (1. - 2. * 0.2);
  double scale = 0.;
  double force[2];
  for (int k : {0, 1})
  {
    const double along = k == 0 ? u(1, 0, 0) - 2 * u(0, 0, 0) + u(-1, 0, 0)
                                : u(0, 1, 1) - 2 * u(0, 0, 1) + u(0, -1, 1);
    const double across = k == 0 ? u(0, 1, 0) - 2 * u(0, 0, 0) + u(0, -1, 0)
                                 : u(1, 0, 1) - 2 * u(0, 0, 1) + u(-1, 0, 1);
    const double mixed =
      0.25 * (u(1, 1, 1 - k) - u(1, -1, 1 - k) - u(-1, 1, 1 - k) + u(-1, -1, 1 - k));
    force[k] = (1. + factor) * along + across + factor * mixed;
    scale = std::max(scale, std::abs(along));
  }
  CHECK(std::abs(force[0]) < 1e-4 * scale);
  CHECK(std::abs(force[1]) < 1e-4 * scale);
}

TEST_CASE("penny crack: the displacement field opens the crack, is in equilibrium and fades")
{
  const double nu = 0.2, radius = 0.7;
  const PennyCrack crack({1e10, nu, radius, 2e6});
  for (const double r : {0., 0.3, 0.65})
    CHECK(2. * crack.displacement(r, 1e-12)[1] == doctest::Approx(crack.opening(r)).epsilon(1e-6));
  CHECK(std::abs(crack.displacement(0.8, 1e-12)[1]) < 1e-9 * crack.opening(0.));

  const auto at = [&](const double x, const double y, const double z)
  {
    const double r = std::hypot(x, y);
    const auto u = crack.displacement(r, z);
    return std::array<double, 3>{{u[0] * x / r, u[0] * y / r, u[1]}};
  };
  // Navier's equation by central differences, beside and above the crack's edge.
  const double h = 1e-3;
  for (const double z : {0.4, -0.2})
  {
    const auto u = [&](const int i, const int j, const int k, const int component)
    { return at(0.5 + i * h, 0.3 + j * h, z + k * h)[component]; };
    const auto second = [&](const int a, const int b, const int component)
    {
      const auto moved = [&](const int s, const int t)
      {
        int by[3] = {0, 0, 0};
        by[a] += s;
        by[b] += t;
        return u(by[0], by[1], by[2], component);
      };
      return a == b ? moved(1, 0) - 2. * moved(0, 0) + moved(-1, 0)
                    : 0.25 * (moved(1, 1) - moved(1, -1) - moved(-1, 1) + moved(-1, -1));
    };
    for (const int c : {0, 1, 2})
    {
      double force = 0., scale = 0.;
      for (const int d : {0, 1, 2})
      {
        force += second(c, d, d) / (1. - 2. * nu) + second(d, d, c);
        scale = std::max(scale, std::abs(second(d, d, c)));
      }
      CHECK(std::abs(force) < 1e-4 * scale);
    }
  }

  // No shear on the crack's plane, and p on its faces.
  const double lambda = 1e10 * nu / ((1. + nu) * (1. - 2. * nu)), G = 1e10 / (2. * (1. + nu));
  const double d = 1e-5, z = 2e-5;
  const auto slope = [&](const int c, const int axis)
  {
    const double x = 0.3, y = 0.1;
    const auto ahead = at(x + (axis == 0) * d, y + (axis == 1) * d, z + (axis == 2) * d);
    const auto behind = at(x - (axis == 0) * d, y - (axis == 1) * d, z - (axis == 2) * d);
    return (ahead[c] - behind[c]) / (2. * d);
  };
  const double divergence = slope(0, 0) + slope(1, 1) + slope(2, 2);
  CHECK(lambda * divergence + 2. * G * slope(2, 2) == doctest::Approx(-2e6).epsilon(1e-3));
  CHECK(std::abs(G * (slope(0, 2) + slope(2, 0))) < 1e-3 * 2e6);

  // Far away as 1/r^2.
  CHECK(at(0., 40., 30.)[2] == doctest::Approx(0.25 * at(0., 20., 15.)[2]).epsilon(0.01));
}

TEST_CASE("crack between rollers")
{
  const ReferenceTable table("crack_box_rollers");
  const LineCrack unbounded({1., 0.25, 1., 1.});
  const auto crack = [&](const auto i)
  {
    const double a = table(i, "a_over_W") * table(i, "W");
    return CrackInBox({1., 0.25, 1., table(i, "W") / a, table(i, "H") / a, 1.});
  };
  const auto each = RelativeTo::each;
  CHECK_COLUMN(table, "K_over_Kinf", 1e-7, each,
               [&](const auto i)
               { return crack(i).stress_intensity() / unbounded.stress_intensity().mode_I; });
  CHECK_COLUMN(table, "V_over_Vinf", 1e-7, each,
               [&](const auto i) { return crack(i).volume() / unbounded.volume(); });
  CHECK_COLUMN(table, "w0_over_w0inf", 1e-7, each,
               [&](const auto i) { return crack(i).opening(0.) / unbounded.opening(0.); });
}

TEST_CASE("crack in a high box is one of a row of collinear cracks")
{
  const ReferenceTable table("crack_strip_corrections");
  const auto crack = [&](const auto i) {
    return CrackInBox({1., 0.25, table(i, "a_over_W"), 1., 1e9, 1.});
  };
  CHECK_COLUMN(table, "K_rollers_sides", 1e-7, RelativeTo::each,
               [&](const auto i)
               { return crack(i).stress_intensity() / std::sqrt(pi * table(i, "a_over_W")); });
  CHECK_COLUMN(
    table, "w0_rollers_sides", 1e-7, RelativeTo::each,
    [&](const auto i) {
      return crack(i).opening(0.) / LineCrack({1., 0.25, table(i, "a_over_W"), 1.}).opening(0.);
    });
}

TEST_CASE("parallel cracks")
{
  const ReferenceTable table("parallel_cracks");
  const LineCrack single({1e10, 0.25, 2., 3e6});
  const double K = single.stress_intensity().mode_I;
  const auto cracks = [&](const unsigned int n)
  {
    std::vector<ParallelCracks> solutions;
    for (std::size_t i = 0; i < table.rows(); ++i)
      solutions.push_back(ParallelCracks({1e10, 0.25, 2., 2. * table(i, "d_over_a"), 3e6, n}));
    return solutions;
  };
  const auto pair = cracks(2), triple = cracks(3);
  const auto each = RelativeTo::each;
  CHECK_COLUMN(table, "KI", digits, each,
               [&](const auto i) { return pair[i].stress_intensity(1).mode_I / K; });
  CHECK_COLUMN(table, "KII", digits, each,
               [&](const auto i) { return pair[i].stress_intensity(1).mode_II / K; });
  CHECK_COLUMN(table, "V", digits, each,
               [&](const auto i) { return pair[i].volume(1) / single.volume(); });
  CHECK_COLUMN(table, "w0", digits, each,
               [&](const auto i) { return pair[i].opening(1, 0.) / single.opening(0.); });
  CHECK_COLUMN(table, "kink_deg", digits, each,
               [&](const auto i) { return pair[i].stress_intensity(1).kink_angle() * 180. / pi; });
  CHECK_COLUMN(table, "KI3_outer", digits, each,
               [&](const auto i) { return triple[i].stress_intensity(2).mode_I / K; });
  CHECK_COLUMN(table, "KII3_outer", digits, each,
               [&](const auto i) { return triple[i].stress_intensity(2).mode_II / K; });
  CHECK_COLUMN(table, "KI3_mid", digits, each,
               [&](const auto i) { return triple[i].stress_intensity(1).mode_I / K; });
  CHECK_COLUMN(table, "V3_mid", digits, each,
               [&](const auto i) { return triple[i].volume(1) / single.volume(); });
  CHECK(pair[0].stress_intensity(0).mode_II ==
        doctest::Approx(-pair[0].stress_intensity(1).mode_II));
  const ParallelCracks one({1e10, 0.25, 2., 1., 3e6, 1});
  CHECK(one.opening(0, 1.2) == doctest::Approx(single.opening(1.2)).epsilon(1e-12));
}
} // namespace stockwork::analytical_crack_test
