// Bands of cracked cells: their areas, the rock on both sides of them, and the way of the fluid.
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <doctest/doctest.h>

#include "fracture/damage/band.h"

#include <algorithm>
#include <map>
#include <random>

namespace stockwork::damage_band_test
{
using namespace stockwork::damage;
using dealii::Point;
using dealii::Tensor;

namespace
{
enum class Mesh
{
  even,
  graded,
  distorted
};

/// Q1 displacements on the box [-1, 1]^dim with n cells along each side.
template <int dim>
struct Box
{
  explicit Box(const unsigned int n, const Mesh mesh = Mesh::even)
    : triangulation(MPI_COMM_WORLD)
    , fe(dealii::FE_Q<dim>(1), dim)
    , dof_handler(triangulation)
    , mapping(1)
  {
    std::vector<std::vector<double>> sizes(dim, std::vector<double>(n, 2. / n));
    if (mesh == Mesh::graded)
      for (unsigned int d = 0; d < dim; ++d)
      {
        double sum = 0.;
        for (unsigned int i = 0; i < n; ++i)
          sum += sizes[d][i] = std::pow(1.1 + 0.05 * d, std::abs(i - 0.4 * n));
        for (double &size : sizes[d])
          size *= 2. / sum;
      }
    Point<dim> low, high;
    for (unsigned int d = 0; d < dim; ++d)
    {
      low[d] = -1.;
      high[d] = 1.;
    }
    dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, sizes, low, high);
    if (mesh == Mesh::distorted)
      dealii::GridTools::transform(
        [](Point<dim> p)
        {
          const double x = p[0], y = p[1];
          p[0] += 0.06 * std::sin(3. * y) * (1. - x * x);
          p[1] += 0.05 * std::cos(2. * x) * (1. - y * y);
          return p;
        },
        triangulation);
    dof_handler.distribute_dofs(fe);
    constraints.close();
  }

  Band<dim> band(const InitialCrack<dim> &crack, const bool linear = false) const
  {
    Band<dim> band(linear);
    band.setup({triangulation, dof_handler, mapping, constraints, false});
    band.replace(band.passed(crack));
    return band;
  }

  dealii::parallel::distributed::Triangulation<dim> triangulation;
  dealii::FESystem<dim> fe;
  dealii::DoFHandler<dim> dof_handler;
  dealii::MappingQ<dim> mapping;
  dealii::AffineConstraints<double> constraints;
};


InitialCrack<2> line(const Point<2> &a, const Point<2> &b)
{
  InitialCrack<2> crack;
  crack.points = {a, b};
  return crack;
}


/// Through the whole box.
InitialCrack<2> line_at(const double angle, const Point<2> &through)
{
  const Tensor<1, 2> along({std::cos(angle), std::sin(angle)});
  return line(through - 4. * along, through + 4. * along);
}


InitialCrack<3> plane(Tensor<1, 3> normal, const Point<3> &through)
{
  InitialCrack<3> crack;
  crack.disc = Disc<3>{through, normal / normal.norm(), 10.};
  return crack;
}


/// The flux through the boundary of phi, one on the plus side of the plane, which by Gauss's
/// theorem is the area: by the trapezoidal rule, exact for what is linear along edges.
template <int dim>
double
area_by_boundary(const Box<dim> &box, const Tensor<1, dim> &normal, const Point<dim> &on_plane)
{
  double sum = 0.;
  for (const auto &cell : box.dof_handler.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
      {
        Tensor<1, dim> outward;
        for (unsigned int d = 0; d < dim; ++d)
          if (std::abs(std::abs(face->center()[d]) - 1.) < 1e-10)
            outward[d] = face->center()[d];
        for (unsigned int v = 0; v < face->n_vertices(); ++v)
          if (normal * (face->vertex(v) - on_plane) > 0.)
            sum += face->measure() / face->n_vertices() * (outward * normal);
      }
  return sum;
}


template <int dim>
double area(const Band<dim> &band)
{
  double sum = 0.;
  for (const CrackCell<dim> &cell : band.cells)
  {
    CHECK(cell.area() > 0.);
    sum += cell.area();
  }
  return sum;
}


/// Nodes on the plus side move by a and turn, and so do the jumps: greatest strain of a cell, in
/// the mean; where sides turn, their shear is not zero above and below the crack.
template <int dim>
double strain_of_halves(const Box<dim> &box,
                        const Band<dim> &band,
                        const Tensor<1, dim> &normal,
                        const Point<dim> &on_plane,
                        const Tensor<1, dim> &a,
                        const double turned = 0.)
{
  // About the last axis.
  Tensor<2, dim> turn;
  turn[0][1] = -turned;
  turn[1][0] = turned;
  double greatest = 0.;
  const dealii::QGauss<dim> quadrature(2);
  dealii::FE_Q<dim> vertex_functions(1);
  dealii::FEValues<dim> values(box.mapping, vertex_functions, quadrature, dealii::update_gradients);
  for (const auto &cell : box.dof_handler.active_cell_iterators())
  {
    values.reinit(typename dealii::Triangulation<dim>::active_cell_iterator(cell));
    const CutCell<dim> *cut = band.cut_cell(cell->active_cell_index());
    Tensor<2, dim> mean;
    for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      Tensor<2, dim> gradient;
      for (unsigned int v = 0; v < cell->n_vertices(); ++v)
        if (normal * (cell->vertex(v) - on_plane) > 1e-12)
          gradient += dealii::outer_product(a + turn * cell->vertex(v), values.shape_grad(v, q));
      for (unsigned int c = 0; cut && c < cut->n_columns(); ++c)
      {
        const unsigned int i = *band.number(cell), k = cut->extra[c] - band.first_unknown(i);
        const CrackCell<dim> &crack = band.cells[i];
        const double unknown = k < dim
                                 ? (a + turn * crack.middle())[k]
                                 : crack.size() * (crack.normal * (turn * crack.axes()[k - dim]));
        gradient[cut->component[c]] += unknown * cut->gradients[q * cut->n_columns() + c];
      }
      mean += quadrature.weight(q) * gradient;
      if (turned == 0.)
        greatest = std::max(greatest, gradient.norm());
    }
    greatest = std::max(greatest, Tensor<2, dim>(symmetrize(mean)).norm());
  }
  return greatest;
}
} // namespace


TEST_CASE("areas of the cells that a line passes add up to its length")
{
  // Between the middles of two edges, the sum is the length; elsewhere each end is known to half an
  // edge.
  std::mt19937 random(3);
  const unsigned int n = 20;
  for (const Mesh mesh : {Mesh::even, Mesh::graded, Mesh::distorted})
  {
    const Box<2> box(n, mesh);
    std::vector<Point<2>> left, right;
    for (const auto &cell : box.dof_handler.active_cell_iterators())
    {
      if (cell->face(0)->at_boundary())
        left.push_back(cell->face(0)->center());
      if (cell->face(1)->at_boundary())
        right.push_back(cell->face(1)->center());
    }
    for (unsigned int repeat = 0; repeat < 30; ++repeat)
    {
      const Point<2> a = left[random() % n], b = right[random() % n];
      CHECK(area(box.band(line(a - 0.1 * (b - a), b + 0.1 * (b - a)))) ==
            doctest::Approx(a.distance(b)).epsilon(1e-12));
    }
    for (unsigned int repeat = 0; repeat < 30; ++repeat)
    {
      const double angle = std::uniform_real_distribution<double>(0., M_PI)(random);
      const Point<2> centre(0.3 * std::sin(repeat), 0.3 * std::cos(repeat));
      const auto band = box.band(line_at(angle, centre));
      CHECK(area(band) ==
            doctest::Approx(area_by_boundary(box, band.cells[0].normal, centre)).epsilon(1e-12));
    }
  }
}


TEST_CASE("areas of the cells that a plane passes add up to its own")
{
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const Mesh mesh : {Mesh::even, Mesh::graded})
  {
    const Box<3> box(10, mesh);
    for (unsigned int repeat = 0; repeat < 10; ++repeat)
    {
      const Tensor<1, 3> across({normal(random), normal(random), normal(random)});
      const Point<3> centre(0.2 * std::sin(repeat), 0.2 * std::cos(repeat), 0.1);
      const auto band = box.band(plane(across, centre));
      CHECK(area(band) ==
            doctest::Approx(area_by_boundary(box, band.cells[0].normal, centre)).epsilon(1e-12));
    }
  }
  // One parallel to an axis, between the middles of edges: 2 x 2 / cos(angle).
  const Box<3> box(10);
  for (const unsigned int rise : {0, 1, 3, 8})
  {
    const double tangent = 0.1 * rise;
    CHECK(area(box.band(plane(Tensor<1, 3>({-tangent, 1., 0.}), Point<3>(-1., -0.9, 0.3)))) ==
          doctest::Approx(4. * std::sqrt(1. + tangent * tangent)).epsilon(1e-12));
  }
  // An inclined one through the middle: a hexagon, in cells of a fifteenth of its width.
  const double exact = 3. * std::sqrt(3.); // across (1, 1, 1): sides of sqrt(2)
  CHECK(area(Box<3>(15).band(plane(Tensor<1, 3>({1., 1., 1.}), Point<3>()))) ==
        doctest::Approx(exact).epsilon(0.01));
}


TEST_CASE("halves of a body that move apart leave no strain in any cell, at any angle")
{
  for (const double degrees : {0., 10., 22.5, 45., 80., 90., 135., 170.})
    for (const double shift : {0., 0.013, 0.05})
    {
      CAPTURE(degrees);
      CAPTURE(shift);
      const double angle = degrees * M_PI / 180.;
      const Point<2> centre(shift, -shift);
      for (const Mesh mesh : {Mesh::even, Mesh::graded, Mesh::distorted})
      {
        const Box<2> box(20, mesh);
        const auto band = box.band(line_at(angle, centre));
        const Tensor<1, 2> &normal = band.cells[0].normal;
        for (const auto &a : {normal, Tensor<1, 2>({0.3, -0.7})})
          CHECK(strain_of_halves(box, band, normal, centre, a) < 1e-10);
        // Where the mesh lets each side have as many vertices as the other, they may turn as well.
        if (mesh != Mesh::distorted && std::fmod(degrees, 90.) == 0.)
          CHECK(strain_of_halves(box, box.band(line_at(angle, centre), true), normal, centre,
                                 Tensor<1, 2>({0.3, -0.7}), 0.2) < 1e-10);
      }
      const Box<3> box(8);
      const Point<3> middle(shift, -shift, shift);
      const auto band =
        box.band(plane(Tensor<1, 3>({-std::sin(angle), std::cos(angle), 0.4}), middle));
      CHECK(strain_of_halves(box, band, band.cells[0].normal, middle,
                             Tensor<1, 3>({0.3, -0.7, 0.2})) < 1e-10);
    }
}


TEST_CASE("a band that has grown in parts is the one that is there at once")
{
  const Box<3> box(12);
  const auto whole = box.band(plane(Tensor<1, 3>({0.2, 1., 0.4}), Point<3>(0.03, -0.02, 0.01)));
  REQUIRE(whole.cells.size() > 100);
  Band<3> grown(false);
  grown.setup({box.triangulation, box.dof_handler, box.mapping, box.constraints, false});
  for (unsigned int i = 0; i < whole.cells.size(); i += 7)
  {
    const auto first = whole.cells.begin() + i,
               last = i + 7 < whole.cells.size() ? first + 7 : whole.cells.end();
    grown.add({first, last});
  }
  REQUIRE(grown.cells.size() == whole.cells.size());
  REQUIRE(grown.owned().size() == whole.owned().size());
  for (unsigned int k = 0; k < whole.owned().size(); ++k)
  {
    const unsigned int i = whole.owned()[k].number,
                       cell = whole.owned()[k].cell->active_cell_index();
    CHECK(grown.owned()[k].number == i);
    CHECK(grown.owned()[k].cell == whole.owned()[k].cell);
    CHECK(grown.first_unknown(i) == whole.first_unknown(i));
    CHECK(grown.is_front(i) == whole.is_front(i));
    for (unsigned int f = 0; f < Band<3>::n_faces; ++f)
      CHECK(grown.neighbour(i, f) == whole.neighbour(i, f));
    REQUIRE(grown.cut_cell(cell) != nullptr);
    CHECK(grown.cut_cell(cell)->extra == whole.cut_cell(cell)->extra);
    CHECK(grown.cut_cell(cell)->values == whole.cut_cell(cell)->values);
  }
  // Put back, nothing of what came last is left.
  const auto part =
    std::vector<CrackCell<3>>(whole.cells.begin(), whole.cells.begin() + whole.cells.size() / 2);
  grown.replace(part);
  CHECK(grown.unknowns().size() == 3 * part.size());
  CHECK(grown.owned().size() == part.size());
  CHECK(grown.segments([](const Point<3> &) { return 0.; }).size() == part.size());
}


TEST_CASE("a crack with a corner has every vertex on one side")
{
  const Box<2> box(20);
  for (const double degrees : {5., 20., 40., -30.})
    for (const double shift : {0., 0.02, 0.05, 0.07})
    {
      CAPTURE(degrees);
      CAPTURE(shift);
      const double angle = degrees * M_PI / 180.;
      const Point<2> corner(shift, 0.3 * shift + 0.01);
      InitialCrack<2> crack;
      crack.points = {corner - Tensor<1, 2>({0.6, 0.05}), corner,
                      corner + 0.6 * Tensor<1, 2>({std::cos(angle), std::sin(angle)})};
      const auto band = box.band(crack);
      unsigned int n_contradictions = 0;
      for (const auto &one : band.cells)
        for (const auto &other : band.cells)
          for (unsigned int v = 0; v < 4; ++v)
            for (unsigned int w = 0; w < 4; ++w)
              n_contradictions += one.vertices[v].distance(other.vertices[w]) < 1e-10 &&
                                  one.is_on_plus_side(v) != other.is_on_plus_side(w);
      CHECK(n_contradictions == 0);
    }
}


TEST_CASE("fluid goes as far along a straight crack as this is long")
{
  const Box<2> box(40);
  const double h = 0.05;
  for (const double degrees : {0., 3., 7., 10., 22.5, 30., 45., 67.5, 80., 90.})
  {
    CAPTURE(degrees);
    const double angle = degrees * M_PI / 180.;
    const Tensor<1, 2> along({std::cos(angle), std::sin(angle)});
    const Point<2> centre(0.011, 0.017);
    const auto band = box.band(line(centre - 0.6 * along, centre + 0.6 * along));
    const auto segments = band.segments([](const Point<2> &) { return 0.; });
    REQUIRE(segments.size() == band.cells.size());
    std::map<std::uint64_t, const Segment<2> *> by_key;
    for (const auto &segment : segments)
      by_key[segment.key] = &segment;
    double distance = 0., total = 0., first = 1e9, last = -1e9;
    unsigned int n_ends = 0;
    // Steps aside are no shorter than a twentieth of a cell.
    const double epsilon = degrees > 0. && degrees < 6. ? 0.01 : 1e-10;
    for (const auto &segment : segments)
    {
      double own = 0.;
      for (const auto &neighbour : segment.neighbours)
      {
        own += neighbour.distance;
        CHECK(neighbour.width == 1.);
        const auto &back = by_key.at(neighbour.key)->neighbours;
        CHECK(std::count_if(back.begin(), back.end(),
                            [&](const auto &other) { return other.key == segment.key; }) == 1);
      }
      distance += own;
      total += segment.area;
      n_ends += segment.neighbours.size() == 1;
      if (segment.neighbours.size() == 2)
        CHECK(own == doctest::Approx(segment.area).epsilon(epsilon > 1e-9 ? 0.2 : 1e-10));
      const double place = along * (segment.centre - centre);
      first = std::min(first, place);
      last = std::max(last, place);
    }
    CHECK(n_ends == 2);
    CHECK(distance == doctest::Approx(last - first).epsilon(epsilon));
    CHECK(std::abs(total - 1.2) < 1.01 * h);
  }
}


TEST_CASE("a plane conducts alike in all its directions, whatever stairs its cells lie in")
{
  // A linear pressure of gradient g drives T g between two centres d apart, d d T in all: with the
  // edges that cubes really have on a plane, a partition with edges across the lines between its
  // centres, the sum of width |d| (d d)/|d|^2 is the area times the plane's unit tensor.
  const unsigned int n = 24;
  const Box<3> box(n);
  const double h = 2. / n;
  for (const auto &across : {Tensor<1, 3>({0., 1., 0.}), Tensor<1, 3>({-0.45, 0.89, 0.}),
                             Tensor<1, 3>({-1., 1., 0.}), Tensor<1, 3>({-0.42, 0.84, 0.34}),
                             Tensor<1, 3>({-1., 1., 1.}), Tensor<1, 3>({0.1, 1., 0.2})})
  {
    CAPTURE(across);
    const auto band = box.band(plane(across, Point<3>(0.011, 0.017, 0.023)));
    const Tensor<1, 3> normal = band.cells[0].normal;
    const auto segments = band.segments([](const Point<3> &) { return 0.; });
    std::map<std::uint64_t, const Segment<3> *> by_key;
    for (const auto &segment : segments)
      by_key[segment.key] = &segment;
    Tensor<2, 3> conducts;
    double covered = 0.;
    for (const auto &segment : segments)
    {
      if (segment.centre.norm() > 0.7)
        continue;
      covered += segment.area;
      for (const auto &neighbour : segment.neighbours)
      {
        const auto &other = *by_key.at(neighbour.key);
        const auto back = std::find_if(other.neighbours.begin(), other.neighbours.end(),
                                       [&](const auto &entry) { return entry.key == segment.key; });
        REQUIRE(back != other.neighbours.end());
        CHECK(back->width == doctest::Approx(neighbour.width).epsilon(1e-12));
        const Tensor<1, 3> way = other.centre - segment.centre;
        conducts += neighbour.width * neighbour.distance / way.norm_square() *
                    dealii::outer_product(way, way);
      }
    }
    REQUIRE(covered > 1.2);
    const Tensor<2, 3> wanted =
      dealii::unit_symmetric_tensor<3>() - dealii::outer_product(normal, normal);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        CHECK(std::abs((conducts / covered - wanted)[i][j]) < 0.6 * h);
  }
}


TEST_CASE("the stairs of a plane lean to all sides alike")
{
  const Box<3> box(24);
  for (const auto &across : {Tensor<1, 3>({0., 1., 0.}), Tensor<1, 3>({-1., 1., 0.})})
    for (const auto &cell : box.band(plane(across, Point<3>(0.011, 0.017, 0.023))).cells)
      CHECK(cell.lean().norm() < 1e-12);
  const auto band =
    box.band(plane(Tensor<1, 3>({-0.42, 0.84, 0.34}), Point<3>(0.011, 0.017, 0.023)));
  Tensor<1, 3> sum;
  double area = 0., most = 0.;
  for (const auto &cell : band.cells)
  {
    if (cell.centre().norm() > 0.7)
      continue;
    area += cell.area();
    sum += cell.area() * cell.lean();
    most = std::max(most, cell.lean().norm());
    CHECK(std::abs(cell.lean() * cell.normal) < 1e-12);
  }
  CHECK(most > 0.3);
  CHECK(sum.norm() / area < 0.02);
}
} // namespace stockwork::damage_band_test
