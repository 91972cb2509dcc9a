// Cutting cells: geometry, quadrature, numbering, growth, and a body that a crack cuts in two.
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <doctest/doctest.h>

#include "discontinuity/discontinuity.h"
#include "stockwork/base/error.h"

namespace stockwork::discontinuity_test
{
using dealii::Point;
using dealii::Tensor;

namespace
{
/// Q1 displacements on the square [-1, 1]^2 with n x n cells, distorted if asked for.
struct Square
{
  explicit Square(const unsigned int n, const bool distort = false)
    : triangulation(MPI_COMM_WORLD)
    , fe(dealii::FE_Q<2>(1), 2)
    , dof_handler(triangulation)
    , mapping(1)
    , collectives(MPI_COMM_WORLD)
  {
    dealii::GridGenerator::subdivided_hyper_cube(triangulation, n, -1., 1.);
    if (distort)
      dealii::GridTools::transform(
        [](const Point<2> &p)
        {
          return Point<2>(p[0] + 0.06 * std::sin(3. * p[1]) * (1. - p[0] * p[0]),
                          p[1] + 0.05 * std::cos(2. * p[0]) * (1. - p[1] * p[1]));
        },
        triangulation);
    dof_handler.distribute_dofs(fe);
    constraints.close();
  }

  MeshView<2> mesh_view() const
  {
    return {triangulation, dof_handler, mapping, constraints, false};
  }

  dealii::parallel::distributed::Triangulation<2> triangulation;
  dealii::FESystem<2> fe;
  dealii::DoFHandler<2> dof_handler;
  dealii::MappingQ<2> mapping;
  dealii::AffineConstraints<double> constraints;
  Collectives collectives;
};

Discontinuity<2> cut(const Square &square, const std::vector<std::vector<Point<2>>> &polylines)
{
  Discontinuity<2> discontinuity(2.8);
  discontinuity.setup(square.mesh_view(), square.collectives);
  std::vector<InitialCrack<2>> cracks;
  for (const auto &polyline : polylines)
  {
    cracks.emplace_back();
    cracks.back().points = polyline;
  }
  discontinuity.cut(cracks, square.collectives);
  return discontinuity;
}

/// A piece in the unit cell.
CrackPiece<2> piece_in_unit_cell(const Point<2> &a, const Point<2> &b)
{
  CrackPiece<2> piece;
  for (unsigned int v = 0; v < 4; ++v)
    piece.corners[v] = dealii::GeometryInfo<2>::unit_cell_vertex(v);
  const Point<2> ends[2] = {a, b};
  for (unsigned int e = 0; e < 2; ++e)
  {
    const Point<2> &p = ends[e];
    piece.unit_ends[e] = piece.ends[e] = p;
    piece.faces[e] = p[0] == 0. ? 0 : p[0] == 1. ? 1 : p[1] == 0. ? 2 : 3;
  }
  return piece;
}
} // namespace

TEST_CASE("split quadrature: area and moments of both parts, down to slivers")
{
  for (const double cut : {0.5, 0.3, 1e-2, 1e-4, 1e-8})
    for (const auto &piece : {
           piece_in_unit_cell({0., cut}, {1., cut}),     // a row
           piece_in_unit_cell({1., cut}, {0., 0.4}),     // inclined, backwards
           piece_in_unit_cell({0., cut}, {cut, 0.}),     // a corner
           piece_in_unit_cell({1. - cut, 1.}, {1., 0.7}) // another one
         })
    {
      const auto rule = split_quadrature(piece, 1);
      double area = 0., plus = 0., moment = 0.;
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double x = rule.point(q)[0], y = rule.point(q)[1];
        area += rule.weight(q);
        plus += piece.plus_side(rule.point(q)) * rule.weight(q);
        moment += rule.weight(q) * x * x * y * y * y;
        CHECK(rule.weight(q) > 0.);
      }
      CHECK(area == doctest::Approx(1.).epsilon(1e-14));
      CHECK(moment == doctest::Approx(1. / 12.).epsilon(1e-14));
      // The plus side lies to the left of the piece: the shoelace formula.
      const Point<2> &a = piece.ends[0], &b = piece.ends[1];
      double exact = 0.;
      {
        std::vector<Point<2>> polygon{a, b};
        const Point<2> corner[4] = {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}};
        const auto angle = [](const Point<2> &p) {
          return p[1] == 0. ? p[0] : p[0] == 1. ? 1. + p[1] : p[1] == 1. ? 3. - p[0] : 4. - p[1];
        };
        for (int k = 0; k < 8; ++k)
        {
          const double end = angle(a) > angle(b) ? angle(a) : angle(a) + 4.;
          if (k > angle(b) && k < end)
            polygon.push_back(corner[k % 4]);
        }
        for (unsigned int i = 0; i < polygon.size(); ++i)
        {
          const auto &p = polygon[i], &r = polygon[(i + 1) % polygon.size()];
          exact += 0.5 * (p[0] * r[1] - p[1] * r[0]);
        }
      }
      CHECK(plus == doctest::Approx(exact).epsilon(1e-12));
    }
}

TEST_CASE("spans are about as long as a cell, and point along the crack, wherever it lies")
{
  Square square(20);
  const double h = 0.1;
  for (const double angle : {0., 10., 27., 45., 63., 80., 90.})
    for (const double shift : {0., 1e-9, 1e-4, 0.013, 0.05, 1. / 30.})
    {
      CAPTURE(angle);
      CAPTURE(shift);
      const double a = angle * dealii::numbers::PI / 180., c = std::cos(a), s = std::sin(a);
      const Point<2> centre(shift, -shift);
      const Tensor<1, 2> half({0.53 * c, 0.53 * s});
      auto discontinuity = cut(square, {{centre - half, centre + half}});
      const double longest = h / std::max(std::abs(c), std::abs(s));
      const auto check = [&]()
      {
        const auto &path = discontinuity.paths()[0];
        double length = 0.;
        for (const CrackSpan &span : discontinuity.spans(0))
        {
          const double own = discontinuity.length(0, span);
          CHECK(own == doctest::Approx(longest).epsilon(5e-3)); // crossings keep clear of vertices
          length += own;
          for (unsigned int i = span.first; i <= span.last; ++i)
          {
            CHECK(path.pieces[i].along * half / half.norm() == doctest::Approx(1.).epsilon(1e-12));
            CHECK(discontinuity.segment_key(0, i) == discontinuity.key(0, span));
          }
        }
        CHECK(length == doctest::Approx(path.length()));
        for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
          CHECK(path.piece_at(end).crosses_transverse_face(static_cast<unsigned int>(end)));
        return length;
      };
      const double length = check();
      CHECK(std::abs(length - 1.06) < longest * 1.01);

      // A segment for each span, as long as it.
      const auto segments = discontinuity.segments([](const Point<2> &) { return 0.; });
      double area = 0.;
      for (const auto &segment : segments)
        area += segment.area;
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
      {
        CHECK(segments.size() == discontinuity.spans(0).size());
        CHECK(area == doctest::Approx(length));
      }

      // Each end advances by a span.
      const auto direction = half / half.norm();
      const auto outcomes = discontinuity.grow(
        {{0, CrackEnd::first, -direction}, {0, CrackEnd::last, direction}}, square.collectives);
      for (const auto outcome : outcomes)
        CHECK(outcome == Discontinuity<2>::Outcome::grown);
      CHECK(check() == doctest::Approx(length + 2. * longest).epsilon(1e-3));
    }
}

TEST_CASE("weights of cut cells sum to their area on a distorted mesh")
{
  Square square(9, true);
  const auto discontinuity = cut(square, {{{-0.81, -0.3}, {0.7, 0.52}}});
  unsigned int n = 0;
  for (const auto &cell : square.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const auto *c = discontinuity.cut_cell(cell->active_cell_index()))
      {
        ++n;
        double area = 0.;
        for (const double w : c->weights)
          area += w;
        CHECK(area == doctest::Approx(cell->measure()).epsilon(1e-14));
      }
  unsigned int n_pieces = discontinuity.paths()[0].pieces.size();
  CHECK(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD) == n_pieces);
  CHECK(n_pieces > 8);
}

TEST_CASE("a crack ends on the nearest edge, its pieces form a chain")
{
  Square square(10); // cells of 0.2
  const auto discontinuity = cut(square, {{{-0.57, 0.1}, {0.44, 0.1}}});
  const auto &path = discontinuity.paths()[0];
  CHECK(path.pieces.size() == 5);
  CHECK(path.tip(CrackEnd::first)[0] == doctest::Approx(-0.6));
  CHECK(path.tip(CrackEnd::last)[0] == doctest::Approx(0.4));
  for (unsigned int i = 0; i + 1 < path.pieces.size(); ++i)
    CHECK(path.pieces[i].ends[1].distance(path.pieces[i + 1].ends[0]) < 1e-14);
  CHECK(path.is_tip[0]);
  CHECK(path.is_tip[1]);
  CHECK(path.direction(CrackEnd::first)[0] == doctest::Approx(-1.));
  // Vertices between the two tip edges: 4 columns of 2, both components.
  CHECK(discontinuity.enrichment().unknowns().size() == 16);
}

TEST_CASE("a crack from the boundary has a mouth")
{
  Square square(10);
  const auto discontinuity = cut(square, {{{-1., 0.1}, {-0.6, 0.1}}});
  CHECK(!discontinuity.paths()[0].is_tip[0]);
  CHECK(discontinuity.paths()[0].is_tip[1]);
  CHECK(discontinuity.enrichment().unknowns().size() == 8);
}

TEST_CASE("a crack along a mesh line, through vertices, and at a shallow angle")
{
  Square square(10);
  for (const auto &line : {std::vector<Point<2>>{{-0.6, 0.}, {0.6, 0.}}, // on mesh lines
                           std::vector<Point<2>>{{0.2, -0.6}, {0.2, 0.6}},
                           std::vector<Point<2>>{{-0.6, -0.6}, {0.6, 0.6}},   // through vertices
                           std::vector<Point<2>>{{-0.6, 1e-5}, {0.6, -1e-5}}, // through one
                           std::vector<Point<2>>{{-0.7, 0.11}, {0.1, 0.}, {0.7, -0.3}}})
  {
    const auto discontinuity = cut(square, {line});
    const auto &path = discontinuity.paths()[0];
    double length = 0.;
    for (unsigned int i = 1; i < line.size(); ++i)
      length += line[i].distance(line[i - 1]);
    CHECK(path.length() == doctest::Approx(length).epsilon(0.15));
    for (const auto &piece : path.pieces)
    {
      CHECK(piece.length() > 1e-4);
      for (unsigned int e = 0; e < 2; ++e)
        for (const auto &corner : piece.corners)
          CHECK(piece.ends[e].distance(corner) > 0.99e-3 * 0.2);
    }
  }
}

TEST_CASE("keys do not change when a crack grows, and come back after a rollback")
{
  Square square(10);
  auto discontinuity = cut(square, {{{-0.2, 0.1}, {0.2, 0.1}}});
  const auto before = discontinuity.enrichment().unknowns();
  const auto paths = discontinuity.paths();
  Tensor<1, 2> right, left;
  right[0] = 1.;
  right[1] = 0.3;
  left[0] = -1.;
  const auto outcomes = discontinuity.grow(
    {{0, CrackEnd::last, right / right.norm()}, {0, CrackEnd::first, left}}, square.collectives);
  CHECK(outcomes[0] == Discontinuity<2>::Outcome::grown);
  CHECK(outcomes[1] == Discontinuity<2>::Outcome::grown);
  CHECK(discontinuity.paths()[0].pieces.size() == 4);
  CHECK(discontinuity.paths()[0].tip(CrackEnd::last)[1] == doctest::Approx(0.1 + 0.06));
  CHECK(discontinuity.paths()[0].tip(CrackEnd::first)[0] == doctest::Approx(-0.4));
  for (unsigned int i = 0; i + 1 < 4; ++i)
    CHECK(discontinuity.paths()[0].pieces[i].ends[1].distance(
            discontinuity.paths()[0].pieces[i + 1].ends[0]) < 1e-14);
  const auto &after = discontinuity.enrichment().unknowns();
  CHECK(after.size() == before.size() + 8);
  for (const auto &unknown : before)
    CHECK(std::count_if(after.begin(), after.end(),
                        [&](const ExtraUnknown &u) { return u.key == unknown.key; }) == 1);

  discontinuity.restore(paths);
  REQUIRE(discontinuity.enrichment().unknowns().size() == before.size());
  for (unsigned int i = 0; i < before.size(); ++i)
    CHECK(discontinuity.enrichment().unknowns()[i].key == before[i].key);
}

TEST_CASE("growth goes on to the boundary, never turns back, and ends on another crack")
{
  Square square(10);
  auto discontinuity = cut(square, {{{0.2, 0.1}, {0.6, 0.1}}, {{-0.5, -0.6}, {-0.5, 0.6}}});
  Tensor<1, 2> right, down;
  right[0] = 1.;
  down[0] = 1e-12;
  down[1] = -1.;
  using Outcome = Discontinuity<2>::Outcome;
  CHECK(discontinuity.grow({{0, CrackEnd::last, right}}, square.collectives)[0] == Outcome::grown);
  CHECK(discontinuity.grow({{0, CrackEnd::last, right}}, square.collectives)[0] ==
        Outcome::reached_boundary);
  CHECK(!discontinuity.paths()[0].is_tip[1]);
  // Along the edge it leaves through, a tip still finds its way into the next cell.
  CHECK(discontinuity.grow({{0, CrackEnd::first, down}}, square.collectives)[0] == Outcome::grown);
  CHECK(discontinuity.paths()[0].pieces.front().length() > 0.09);
  Tensor<1, 2> left;
  left[0] = -1.;
  auto outcome = Outcome::grown;
  for (unsigned int i = 0; i < 10 && outcome == Outcome::grown; ++i)
    outcome = discontinuity.grow({{0, CrackEnd::first, left}}, square.collectives)[0];
  CHECK(outcome == Outcome::joined_crack);
  CHECK(discontinuity.paths()[0].ends_on[0] == 1);
  CHECK(!discontinuity.paths()[0].is_tip[0]);
  CHECK(discontinuity.paths()[0].tip(CrackEnd::first)[0] == doctest::Approx(-0.5));
}

TEST_CASE("a crack that the mesh cannot hold is refused with the entry that asks for it")
{
  Square square(10);
  Discontinuity<2> discontinuity(2.8);
  discontinuity.setup(square.mesh_view(), square.collectives);
  const auto refused = [&](const std::vector<InitialCrack<2>> &cracks)
  {
    try
    {
      discontinuity.cut(cracks, square.collectives);
    }
    catch (const EntryError &error)
    {
      return error.path() + ": " + error.what();
    }
    return std::string("accepted");
  };
  using Kind = InitialCrack<2>::Kind;
  const InitialCrack<2> along{{{-0.6, 0.1}, {0.6, 0.1}}, Kind::open, "Cracks/Open", "along", {}},
    across{{{-0.1, -0.6}, {-0.1, 0.6}}, Kind::cohesive, "Cracks/Cohesive", "across", {}},
    outside{{{2., 0.1}, {2.6, 0.1}}, Kind::open, "Cracks/Open", "outside", {}};
  CHECK(refused({along}) == "accepted");
  CHECK(refused({along, across}).find("Cracks/Cohesive: 'Cracks/Cohesive' is 'across'") == 0);
  CHECK(refused({outside}).find("Cracks/Open: 'Cracks/Open' is 'outside'") == 0);
}

TEST_CASE("tips with functions of their own lie where the crack ends")
{
  Square square(10); // cells of 0.2
  Discontinuity<2> discontinuity(2.8);
  discontinuity.setup(square.mesh_view(), square.collectives);
  InitialCrack<2> crack;
  crack.points = {{-0.57, 0.1}, {0.44, 0.13}};
  RockProperties properties;
  properties.young_modulus = 1.;
  properties.poisson_ratio = 0.25;
  const LinearStiffness<2> rock(properties);
  discontinuity.cut({crack}, square.collectives, [&](const auto) { return rock; });
  const auto &path = discontinuity.paths()[0];
  CHECK(path.length() == doctest::Approx(std::hypot(1.01, 0.03)));
  CHECK(path.pieces.size() == 6);
  const auto *tip = discontinuity.tip(0, CrackEnd::last);
  REQUIRE(tip != nullptr);
  CHECK(tip->radius == doctest::Approx(0.5 * std::hypot(1.01, 0.03)));
  // Corners between the cells of the tips: 3 columns of 2, both components; two per tip.
  CHECK(discontinuity.enrichment().unknowns().size() == 12 + 4);

  // The opening of a unit function near its tip is the root of the distance; both tips open.
  for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
  {
    const auto &piece = path.piece_at(end);
    const Tensor<1, 2> jump = discontinuity.tip(0, end)->mean_jump(0, piece);
    CHECK(jump * piece.normal() > 0.);
    const double r = piece.length(), R = tip->radius;
    CHECK(jump.norm() == doctest::Approx(2. / 3. * std::sqrt(r / R)).epsilon(0.06));
  }
  // The jump of the function itself, from both sides of the crack.
  using Side = CrackTip<2>::Side;
  const Point<2> x = path.pieces[4].centre();
  for (unsigned int mode = 0; mode < 2; ++mode)
  {
    const auto plus = tip->evaluate(mode, x, Side::plus),
               minus = tip->evaluate(mode, x, Side::minus);
    const Tensor<1, 2> jump = plus.value - minus.value;
    CHECK(jump * (mode == 0 ? path.pieces[4].normal() : path.pieces[4].along) ==
          doctest::Approx(jump.norm()));
    // The gradient against differences.
    for (unsigned int d = 0; d < 2; ++d)
    {
      Point<2> a(0.35, 0.2), b = a;
      const double eps = 1e-6;
      a[d] -= eps;
      b[d] += eps;
      const auto difference = (tip->evaluate(mode, b, Side::by_place).value -
                               tip->evaluate(mode, a, Side::by_place).value) /
                              (2. * eps);
      const auto gradient = tip->evaluate(mode, Point<2>(0.35, 0.2), Side::by_place).gradient;
      for (unsigned int i = 0; i < 2; ++i)
        CHECK(difference[i] == doctest::Approx(gradient[i][d]).epsilon(1e-6));
    }
  }
}

TEST_CASE("the rule around a tip integrates the inverse of the distance")
{
  const Point<2> tip(0.3, 0.4);
  const auto rule = fan_quadrature(tip, std::make_pair(Point<2>(0., 0.2), 0u), 6);
  double area = 0., integral = 0.;
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    area += rule.weight(q);
    integral += rule.weight(q) / rule.point(q).distance(tip);
  }
  CHECK(area == doctest::Approx(1.).epsilon(1e-13));
  // In closed form: for each edge, its distance times the integral of 1/cos over its angle.
  const auto edge = [](const double d, const double from, const double to)
  { return d * (std::asinh(to / d) - std::asinh(from / d)); };
  const double exact =
    edge(0.3, -0.4, 0.6) + edge(0.7, -0.4, 0.6) + edge(0.4, -0.3, 0.7) + edge(0.6, -0.3, 0.7);
  CHECK(integral == doctest::Approx(exact).epsilon(1e-4));
}

TEST_CASE("two cracks that cross and a crack off the mesh are refused")
{
  Square square(10);
  CHECK_THROWS_AS(cut(square, {{{-0.6, 0.1}, {0.6, 0.1}}, {{-0.1, -0.6}, {-0.1, 0.6}}}),
                  InputError);
  CHECK_THROWS_AS(cut(square, {{{2., 0.1}, {2.6, 0.1}}}), InputError);
}
} // namespace stockwork::discontinuity_test
