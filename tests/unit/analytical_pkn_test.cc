#include "reference_table.h"
#include "verification/analytical/pkn.h"
#include "verification/analytical/pkn_carter.h"

#include "verification/analytical/constants.h"

#include <doctest/doctest.h>

namespace stockwork::analytical_pkn_test
{
using namespace stockwork::analytical;
using stockwork::test::ReferenceTable;
using stockwork::test::RelativeTo;

TEST_CASE("PKN: profile")
{
  const ReferenceTable table("pkn_similarity_profile");
  const Pkn fracture({2e10, 0.25, 1e-3, 10., 0.01});
  const double t = 300.;
  CHECK_COLUMN(table, "w_over_w0", 1e-6, RelativeTo::largest,
               [&](const auto i)
               {
                 return fracture.opening(table(i, "theta") * fracture.length(t), t) /
                        fracture.inlet_opening(t);
               });
}

TEST_CASE("PKN: length, opening and pressure")
{
  const ReferenceTable table("pkn_storage");
  const auto fracture = [&](const auto i)
  {
    return Pkn({table(i, "E_Pa"), table(i, "nu"), table(i, "mu_Pa_s"), table(i, "h_m"),
                table(i, "Q_one_wing_m3_per_s")});
  };
  const auto each = RelativeTo::each;
  CHECK_COLUMN(table, "L_m", 1e-7, each,
               [&](const auto i) { return fracture(i).length(table(i, "t_s")); });
  CHECK_COLUMN(table, "w0_max_m", 1e-7, each,
               [&](const auto i) { return fracture(i).inlet_opening(table(i, "t_s")); });
  CHECK_COLUMN(table, "p0_Pa", 1e-7, each,
               [&](const auto i) { return fracture(i).inlet_pressure(table(i, "t_s")); });
}

namespace
{
/// From T = 2e-4 to 1e3, between the rows of the solution's own table.
PknCarter leaking(const ReferenceTable &table, const std::size_t i)
{
  return PknCarter({table(i, "E_Pa"), table(i, "nu"), table(i, "mu_Pa_s"), table(i, "h_m"),
                    table(i, "Q_one_wing_m3_per_s")},
                   table(i, "C_L_m_per_sqrt_s"));
}
} // namespace

TEST_CASE("PKN with Carter leak-off: length, opening, pressure and what is left in the fracture")
{
  const ReferenceTable table("pkn_carter_zhang");
  const auto each = RelativeTo::each;
  CHECK_COLUMN(table, "L_m", 2e-5, each,
               [&](const auto i) { return leaking(table, i).length(table(i, "t_s")); });
  CHECK_COLUMN(table, "w0_max_m", 2e-5, each,
               [&](const auto i) { return leaking(table, i).inlet_opening(table(i, "t_s")); });
  CHECK_COLUMN(table, "p0_net_Pa", 2e-5, each,
               [&](const auto i) { return leaking(table, i).inlet_pressure(table(i, "t_s")); });
  CHECK_COLUMN(table, "efficiency", 2e-5, each,
               [&](const auto i)
               {
                 const double t = table(i, "t_s");
                 return leaking(table, i).volume(t) / (table(i, "Q_one_wing_m3_per_s") * t);
               });
}

TEST_CASE("PKN with Carter leak-off: limits of storage and of leak-off, reached slowly")
{
  const PknParameters parameters{3e10, 0.25, 1e-3, 20., 0.01325};
  const Pkn tight(parameters);
  const double t = 300.;
  const auto of_leak_off = [&](const double C_L)
  { return parameters.rate * std::sqrt(t) / (pi * parameters.height * C_L); };
  // T = 5e-16 and 2e10, both beyond the table, at whose ends 3e-4 and 1e-4 are left.
  const PknCarter weak(parameters, 1e-9), strong(parameters, 0.05);
  CHECK(weak.length(t) == doctest::Approx(tight.length(t)).epsilon(4e-4));
  CHECK(weak.inlet_opening(t) == doctest::Approx(tight.inlet_opening(t)).epsilon(2e-4));
  CHECK(strong.length(t) == doctest::Approx(of_leak_off(0.05)).epsilon(2e-4));

  const double C_L = 3.999262e-5; // T = 1
  const PknCarter both(parameters, C_L);
  CHECK(both.length(t) / tight.length(t) == doctest::Approx(0.4848814 / 1.3208446).epsilon(1e-5));
  CHECK(both.length(t) / of_leak_off(C_L) == doctest::Approx(0.4848814 * pi / 2.).epsilon(1e-5));
  CHECK(both.volume(t) + both.leaked_volume(t) == doctest::Approx(parameters.rate * t));
}
} // namespace stockwork::analytical_pkn_test
