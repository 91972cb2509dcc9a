// The lattice as the mesh has it.
#include "fracture/peridynamics/bond_forces.h"
#include "fracture/peridynamics/zone.h"

#include <deal.II/dofs/dof_accessor.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

namespace stockwork::peridynamics
{
using dealii::Point;

namespace
{
/// Marks a rank that knows a site's values, but does not own them.
constexpr unsigned int not_owner = 1u << 31;

/// Is the cell a cube? If so, its edge; else zero.
template <int dim>
double edge_of_cube(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell)
{
  const auto diagonal = cell->vertex((1 << dim) - 1) - cell->vertex(0);
  const double edge = diagonal[0];
  for (const unsigned int v : cell->vertex_indices())
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(cell->vertex(v)[d] - cell->vertex(0)[d] - (v >> d & 1) * edge) > 1e-6 * edge)
        return 0.;
  return edge;
}

/// A box that grows with the points it has to hold.
template <int dim>
struct Extent
{
  Point<dim> lower, upper;

  Extent()
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::numeric_limits<double>::infinity();
      upper[d] = -lower[d];
    }
  }

  void add(const Point<dim> &point)
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::min(lower[d], point[d]);
      upper[d] = std::max(upper[d], point[d]);
    }
  }

  /// Over all ranks.
  void unite(const Collectives &collectives)
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = collectives.min(lower[d]);
      upper[d] = collectives.max(upper[d]);
    }
  }
};

/// Add the planes on which a face of a cell slides and that nothing else holds: direction, side and
/// place on the lattice.
template <int dim>
void add_mirrors(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                 const std::array<int, dim> &place,
                 const dealii::AffineConstraints<double> &constraints,
                 const std::function<bool(dealii::types::boundary_id)> &moves_side,
                 std::vector<std::array<int, 3>> &mirrors)
{
  const auto constrained = [&](const unsigned int v, const unsigned int d)
  { return constraints.is_constrained(cell->vertex_dof_index(v, d)); };
  const auto rolls = [&](const unsigned int f)
  {
    bool all =
      cell->face(f)->at_boundary() && !(moves_side && moves_side(cell->face(f)->boundary_id()));
    for (const unsigned int v : cell->vertex_indices())
      if ((v >> f / 2 & 1) == f % 2)
        all &= constrained(v, f / 2);
    return all;
  };
  for (const unsigned int f : cell->face_indices())
    if (rolls(f))
    {
      // A node on two such planes does not slide, but would if it were on one.
      const unsigned int normal = f / 2;
      bool slides = true;
      for (const unsigned int v : cell->vertex_indices())
        if ((v >> normal & 1) == f % 2)
          for (unsigned int d = 0; d < dim; ++d)
            slides &= d == normal || !constrained(v, d) || rolls(2 * d + (v >> d & 1));
      if (slides)
        mirrors.push_back({{static_cast<int>(normal), static_cast<int>(f % 2),
                            place[normal] + static_cast<int>(f % 2)}});
    }
}

/// @param odd edge and centre of cells in the zone that do not fit its lattice
/// @throws InputError if there are any
template <int dim>
void refuse_odd_cells(const std::vector<double> &odd, const double h)
{
  if (odd.empty())
    return;
  std::ostringstream message;
  message << "Cells in the peridynamic zone must be squares (cubes) of one size, " << h
          << " m; the one at (";
  for (unsigned int d = 0; d < dim; ++d)
    message << odd[1 + d] << (d + 1 < dim ? ", " : "");
  message << ") m is not. Change the spacing in subsection Mesh, or set 'Cell size'.";
  throw unsuitable_mesh(message.str());
}

/// This rank's sites, and those of others that lie in the box which these fill, enlarged.
/// @param more in each direction [spacings]
template <int dim>
std::vector<Site<dim>>
with_sites_around(std::vector<Site<dim>> mine, const int more, const Collectives &collectives)
{
  using Box = std::array<int, 2 * dim>; // lower and upper end in each direction
  Box box;
  for (unsigned int d = 0; d < dim; ++d)
  {
    box[2 * d] = std::numeric_limits<int>::max();
    box[2 * d + 1] = std::numeric_limits<int>::lowest();
    for (const Site<dim> &site : mine)
    {
      box[2 * d] = std::min(box[2 * d], site.place[d] - more);
      box[2 * d + 1] = std::max(box[2 * d + 1], site.place[d] + more);
    }
  }
  std::vector<Box> others = collectives.gather(std::vector<Box>{box});
  others.erase(others.begin() + collectives.rank());
  const auto is_in = [](const Site<dim> &site, const Box &box)
  {
    bool inside = true;
    for (unsigned int d = 0; d < dim; ++d)
      inside = inside && site.place[d] >= box[2 * d] && site.place[d] <= box[2 * d + 1];
    return inside;
  };
  std::vector<Site<dim>> wanted; // by some other rank
  for (const Site<dim> &site : mine)
    if (std::any_of(others.begin(), others.end(),
                    [&](const Box &other) { return is_in(site, other); }))
      wanted.push_back(site);
  for (const Site<dim> &site : collectives.gather(wanted))
    if (is_in(site, box))
      mine.push_back(site);
  return mine;
}

/// Sites in their order; of one that several ranks know, the owner's word counts.
template <int dim>
std::vector<Site<dim>> unite(std::vector<Site<dim>> known)
{
  std::stable_sort(known.begin(), known.end(),
                   [](const auto &a, const auto &b)
                   { return std::tie(a.place, a.owner) < std::tie(b.place, b.owner); });
  std::vector<Site<dim>> all;
  for (Site<dim> &site : known)
    if (all.empty() || all.back().place != site.place)
    {
      site.owner &= ~not_owner;
      all.push_back(site);
    }
  return all;
}
} // namespace


template <int dim>
void Zone<dim>::find_spacing(const ZoneShape<dim> &shape,
                             const MeshView<dim> &mesh_view,
                             const Collectives &collectives)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const double edge = cell->minimum_vertex_distance();
      if (shape.contains(cell->center(), 0.) ||
          shape.contains(cell->center(), edge, 0.5 - shape.margin))
        smallest = std::min(smallest, edge);
    }
  h = collectives.min(smallest);
  if (!std::isfinite(h))
    throw unsuitable_mesh("No cell is in the zone.");
}


template <int dim>
void Zone<dim>::gather_sites(const ZoneShape<dim> &shape,
                             const unsigned int reach,
                             const std::function<bool(dealii::types::boundary_id)> &moves_side,
                             const MeshView<dim> &mesh_view,
                             const Collectives &collectives)
{
  const auto &dof_handler = mesh_view.dof_handler;

  // The domain, and a vertex of the lattice to count from: the lowest of all in the zone.
  Extent<dim> all_cells, in_zone;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int v : cell->vertex_indices())
      {
        all_cells.add(cell->vertex(v));
        if (shape.contains(cell->vertex(v), h))
          in_zone.add(cell->vertex(v));
      }
  all_cells.unite(collectives);
  in_zone.unite(collectives);
  domain = dealii::BoundingBox<dim>(std::make_pair(all_cells.lower, all_cells.upper));
  if (!has_corner)
    set_origin(in_zone.lower);

  const auto place_of = [&](const Point<dim> &point)
  {
    Place<dim> place;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = static_cast<int>(std::lround((point[d] - corner[d]) / h));
    return place;
  };

  std::map<Place<dim>, Site<dim>> mine;
  std::vector<std::array<int, 3>> my_mirrors;        // direction, side, place
  std::vector<std::array<unsigned int, 2>> my_moved; // direction, side
  std::vector<double> odd_cell; // centre of a cell in the zone that is of another size
  owned_cells.clear();
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && shape.contains(cell->center(), h, reach + 2.))
    {
      const double edge = edge_of_cube<dim>(cell);
      const Place<dim> place = place_of(cell->vertex(0));
      if (std::abs(edge - h) > 1e-6 * h || position(place).distance(cell->vertex(0)) > 1e-4 * h)
      {
        for (const unsigned int v : cell->vertex_indices())
          if (odd_cell.empty() && shape.contains(cell->vertex(v), h))
          {
            odd_cell.push_back(edge);
            for (unsigned int d = 0; d < dim; ++d)
              odd_cell.push_back(cell->center()[d]);
          }
        continue;
      }
      owned_cells[place] = cell->active_cell_index();
      for (const unsigned int v : cell->vertex_indices())
      {
        Site<dim> site;
        site.place = place;
        for (unsigned int d = 0; d < dim; ++d)
        {
          site.place[d] += v >> d & 1;
          site.dofs[d] = cell->vertex_dof_index(v, d);
        }
        if (mesh_view.has_pore_pressure)
          site.pressure_dof = cell->vertex_dof_index(v, dim);
        // Rows are assembled where they are stored.
        site.owner = dof_handler.locally_owned_dofs().is_element(site.dofs[0])
                       ? collectives.rank()
                       : collectives.rank() | not_owner;
        mine.emplace(site.place, site);
      }
      add_mirrors<dim>(cell, place, mesh_view.constraints, moves_side, my_mirrors);
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && moves_side && moves_side(cell->face(f)->boundary_id()))
          my_moved.push_back({{f / 2, f % 2}});
    }

  refuse_odd_cells<dim>(collectives.gather(odd_cell), h);

  for (auto &m : mirrors)
    m = {{no_mirror, no_mirror}};
  for (const auto &m : collectives.gather(my_mirrors))
    mirrors[m[0]][m[1]] = m[2];
  moved = {};
  for (const auto &[direction, side] : collectives.gather(my_moved))
    moved[direction][side] = true;
  find_room(in_zone.lower, in_zone.upper, reach, mesh_view, collectives);
  std::vector<Site<dim>> known;
  for (const auto &[place, site] : mine)
    known.push_back(site);
  all_sites = unite(knows_own_part ? with_sites_around(known, 2 * reach, collectives)
                                   : collectives.gather(known));
}


template <int dim>
void Zone<dim>::leave_what_is_needed(const int reach)
{
  if (all_sites.empty())
    return;
  // The box of all that is known.
  Place<dim> lower = all_sites.front().place, upper = lower;
  for (const Site<dim> &site : all_sites)
    for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::min(lower[d], site.place[d]);
      upper[d] = std::max(upper[d], site.place[d]);
    }
  LatticeBox<dim> box;
  for (unsigned int d = 0; d < dim; ++d)
    box.size[d] = upper[d] - lower[d] + 1;
  const auto index_of = [&](const Place<dim> &place)
  {
    std::array<int, dim> offset;
    for (unsigned int d = 0; d < dim; ++d)
      offset[d] = place[d] - lower[d];
    return box.stride(offset);
  };

  std::vector<bool> is_near(box.n_sites(), false);
  for (const auto &[cell, index] : owned_cells)
    for (unsigned int v = 0; v < 1u << dim; ++v)
    {
      Place<dim> corner_of_cell = cell;
      for (unsigned int d = 0; d < dim; ++d)
        corner_of_cell[d] += static_cast<int>(v >> d & 1);
      is_near[index_of(corner_of_cell)] = true;
    }
  // A horizon away, in all directions alike. Images lie no farther than what they are images for.
  const auto widen = [&]()
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      const std::vector<bool> before = is_near;
      std::array<int, dim> unit{};
      unit[d] = 1;
      const std::ptrdiff_t step = box.stride(unit);
      for (std::size_t i = 0; i < before.size(); ++i)
        if (before[i])
        {
          const int at = box.position(i)[d];
          for (int k = std::max(-reach, -at); k <= std::min<int>(reach, box.size[d] - 1 - at); ++k)
            is_near[i + k * step] = true;
        }
    }
  };
  widen();
  for (Site<dim> &site : all_sites)
    site.has_bonds = site.peridynamic && is_near[index_of(site.place)];
  widen();
  all_sites.erase(std::remove_if(all_sites.begin(), all_sites.end(),
                                 [&](const Site<dim> &site)
                                 { return !is_near[index_of(site.place)]; }),
                  all_sites.end());
  all_sites.shrink_to_fit();
}


template <int dim>
dealii::BoundingBox<dim> room_among(const std::vector<dealii::BoundingBox<dim>> &obstacles,
                                    const dealii::BoundingBox<dim> &zone,
                                    Bounds<dim> bounds,
                                    const double distance,
                                    const Collectives &collectives)
{
  const double tolerance = 1e-6 * distance;
  const auto away =
    [&](const dealii::BoundingBox<dim> &cell, const unsigned int d, const unsigned int side)
  {
    return side == 0 ? zone.lower_bound(d) - cell.upper_bound(d)
                     : cell.lower_bound(d) - zone.upper_bound(d);
  };
  const auto is_kept_away = [&](const dealii::BoundingBox<dim> &cell)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (cell.upper_bound(d) < bounds[d][0] - distance + tolerance ||
          cell.lower_bound(d) > bounds[d][1] + distance - tolerance)
        return true;
    return false;
  };
  // Those that the zone would meet if it grew in one direction alone bound that. Of the others,
  // some are no farther then; the rest bound the direction in which they are farthest.
  for (const bool straight : {true, false})
  {
    Bounds<dim> new_bounds = bounds;
    for (const dealii::BoundingBox<dim> &cell : obstacles)
    {
      double farthest = 0.;
      unsigned int direction = 0, side = 0, n_directions = 0;
      for (unsigned int d = 0; d < dim; ++d)
        for (const unsigned int s : {0u, 1u})
        {
          n_directions += away(cell, d, s) > distance - tolerance;
          if (away(cell, d, s) > farthest)
          {
            farthest = away(cell, d, s);
            direction = d;
            side = s;
          }
        }
      if (farthest == 0. || (straight ? n_directions != 1 : is_kept_away(cell)))
        continue;
      double &bound = new_bounds[direction][side];
      bound = side == 0 ? std::max(bound, cell.upper_bound(direction) + distance)
                        : std::min(bound, cell.lower_bound(direction) - distance);
    }
    for (auto &[lower, upper] : new_bounds)
    {
      lower = collectives.max(lower);
      upper = collectives.min(upper);
    }
    bounds = new_bounds;
  }
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
  {
    lower[d] = std::min(zone.lower_bound(d), bounds[d][0]);
    upper[d] = std::max(zone.upper_bound(d), bounds[d][1]);
  }
  return dealii::BoundingBox<dim>(std::make_pair(lower, upper));
}


template <int dim>
std::optional<std::array<unsigned int, 2>> Zone<dim>::moved_side_within(const double distance) const
{
  for (const unsigned int i : peridynamic_sites())
    for (unsigned int d = 0; d < dim; ++d)
      for (const unsigned int side : {0u, 1u})
      {
        const double place = position(all_sites[i].place)[d];
        if (moved[d][side] &&
            (side == 0 ? place - domain.lower_bound(d) : domain.upper_bound(d) - place) < distance)
          return std::array<unsigned int, 2>{{d, side}};
      }
  return {};
}


template <int dim>
void Zone<dim>::find_room(const Point<dim> &first,
                          const Point<dim> &last,
                          const unsigned int reach,
                          const MeshView<dim> &mesh_view,
                          const Collectives &collectives)
{
  const auto rim = [&](const unsigned int d, const unsigned int side)
  {
    return mirrors[d][side] != no_mirror || (has_free_boundaries && !moved[d][side]) ? 0.
                                                                                     : reach * h;
  };
  Bounds<dim> bound;
  std::vector<dealii::BoundingBox<dim>> odd_cells;
  for (unsigned int d = 0; d < dim; ++d)
    bound[d] = {{domain.lower_bound(d) + rim(d, 0), domain.upper_bound(d) - rim(d, 1)}};
  for (const auto &cell : mesh_view.triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const Point<dim> low = cell->vertex(0), high = cell->vertex((1 << dim) - 1);
      const double halvings = std::log2((high[0] - low[0]) / h);
      bool suits = std::abs(halvings - std::round(halvings)) < 1e-4;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double place = (low[d] - corner[d]) / h;
        suits = suits && std::abs(place - std::round(place)) < 1e-4 &&
                std::abs(high[d] - low[d] - (high[0] - low[0])) < 1e-4 * h;
      }
      if (!suits)
        odd_cells.emplace_back(std::make_pair(low, high));
    }
  const dealii::BoundingBox<dim> zone_now(std::make_pair(first, last));
  largest = room_among<dim>(odd_cells, zone_now, bound, reach * h, collectives);
}


#define INSTANTIATE(dim)                                                                           \
  template void Zone<dim>::find_spacing(const ZoneShape<dim> &, const MeshView<dim> &,             \
                                        const Collectives &);                                      \
  template void Zone<dim>::gather_sites(const ZoneShape<dim> &, unsigned int,                      \
                                        const std::function<bool(dealii::types::boundary_id)> &,   \
                                        const MeshView<dim> &, const Collectives &);               \
  template dealii::BoundingBox<dim> room_among<dim>(const std::vector<dealii::BoundingBox<dim>> &, \
                                                    const dealii::BoundingBox<dim> &, Bounds<dim>, \
                                                    double, const Collectives &);                  \
  template std::optional<std::array<unsigned int, 2>> Zone<dim>::moved_side_within(double) const;  \
  template void Zone<dim>::leave_what_is_needed(int);                                              \
  template void Zone<dim>::find_room(const Point<dim> &, const Point<dim> &, unsigned int,         \
                                     const MeshView<dim> &, const Collectives &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
