// What points of a cell remember when a crack comes to cut it, and when its mesh changes.
#include "biot/point_history.h"
#include "discontinuity/crack_path.h"
#include "discontinuity/cut_cell.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>

#include <doctest/doctest.h>

namespace stockwork::point_history_test
{
using dealii::Point;

namespace
{
/// A cell that a crack cuts from its left to its right face at two heights.
struct CutSquare
{
  CutSquare(const double left, const double right)
  {
    dealii::Triangulation<2> square;
    dealii::GridGenerator::hyper_cube(square);
    const dealii::MappingQ1<2> mapping;
    piece.faces = {{0, 1}};
    piece.ends = piece.unit_ends = {{Point<2>(0., left), Point<2>(1., right)}};
    cut = make_cut_cell<2>(make_cut_geometry<2>(mapping, square.begin_active(), {&piece}, 2), {});
  }

  CrackPiece<2> piece;
  CutCell<2> cut;
};

const std::vector<Point<2>> ordinary = dealii::QGauss<2>(3).get_points();

/// A plastic strain for each side: the height of the point, with the sign of its side.
std::vector<double> by_side(const std::vector<Point<2>> &points, const CutCell<2> &cut)
{
  std::vector<double> values;
  for (const Point<2> &p : points)
    values.push_back(cut.side(p) * p[1]);
  return values;
}

/// Points that take their history from across the crack.
unsigned int n_from_across(const PointHistory<2> &history, const CutCell<2> &cut, const bool aware)
{
  unsigned int n = 0;
  for (const Point<2> &p : cut.points)
    n += *history.nearest(0, p, aware ? &cut : nullptr) * cut.side(p) < 0.;
  return n;
}
} // namespace


TEST_CASE("A cut cell says on which side a point is, as its crack does")
{
  const CutSquare square(0.2, 0.6);
  double above = 0.;
  for (unsigned int q = 0; q < square.cut.points.size(); ++q)
  {
    const Point<2> &p = square.cut.points[q];
    CHECK((square.cut.side(p) > 0) == square.piece.plus_side(p));
    if (square.cut.side(p) > 0)
      above += square.cut.weights[q];
  }
  CHECK(above == doctest::Approx(0.6));
  CHECK(CutCell<2>().side(Point<2>(0.5, 0.5)) == 0);
}


TEST_CASE("When a crack comes to cut a cell, each side keeps its own history")
{
  const CutSquare square(0.35, 0.6);
  PointHistory<2> history(1, ordinary);
  history.reinit(1);
  history.set(0, ordinary, by_side(ordinary, square.cut));
  CHECK(n_from_across(history, square.cut, false) > 0); // the nearest point of all would not do
  CHECK(n_from_across(history, square.cut, true) == 0);
  for (const Point<2> &p : square.cut.points)
  {
    double least = 2., expected = 0.;
    for (const Point<2> &other : ordinary)
      if (square.cut.side(other) == square.cut.side(p) && other.distance(p) < least)
      {
        least = other.distance(p);
        expected = square.cut.side(p) * other[1];
      }
    CHECK(*history.nearest(0, p, &square.cut) == expected);
  }
}


TEST_CASE("When a cut moves, each side keeps its own history as far as it has any")
{
  const CutSquare before(0.3, 0.3), after(0.34, 0.32);
  PointHistory<2> history(1, ordinary);
  history.reinit(1);
  const auto &points = before.cut.points;
  history.set(0, points, by_side(points, after.cut));
  CHECK(n_from_across(history, after.cut, true) == 0);

  // All that is remembered lies above a crack along the bottom.
  const CutSquare low(0.05, 0.05);
  history.set(0, ordinary, std::vector<double>(ordinary.size(), 1.));
  for (const Point<2> &p : low.cut.points)
    CHECK(*history.nearest(0, p, &low.cut) == 1.);
  history.reinit(1);
  CHECK(history.nearest(0, Point<2>(), &low.cut) == nullptr);
}
} // namespace stockwork::point_history_test
