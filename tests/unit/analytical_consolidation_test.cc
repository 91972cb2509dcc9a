#include "reference_table.h"
#include "verification/analytical/column.h"
#include "verification/analytical/mandel.h"

#include <doctest/doctest.h>

#include <cmath>

namespace stockwork::analytical_consolidation_test
{
using namespace stockwork::analytical;
using stockwork::test::ReferenceTable;
using stockwork::test::RelativeTo;

namespace
{
PoroelasticMedium medium(const ReferenceTable &table, const double poisson_ratio)
{
  return {table.parameter("E"),      poisson_ratio,        table.parameter("alpha"),
          1. / table.parameter("Q"), table.parameter("k"), table.parameter("mu")};
}

Column column(const ReferenceTable &table, const ColumnParameters::Kind kind)
{
  const bool rod = kind == ColumnParameters::Kind::rod;
  return Column({kind, medium(table, rod ? 0. : table.parameter("nu")), table.parameter("L"),
                 table.parameter("P0")});
}

MandelParameters mandel(const ReferenceTable &table)
{
  return {block_rock(medium(table, table.parameter("nu"))), table.parameter("a"),
          table.parameter("b"), table.parameter("F")};
}
} // namespace

// The tables hold eight digits, so the last one is worth up to 5e-8.
constexpr double digits = 6e-8;

TEST_CASE("column: pressure and displacement")
{
  using Kind = ColumnParameters::Kind;
  for (const auto &[name, kind] :
       {std::pair{"column_rod_sun_profiles", Kind::rod},
        std::pair{"column_ps_nu04_profiles", Kind::uniaxial_strain},
        std::pair{"column_ps_incompressible_profiles", Kind::uniaxial_strain}})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const Column solution = column(table, kind);
    CHECK_COLUMN(table, "p_Pa", digits, RelativeTo::largest,
                 [&](const auto i) { return solution.pressure(table(i, "z_m"), table(i, "t_s")); });
    CHECK_COLUMN(table, "u_m", digits, RelativeTo::largest,
                 [&](const auto i)
                 { return solution.displacement(table(i, "z_m"), table(i, "t_s")); });
  }
}

TEST_CASE("column: histories from the undrained to the drained state")
{
  using Kind = ColumnParameters::Kind;
  for (const auto &[name, kind] : {std::pair{"column_rod_sun_history", Kind::rod},
                                   std::pair{"column_ps_nu04_history", Kind::uniaxial_strain}})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const Column solution = column(table, kind);
    CHECK_COLUMN(table, "p_base_Pa", digits, RelativeTo::largest,
                 [&](const auto i) { return solution.base_pressure(table(i, "t_s")); });
    CHECK_COLUMN(table, "u_top_m", digits, RelativeTo::each,
                 [&](const auto i) { return solution.top_displacement(table(i, "t_s")); });
  }
}

TEST_CASE("column: limits, and no permeability")
{
  const ReferenceTable table("column_undrained_limit");
  std::vector<Column> columns, impermeable;
  for (std::size_t i = 0; i < table.rows(); ++i)
  {
    const bool rod = table(i, "nu") < 0.;
    ColumnParameters parameters{rod ? ColumnParameters::Kind::rod
                                    : ColumnParameters::Kind::uniaxial_strain,
                                {table(i, "E_Pa"), rod ? 0. : table(i, "nu"), table(i, "alpha"),
                                 1. / table(i, "Q_Pa"), 1e-12, 1e-3},
                                table(i, "L_m"),
                                table(i, "P0_Pa")};
    columns.emplace_back(parameters);
    parameters.medium.permeability = 0.;
    impermeable.emplace_back(parameters);
  }
  const auto each = RelativeTo::each;
  CHECK_COLUMN(table, "p0_undrained_Pa", digits, each,
               [&](const auto i) { return columns[i].undrained_pressure(); });
  CHECK_COLUMN(table, "u_top_undrained_m", digits, RelativeTo::largest,
               [&](const auto i) { return columns[i].undrained_top_displacement(); });
  CHECK_COLUMN(table, "u_top_drained_m", digits, each,
               [&](const auto i) { return columns[i].drained_top_displacement(); });
  CHECK_COLUMN(table, "p0_undrained_Pa", digits, each,
               [&](const auto i) { return impermeable[i].pressure(0.3 * table(i, "L_m"), 1e9); });
  CHECK_COLUMN(table, "u_top_undrained_m", digits, RelativeTo::largest,
               [&](const auto i)
               { return impermeable[i].displacement(0.5 * table(i, "L_m"), 1e9) * 2.; });
}

TEST_CASE("column: images and Fourier series meet")
{
  const ReferenceTable table("column_rod_sun_history");
  const Column solution = column(table, ColumnParameters::Kind::rod);
  const double t = 0.1 * 15. * 15. / solution.diffusivity();
  for (const double z : {0.5, 4., 11., 15.})
  {
    CHECK(solution.pressure(z, t * (1. - 1e-14)) ==
          doctest::Approx(solution.pressure(z, t * (1. + 1e-14))).epsilon(1e-12));
    CHECK(solution.displacement(z, t * (1. - 1e-14)) ==
          doctest::Approx(solution.displacement(z, t * (1. + 1e-14))).epsilon(1e-12));
  }
}

TEST_CASE("Mandel: profiles")
{
  for (const char *name :
       {"mandel_classic_profiles", "mandel_incompressible_profiles", "mandel_soft_profiles"})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const MandelParameters parameters = mandel(table);
    const Mandel solution(parameters);
    const auto now = [&](const auto i) { return solution.at(table(i, "t_s")); };
    const auto largest = RelativeTo::largest;
    CHECK_COLUMN(table, "p_Pa", digits, largest,
                 [&](const auto i) { return now(i).pressure(table(i, "x_m")); });
    CHECK_COLUMN(table, "ux_m", digits, largest,
                 [&](const auto i) { return now(i).displacement_x(table(i, "x_m")); });
    CHECK_COLUMN(table, "uy_plate_m", digits, largest,
                 [&](const auto i) { return now(i).displacement_y(parameters.half_height); });
    CHECK_COLUMN(table, "sigma_yy_Pa", digits, largest,
                 [&](const auto i) { return now(i).stress_yy(table(i, "x_m")); });
  }
}

TEST_CASE("Mandel: histories and the undrained state")
{
  for (const char *name : {"mandel_classic_history", "mandel_rock_history"})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const MandelParameters parameters = mandel(table);
    const Mandel solution(parameters);
    CHECK_COLUMN(table, "p_centre_Pa", digits, RelativeTo::largest,
                 [&](const auto i) { return solution.at(table(i, "t_s")).pressure(0.); });
    CHECK_COLUMN(table, "ux_edge_m", digits, RelativeTo::each,
                 [&](const auto i)
                 { return solution.at(table(i, "t_s")).displacement_x(parameters.half_width); });

    // Values at t = 0+ stand in the header: p(x,0+), u_x(a,0+), u_y(b,0+).
    const auto start = solution.at(0.);
    CHECK(start.pressure(0.2) == doctest::Approx(table.parameter("p(x,0+)")).epsilon(1e-7));
    CHECK(start.displacement_x(parameters.half_width) ==
          doctest::Approx(table.parameter("u_x(a,0+)")).epsilon(1e-7));
    CHECK(start.displacement_y(parameters.half_height) ==
          doctest::Approx(table.parameter("u_y(b,0+)")).epsilon(1e-7));

    // The series reaches the undrained state as the square root of time.
    const double t = 1e-6 * parameters.half_width * parameters.half_width / solution.diffusivity();
    CHECK(solution.at(t).pressure(0.) == doctest::Approx(start.pressure(0.)).epsilon(2e-3));
  }
}

TEST_CASE("Mandel: the plate carries the force at all times")
{
  const PoroelasticMedium medium{1e8, 0.25, 0.5, 1. / 6.06e9, 1e-12, 1e-3};
  const MandelParameters parameters{block_rock(medium), 2., 1., 1e4};
  const Mandel solution(parameters);
  const auto now = solution.at(0.4);
  double sum = 0.;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i)
    sum += now.stress_yy((i + 0.5) / n * parameters.half_width) * parameters.half_width / n;
  CHECK(sum == doctest::Approx(-parameters.force).epsilon(1e-7));
}

TEST_CASE("Mandel: isotropic rock as Cheng and Detournay (1988) have it")
{
  const PoroelasticMedium medium{15.96e9, 0.25, 0.8, 1. / 11.65e9, 1e-14, 1e-3};
  const double a = 1.5, force = 1e6, nu = medium.poisson_ratio,
               nu_u = medium.undrained_poisson_ratio(), shear = medium.shear_modulus();
  const Mandel solution({block_rock(medium), a, 1., force});
  const auto approx = [](const double value) { return doctest::Approx(value).epsilon(1e-12); };
  CHECK(solution.diffusivity() == approx(medium.diffusivity()));
  CHECK(solution.undrained_pressure() ==
        approx(force * medium.skempton_coefficient() * (1. + nu_u) / (3. * a)));
  const auto start = solution.at(0.), end = solution.at(1e9);
  CHECK(start.displacement_x(a) == approx(force * nu_u / (2. * shear)));
  CHECK(start.displacement_y(1.) == approx(-force * (1. - nu_u) / (2. * shear * a)));
  CHECK(end.displacement_x(a) == approx(force * nu / (2. * shear)));
  CHECK(end.displacement_y(1.) == approx(-force * (1. - nu) / (2. * shear * a)));
}

TEST_CASE("Mandel: layered rock obeys the equations of the block")
{
  // Along the plates stiff and permeable; across them; and one in which nu' turns the coupling
  // over.
  for (const BlockRock &rock : {BlockRock{30e9, 4e9, 14e9, 0.8, 1. / 12e9, 1e-16},
                                BlockRock{14e9, 4e9, 30e9, 0.8, 1. / 12e9, 1e-17},
                                BlockRock{10e9, 15e9, 40e9, 0.8, 1. / 12e9, 1e-17}})
  {
    const double a = 0.04, force = 4e5;
    const Mandel solution({rock, a, 0.1, force});
    const double scale = std::abs(solution.undrained_pressure()),
                 unit_time = a * a / solution.diffusivity();
    for (const double time : {0.01, 0.1, 0.7})
    {
      CAPTURE(time);
      const double t = time * unit_time, dt = 1e-4 * t, h = 1e-3 * a;
      const auto before = solution.at(t - dt), now = solution.at(t), after = solution.at(t + dt);
      double carried = 0.;
      constexpr int n = 2000;
      for (int i = 0; i < n; ++i)
      {
        const double x = (i + 0.5) / n * a;
        carried += now.stress_yy(x) * a / n;
        if (i % 400 != 100)
          continue;
        const double p = now.pressure(x), e_yy = now.displacement_y(1.),
                     e_xx = (now.displacement_x(x + h) - now.displacement_x(x - h)) / (2. * h);
        CHECK(std::abs(rock.c_xx * e_xx + rock.c_xy * e_yy - rock.biot_coefficient * p) <
              1e-5 * scale);
        CHECK(std::abs(rock.c_xy * e_xx + rock.c_yy * e_yy - rock.biot_coefficient * p -
                       now.stress_yy(x)) < 1e-5 * scale);
        const auto content = [&](const MandelAtTime &state)
        {
          return rock.inverse_biot_modulus * state.pressure(x) +
                 rock.biot_coefficient *
                   ((state.displacement_x(x + h) - state.displacement_x(x - h)) / (2. * h) +
                    state.displacement_y(1.));
        };
        const double gained = (content(after) - content(before)) / (2. * dt),
                     flows_in = rock.mobility / (h * h) *
                                (now.pressure(x + h) - 2. * p + now.pressure(x - h));
        CHECK(std::abs(gained - flows_in) < 1e-5 * rock.storage() * scale / t);
      }
      CHECK(carried == doctest::Approx(-force).epsilon(1e-6));
      CHECK(std::abs(now.pressure(a)) < 1e-12 * scale);
    }
    // At first no fluid has moved.
    const auto start = solution.at(0.);
    CHECK(std::abs(rock.inverse_biot_modulus * start.pressure(0.) +
                   rock.biot_coefficient * (start.displacement_x(1.) + start.displacement_y(1.))) <
          1e-12 * rock.storage() * scale);
    CHECK(solution.at(1e-6 * unit_time).pressure(0.) ==
          doctest::Approx(solution.undrained_pressure()).epsilon(5e-3));
  }
}
} // namespace stockwork::analytical_consolidation_test
