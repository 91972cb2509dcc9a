#include "fracture/damage/band.h"

#include "stockwork/mesh/key.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork::damage
{
using dealii::Point;
using dealii::Tensor;

template <int dim>
void Band<dim>::setup(const MeshView<dim> &new_mesh_view)
{
  mesh_view = std::make_unique<MeshView<dim>>(new_mesh_view);
  replace(std::vector<CrackCell<dim>>(cells));
}


template <int dim>
void Band<dim>::replace(const std::vector<CrackCell<dim>> &others)
{
  cells.clear();
  cuts.clear();
  by_index.clear();
  owned_cells.clear();
  links.clear();
  faces.clear();
  all_motions.clear();
  first_unknowns.assign(1, 0);
  add(std::vector<CrackCell<dim>>(others));
}


template <int dim>
void Band<dim>::add(const std::vector<CrackCell<dim>> &more)
{
  // Nothing is asked of cells that were there before, but for those whose faces the new ones have:
  // growth costs what is new and not what is cracked.
  const unsigned int first = cells.size();
  cells.insert(cells.end(), more.begin(), more.end());
  for (unsigned int i = first; i < cells.size(); ++i)
  {
    link_neighbours(i);
    all_motions.push_back(motions_of(i));
    first_unknowns.push_back(first_unknowns.back() + all_motions.back().size());
  }
  if (mesh_view && !more.empty())
    embed(first);
}


template <int dim>
std::optional<typename Band<dim>::CellIterator> Band<dim>::find(const dealii::CellId &id) const
{
  // Every rank has all cells of the coarse mesh.
  const auto &triangulation = mesh_view->triangulation;
  auto cell = triangulation.create_cell_iterator(
    dealii::CellId(id.get_coarse_cell_id(), std::vector<std::uint8_t>()));
  for (const auto child : id.get_child_indices())
  {
    if (!cell->has_children())
      return {};
    cell = cell->child(child);
  }
  if (!cell->is_active() || cell->is_artificial())
    return {};
  return CellIterator(&triangulation, cell->level(), cell->index(), &mesh_view->dof_handler);
}


template <int dim>
void Band<dim>::embed(const unsigned int first)
{
  const dealii::FE_Q<dim> vertex_functions(1);
  const dealii::QGauss<dim> quadrature(mesh_view->dof_handler.get_fe().base_element(0).degree + 1);
  dealii::FEValues<dim> values(mesh_view->mapping, vertex_functions, quadrature,
                               dealii::update_values | dealii::update_gradients |
                                 dealii::update_quadrature_points | dealii::update_JxW_values);
  for (unsigned int i = first; i < cells.size(); ++i)
    if (const auto cell = find(cells[i].id))
    {
      by_index[(*cell)->active_cell_index()] = i;
      if (!(*cell)->is_locally_owned())
        continue;
      owned_cells.push_back({i, *cell});
      make_cut(i, *cell, values);
    }
}


namespace
{
/// Whether a motion has a component.
template <int dim>
bool moves(const Motion<dim> &motion, const unsigned int component)
{
  return motion.base[component] != 0. || motion.turn[component].norm_square() > 0.;
}
} // namespace


template <int dim>
void Band<dim>::make_cut(const unsigned int i,
                         const CellIterator &cell,
                         dealii::FEValues<dim> &values)
{
  const CrackCell<dim> &crack = cells[i];
  values.reinit(typename dealii::Triangulation<dim>::active_cell_iterator(cell));
  CutCell<dim> &cut = cuts[cell->active_cell_index()];
  cut = CutCell<dim>();
  cut.points = values.get_quadrature().get_points();
  cut.weights = values.get_JxW_values();
  // One column for each motion and component.
  for (unsigned int k = 0; k < motions(i).size(); ++k)
    for (unsigned int d = 0; d < dim; ++d)
      if (moves(motions(i)[k], d))
      {
        cut.extra.push_back(first_unknown(i) + k);
        cut.component.push_back(d);
      }
  const Point<dim> middle = crack.middle();
  for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
  {
    const Tensor<1, dim> place = values.quadrature_point(q) - middle;
    double value = crack.normal * place > 0. ? 1. : 0.;
    Tensor<1, dim> gradient;
    for (unsigned int v = 0; v < CrackCell<dim>::n_vertices; ++v)
      if (crack.is_on_plus_side(v))
      {
        value -= values.shape_value(v, q);
        gradient -= values.shape_grad(v, q);
      }
    for (const Motion<dim> &motion : motions(i))
      for (unsigned int d = 0; d < dim; ++d)
        if (moves(motion, d))
        {
          cut.values.push_back(value * motion.at(place)[d]);
          cut.gradients.push_back(motion.at(place)[d] * gradient + value * motion.turn[d]);
        }
  }
}


template <int dim>
std::vector<Motion<dim>> Band<dim>::motions_of(const unsigned int i) const
{
  const CrackCell<dim> &crack = cells[i];
  const Tensor<1, dim> &n = crack.normal;
  std::vector<Motion<dim>> result(dim);
  for (unsigned int d = 0; d < dim; ++d)
    result[d].base[d] = 1.;
  // An opening that changes along the crack by one over the size of the cell.
  if (linear && crack.is_cut_evenly())
    for (const Tensor<1, dim> &axis : crack.axes())
      result.push_back(
        {Tensor<1, dim>(), (outer_product(n, axis) - outer_product(axis, n)) / crack.size()});
  return result;
}


template <int dim>
std::array<Tensor<1, dim>, CrackCell<dim>::n_points>
Band<dim>::jumps(const unsigned int i, const std::vector<double> &extra) const
{
  std::array<Tensor<1, dim>, CrackCell<dim>::n_points> result;
  const auto points = cells[i].points();
  for (unsigned int q = 0; q < points.size(); ++q)
    for (unsigned int k = 0; k < motions(i).size(); ++k)
      result[q] += extra[first_unknown(i) + k] * motions(i)[k].at(points[q]);
  return result;
}


namespace
{
/// Of a polyline, the place nearest to a point.
struct NearestPlace
{
  Point<2> place;
  Tensor<1, 2> normal; ///< of the leg, unit, to its left
  Tensor<1, 2> side;   ///< points to the plus side; at a corner between both legs' normals
  bool is_beyond_end = false;
};

NearestPlace nearest_place(const std::vector<Point<2>> &corners, const Point<2> &x)
{
  NearestPlace nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto normal = [&corners](const unsigned int k)
  {
    const Tensor<1, 2> leg = corners[k + 1] - corners[k];
    return Tensor<1, 2>({-leg[1], leg[0]}) / leg.norm();
  };
  const unsigned int n = corners.size() - 1;
  for (unsigned int k = 0; k < n; ++k)
  {
    const Tensor<1, 2> leg = corners[k + 1] - corners[k];
    const double along = (x - corners[k]) * leg / leg.norm_square(),
                 t = std::min(1., std::max(0., along));
    const Point<2> place = corners[k] + t * leg;
    if (place.distance(x) >= least)
      continue;
    least = place.distance(x);
    nearest = {place, normal(k), normal(k), (along < 0. && k == 0) || (along > 1. && k + 1 == n)};
    if (along >= 1. && k + 1 < n)
      nearest.side += normal(k + 1);
    else if (along <= 0. && k > 0)
      nearest.side += normal(k - 1);
  }
  return nearest;
}
} // namespace


template <int dim>
std::vector<CrackCell<dim>> Band<dim>::passed(const InitialCrack<dim> &crack) const
{
  std::vector<CrackCell<dim>> found;
  for (const auto &cell : mesh_view->dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned() || crack.distance(cell->center()) > cell->diameter())
      continue;
    CrackCell<dim> piece = describe<dim>(cell);
    if (crack.disc)
    {
      piece.normal = crack.disc->normal;
      piece.on_plane = crack.disc->centre;
      const Tensor<1, dim> away = piece.centre() - piece.on_plane;
      piece.part_by_plane();
      if (piece.is_cut() &&
          (away - (away * piece.normal) * piece.normal).norm() <= crack.disc->radius)
        found.push_back(piece);
    }
    else if constexpr (dim == 2)
    {
      const NearestPlace near = nearest_place(crack.points, piece.centre());
      if (near.is_beyond_end)
        continue;
      piece.normal = near.normal;
      piece.on_plane = near.place;
      // One side for the whole crack, or the cells around a corner contradicted one another.
      for (unsigned int v = 0; v < CrackCell<dim>::n_vertices; ++v)
      {
        const NearestPlace of_vertex = nearest_place(crack.points, piece.vertices[v]);
        if ((piece.vertices[v] - of_vertex.place) * of_vertex.side > 1e-9 * piece.size())
          piece.plus |= 1u << v;
      }
      if (piece.is_cut())
        found.push_back(piece);
    }
  }
  return found;
}


template <int dim>
std::vector<ExtraUnknown> Band<dim>::unknowns() const
{
  std::vector<ExtraUnknown> all;
  for (unsigned int i = 0; i < cells.size(); ++i)
    for (unsigned int k = 0; k < motions(i).size(); ++k)
      all.push_back({cells[i].key() + 1 + k});
  return all;
}


template <int dim>
void Band<dim>::link_neighbours(const unsigned int i)
{
  links.emplace_back().fill(none);
  for (unsigned int f = 0; f < n_faces; ++f)
  {
    const std::uint64_t place = Key().add(cells[i].face_centre(f), 1e-3 * cells[0].size());
    const auto [other, is_new] = faces.emplace(place, std::make_pair(i, f));
    if (is_new)
      continue;
    const auto [j, g] = other->second;
    if (!cells[i].crosses(f) && !cells[j].crosses(g))
      continue;
    links[i][f] = j;
    links[j][g] = i;
  }
}


template <int dim>
bool Band<dim>::is_front(const unsigned int i) const
{
  for (unsigned int f = 0; f < n_faces; ++f)
    if (cells[i].crosses(f) && links[i][f] == none && !cells[i].is_at_boundary(f))
      return true;
  return false;
}


namespace
{
/// Length of the line in which a crack passes a face, in this direction [m]. By Gauss's theorem in
/// the face, with the mean slopes of phi; along a crack, whatever stairs its cells lie in, these
/// lengths add up to its own, as areas do.
double
length_in_face(const CrackCell<3> &crack, const unsigned int face, const Tensor<1, 3> &direction)
{
  constexpr unsigned int n = dealii::GeometryInfo<3>::vertices_per_face;
  std::array<Tensor<1, 3>, 2> edges;
  std::array<double, 2> slopes{};
  for (unsigned int v = 0; v < n; ++v)
  {
    const unsigned int vertex = dealii::GeometryInfo<3>::face_to_cell_vertices(face, v);
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double sign = (v >> d) & 1 ? 0.5 : -0.5;
      edges[d] += sign * crack.vertices[vertex];
      slopes[d] += crack.is_on_plus_side(vertex) ? sign : 0.;
    }
  }
  return std::abs(direction * (slopes[0] * edges[1] - slopes[1] * edges[0]));
}


double length_in_face(const CrackCell<2> &, const unsigned int, const Tensor<1, 2> &)
{
  return 1.;
}


/// Direction of the line in which two cracks on the sides of a face meet it, the same seen from
/// either; zero: they meet it in none.
Tensor<1, 3> direction_in_face(const CrackCell<3> &crack, const CrackCell<3> &other)
{
  const Tensor<1, 3> normal =
    crack.normal + (crack.normal * other.normal < 0. ? -1. : 1.) * other.normal;
  const Tensor<1, 3> line =
    dealii::cross_product_3d(normal, Tensor<1, 3>(other.centre() - crack.centre()));
  return line / std::max(line.norm(), 1e-300);
}


Tensor<1, 2> direction_in_face(const CrackCell<2> &, const CrackCell<2> &)
{
  return {};
}
} // namespace


template <int dim>
void Band<dim>::add_neighbours(const unsigned int i, Segment<dim> &segment) const
{
  const CrackCell<dim> &crack = cells[i];
  for (unsigned int f = 0; f < n_faces; ++f)
    if (links[i][f] != none)
    {
      // Lengths along the crack and not along the stairs of cells.
      const Tensor<1, dim> to_face = crack.face_centre(f) - crack.centre();
      const double along = (to_face - (to_face * crack.normal) * crack.normal).norm();
      const unsigned int j = links[i][f];
      const CrackCell<dim> &other = cells[j];
      const Tensor<1, dim> line = direction_in_face(crack, other);
      const unsigned int g = std::find(links[j].begin(), links[j].end(), i) - links[j].begin();
      // Either may have put a vertex on another side; where both cracks turn away from how their
      // vertices are parted, fluid passes all the same.
      const double least =
        line.norm_square() > 0. ? 0.05 * std::min(crack.size(), other.size()) : 0.;
      const double width =
        std::max(0.5 * (length_in_face(crack, f, line) + length_in_face(other, g, line)), least);
      segment.neighbours.push_back({other.key(), std::max(along, 0.05 * crack.size()), width});
    }
}


template <int dim>
void Band<dim>::add_pore_pressure(const Owned &owned, Segment<dim> &segment) const
{
  const CrackCell<dim> &crack = cells[owned.number];
  const auto &fe = owned.cell->get_fe();
  std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
  owned.cell->get_dof_indices(dofs);
  Point<dim> middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = 0.5;
  for (unsigned int i = 0; i < dofs.size(); ++i)
    if (fe.system_to_component_index(i).first == dim)
    {
      const double share = fe.shape_value(i, middle);
      const Point<dim> &node = crack.vertices[fe.system_to_component_index(i).second];
      segment.pore_pressure.bulk.push_back(dofs[i]);
      segment.pore_pressure.bulk_coefficients.push_back(share);
      segment.pore_distance += share * std::abs((node - segment.centre) * crack.normal);
    }
}


template <int dim>
std::vector<Segment<dim>>
Band<dim>::segments(const std::function<double(const Point<dim> &)> &in_situ_pore_pressure) const
{
  std::vector<Segment<dim>> all;
  for (const Owned &owned : owned_cells)
  {
    const CrackCell<dim> &crack = cells[owned.number];
    Segment<dim> segment;
    segment.key = crack.key();
    segment.region = crack.region;
    segment.centre = crack.middle();
    segment.normal = crack.normal;
    segment.area = crack.area();
    segment.at_tip = crack.bare && is_front(owned.number);
    add_neighbours(owned.number, segment);
    for (unsigned int d = 0; d < dim; ++d)
    {
      segment.opening.extra.push_back(first_unknown(owned.number) + d);
      segment.opening.extra_coefficients.push_back(crack.normal[d]);
    }
    segment.pore_pressure.constant = in_situ_pore_pressure(segment.centre);
    if (mesh_view->has_pore_pressure)
      add_pore_pressure(owned, segment);
    all.push_back(std::move(segment));
  }
  return all;
}


template class Band<2>;
template class Band<3>;
} // namespace stockwork::damage
