#include "reference_table.h"
#include "verification/analytical/pkn.h"

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
} // namespace stockwork::analytical_pkn_test
