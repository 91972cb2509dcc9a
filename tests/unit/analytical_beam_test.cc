#include "reference_table.h"
#include "verification/analytical/double_cantilever.h"
#include "verification/analytical/three_point_bending.h"

#include <doctest/doctest.h>

namespace stockwork::analytical_beam_test
{
using namespace stockwork::analytical;
using stockwork::test::ReferenceTable;
using stockwork::test::RelativeTo;

namespace
{
constexpr DoubleCantileverParameters beam{1e10, 0.1, 0.4, 100.};
}

TEST_CASE("double cantilever beam: brittle")
{
  const ReferenceTable table("dcb_lefm");
  const BrittleDoubleCantilever solution(beam);
  CHECK_COLUMN(table, "P_N_per_m", 1e-7, RelativeTo::each,
               [&](const auto i) { return solution.force(table(i, "opening_m")); });
  CHECK_COLUMN(table, "a_m", 1e-7, RelativeTo::each,
               [&](const auto i) { return solution.crack_length(table(i, "opening_m")); });
  CHECK(solution.force(0.5 * solution.opening_at_onset()) ==
        doctest::Approx(0.5 * solution.force(solution.opening_at_onset())));
}

TEST_CASE("three-point bending: factor of the stress intensity")
{
  const ReferenceTable table("three_point_bending");
  CHECK_COLUMN(table, "f", 1e-6, RelativeTo::each,
               [&](const auto i) { return three_point_bending_factor(table(i, "a_over_W")); });
}

TEST_CASE("double cantilever beam: bilinear cohesive layer")
{
  const ReferenceTable table("dcb_bilinear");
  const CohesiveDoubleCantilever solution({beam, 5e6, 1e13});
  // The table was computed with beam elements; its J is within 2e-4 of G_c.
  CHECK_COLUMN(table, "P_N_per_m", 1e-3, RelativeTo::each,
               [&](const auto i) { return solution.at(table(i, "opening_m")).force; });
  CHECK_COLUMN(table, "traction_free_length_m", 3e-3, RelativeTo::each,
               [&](const auto i)
               { return solution.at(table(i, "opening_m")).traction_free_length; });

  // A stiff, strong layer is brittle.
  const CohesiveDoubleCantilever brittle({beam, 5e8, 1e18});
  const BrittleDoubleCantilever limit(beam);
  CHECK(brittle.at(3e-3).force == doctest::Approx(limit.force(3e-3)).epsilon(1e-2));
}
} // namespace stockwork::analytical_beam_test
