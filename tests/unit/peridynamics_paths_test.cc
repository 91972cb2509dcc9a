// The ways of cracks between the vertices of a lattice.
#include <doctest/doctest.h>

#include "fracture/peridynamics/stencil.h"
#include "fracture/peridynamics/tracked_paths.h"

#include <cmath>

namespace stockwork::peridynamics_paths_test
{
using dealii::Point;
using dealii::Tensor;
using peridynamics::TrackedPaths;

namespace
{
InitialCrack<2> crack(const std::vector<Point<2>> &points)
{
  InitialCrack<2> result;
  result.points = points;
  return result;
}

double sum(const peridynamics::CellShares &shares)
{
  double total = 0.;
  for (const auto &share : shares)
    total += share.second;
  return total;
}

bool anywhere(const Point<2> &)
{
  return true;
}

double none_ahead(const TrackedPaths::End &)
{
  return 0.;
}
} // namespace


TEST_CASE("pieces are about as long as cells, an odd number of them between two ends that grow")
{
  TrackedPaths paths;
  paths.reinit({crack({Point<2>(-1., 0.5), Point<2>(1., 0.5)})}, 0.2, anywhere);
  REQUIRE(paths.wet_pieces().size() % 2 == 1);
  CHECK(paths.length() == doctest::Approx(2.));
  CHECK(paths.wet_pieces().front().at_tip);
  CHECK(paths.wet_pieces().back().at_tip);
  // One that begins at a wall has any number.
  paths.reinit({crack({Point<2>(0., 0.5), Point<2>(0.8, 0.5)})}, 0.2,
               [](const Point<2> &end) { return end[0] > 0.; });
  CHECK(paths.wet_pieces().size() == 4);
  CHECK(!paths.wet_pieces().front().at_tip);
  CHECK(paths.ends().size() == 1);
}


TEST_CASE("a bond crosses a path where it does, and its shares add up to one")
{
  TrackedPaths paths;
  paths.reinit({crack({Point<2>(0., 0.5), Point<2>(4., 0.5)})}, 1.,
               [](const Point<2> &end) { return end[0] > 0.; });
  const auto crossing = paths.crossing(Point<2>(1., 0.), Point<2>(2., 2.));
  REQUIRE(crossing);
  CHECK(crossing->arc == doctest::Approx(1.25));
  CHECK(!paths.end_at(*crossing));
  CHECK(!paths.crossing(Point<2>(1., 1.), Point<2>(3., 1.)));
  CHECK(!paths.crossing(Point<2>(5., 0.), Point<2>(5., 1.)));
  CHECK(sum(paths.shares(*crossing, 3.)) == doctest::Approx(1.));
  // From 0.25 to 2.25: of the pieces 0, 1 and 2.
  const auto shares = paths.shares(*crossing, 3.);
  REQUIRE(shares.size() == 3);
  CHECK(shares[0].second == doctest::Approx(0.375));
  CHECK(shares[1].second == doctest::Approx(0.5));
  CHECK(shares[2].second == doctest::Approx(0.125));
  CHECK((paths.left(*crossing) - Tensor<1, 2>({0., 1.})).norm() < 1e-12);
  // A node on a path is on its left side.
  CHECK(paths.crossing(Point<2>(1., 0.5), Point<2>(1., 0.)));
  CHECK(!paths.crossing(Point<2>(1., 0.5), Point<2>(1., 1.)));
}


TEST_CASE("pieces of a path read an opening that is the same everywhere alike, at any angle")
{
  const auto stencil = peridynamics::horizon_stencil<2>(3, peridynamics::VolumeRule::isotropic);
  double most_before = 0.;
  for (const double angle : {7.5, 15., 22.5, 30., 37.5, 45.})
  {
    const Tensor<1, 2> t({std::cos(angle * M_PI / 180.), std::sin(angle * M_PI / 180.)});
    const Point<2> centre(0.31, 0.17);
    TrackedPaths paths;
    paths.reinit({crack({centre - 12.5 * t, centre + 12.5 * t})}, 1., anywhere);
    const unsigned int n_pieces = paths.wet_pieces().size();
    constexpr double apart = 14.;
    TrackedPaths::Readings readings;
    for (int x = -16; x <= 16; ++x)
      for (int y = -16; y <= 16; ++y)
        for (const auto &bond : stencil)
        {
          const Point<2> from(x, y), to(x + bond.offset[0], y + bond.offset[1]);
          if (const auto crossing = paths.crossing(from, to))
            readings.emplace_back(*crossing, bond.volume_fraction *
                                               std::abs(bond.direction() * paths.left(*crossing)));
        }
    // Root of the mean square, of all but the four pieces at either end, over their mean.
    const auto deviation = [&]
    {
      std::vector<double> read(paths.wet_pieces().size(), 0.);
      for (const auto &[crossing, reading] : readings)
      {
        const auto shares = paths.shares(crossing, 0.);
        CHECK(sum(shares) == doctest::Approx(crossing.arc < 0. || crossing.arc > 25. ? 0. : 1.));
        for (const auto &[piece, share] : shares)
          read[piece] += share * reading;
      }
      const unsigned int first = 4, n = n_pieces - 2 * first;
      double mean = 0., squares = 0.;
      for (unsigned int i = first; i < first + n; ++i)
        mean += read[i] / n;
      for (unsigned int i = first; i < first + n; ++i)
        squares += std::pow(read[i] / mean - 1., 2) / n;
      return std::sqrt(squares);
    };
    most_before = std::max(most_before, deviation());
    paths.share_evenly([&] { return readings; }, apart);
    const double even = deviation();
    CHECK(even < 0.005);

    // Another crack, that these bonds do not cross, changes nothing if it is far enough.
    const Tensor<1, 2> n = cross_product_2d(t);
    for (const double distance : {1.5 * apart, 0.5 * apart})
    {
      paths.reinit({crack({centre - 12.5 * t, centre + 12.5 * t}),
                    crack({centre + distance * n - 12.5 * t, centre + distance * n + 12.5 * t})},
                   1., anywhere);
      const double before = deviation();
      paths.share_evenly([&] { return readings; }, apart);
      CHECK(deviation() == doctest::Approx(distance > apart ? even : before));
    }
  }
  CHECK(most_before > 0.015);
}


TEST_CASE("a tip goes on its way, and fluid follows it")
{
  TrackedPaths paths;
  paths.reinit({crack({Point<2>(0., 0.), Point<2>(2., 0.)})}, 1.,
               [](const Point<2> &end) { return end[0] > 0.; });
  const TrackedPaths::End end = paths.ends().front();
  const Tensor<1, 2> up({std::sqrt(0.75), 0.5});
  const TrackedPaths before = paths;
  CHECK(paths.run_as(before));
  paths.extend({{end, up}});
  CHECK(!paths.run_as(before));
  CHECK(paths.boxes().size() == 3);
  CHECK(paths.boxes().back()[1].distance(Point<2>(2., 0.) + up) < 1e-12);
  paths.extend({{end, up}});
  CHECK(paths.wet_pieces().size() == 2); // the way is dry
  // A bond across the way feels the fluid that is near enough.
  const auto ahead = paths.crossing(Point<2>(3., 0.), Point<2>(3., 1.));
  REQUIRE(ahead);
  CHECK(ahead->arc == doctest::Approx(2. + 1. / std::sqrt(0.75)));
  CHECK(paths.end_at(*ahead));
  CHECK(paths.shares(*ahead, 1.).empty());
  CHECK(sum(paths.shares(*ahead, 2.)) == doctest::Approx(1.));

  // Fluid may be ahead of the tip.
  CHECK(paths.set_advances([](const TrackedPaths::End &) { return 0.5; },
                           [](const TrackedPaths::End &) { return 1.25; }));
  CHECK(paths.wet_pieces().size() == 4);
  CHECK(paths.lead(end) == doctest::Approx(1.5));
  CHECK(!paths.set_advances([](const TrackedPaths::End &) { return 1.25; }, none_ahead));
  CHECK(paths.wet_pieces().size() == 4);
  CHECK(paths.wet_pieces().back().at_tip);
  CHECK(!paths.wet_pieces()[1].at_tip);
  CHECK(paths.lead(end) == doctest::Approx(0.75));
  CHECK((paths.left(*ahead) - Tensor<1, 2>({-0.5, std::sqrt(0.75)})).norm() < 1e-12);
  CHECK(paths.length() == doctest::Approx(3.25));
  CHECK(paths.along_way(*ahead, end) == doctest::Approx(1. / std::sqrt(0.75)));
  CHECK(paths.distance(Point<2>(1., 2.)) == doctest::Approx(2.));
  CHECK(paths.tip(end).distance(Point<2>(2., 0.) + 1.25 * up) < 1e-12);
  // It does not run dry again, unless fluid is let back to where tips are; but not beyond where a
  // step has left it.
  paths.set_advances([](const TrackedPaths::End &) { return 0.5; }, none_ahead);
  CHECK(paths.wet_pieces().size() == 4);
  CHECK(paths.let_fluid_back());
  CHECK(paths.wet_pieces().size() == 3);
  CHECK(!paths.let_fluid_back());
  paths.keep_fluid();
  paths.set_advances([](const TrackedPaths::End &) { return 0.; }, none_ahead);
  CHECK(!paths.let_fluid_back());
  CHECK(paths.wet_pieces().size() == 3);
  // It stays where it has gone by itself: it would go there again.
  const auto half = [](const TrackedPaths::End &) { return 0.5; };
  CHECK(paths.set_advances([](const TrackedPaths::End &) { return 1.25; }, none_ahead, true));
  CHECK(!paths.set_advances(half, none_ahead, true));
  CHECK(!paths.let_fluid_back());
  CHECK(paths.wet_pieces().size() == 4);
  // But where something has softened since, it might not,
  CHECK(!paths.set_advances(half, none_ahead));
  CHECK(paths.let_fluid_back());
  CHECK(paths.wet_pieces().size() == 3);
  // nor where something softened with it,
  paths.extend({{end, up}});
  CHECK(paths.set_advances([](const TrackedPaths::End &) { return 2.25; }, none_ahead));
  CHECK(!paths.set_advances(half, none_ahead, true));
  CHECK(paths.let_fluid_back());
  CHECK(paths.wet_pieces().size() == 3);
  // nor back to where it has not been.
  CHECK(paths.set_advances([](const TrackedPaths::End &) { return 2.25; }, none_ahead, true));
  CHECK(!paths.set_advances([](const TrackedPaths::End &) { return 1.25; }, none_ahead, true));
  CHECK(paths.let_fluid_back());
  CHECK(paths.wet_pieces().size() == 4);
}


TEST_CASE("a way turns to a crack that it comes past, and not to one that it leads to")
{
  const double angle = M_PI * 25. / 180.;
  const Tensor<1, 2> along({std::cos(angle), std::sin(angle)}), ahead({1., 0.});
  const Point<2> met(2. + 1.4 / std::sin(angle), 0.); // 1.4 pieces from the tip, 3.3 ahead
  const auto joins = [&](const Point<2> &to)
  {
    TrackedPaths paths;
    paths.reinit({crack({Point<2>(0., 0.), Point<2>(2., 0.)}), crack({met - 6. * along, to})}, 1.,
                 [](const Point<2> &end) { return end[0] > 0.; });
    const TrackedPaths::End end{0, 1};
    paths.extend({{end, ahead}});
    return paths.has_met(end);
  };
  CHECK(!joins(met + 4. * along));
  CHECK(joins(met - along));
}


TEST_CASE("cracks that cross, and such that end on another one")
{
  const auto across = [](const double from, const double to)
  {
    TrackedPaths paths;
    paths.reinit({crack({Point<2>(0., 0.), Point<2>(4., 0.)}),
                  crack({Point<2>(1.8, from), Point<2>(1.8, to)})},
                 1., [](const Point<2> &) { return true; });
    return paths.cross();
  };
  const auto place = across(-2., 1.);
  REQUIRE(place);
  CHECK(place->distance(Point<2>(1.8, 0.)) < 1e-12);
  CHECK(!across(0., 2.));
  CHECK(!across(-2., 0.));
  CHECK(!across(0.5, 2.));
  TrackedPaths loop;
  loop.reinit({crack({Point<2>(0., 0.), Point<2>(4., 0.), Point<2>(4., 3.), Point<2>(1.7, -2.)})},
              1., [](const Point<2> &) { return true; });
  REQUIRE(loop.cross());
  CHECK(std::abs((*loop.cross())[1]) < 1e-12);
}


TEST_CASE("a way ends where it meets another path, and the fluid goes on there")
{
  TrackedPaths paths;
  paths.reinit(
    {crack({Point<2>(0., 0.), Point<2>(2., 0.)}), crack({Point<2>(3.7, -3.), Point<2>(3.7, 3.)})},
    1., [](const Point<2> &end) { return end[0] > 0.; });
  REQUIRE(paths.ends().size() == 3);
  const TrackedPaths::End end{0, 1};
  const Tensor<1, 2> along({1., 0.});
  paths.extend({{end, along}});
  CHECK(paths.ends().size() == 3);
  paths.extend({{end, along}}); // 0.7 to go
  CHECK(paths.ends().size() == 2);
  CHECK(paths.lead(end) == doctest::Approx(1.7));
  const std::size_t before = paths.wet_pieces().size();
  paths.set_advances([](const TrackedPaths::End &e) { return e.path == 0 ? 1.5 : 0.; }, none_ahead);
  const auto &pieces = paths.wet_pieces();
  REQUIRE(pieces.size() == before + 2);
  CHECK(!pieces[3].at_tip);
  REQUIRE(pieces[3].neighbours.size() == 2);
  const auto &other = pieces[pieces[3].neighbours[1]];
  CHECK(other.path == 1);
  CHECK(other.neighbours.back() == 3);
  // Fluid that went back would cut the other path off.
  paths.set_advances([](const TrackedPaths::End &) { return 0.; }, none_ahead);
  CHECK(!paths.let_fluid_back());
}


TEST_CASE("tips that come upon one another meet half-way, whatever their order")
{
  const Tensor<1, 2> along({1., 0.});
  const TrackedPaths::End left{0, 1}, right{1, 1};
  for (const double apart : {1.4, 3.2})
    for (const bool left_is_first : {true, false})
    {
      CAPTURE(apart);
      CAPTURE(left_is_first);
      TrackedPaths paths;
      paths.reinit({crack({Point<2>(0., 0.), Point<2>(2., 0.)}),
                    crack({Point<2>(4. + apart, 0.2), Point<2>(2. + apart, 0.2)})},
                   1., [&](const Point<2> &end) { return end[0] > 1. && end[0] < 3. + apart; });
      std::vector<std::pair<TrackedPaths::End, Tensor<1, 2>>> ahead{{left, along}, {right, -along}};
      if (!left_is_first)
        std::swap(ahead[0], ahead[1]);
      paths.extend(ahead);
      const unsigned int n = apart > 3. ? 4 : 3; // pieces of each, in the end
      if (n == 4)                                // they come nearer, both from where the other was
      {
        CHECK(paths.ends().size() == 2);
        CHECK(paths.way(left) == doctest::Approx(1.));
        CHECK(paths.way(right) == doctest::Approx(1.));
        paths.extend(ahead);
      }
      CHECK(paths.ends().empty());
      const double way = std::hypot(0.5 * apart, 0.1);
      CHECK(paths.way(left) == doctest::Approx(way));
      CHECK(paths.way(left) == doctest::Approx(paths.way(right)));
      for (const unsigned int path : {0u, 1u})
        CHECK(paths.point({path, 2. + paths.way(left)}).distance(Point<2>(2. + 0.5 * apart, 0.1)) <
              1e-12);
      paths.set_advances([&](const TrackedPaths::End &end) { return paths.way(end); }, none_ahead);
      const auto &pieces = paths.wet_pieces();
      REQUIRE(pieces.size() == 2 * n);
      CHECK(pieces[n - 1].neighbours == std::vector<unsigned int>{n - 2, 2 * n - 1});
      CHECK(pieces[2 * n - 1].neighbours == std::vector<unsigned int>{2 * n - 2, n - 1});
      CHECK(!pieces[n - 1].at_tip);
      CHECK(!pieces[2 * n - 1].at_tip);
    }
}


TEST_CASE("beyond a path that has been met another one begins, which fluid reaches from both")
{
  TrackedPaths paths;
  paths.reinit(
    {crack({Point<2>(0., 0.), Point<2>(2., 0.)}), crack({Point<2>(3.7, -3.), Point<2>(3.7, 3.)})},
    1., [](const Point<2> &end) { return end[0] > 0.; });
  const TrackedPaths::End end{0, 1};
  const Tensor<1, 2> along({1., 0.}), up({std::sqrt(0.5), std::sqrt(0.5)});
  CHECK(paths.meetings().empty());
  paths.extend({{end, along}});
  paths.extend({{end, along}});
  REQUIRE(paths.meetings().size() == 1);
  const auto meeting = paths.meetings().front();
  CHECK(meeting.place.distance(Point<2>(3.7, 0.)) < 1e-12);
  CHECK((meeting.across - along).norm() < 1e-12);
  CHECK(!meeting.beyond);
  const double length = paths.length();
  paths.begin_beyond(meeting, up);
  REQUIRE(paths.n_paths() == 3);
  CHECK(paths.began_beyond(2));
  CHECK(!paths.began_beyond(0));
  CHECK(!paths.is_wet(2));
  CHECK(paths.length() == doctest::Approx(length));
  // Another direction in its place.
  paths.begin_beyond(paths.meetings().front(), along);
  REQUIRE(paths.n_paths() == 3);
  const TrackedPaths::End beyond = *paths.meetings().front().beyond;
  CHECK((paths.direction(beyond) - along).norm() < 1e-12);
  const auto crossing = paths.crossing(Point<2>(4., -0.5), Point<2>(4., 0.5));
  REQUIRE(crossing);
  CHECK(crossing->path == 2);
  CHECK(paths.end_at(*crossing));
  CHECK(paths.shares(*crossing, 3.).empty());

  paths.extend({{beyond, along}});
  // A bond that has begun to soften lets no fluid in; a tenth of the first piece's energy does.
  for (const double advance : {0.01, 0.11})
  {
    paths.set_advances([advance](const TrackedPaths::End &e)
                       { return e.path == 0   ? 1.7
                                : e.path == 2 ? advance
                                              : 0.; },
                       none_ahead);
    CHECK(paths.advance(beyond) == advance);
    CHECK(paths.is_wet(2) == (advance > 0.1));
  }
  paths.set_advances([](const TrackedPaths::End &e)
                     { return e.path == 0   ? 1.7
                              : e.path == 2 ? 1.2
                                            : 0.; },
                     none_ahead);
  CHECK(paths.is_wet(2));
  CHECK(paths.tip(beyond).distance(Point<2>(4.9, 0.)) < 1e-12);
  const auto &pieces = paths.wet_pieces();
  const auto &last = pieces.back(), &first = pieces[pieces.size() - 2];
  CHECK(last.path == 2);
  CHECK(last.at_tip);
  CHECK(!first.at_tip);
  REQUIRE(first.neighbours.size() == 3);
  CHECK(pieces[first.neighbours[1]].path == 1);
  CHECK(pieces[first.neighbours[2]].path == 0);
}
} // namespace stockwork::peridynamics_paths_test
