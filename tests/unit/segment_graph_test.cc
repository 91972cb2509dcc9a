#include <doctest/doctest.h>

#include "flow/segment_graph.h"

#include <map>

namespace stockwork::segment_graph_test
{
using doctest::Approx;

/// Cells of a grid that lines pass through, or bands of so many cells, as a model of bonds flags
/// them.
class Band
{
public:
  void
  draw(const double angle, const double length, const int width, const double x, const double y)
  {
    for (double s = 0.; s < length; s += 0.25)
      for (int k = 0; k < width; ++k)
        cells[{static_cast<int>(std::floor(x + s * std::cos(angle))),
               static_cast<int>(std::floor(y + s * std::sin(angle))) + k}] = true;
  }

  std::vector<NetworkSegment<2>> segments() const
  {
    const auto key = [](const int x, const int y) { return 1000u * (x + 500) + (y + 500); };
    std::vector<NetworkSegment<2>> result;
    for (const auto &[place, on] : cells)
    {
      NetworkSegment<2> segment;
      segment.key = key(place.first, place.second);
      segment.centre = {0.1 * place.first, 0.1 * place.second};
      segment.area = 0.1;
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy)
          if ((dx != 0 || dy != 0) && cells.count({place.first + dx, place.second + dy}) != 0)
            segment.neighbours.push_back({key(place.first + dx, place.second + dy), 0.05, 1.});
      result.push_back(segment);
    }
    return result;
  }

private:
  std::map<std::pair<int, int>, bool> cells;
};

constexpr double degree = M_PI / 180.;


TEST_CASE("a fracture without forks has one branch, straight or oblique, thin or thick")
{
  for (const double angle : {0., 20., 45., 77., 90.})
    for (const int width : {1, 2, 3})
    {
      CAPTURE(angle);
      CAPTURE(width);
      Band band;
      band.draw(angle * degree, 40., width, 0.3, 0.2);
      const SegmentGraph graph = segment_graph(band.segments());
      CHECK(graph.n_fractures == 1);
      CHECK(graph.n_branches == 1);
      CHECK(graph.fork_angles.empty());
    }
}


TEST_CASE("a Y has three branches and the angle between its arms")
{
  for (const double half_angle : {20., 30., 45., 60.})
    for (const int width : {1, 3})
    {
      CAPTURE(half_angle);
      CAPTURE(width);
      Band band;
      band.draw(180. * degree, 25., width, 0.5, 0.5);
      band.draw(half_angle * degree, 30., width, 0.5, 0.5);
      band.draw(-half_angle * degree, 30., width, 0.5, 0.5);
      const SegmentGraph graph = segment_graph(band.segments());
      CHECK(graph.n_branches == 3);
      REQUIRE(graph.fork_angles.size() == 1);
      CHECK(graph.fork_angles[0] / degree == Approx(2. * half_angle).epsilon(8. / half_angle / 2.));
    }
}


TEST_CASE("two fractures, one of them with a knob that is no branch, and a T")
{
  Band band;
  band.draw(0., 40., 1, 0.5, 0.5);
  band.draw(90. * degree, 3., 1, 20.5, 0.5);
  band.draw(0., 40., 1, 0.5, 50.5);
  SegmentGraph graph = segment_graph(band.segments());
  CHECK(graph.n_fractures == 2);
  CHECK(graph.n_branches == 2);
  CHECK(graph.fork_angles.empty());

  band.draw(90. * degree, 30., 1, 20.5, 50.5);
  graph = segment_graph(band.segments());
  CHECK(graph.n_branches == 4);
  REQUIRE(graph.fork_angles.size() == 1);
  CHECK(graph.fork_angles[0] / degree == Approx(90.).epsilon(0.05));

  CHECK(segment_graph({}).n_branches == 0);
}

TEST_CASE("a crossing is one fork of four branches, whichever of its fractures is the longer")
{
  for (const double half : {25., 50.})
  {
    // Straight lines of segments a unit long, as tracked paths have them: the way of one up to the
    // other, and the one that goes on beyond it, which the fluid enters from both.
    std::vector<NetworkSegment<2>> network;
    const auto add = [&](const double x, const double y)
    {
      NetworkSegment<2> segment;
      segment.key = network.size();
      segment.centre = {x, y};
      segment.area = 1.;
      network.push_back(segment);
      return network.size() - 1;
    };
    const auto connect = [&](const unsigned int a, const unsigned int b)
    {
      network[a].neighbours.push_back({b, 0.5, 1.});
      network[b].neighbours.push_back({a, 0.5, 1.});
    };
    unsigned int crossed = 0, last = 0;
    for (int x = -30; x <= 30; ++x)
    {
      const unsigned int segment = add(x, 0.);
      if (x > -30)
        connect(last, segment);
      last = segment;
      if (x == 0)
        crossed = segment;
    }
    std::array<unsigned int, 2> mouths;
    for (const int side : {0, 1})
      for (int y = 0; y < half; ++y)
      {
        const unsigned int segment = add(0., (side == 0 ? -1. : 1.) * (y + 0.5));
        connect(y == 0 ? crossed : last, segment);
        if (y == 0)
          mouths[side] = segment;
        last = segment;
      }
    connect(mouths[0], mouths[1]);
    const SegmentGraph graph = segment_graph(network);
    CHECK(graph.n_branches == 4);
    REQUIRE(graph.fork_angles.size() == 1);
    CHECK(graph.fork_angles[0] / degree == Approx(90.).epsilon(0.05));
  }
}
} // namespace stockwork::segment_graph_test
