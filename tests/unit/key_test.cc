#include <doctest/doctest.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <set>

#include "stockwork/mesh/key.h"

namespace stockwork::key_test
{
TEST_CASE("a key is the same on every machine")
{
  // SplitMix64 from state 0, first output: Vigna's reference implementation.
  CHECK(std::uint64_t(Key().add(std::uint64_t(0))) == 0xe220a8397b1dcdafull);
  const std::uint64_t cell = Key().add(dealii::CellId("3_2:01"));
  CHECK(cell == std::uint64_t(Key().add(3).add(0).add(1).add(0xff)));
}

TEST_CASE("different cells, parents and places have different keys")
{
  dealii::Triangulation<2> triangulation;
  dealii::GridGenerator::subdivided_hyper_cube(triangulation, 5);
  triangulation.refine_global(4);
  std::set<std::uint64_t> keys;
  unsigned int n = 0;
  for (const auto &cell : triangulation.cell_iterators())
  {
    keys.insert(Key().add(cell->id()));
    keys.insert(Key().add(cell->id()).add(1));
    keys.insert(Key().add(cell->center(), 1e-6));
    n += 3;
  }
  CHECK(keys.size() == n);
}

TEST_CASE("round-off does not change the key of a place")
{
  const double h = 0.1;
  for (int i = -1000; i < 1000; ++i)
  {
    const dealii::Point<3> a(i * h, 0.5 * i * h, 0.25 * i * h);
    const dealii::Point<3> b(a[0] * (1. + 1e-14) + 1e-14, a[1] - 1e-14, a[2] + 1e-14);
    CHECK(std::uint64_t(Key().add(a, 1e-6 * h)) == std::uint64_t(Key().add(b, 1e-6 * h)));
  }
}
} // namespace stockwork::key_test
