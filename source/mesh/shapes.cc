// The coarse meshes of the shapes that a domain can have.
#include "mesh/geometry.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/gmsh_file.h"
#include "mesh/interpret_entry.h"
#include "mesh/spacing.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork
{
using namespace dealii;

namespace
{
/// Names of the two sides of a box across each axis.
template <int dim>
std::array<std::string, 2> box_sides(const unsigned int axis)
{
  if (axis == 0)
    return {{"left", "right"}};
  if (axis == dim - 1)
    return {{"bottom", "top"}};
  return {{"front", "back"}};
}
} // namespace

template <int dim>
void Geometry<dim>::make_box(ParameterHandler &prm)
{
  prm.enter_subsection("Box");
  const auto corner = [&prm](const std::string &entry)
  {
    auto coordinates = get_quantities(prm, entry, dimension::length);
    if (coordinates.empty() && entry == "Lower corner")
      coordinates.assign(dim, 0.);
    if (coordinates.size() != dim)
      throw EntryError("Mesh/Box/" + entry, prm.get(entry),
                       std::to_string(dim) + " coordinates, as many as the case has dimensions");
    return coordinates;
  };
  const auto lower = corner("Lower corner"), upper = corner("Upper corner");
  for (unsigned int d = 0; d < dim; ++d)
    if (!(lower[d] < upper[d]))
      throw EntryError("Mesh/Box/Upper corner", prm.get("Upper corner"),
                       "a corner above the lower one, " + prm.get("Lower corner") +
                         ", in every coordinate");

  // Equal cells are halved from coarser ones as far as that goes: p4est orders and stores them
  // better than coarse cells, and the mesh is the same.
  std::array<unsigned int, dim> equal_cells;
  std::vector<std::vector<double>> lines(dim);
  for (unsigned int d = 0; d < dim; ++d)
    interpret_entry(prm, "Mesh/Box", spacing_entry[d],
                    "'16 cells', '0.5 m', 'lines 0, 1, 2.5' or '1 cm at 0 m, 2 cm from 3 m to 5 m, "
                    "1 cm around 8 m, growth 1.2, largest 10 m'",
                    [&](const std::string &text)
                    {
                      equal_cells[d] = parse_equal_cells(text, lower[d], upper[d]);
                      lines[d] = parse_lines(text, lower[d], upper[d]);
                    });
  const auto all_even = [&equal_cells]()
  {
    return std::all_of(equal_cells.begin(), equal_cells.end(),
                       [](const unsigned int n) { return n > 0 && n % 2 == 0; });
  };
  for (; all_even(); ++uniform_refinements)
    for (unsigned int d = 0; d < dim; ++d)
    {
      equal_cells[d] /= 2;
      for (unsigned int i = 0; i <= equal_cells[d]; ++i)
        lines[d][i] = lines[d][2 * i];
      lines[d].resize(equal_cells[d] + 1);
    }

  std::vector<unsigned int> n_cells(dim);
  double n_all = 1.;
  Point<dim> index_of_upper;
  for (unsigned int d = 0; d < dim; ++d)
  {
    n_cells[d] = lines[d].size() - 1;
    index_of_upper[d] = n_cells[d];
    n_all *= n_cells[d];
  }
  refuse_cells(n_all, uniform_refinements);

  // First a box of unit cells, whose vertices are the indices of the mesh lines: the lines come
  // out exactly where the deck wants them.
  GridGenerator::subdivided_hyper_rectangle(*coarse, n_cells, Point<dim>(), index_of_upper, true);
  for (const auto &cell : coarse->active_cell_iterators())
    cell->set_material_id(0); // which "colorize" has set to the quadrant
  GridTools::transform(
    [&lines](const Point<dim> &index)
    {
      Point<dim> p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = lines[d][static_cast<std::size_t>(std::lround(index[d]))];
      return p;
    },
    *coarse);
  cells = Cells::cartesian;

  for (unsigned int d = 0; d < dim; ++d)
    for (unsigned int end = 0; end < 2; ++end)
      sides[box_sides<dim>(d)[end]] = 2 * d + end;
  prm.leave_subsection();
}

template <int dim>
void Geometry<dim>::make_ball(ParameterHandler &prm)
{
  prm.enter_subsection("Ball");
  if (prm.get("Radius").empty())
    throw EntryError("Mesh/Ball/Radius", "", "a length > 0 m, such as '5 cm'");
  const double radius = get_quantity(prm, "Radius", dimension::length);
  prm.leave_subsection();

  GridGenerator::quarter_hyper_ball(*coarse, Point<dim>(), radius);
  cells = Cells::curved;

  // All cells bend with the surface, not only those beside it: halving them leaves them regular.
  coarse->set_all_manifold_ids(interior_manifold);
  for (const auto &face : coarse->active_face_iterators())
    if (face->at_boundary() && std::abs(face->vertex(0).norm() - radius) < 1e-10 * radius &&
        std::all_of(face->vertex_indices().begin(), face->vertex_indices().end(),
                    [&](const unsigned int v)
                    { return std::abs(face->vertex(v).norm() - radius) < 1e-10 * radius; }))
      face->set_all_manifold_ids(0);

  const types::boundary_id surface = 1;
  for (unsigned int d = 0; d < dim; ++d)
    sides[box_sides<dim>(d)[0]] = 2 * d;
  sides["surface"] = surface;
  for (const auto &face : coarse->active_face_iterators())
    if (face->at_boundary())
    {
      face->set_boundary_id(surface);
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(face->center()[d]) < 1e-10 * radius)
          face->set_boundary_id(2 * d);
    }
}

template <int dim>
void Geometry<dim>::make_ring(ParameterHandler &prm)
{
  prm.enter_subsection("Ring");
  for (const char *entry : {"Inner radius", "Outer radius"})
    if (prm.get(entry).empty())
      throw EntryError(std::string("Mesh/Ring/") + entry, "", "a length > 0 m, such as '10 cm'");
  const double inner = get_quantity(prm, "Inner radius", dimension::length),
               outer = get_quantity(prm, "Outer radius", dimension::length);
  if (!(inner < outer))
    throw EntryError("Mesh/Ring/Outer radius", prm.get("Outer radius"),
                     "a length above the inner radius, " + prm.get("Inner radius"));
  std::vector<double> radii;
  interpret_entry(prm, "Mesh/Ring", "Cells along the radius",
                  "'16 cells', '0.5 m' or '1 cm at 10 cm, growth 1.2, largest 20 m'",
                  [&](const std::string &text) { radii = parse_lines(text, inner, outer); });
  const unsigned int n_arc = prm.get_integer("Cells along the arc");
  if (dim == 3 && n_arc % 2 != 0)
    throw EntryError("Mesh/Ring/Cells along the arc", prm.get("Cells along the arc"),
                     "an even number with 'Mesh/Shape = octant of shell'");
  refuse_cells((dim == 2 ? n_arc : 0.75 * n_arc * n_arc) * (radii.size() - 1.),
               uniform_refinements);
  prm.leave_subsection();
  make_ring_cells(radii, n_arc);
  cells = Cells::ring;
  inner_radius = inner;
  coarse->set_all_manifold_ids(0);
}

template <>
void Geometry<2>::make_ring_cells(const std::vector<double> &radii, const unsigned int n_arc)
{
  const unsigned int n_radius = radii.size() - 1;
  // Counterclockwise from the x axis, so that cells do not turn over.
  GridGenerator::subdivided_hyper_rectangle(*coarse, {n_radius, n_arc}, Point<2>(),
                                            Point<2>(n_radius, n_arc), true);
  for (const auto &cell : coarse->active_cell_iterators())
    cell->set_material_id(0);
  GridTools::transform(
    [&](const Point<2> &index)
    {
      const double r = radii[static_cast<std::size_t>(std::lround(index[0]))];
      const long i = std::lround(index[1]);
      if (i == static_cast<long>(n_arc))
        return Point<2>(0., r); // and not 1e-17 beside the plane of symmetry
      const double angle = 0.5 * numbers::PI * i / n_arc;
      return Point<2>(r * std::cos(angle), r * std::sin(angle));
    },
    *coarse);
  sides = {{"wall", 0}, {"surface", 1}, {"bottom", 2}, {"left", 3}};
}

template <>
void Geometry<3>::make_ring_cells(const std::vector<double> &radii, const unsigned int n_arc)
{
  // Three patches around the axes, which meet along the lines from the middles of the arcs to the
  // middle of the octant. Each is a box of indices: twice along the arcs, and along the radius.
  const unsigned int n = n_arc / 2, n_radius = radii.size() - 1;
  std::array<dealii::Triangulation<3>, 3> patches;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    Tensor<1, 3> x, y, z;
    x[axis] = y[(axis + 1) % 3] = z[(axis + 2) % 3] = 1.;
    GridGenerator::subdivided_hyper_rectangle(patches[axis], {n, n, n_radius}, Point<3>(),
                                              Point<3>(n, n, n_radius));
    GridTools::transform(
      [&](const Point<3> &index)
      {
        const double s = index[0] / n, t = index[1] / n;
        const Tensor<1, 3> corner[4] = {x, (x + y) / std::sqrt(2.), (x + z) / std::sqrt(2.),
                                        (x + y + z) / std::sqrt(3.)};
        const Tensor<1, 3> flat = (1. - t) * ((1. - s) * corner[0] + s * corner[1]) +
                                  t * ((1. - s) * corner[2] + s * corner[3]);
        return Point<3>(radii[static_cast<std::size_t>(std::lround(index[2]))] / flat.norm() *
                        flat);
      },
      patches[axis]);
  }
  GridGenerator::merge_triangulations({&patches[0], &patches[1], &patches[2]}, *coarse,
                                      1e-6 * radii.front() / n_arc);

  sides = {{"left", 0}, {"surface", 1}, {"front", 2}, {"wall", 3}, {"bottom", 4}};
  const double inside = 0.5 * (radii[0] + radii[1]);
  for (const auto &face : coarse->active_face_iterators())
    if (face->at_boundary())
    {
      face->set_boundary_id(face->vertex(0).norm() < inside ? 3 : 1);
      for (unsigned int d = 0; d < 3; ++d)
        if (std::abs(face->center()[d]) < 1e-10 * radii.front())
          face->set_boundary_id(2 * d);
    }
}

template <int dim>
void Geometry<dim>::read_gmsh(ParameterHandler &prm, const std::string &deck_directory)
{
  prm.enter_subsection("Gmsh");
  interpret_entry(prm, "Mesh/Gmsh", "File",
                  std::string("a mesh of ") + (dim == 2 ? "quadrilaterals" : "hexahedra") +
                    " written by gmsh",
                  [&](const std::string &name)
                  {
                    GmshGroups groups = read_gmsh_file(name, deck_directory, *coarse);
                    sides = std::move(groups.sides);
                    regions = std::move(groups.regions);
                  });
  GridTools::scale(get_quantity(prm, "Scale", dimension::number), *coarse);
  cells = Cells::straight;
  prm.leave_subsection();
}


template void Geometry<2>::make_box(ParameterHandler &);
template void Geometry<2>::make_ball(ParameterHandler &);
template void Geometry<2>::make_ring(ParameterHandler &);
template void Geometry<3>::make_box(ParameterHandler &);
template void Geometry<3>::make_ball(ParameterHandler &);
template void Geometry<3>::make_ring(ParameterHandler &);
template void Geometry<2>::read_gmsh(ParameterHandler &, const std::string &);
template void Geometry<3>::read_gmsh(ParameterHandler &, const std::string &);
} // namespace stockwork
