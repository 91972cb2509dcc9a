// Runs on one and on two ranks.
#include <doctest/doctest.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <sstream>

#include "stockwork/exchange/diffuse_crack.h"

namespace stockwork::diffuse_crack_mpi_test
{
using namespace dealii;

namespace
{
/// A crack along an edge of cells of a quarter, with stations at -3/4, -1/4, 1/4 and 3/4.
struct Case
{
  Case()
    : triangulation(MPI_COMM_WORLD)
    , collectives(MPI_COMM_WORLD)
  {
    GridGenerator::subdivided_hyper_rectangle(triangulation, {24, 16}, Point<2>(-3., -2.),
                                              Point<2>(3., 2.));
    crack.begin(cracks, 0.5, 1.);
    crack.extend({}, triangulation, collectives);
  }

  /// Each cell of a station adds an area of 1/100 and opens by its own place along x.
  void list_segments()
  {
    std::vector<DiffuseCrack<2>::Piece> pieces(crack.stations().size());
    for (const auto &cell : triangulation.active_cell_iterators())
      if (const int station = crack.station(cell->active_cell_index());
          cell->is_locally_owned() && station >= 0)
      {
        pieces[station].area += 0.01;
        pieces[station].across[1][1] += 1.;
        pieces[station].across[0][0] += 0.1;
        pieces[station].volume[0] += cell->center()[0];
      }
    crack.list_segments(
      pieces, triangulation, [](const Point<2> &x) { return 5. + x[0]; }, collectives);
  }

  /// Of all ranks: a number of a segment, for each station.
  template <class Number>
  std::vector<double> of_stations(const Number &number) const
  {
    std::vector<double> sums(crack.stations().size(), 0.);
    for (const Segment<2> &segment : crack.segments())
      for (unsigned int k = 0; k < sums.size(); ++k)
        if (crack.key(k) == segment.key)
          sums[k] += number(segment);
    collectives.sum(sums);
    return sums;
  }

  unsigned int n_cells(const int station) const
  {
    double n = 0.;
    for (const auto &cell : triangulation.active_cell_iterators())
      n += cell->is_locally_owned() && crack.station(cell->active_cell_index()) == station;
    return std::lround(collectives.sum(n));
  }

  parallel::distributed::Triangulation<2> triangulation;
  const Collectives collectives;
  const std::vector<InitialCrack<2>> cracks{
    {{Point<2>(-1., 0.), Point<2>(1., 0.)}, InitialCrack<2>::Kind::open, "", "", {}}};
  DiffuseCrack<2> crack;
};
} // namespace

TEST_CASE("the scene's crack passes one row of cells, between its ends")
{
  const Case c;
  double n = 0.;
  for (const auto &cell : c.triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && passes(c.cracks[0], cell->center(), 0.25))
    {
      ++n;
      CHECK(cell->center()[1] == doctest::Approx(0.125));
    }
  CHECK(c.collectives.sum(n) == 8.);
}


TEST_CASE("cells belong to the nearest station within reach")
{
  Case c;
  REQUIRE(c.crack.stations().size() == 4);
  for (const auto &cell : c.triangulation.active_cell_iterators())
    if (!cell->is_artificial())
    {
      double nearest = 1.;
      int expected = -1;
      for (int k = 0; k < 4; ++k)
        if (const double away = cell->center().distance(Point<2>(-0.75 + 0.5 * k, 0.));
            away < nearest - 1e-9)
        {
          nearest = away;
          expected = k;
        }
      CHECK(c.crack.station(cell->active_cell_index()) == expected);
    }
}


TEST_CASE("segments have the area, normal, opening and neighbours of their station's cells")
{
  Case c;
  c.list_segments();
  const auto opening =
    c.of_stations([](const Segment<2> &s) { return s.area * s.opening.bulk_coefficients.at(0); });
  const auto pressure = c.of_stations([](const Segment<2> &s) { return s.pore_pressure.constant; });
  double expected_opening[4] = {};
  for (const auto &cell : c.triangulation.active_cell_iterators())
    if (const int k = c.crack.station(cell->active_cell_index());
        k >= 0 && cell->is_locally_owned())
      expected_opening[k] += cell->center()[0];
  for (const Segment<2> &segment : c.crack.segments())
  {
    const unsigned int k = std::lround((segment.centre[0] + 0.75) / 0.5);
    CHECK(std::abs(segment.normal[1]) == doctest::Approx(1.));
    REQUIRE(segment.neighbours.size() == (k == 0 || k == 3 ? 1u : 2u));
    for (const auto &neighbour : segment.neighbours)
    {
      CHECK(neighbour.distance == doctest::Approx(0.25));
      CHECK((neighbour.key == c.crack.key(k == 0 ? 1 : k - 1) ||
             neighbour.key == c.crack.key(k == 3 ? 2 : k + 1)));
    }
  }
  for (unsigned int k = 0; k < 4; ++k)
  {
    CHECK(opening[k] == doctest::Approx(c.collectives.sum(expected_opening[k])));
    CHECK(pressure[k] == doctest::Approx(5. + c.crack.stations()[k][0])); // parts add up
    const unsigned int n = c.n_cells(k);
    for (const Segment<2> &segment : c.crack.segments())
      if (segment.key == c.crack.key(k))
        CHECK(segment.area == doctest::Approx(0.01 * n));
  }
}


TEST_CASE("the crack grows, takes a step back, and is saved")
{
  Case c;
  const Point<2> ahead(1.375, 0.125), near(1.125, 0.125);
  // One rank has seen it.
  const auto broken =
    c.collectives.rank() == 0 ? std::vector<Point<2>>{near, ahead} : std::vector<Point<2>>();
  c.crack.extend(broken, c.triangulation, c.collectives);
  REQUIRE(c.crack.n_new() == 1);
  CHECK(c.crack.stations().back().distance(ahead) < 1e-12); // the near one is a station's already
  c.crack.rollback();
  c.crack.extend({}, c.triangulation, c.collectives);
  CHECK(c.crack.n_new() == 0);
  CHECK(c.crack.stations().size() == 4);

  c.crack.extend(broken, c.triangulation, c.collectives);
  c.crack.commit();
  c.crack.rollback();
  CHECK(c.crack.stations().size() == 5);
  std::stringstream file;
  {
    boost::archive::binary_oarchive archive(file);
    const DiffuseCrack<2> &saved = c.crack;
    archive << saved;
  }
  DiffuseCrack<2> loaded;
  {
    boost::archive::binary_iarchive archive(file);
    archive >> loaded;
  }
  CHECK(loaded.n_new() == 0);
  REQUIRE(loaded.stations().size() == 5);
  for (unsigned int k = 0; k < 5; ++k)
    CHECK(loaded.key(k) == c.crack.key(k));
}
} // namespace stockwork::diffuse_crack_mpi_test
