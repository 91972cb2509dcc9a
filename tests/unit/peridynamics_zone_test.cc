// Where a peridynamic zone has room to grow: cells that cannot be halved to the lattice's keep it
// away.
#include <doctest/doctest.h>

#include "fracture/peridynamics/zone.h"

namespace stockwork::peridynamics_zone_test
{
using dealii::Point;
using Box = dealii::BoundingBox<2>;

namespace
{
Box box(const double x, const double y, const double to_x, const double to_y)
{
  return Box(std::make_pair(Point<2>(x, y), Point<2>(to_x, to_y)));
}

/// Of a zone of 20 m by 4 m about the origin, in a domain of 200 m, at a distance of 3 m.
Box room(const std::vector<Box> &obstacles)
{
  return peridynamics::room_among<2>(obstacles, box(-10., -2., 10., 2.),
                                     {{{{-97., 97.}}, {{-97., 97.}}}}, 3.,
                                     Collectives(MPI_COMM_SELF));
}

void check(const Box &found, const Box &expected)
{
  for (unsigned int d = 0; d < 2; ++d)
  {
    CHECK(found.lower_bound(d) == doctest::Approx(expected.lower_bound(d)));
    CHECK(found.upper_bound(d) == doctest::Approx(expected.upper_bound(d)));
  }
}
} // namespace


TEST_CASE("a column of odd cells bounds its direction, whatever the size of its cells")
{
  check(room({}), box(-97., -97., 97., 97.));
  for (const double size : {4., 8., 16., 40.})
  {
    std::vector<Box> column;
    for (double y = -100.; y < 100.; y += size)
      column.push_back(box(20., y, 22., y + size));
    check(room(column), box(-97., -97., 17., 97.));
  }
}


TEST_CASE("an odd cell aside of the zone bounds where it is farther away, unless others do")
{
  const Box aside = box(30., 40., 38., 48.);
  check(room({aside}), box(-97., -97., 97., 37.));
  const Box above = box(-4., 25., 4., 33.), ahead = box(30., -4., 38., 4.);
  check(room({aside, above}), box(-97., -97., 97., 22.));
  check(room({aside, ahead}), box(-97., -97., 27., 97.));
  check(room({aside, ahead, above}), box(-97., -97., 27., 22.));
}


TEST_CASE("what is near the zone does not make it smaller, and is passed by")
{
  check(room({box(11., -2., 12., 2.)}), box(-97., -97., 10., 97.));
  // Nearer than the distance above, and far ahead.
  check(room({box(50., 3., 58., 11.)}), box(-97., -97., 47., 97.));
}
} // namespace stockwork::peridynamics_zone_test
