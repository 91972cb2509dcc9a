#include "reference_table.h"
#include "verification/analytical/bar_wave.h"
#include "verification/analytical/porous_wave.h"

#include <doctest/doctest.h>

namespace stockwork::analytical_wave_test
{
using namespace stockwork::analytical;
using stockwork::test::ReferenceTable;
using stockwork::test::RelativeTo;

TEST_CASE("elastic bar: step and ramp")
{
  for (const auto &[name, ramp] :
       {std::pair{"bar_wave_step", 0.}, std::pair{"bar_wave_ramp", 0.032691742}})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const BarWave bar({table.parameter("M"), table.parameter("rho"), table.parameter("L"),
                       table.parameter("P0"), ramp});
    const auto time = [&](const auto i) { return table(i, "t_s"); };
    const auto largest = RelativeTo::largest;
    CHECK_COLUMN(table, "u_top_m", 1e-7, largest,
                 [&](const auto i) { return bar.displacement(0., time(i)); });
    CHECK_COLUMN(table, "v_top_m_per_s", 1e-6, largest,
                 [&](const auto i) { return bar.velocity(0., time(i)); });
    CHECK_COLUMN(table, "u_mid_m", 1e-7, largest,
                 [&](const auto i) { return bar.displacement(7.5, time(i)); });
    if (ramp == 0.) // some rows stand on the front of the step
      continue;
    CHECK_COLUMN(table, "sigma_mid_Pa", 1e-6, largest,
                 [&](const auto i) { return bar.stress(7.5, time(i)); });
    CHECK_COLUMN(table, "sigma_base_Pa", 1e-6, largest,
                 [&](const auto i) { return bar.stress(15., time(i)); });
  }
}

TEST_CASE("saturated column with inertia")
{
  const ReferenceTable table("porous_wave_up");
  const PorousWave column({table.parameter("E"), table.parameter("rho"), table.parameter("alpha"),
                           1. / table.parameter("Q"), 1e-9, table.parameter("L"),
                           table.parameter("P0"), table.parameter("tau")});
  std::vector<PorousWaveAtTime> states;
  for (std::size_t i = 0; i < table.rows(); ++i)
    states.push_back(column.at(table(i, "t_s")));
  // The table carries the error of its own inversion, 1.2e-4: before the wave arrives at 8.1 ms it
  // has a pressure of 3 Pa in the middle.
  const auto largest = RelativeTo::largest;
  CHECK_COLUMN(table, "u_top_m", 2e-4, largest,
               [&](const auto i) { return states[i].displacement(0.); });
  CHECK_COLUMN(table, "u_mid_m", 2e-4, largest,
               [&](const auto i) { return states[i].displacement(7.5); });
  CHECK_COLUMN(table, "p_mid_Pa", 2e-4, largest,
               [&](const auto i) { return states[i].pressure(7.5); });
  CHECK_COLUMN(table, "p_base_Pa", 2e-4, largest,
               [&](const auto i) { return states[i].pressure(15.); });
}

TEST_CASE("saturated column: nothing arrives before the undrained wave")
{
  const PorousWave column({1e8, 1900., 0.5, 1. / 6.06e9, 1e-9, 15., 1e4, 0.002});
  const auto now = column.at(0.005); // the wave has come 4.6 m
  CHECK(std::abs(now.pressure(7.5)) < 1e-5);
  CHECK(std::abs(now.displacement(7.5)) < 1e-13);
  CHECK(now.pressure(2.) > 1e3);
}

TEST_CASE("saturated column: without coupling it is an elastic bar")
{
  const double rise = 0.002, t = 0.07, c = std::sqrt(1e8 / 1900.);
  const PorousWave column({1e8, 1900., 1e-6, 1e-9, 1e-9, 15., 1e4, rise});
  // The load's impulse is that of a step three rise times later.
  CHECK(column.at(t).displacement(0.) ==
        doctest::Approx(1e4 / (1900. * c) * (t - 3. * rise)).epsilon(1e-7));
}
} // namespace stockwork::analytical_wave_test
