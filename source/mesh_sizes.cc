#include "mesh_sizes.h"

#include "scene_estimates.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork
{
using namespace dealii;

namespace
{
template <int dim>
using Mesh = parallel::distributed::Triangulation<dim>;

template <int dim>
using Line = std::pair<Point<dim>, Point<dim>>;


template <int dim>
double smallest_size(const Mesh<dim> &mesh)
{
  double size = std::numeric_limits<double>::infinity();
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned())
      size = std::min(size, cell_size(cell));
  return Utilities::MPI::min(size, mesh.get_communicator());
}


template <int dim, class CellIterator>
bool passes(const Line<dim> &line, const CellIterator &cell)
{
  const Tensor<1, dim> way = line.second - line.first;
  const double length = way.norm(), reach = 0.5 * cell->diameter();
  const Tensor<1, dim> along = length > 0. ? way / length : way;
  const double at = (cell->center() - line.first) * along;
  if (cell->center().distance(line.first + std::clamp(at, 0., length) * along) > reach)
    return false;
  constexpr unsigned int n = 40; // a corner that is cut off by less is none
  const double begin = std::clamp(at - reach, 0., length), end = std::clamp(at + reach, 0., length);
  for (unsigned int i = 0; i <= n; ++i)
    if (cell->point_inside(line.first + (begin + (end - begin) * i / n) * along))
      return true;
  return false;
}


template <int dim>
CellsAlong cells_along(const Mesh<dim> &mesh, const Line<dim> &line)
{
  CellsAlong found;
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned() && passes<dim>(line, cell))
      found.add({std::ldexp(cell_size(cell), cell->level()), unsigned(cell->level())});
  return {Utilities::MPI::max(found.unsplit, mesh.get_communicator()),
          Utilities::MPI::max(found.most_split, mesh.get_communicator())};
}


template <int dim>
types::material_id region_of(const Mesh<dim> &mesh, const Point<dim> &point)
{
  types::material_id region = 0;
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned() && cell->point_inside(point))
      region = std::max(region, cell->material_id());
  return Utilities::MPI::max(region, mesh.get_communicator());
}


/// Lines from the middle of a disc, along the axes of the mesh that lie most nearly in its plane.
std::vector<Line<3>> lines_of(const InitialCrack<3> &crack, const double radius)
{
  const Disc<3> &disc = *crack.disc;
  std::vector<Line<3>> lines;
  for (unsigned int d = 0; d < 3; ++d)
  {
    Tensor<1, 3> axis;
    axis[d] = 1.;
    const Tensor<1, 3> along = axis - (axis * disc.normal) * disc.normal;
    if (along.norm() > 0.5)
      for (const double sign : {-1., 1.})
        lines.emplace_back(disc.centre, disc.centre + sign * radius / along.norm() * along);
  }
  return lines;
}


std::vector<Line<3>> lines_of_growth(const Case<3> &the_case, const double radius)
{
  return lines_of(the_case.scene.cracks[0], radius);
}


/// Straight on, or along the greatest compression if that is another direction.
std::vector<Line<2>> lines_of_growth(const Case<2> &the_case, const double half_length)
{
  const auto &corners = the_case.scene.cracks[0].points;
  const Geometry<2> &geometry = the_case.geometry;
  const SymmetricTensor<2, 2> stress = the_case.scene.in_situ_stress(corners.front());
  std::vector<Line<2>> lines;
  for (const bool forward : {false, true})
  {
    const Point<2> &tip = forward ? corners.back() : corners.front();
    const Point<2> &other = forward ? corners.front() : corners.back();
    if (geometry.on_side(tip))
      continue;
    Tensor<1, 2> along = (tip - other) / tip.distance(other);
    const Tensor<1, 2> across = Point<2>(-along[1], along[0]);
    if (std::abs(along * (stress * across)) > 0.05 * stress.norm())
    {
      const Tensor<1, 2> axis = eigenvectors(stress)[1].second;
      along = axis * along < 0. ? -axis : axis;
    }
    const Point<2> middle = geometry.on_side(other) ? other : other + 0.5 * (tip - other);
    lines.emplace_back(middle, middle + half_length * along);
  }
  return lines;
}


template <int dim>
std::vector<Line<dim>> lines_at_start(const InitialCrack<dim> &crack)
{
  if constexpr (dim == 3)
    if (crack.disc)
      return lines_of(crack, crack.disc->radius);
  std::vector<Line<dim>> lines;
  for (unsigned int i = 0; i + 1 < crack.points.size(); ++i)
    lines.emplace_back(crack.points[i], crack.points[i + 1]);
  return lines;
}


template <int dim>
CellsAlong cells_along(const MeshSizes<dim> &mesh, const std::vector<Line<dim>> &lines)
{
  CellsAlong found;
  for (const auto &[from, to] : lines)
    found.add(mesh.along(from, to));
  return found;
}
} // namespace


void CellsAlong::add(const CellsAlong &others)
{
  unsplit = std::max(unsplit, others.unsplit);
  most_split = std::max(most_split, others.most_split);
}


template <int dim>
MeshSizes<dim>::MeshSizes(const parallel::distributed::Triangulation<dim> &triangulation)
  : smallest(smallest_size(triangulation))
  , along(
      [&triangulation](const Point<dim> &from, const Point<dim> &to) {
        return cells_along<dim>(triangulation, {from, to});
      })
  , region_at([&triangulation](const Point<dim> &point) { return region_of(triangulation, point); })
{
}


template <int dim>
SizesOfPath
sizes_of_path(const Case<dim> &the_case, const MeshSizes<dim> &mesh, const double half_length)
{
  const CellsAlong start = cells_along(mesh, lines_at_start(the_case.scene.cracks[0]));
  CellsAlong path = cells_along(mesh, lines_of_growth(the_case, half_length));
  path.add(start);
  const int splits = start.most_split;
  return {std::ldexp(start.unsplit, -splits), std::ldexp(path.unsplit, -splits)};
}


template <int dim>
double cells_in_half_length(const Case<dim> &the_case, const MeshSizes<dim> &mesh)
{
  const double half = half_length_at_end(the_case);
  return std::isnan(half) ? half : half / sizes_of_path(the_case, mesh, half).to_the_end;
}


template <int dim>
double unknowns_at_end(const Case<dim> &the_case,
                       const MeshSizes<dim> &mesh,
                       const double n_unknowns,
                       const double n_segments)
{
  if (the_case.scene.cracks.empty() || (dim == 3 && !the_case.scene.cracks[0].disc) ||
      !(half_length_at_end(the_case) > half_length_at_start(the_case)) ||
      cells_along(mesh, lines_at_start(the_case.scene.cracks[0])).most_split == 0)
    return n_unknowns;
  if constexpr (dim == 2)
  {
    const double end = half_length_at_end(the_case), start = half_length_at_start(the_case),
                 wings = the_case.scene.cracks[0].size() / start,
                 crossed = wings * (end - start) / sizes_of_path(the_case, mesh, end).to_the_end;
    // Cells, by kgd/toughness, kgd/viscosity and kgd/sun with all models: 13 to 25.
    constexpr double per_crossed_cell = 16.;
    const auto &elements = the_case.elements;
    return n_unknowns +
           per_crossed_cell * crossed *
             (dim * std::pow(elements.displacement_degree, dim) + elements.has_pore_pressure);
  }
  const Point<dim> centre = the_case.scene.cracks[0].disc->centre;
  double share = 1.; // of the disc, between planes of symmetry
  for (unsigned int d = 0; d < dim; ++d)
    for (const double wall : {the_case.geometry.lower()[d], the_case.geometry.upper()[d]})
      if (std::abs(centre[d] - wall) < 0.5 * mesh.smallest)
        share *= 0.5;
  const double cells = cells_in_half_length(the_case, mesh),
               cracked = share * numbers::PI * cells * cells;
  // By radial/toughness and radial/viscosity with 'damage', coarse and medium: 134 to 171.
  constexpr double per_cracked_cell = 140.;
  return n_unknowns + per_cracked_cell * std::max(cracked - n_segments, 0.);
}


template struct MeshSizes<2>;
template struct MeshSizes<3>;
template SizesOfPath sizes_of_path<2>(const Case<2> &, const MeshSizes<2> &, double);
template SizesOfPath sizes_of_path<3>(const Case<3> &, const MeshSizes<3> &, double);
template double cells_in_half_length<2>(const Case<2> &, const MeshSizes<2> &);
template double cells_in_half_length<3>(const Case<3> &, const MeshSizes<3> &);
template double unknowns_at_end<2>(const Case<2> &, const MeshSizes<2> &, double, double);
template double unknowns_at_end<3>(const Case<3> &, const MeshSizes<3> &, double, double);
} // namespace stockwork
