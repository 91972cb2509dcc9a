#include "fracture/peridynamics/peridynamics.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace stockwork::peridynamics
{
using dealii::BoundingBox;
using dealii::Point;
using dealii::Tensor;

namespace
{
/// What of the points within some distance in each direction is in the box.
template <int dim>
BoundingBox<dim>
surroundings(const Point<dim> &point, const double distance, const BoundingBox<dim> &room)
{
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
  {
    lower[d] = std::max(point[d] - distance, room.lower_bound(d));
    upper[d] = std::max(std::min(point[d] + distance, room.upper_bound(d)), lower[d]);
  }
  return BoundingBox<dim>(std::make_pair(lower, upper));
}

/// Whether all of the box is in the zone, by points that are at most a lattice spacing h apart.
template <int dim>
bool is_filled(const ZoneShape<dim> &shape, const BoundingBox<dim> &box, const double h)
{
  const auto &[lower, upper] = box.get_boundary_points();
  BoundingBox<dim> reached = box;
  reached.extend(same_place * h);
  // A zone that has grown often has thousands of boxes, and few of them are near.
  std::vector<BoundingBox<dim>> near;
  for (const BoundingBox<dim> &one : shape.boxes)
  {
    if (one.point_inside(lower) && one.point_inside(upper))
      return true;
    bool overlaps = true;
    for (unsigned int d = 0; d < dim; ++d)
      overlaps = overlaps && one.lower_bound(d) <= reached.upper_bound(d) &&
                 one.upper_bound(d) >= reached.lower_bound(d);
    if (overlaps)
    {
      near.push_back(one);
      near.back().extend(same_place * h);
    }
  }
  const ZoneShape<dim> around_cracks{shape.cracks, {}, shape.margin};

  std::array<unsigned int, dim> n;
  unsigned int n_points = 1;
  for (unsigned int d = 0; d < dim; ++d)
    n_points *= n[d] = 2 + static_cast<unsigned int>(box.side_length(d) / h);
  for (unsigned int k = 0; k < n_points; ++k)
  {
    Point<dim> point;
    for (unsigned int d = 0, rest = k; d < dim; rest /= n[d++])
      point[d] = box.lower_bound(d) + box.side_length(d) * (rest % n[d]) / (n[d] - 1);
    const auto found =
      std::find_if(near.begin(), near.end(),
                   [&](const BoundingBox<dim> &one) { return one.point_inside(point); });
    if (found != near.end())
      std::iter_swap(near.begin(), found); // the next point may well be in it, too
    else if (!around_cracks.contains(point, h))
      return false;
  }
  return true;
}
} // namespace


template <int dim>
bool Peridynamics<dim>::enlarge_zone()
{
  if (parameters.zone_growth == 0)
    return false;
  const std::size_t n_boxes = shape.boxes.size();
  const double h = lattice.zone.spacing();
  std::vector<Point<dim>> active;
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
    if (fracture.at_front[i])
      active.push_back(fracture.segments[i].centre);
  std::set<Place<dim>> middles; // of bonds, times two: many have the same
  for (const SofteningBond &bond : softening_bonds)
  {
    const auto &[site, b] = bond.view;
    const Place<dim> &place = lattice.zone.sites()[site].place;
    Place<dim> middle;
    for (unsigned int d = 0; d < dim; ++d)
      middle[d] = 2 * place[d] + lattice.stencil[b].offset[d];
    if (middles.insert(middle).second)
      active.push_back(lattice.zone.position(place) +
                       0.5 * lattice.coefficients[b].length * lattice.coefficients[b].direction);
  }

  for (const Point<dim> &point : active)
  {
    const BoundingBox<dim> wanted = surroundings(point, parameters.margin * h, lattice.zone.room());
    if (is_filled(shape, wanted, h))
      continue;
    // Ahead is away from where the fracture is, along it.
    Tensor<1, dim> ahead, normal;
    double nearest = 2. * parameters.margin * h;
    for (unsigned int i = 0; i < fracture.cells.size(); ++i)
    {
      const Tensor<1, dim> away = point - fracture.segments[i].centre;
      if (away.norm() < 2. * parameters.margin * h)
        ahead += away;
      if (away.norm() < nearest)
      {
        nearest = away.norm();
        normal = fracture.cells[i].normal;
      }
    }
    ahead -= (ahead * normal) * normal;
    if (ahead.norm() > 0.1 * h)
      ahead *= parameters.zone_growth * h / ahead.norm();
    BoundingBox<dim> box = surroundings(point + ahead, parameters.margin * h, lattice.zone.room());
    box.merge_with(wanted);
    shape.boxes.push_back(box);
  }
  return shape.boxes.size() > n_boxes;
}


template <int dim>
bool Peridynamics<dim>::zone_may_include(const unsigned int site, const unsigned int bond) const
{
  return parameters.zone_growth > 0 &&
         lattice.zone.room().point_inside(
           lattice.zone.position(lattice.zone.sites()[lattice.zone.far_end(site, bond).site].place),
           1e-6);
}

template bool Peridynamics<2>::enlarge_zone();
template bool Peridynamics<3>::enlarge_zone();
template bool Peridynamics<2>::zone_may_include(unsigned int, unsigned int) const;
template bool Peridynamics<3>::zone_may_include(unsigned int, unsigned int) const;
} // namespace stockwork::peridynamics
