#include <doctest/doctest.h>

#include <deal.II/grid/grid_generator.h>

#include "stockwork/exchange/surroundings.h"

namespace stockwork::surroundings_test
{
using namespace dealii;

TEST_CASE("places of one block have one middle")
{
  const auto middles =
    in_blocks<2>({Point<2>(0.1, 0.2), Point<2>(0.4, -0.3), Point<2>(1.7, -2.6)}, 1.);
  REQUIRE(middles.size() == 2);
  CHECK(middles[0].distance(Point<2>(0., 0.)) < 1e-12);
  CHECK(middles[1].distance(Point<2>(2., -3.)) < 1e-12);
}


TEST_CASE("surroundings of places, and of none")
{
  const Surroundings<2> two({Point<2>(0., 0.), Point<2>(10., 0.)}, 1.), none({}, 1.);
  CHECK(two.include(Point<2>(11.4, 0.), 0.5));
  CHECK(!two.include(Point<2>(11.6, 0.), 0.5));
  CHECK(!none.include(Point<2>(), 100.));
}


TEST_CASE("cells near a crack are asked to be small, others and smaller ones are left alone")
{
  parallel::distributed::Triangulation<2> triangulation(MPI_COMM_SELF);
  GridGenerator::subdivided_hyper_rectangle(triangulation, {10, 10}, Point<2>(0., 0.),
                                            Point<2>(10., 10.));
  InitialCrack<2> crack;
  crack.points = {Point<2>(0., 5.), Point<2>(5., 5.)};
  std::vector<float> of_crack(triangulation.n_active_cells(), 1.f), of_place = of_crack;
  of_crack[0] = 0.01f;
  const double reach = 1.;
  request_cell_size<2>(triangulation, {crack}, reach, 0.25, of_crack);
  request_cell_size(triangulation, Surroundings<2>({Point<2>(5., 5.)}, reach), 0.25, of_place);
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    const unsigned int i = cell->active_cell_index();
    const double touch = reach + 0.5 * cell->diameter();
    if (i > 0)
      CHECK(of_crack[i] == (crack.distance(cell->center()) < touch ? 0.25f : 1.f));
    CHECK(of_place[i] == (cell->center().distance(Point<2>(5., 5.)) < touch ? 0.25f : 1.f));
  }
  CHECK(of_crack[0] == 0.01f);
}
} // namespace stockwork::surroundings_test
