#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include "reference_table.h"
#include "verification/analytical/kgd_history.h"

#include <doctest/doctest.h>

using namespace stockwork::analytical;
using stockwork::test::ReferenceTable;
using stockwork::test::RelativeTo;

TEST_CASE("KGD with Carter leak-off, from strong efficiency to almost none")
{
  const double tolerance = 5e-4;
  for (const char *name : {"kgd_sun_carter", "kgd_carter_strong"})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const double E = table.parameter("E"), nu = table.parameter("nu");
    const KgdHistory fracture(
      {{E, nu, table.parameter("mu"), std::sqrt(E / (1. - nu * nu) * table.parameter("Gc")),
        table.parameter("Q0")},
       table.parameter("C_L")},
      table(table.rows() - 1, "t_s"));
    const auto time = [&](const auto i) { return table(i, "t_s"); };
    const auto each = RelativeTo::each;
    CHECK_COLUMN(table, "l_m", tolerance, each,
                 [&](const auto i) { return fracture.half_length(time(i)); });
    CHECK_COLUMN(table, "w0_m", tolerance, each,
                 [&](const auto i) { return fracture.inlet_opening(time(i)); });
    CHECK_COLUMN(table, "p0_Pa", tolerance, each,
                 [&](const auto i) { return fracture.inlet_pressure(time(i)); });
    CHECK_COLUMN(table, "V_fracture_m2", tolerance, each,
                 [&](const auto i) { return fracture.fracture_volume(time(i)); });
    CHECK_COLUMN(table, "V_leaked_m2", tolerance, each,
                 [&](const auto i) { return fracture.leaked_volume(time(i)); });
  }
}

TEST_CASE("KGD with Carter leak-off: no leak-off gives the similarity solution")
{
  const KgdParameters fluid{3e10, 0.25, 1e-3, 1e6, 1e-4};
  const Kgd impermeable(fluid);
  const KgdHistory fracture({fluid, 0.}, 100.);
  for (const double t : {1e-3, 1., 77.})
  {
    const double x = 0.83 * impermeable.half_length(t);
    CHECK(fracture.half_length(t) == doctest::Approx(impermeable.half_length(t)).epsilon(1e-5));
    CHECK(fracture.opening(x, t) == doctest::Approx(impermeable.opening(x, t)).epsilon(1e-4));
    CHECK(fracture.pressure(x, t) == doctest::Approx(impermeable.pressure(x, t)).epsilon(1e-4));
    CHECK(fracture.leaked_volume(t) == doctest::Approx(0.).epsilon(1e-4));
  }
}

TEST_CASE("KGD between rollers")
{
  const ReferenceTable table("kgd_sun_box");
  const double E = table.parameter("E"), nu = table.parameter("nu");
  const KgdParameters fluid{E, nu, table.parameter("mu"),
                            std::sqrt(E / (1. - nu * nu) * table.parameter("Gc")),
                            table.parameter("Q0")};
  const KgdHistory fracture({fluid, 0., 8., 8.}, table(table.rows() - 1, "t_s"));
  const auto time = [&](const auto i) { return table(i, "t_s"); };
  const auto each = RelativeTo::each;
  const double tolerance = 5e-4;
  CHECK_COLUMN(table, "l_m", tolerance, each,
               [&](const auto i) { return fracture.half_length(time(i)); });
  CHECK_COLUMN(table, "w0_m", tolerance, each,
               [&](const auto i) { return fracture.inlet_opening(time(i)); });
  CHECK_COLUMN(table, "p0_Pa", tolerance, each,
               [&](const auto i) { return fracture.inlet_pressure(time(i)); });
  CHECK_COLUMN(table, "V_both_wings_m2", tolerance, each,
               [&](const auto i) { return fracture.fracture_volume(time(i)); });
}
