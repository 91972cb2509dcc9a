// Where bonds break, a few rows of the matrix are assembled again. What is then in the matrix must
// be what a new assembly of all of it puts there.
#include <doctest/doctest.h>

#include "scenario.h"

#include <algorithm>
#include <cmath>

namespace stockwork::changed_rows_test
{
namespace
{
/// Values of a matrix, row by row.
std::vector<double> values(const dealii::TrilinosWrappers::BlockSparseMatrix &matrix)
{
  std::vector<double> result;
  for (unsigned int b = 0; b < matrix.n_block_rows(); ++b)
    for (unsigned int c = 0; c < matrix.n_block_cols(); ++c)
      for (const auto &entry : matrix.block(b, c))
        result.push_back(entry.value());
  return result;
}


/// Rows that have changed since all of them were assembled.
dealii::types::global_dof_index n_changed(const RowChanges &changes, const unsigned int stamp)
{
  for (unsigned int since = 0; since <= stamp; ++since)
    if (const auto rows = changes.since(since))
      return rows->n_elements();
  return 0;
}


/// Greatest difference, over the greatest value, between the matrix of a fracture that grows and
/// that of a new assembly.
double difference(const std::string &deck, std::vector<std::string> settings)
{
  // A zone that does not grow, or all rows would be assembled.
  settings.push_back("Fracture/peridynamics/Zone=(0, -1 m) to (4 m, 1 m)");
  settings.push_back("Fracture/peridynamics/Zone growth=0");
  Scenario scenario(STOCKWORK_SOURCE "/prm/kgd/sun/" + deck, settings);
  dealii::types::global_dof_index n = 0;
  for (unsigned int step = 0; step < 30 && n < 12; ++step)
  {
    scenario.advance();
    scenario.begin_step();
    n = n_changed(scenario.linearise().bulk_changes, 10000);
  }
  CHECK(n >= 12);
  CHECK(n < scenario.n_bulk() / 4);
  const std::vector<double> kept = values(scenario.linearise().bulk);
  scenario.system.setup_mesh(scenario.time);
  scenario.system.adopt_extra(scenario.system.extra_numbering(), {&scenario.current.extra});
  const LinearSystem &anew = scenario.linearise();
  CHECK(n_changed(anew.bulk_changes, 10000) == 0);
  const std::vector<double> fresh = values(anew.bulk);
  REQUIRE(kept.size() == fresh.size());
  double difference = 0., greatest = 0.;
  for (std::size_t k = 0; k < fresh.size(); ++k)
  {
    difference = std::max(difference, std::abs(kept[k] - fresh[k]));
    greatest = std::max(greatest, std::abs(fresh[k]));
  }
  return difference / greatest;
}
} // namespace


TEST_CASE("changes of rows are known since all rows were assembled, and add up")
{
  const auto rows = [](const std::vector<unsigned int> &list)
  {
    dealii::IndexSet set(10);
    set.add_indices(list.begin(), list.end());
    return set;
  };
  RowChanges changes;
  CHECK_FALSE(changes.since(0)); // nobody has said anything
  changes.anywhere(3);
  CHECK_FALSE(changes.since(2));
  REQUIRE(changes.since(3));
  CHECK(changes.since(3)->n_elements() == 0);
  changes.in(rows({1, 4}), 4);
  changes.in(rows({4, 7}), 6);
  CHECK(*changes.since(3) == rows({1, 4, 7}));
  CHECK(*changes.since(4) == rows({4, 7}));
  CHECK(changes.since(6)->n_elements() == 0);
  changes.anywhere(7);
  CHECK_FALSE(changes.since(6));
}


TEST_CASE("where bonds have broken, the matrix is what a new assembly makes it, to the last digit")
{
  CHECK(difference("peridynamics.prm", {}) == 0.);
  CHECK(difference("peridynamics.prm", {"Fracture/peridynamics/Softening=1"}) == 0.);
  CHECK(difference("peridynamics.prm", {"Fracture/peridynamics/Bond law=state-based"}) == 0.);
  CHECK(difference("peridynamics.prm", {"Fracture/peridynamics/Surface correction=false"}) == 0.);
}


TEST_CASE("the same in porous rock, where cells with a fracture have another Biot tensor")
{
  // Steps of one length, or all rows between pressures would change with each.
  CHECK(difference("permeable/peridynamics.prm",
                   {"Time/Initial step=0.05 s", "Time/Maximum step=0.05 s",
                    "Time/Minimum step=0.05 s"}) < 1e-15);
}
} // namespace stockwork::changed_rows_test
