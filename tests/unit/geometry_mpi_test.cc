// Runs on one and on two ranks.
#include <doctest/doctest.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>

#include "mesh/geometry.h"
#include "mesh/partition.h"
#include "mesh/refinement.h"
#include "stockwork/base/error.h"

namespace stockwork::geometry_mpi_test
{
using namespace dealii;

namespace
{
template <int dim>
struct Case
{
  explicit Case(const std::string &deck)
    : triangulation(MPI_COMM_WORLD)
  {
    ParameterHandler prm;
    Geometry<dim>::declare_parameters(prm);
    // Of unit size where the test does not say otherwise; an entry of a shape that is not there is
    // refused.
    const bool is_ball =
      deck.find("disc") != std::string::npos || deck.find("ball") != std::string::npos;
    const std::string size = is_ball ? "subsection Ball\nset Radius = 1\nend\n"
                                     : "subsection Box\nset Upper corner = 1, 1" +
                                         std::string(dim == 3 ? ", 1" : "") + "\nend\n";
    prm.parse_input_from_string("subsection Mesh\n" + size + deck + "\nend\n");
    geometry.parse_parameters(prm, STOCKWORK_TEST_DATA);
    geometry.create(triangulation);
  }

  double volume() const
  {
    return GridTools::volume(triangulation, *geometry.mapping());
  }

  /// Area of a side, with the shape's mapping.
  double area(const std::string &side) const
  {
    const QGauss<dim - 1> quadrature(3);
    FE_Nothing<dim> fe;
    const auto mapping = geometry.mapping();
    FEFaceValues<dim> face_values(*mapping, fe, quadrature, update_JxW_values);
    double sum = 0.;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == geometry.side(side))
          {
            face_values.reinit(cell, f);
            for (const double JxW : face_values.get_JxW_values())
              sum += JxW;
          }
    return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }

  Geometry<dim> geometry;
  parallel::distributed::Triangulation<dim> triangulation;
};

template <int dim>
double region_volume(const Case<dim> &c, const std::string &name)
{
  double sum = 0.;
  for (const auto &cell : c.triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->material_id() == c.geometry.region(name))
      sum += cell->measure();
  return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}

std::string box(const std::string &entries)
{
  return "subsection Box\n" + entries + "\nend\n";
}

/// The message of the error that a deck must give.
template <int dim>
std::string error_of(const std::string &deck)
{
  try
  {
    Case<dim> c(deck);
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "no error";
}

bool contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}
} // namespace

TEST_CASE("box: volume, sides, corners")
{
  const Case<2> c(box("set Lower corner = -1 m, 0\nset Upper corner = 3, 50 cm\n"
                      "set X spacing = 6 cells\nset Y spacing = 4 cells"));
  CHECK(c.volume() == doctest::Approx(2.));
  CHECK(c.triangulation.n_global_active_cells() == 24);
  CHECK(c.area("left") == doctest::Approx(0.5));
  CHECK(c.area("right") == doctest::Approx(0.5));
  CHECK(c.area("bottom") == doctest::Approx(4.));
  CHECK(c.area("top") == doctest::Approx(4.));
  CHECK(c.geometry.diameter() == doctest::Approx(std::sqrt(16.25)));
  CHECK(c.geometry.lower() == Point<2>(-1., 0.));
  CHECK(c.geometry.upper() == Point<2>(3., 0.5));
  for (const auto &cell : c.triangulation.active_cell_iterators())
    CHECK(cell->material_id() == 0);

  const Case<3> d(box("set Upper corner = 1, 2, 3\nset X spacing = 2 cells\n"
                      "set Y spacing = 3 cells\nset Z spacing = lines 0, 1, 3"));
  CHECK(d.volume() == doctest::Approx(6.));
  CHECK(d.triangulation.n_global_active_cells() == 12);
  CHECK(d.area("left") == doctest::Approx(6.));
  CHECK(d.area("front") == doctest::Approx(3.));
  CHECK(d.area("back") == doctest::Approx(3.));
  CHECK(d.area("bottom") == doctest::Approx(2.));
  CHECK(d.area("top") == doctest::Approx(2.));
  CHECK(d.geometry.side_names().size() == 6);
}

TEST_CASE("sides of a box are where their names say")
{
  const Case<3> c("");
  const std::array<std::string, 6> names{{"left", "right", "front", "back", "bottom", "top"}};
  for (const auto &cell : c.triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (!cell->is_artificial() && face->at_boundary())
        for (unsigned int s = 0; s < 6; ++s)
          if (face->boundary_id() == c.geometry.side(names[s]))
            CHECK(face->center()[s / 2] == doctest::Approx(s % 2));
}

TEST_CASE("sides of the deck's own, through refinement")
{
  // Many coarse cells: p4est does not number them as they came.
  for (const char *refinements : {"0", "2"})
  {
    Case<2> c(
      "set Uniform refinements = " + std::string(refinements) +
      "\nset Side boxes = upper: (-1 mm, 0.6) to (1 mm, 2); lower: (-1 mm, -1) to (1 mm, 0.4)\n" +
      box("set Upper corner = 3, 1\nset X spacing = 15 cells\nset Y spacing = 5 cells"));
    CHECK(c.area("upper") == doctest::Approx(0.4));
    CHECK(c.area("lower") == doctest::Approx(0.4));
    CHECK(c.area("left") == doctest::Approx(0.2));
    CHECK(c.area("right") == doctest::Approx(1.));
    CHECK(c.area("top") == doctest::Approx(3.));
    CHECK(c.area("bottom") == doctest::Approx(3.));
  }
}

TEST_CASE("equal cells come from refinement, others do not")
{
  const Case<2> equal(box("set X spacing = 48 cells\nset Y spacing = 16 cells"));
  CHECK(equal.triangulation.n_cells(0) == 3);
  CHECK(equal.triangulation.n_global_levels() == 5);
  CHECK(equal.triangulation.n_global_active_cells() == 48 * 16);
  const Case<2> mixed(box("set X spacing = 48 cells\nset Y spacing = 0.1 at 0"));
  CHECK(mixed.triangulation.n_global_levels() == 1);
}

TEST_CASE("mesh lines are exactly where asked")
{
  const Case<2> c(box("set Lower corner = -400, -400\nset Upper corner = 400, 400\n"
                      "set X spacing = 0.1 at 7.3, growth 1.3\n"
                      "set Y spacing = 0.1 around 0, growth 1.3"));
  double nearest = 1e300;
  bool line = false;
  for (const auto &cell : c.triangulation.active_cell_iterators())
  {
    for (unsigned int v = 0; v < 4; ++v)
      line |= cell->vertex(v)[0] == 7.3;
    if (cell->is_locally_owned())
      nearest = std::min(nearest, std::abs(cell->center()[1]));
  }
  CHECK(Utilities::MPI::max(line ? 1 : 0, MPI_COMM_WORLD) == 1);
  CHECK(Utilities::MPI::min(nearest, MPI_COMM_WORLD) < 1e-14);
  CHECK(c.volume() == doctest::Approx(640000.).epsilon(1e-12));
}

TEST_CASE("quarter disc and octant of a ball")
{
  const double pi = numbers::PI;
  double error = 1.;
  for (unsigned int r = 2; r < 5; ++r)
  {
    const Case<2> c("set Shape = quarter disc\nset Uniform refinements = " + std::to_string(r) +
                    "\nsubsection Ball\nset Radius = 2\nend");
    const double now = std::abs(c.volume() / pi - 1.);
    CHECK(now < error / 10.); // quadratic sides: order four
    error = now;
    CHECK(c.area("left") == doctest::Approx(2.));
    CHECK(c.area("bottom") == doctest::Approx(2.));
    CHECK(c.area("surface") == doctest::Approx(pi).epsilon(1e-4));
  }
  CHECK(error < 1e-6);

  const Case<3> c("set Shape = octant of ball\nset Uniform refinements = 2");
  CHECK(c.volume() == doctest::Approx(pi / 6.).epsilon(1e-4));
  for (const std::string side : {"left", "front", "bottom"})
    CHECK(c.area(side) == doctest::Approx(pi / 4.).epsilon(1e-4));
  CHECK(c.area("surface") == doctest::Approx(pi / 2.).epsilon(1e-4));
}

TEST_CASE("refinement boxes")
{
  Case<2> c(box("set X spacing = 8 cells\nset Y spacing = 8 cells") +
            "set Refinement boxes = 1 cm: (0.25, 0.25) to (0.5, 0.5); 0.1: (0, 0) to (1, 0.1)\n"
            "set Region boxes = coal: (0, 0) to (1, 0.5); ash: (0.25, 0) to (0.5, 0.25)");
  for (const auto &cell : c.triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const Point<2> p = cell->center();
      if (p[0] > 0.25 && p[0] < 0.5 && p[1] > 0.25 && p[1] < 0.5)
        CHECK(cell_size(cell) == doctest::Approx(1. / 128));
      else if (p[1] < 0.1)
        CHECK(cell_size(cell) <= 0.1);
      if (p[0] > 0.75 && p[1] > 0.75)
        CHECK(cell_size(cell) == doctest::Approx(1. / 8));
    }

  CHECK(region_volume(c, "coal") == doctest::Approx(0.5 - 1. / 16));
  CHECK(region_volume(c, "ash") == doctest::Approx(1. / 16));
  CHECK(c.geometry.region_names() == std::vector<std::string>{"ash", "coal"});
  CHECK(c.geometry.region("coal") == 1);
  c.triangulation.refine_global();
  CHECK(region_volume(c, "coal") == doctest::Approx(0.5 - 1. / 16));
}

TEST_CASE("regions follow the cells' centres through refinement")
{
  Case<2> c(box("set X spacing = 1 cell\nset Y spacing = 1 cell") +
            "set Region boxes = coal: (0.25, 0) to (0.75, 1)");
  CHECK(region_volume(c, "coal") == doctest::Approx(1.));
  c.triangulation.refine_global(2);
  CHECK(region_volume(c, "coal") == doctest::Approx(0.5));
}

TEST_CASE("regions are known to the rank that gets the cells later")
{
  const Case<2> c("set Region boxes = coal: (0, 0) to (1, 0.5)");
  parallel::distributed::Triangulation<2> triangulation(
    MPI_COMM_WORLD, Triangulation<2>::none,
    parallel::distributed::Triangulation<2>::no_automatic_repartitioning);
  c.geometry.create(triangulation);
  share_out(triangulation, 2);
  unsigned int n = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      CHECK(cell->material_id() == (cell->center()[1] < 0.5 ? 1 : 0));
      ++n;
    }
  CHECK(n * Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 64);
}

TEST_CASE("regions by number")
{
  const Case<2> c("set Region boxes = 3: (0, 0) to (0.5, 1)");
  CHECK(c.geometry.region("3") == 3);
  CHECK(region_volume(c, "3") == doctest::Approx(0.5));
}

TEST_CASE("wanted sizes: refine, hold, coarsen back to the initial mesh")
{
  Case<2> c(box("set X spacing = 8 cells\nset Y spacing = 8 cells") +
            "set Refinement boxes = 0.04: (0.7, 0.7) to (1, 1)");
  const auto initial = c.triangulation.n_global_active_cells();
  const Point<2> tip(0.2, 0.2);
  const auto adapt = [&](const double near)
  {
    const auto flag = [&](const bool coarsen)
    {
      std::vector<float> wanted(c.triangulation.n_active_cells(), 1e30f);
      for (const auto &cell : c.triangulation.active_cell_iterators())
        if (cell->center().distance(tip) < 0.1)
          wanted[cell->active_cell_index()] = near;
      return flag_cells(c.triangulation, c.geometry, wanted, {}, coarsen);
    };
    unsigned int passes = 0;
    for (; flag(passes == 0 || near > 1.); ++passes)
    {
      REQUIRE(passes < 20);
      c.triangulation.execute_coarsening_and_refinement();
    }
    return passes;
  };
  CHECK(adapt(0.01) >= 4); // 1/8 to 1/128, and the rim
  unsigned int n_near = 0;
  for (const auto &cell : c.triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center().distance(tip) < 0.1)
    {
      CHECK(cell_size(cell) == doctest::Approx(1. / 128));
      ++n_near;
    }
  CHECK(Utilities::MPI::sum(n_near, MPI_COMM_WORLD) ==
        doctest::Approx(numbers::PI * 0.01 * 128 * 128).epsilon(0.1));
  CHECK(c.triangulation.n_global_active_cells() > initial);

  adapt(1e30);
  CHECK(c.triangulation.n_global_active_cells() == initial);
}

TEST_CASE("cells with a fracture keep their size")
{
  Case<2> c(box("set X spacing = 8 cells\nset Y spacing = 8 cells"));
  const auto in_row = [](const auto &cell) { return std::abs(cell->center()[1] - 0.5625) < 0.01; };
  std::vector<float> wanted(c.triangulation.n_active_cells(), 0.1f);
  std::vector<bool> held(wanted.size());
  for (const auto &cell : c.triangulation.active_cell_iterators())
    held[cell->active_cell_index()] = in_row(cell);
  REQUIRE(flag_cells(c.triangulation, c.geometry, wanted, held));
  c.triangulation.execute_coarsening_and_refinement();
  CHECK(c.triangulation.n_global_active_cells() == 8 + 56 * 4);

  wanted.assign(c.triangulation.n_active_cells(), 0.04f);
  held.assign(wanted.size(), false);
  for (const auto &cell : c.triangulation.active_cell_iterators())
    held[cell->active_cell_index()] = in_row(cell);
  CHECK_THROWS_AS(flag_cells(c.triangulation, c.geometry, wanted, held), SolveError);
}

TEST_CASE("gmsh file: names of sides and regions")
{
  const Case<2> c("set Shape = gmsh file\nset Uniform refinements = 1\n"
                  "subsection Gmsh\nset File = two_layers.msh\nset Scale = 10\nend");
  CHECK(c.volume() == doctest::Approx(200.));
  CHECK(c.area("well side") == doctest::Approx(20.));
  CHECK(c.area("far side") == doctest::Approx(20.));
  CHECK(region_volume(c, "coal") == doctest::Approx(100.));
  CHECK(region_volume(c, "shale") == doctest::Approx(100.));
  CHECK(c.geometry.upper() == Point<2>(10., 20.));
}

TEST_CASE("errors name the entry and what is allowed")
{
  CHECK(contains(error_of<2>(box("set Upper corner = 0, 1")), "Mesh/Box/Upper corner"));
  CHECK(contains(error_of<2>(box("set Upper corner = 1, 1, 1")), "2 coordinates"));
  CHECK(contains(error_of<2>("set Shape = octant of ball"), "Mesh/Shape"));
  CHECK(contains(error_of<2>(box("set X spacing = fine")), "Mesh/Box/X spacing"));
  CHECK(contains(error_of<2>(box("set X spacing = fine")), "16 cells"));
  CHECK(contains(error_of<2>("set Refinement boxes = (0,0) to (1,1)"), "Mesh/Refinement boxes"));
  CHECK(contains(error_of<2>("set Refinement boxes = 1: (0,0,0) to (1,1,1)"), "3 coordinates"));
  CHECK(contains(error_of<2>("set Region boxes = coal: (0,0) to (-1,1)"), "lie below"));
  CHECK(contains(error_of<2>("set Shape = gmsh file\nsubsection Gmsh\nset File = no.msh\nend"),
                 "no file"));
  CHECK(contains(error_of<2>("set Shape = gmsh file\nsubsection Gmsh\nset File = cut.msh\nend"),
                 "cut.msh cannot be read"));
  CHECK(
    contains(error_of<2>("set Shape = gmsh file\nsubsection Gmsh\nset File = triangles.msh\nend"),
             "contains triangles"));
  const Case<2> c("");
  CHECK_THROWS_WITH_AS(c.geometry.side("botom"),
                       "the domain has no side \"botom\"; its sides are bottom, left, right, top",
                       InputError);
  CHECK_THROWS_AS(c.geometry.region("coal"), InputError);
}
} // namespace stockwork::geometry_mpi_test
