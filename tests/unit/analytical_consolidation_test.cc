#include "reference_table.h"
#include "verification/analytical/column.h"
#include "verification/analytical/mandel.h"

#include <doctest/doctest.h>

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
  return {medium(table, table.parameter("nu")), table.parameter("a"), table.parameter("b"),
          table.parameter("F")};
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
  const MandelParameters parameters{{1e8, 0.25, 0.5, 1. / 6.06e9, 1e-12, 1e-3}, 2., 1., 1e4};
  const Mandel solution(parameters);
  const auto now = solution.at(0.4);
  double sum = 0.;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i)
    sum += now.stress_yy((i + 0.5) / n * parameters.half_width) * parameters.half_width / n;
  CHECK(sum == doctest::Approx(-parameters.force).epsilon(1e-7));
}
} // namespace stockwork::analytical_consolidation_test
