#include "fracture/peridynamics/peridynamics.h"

#include <algorithm>
#include <cmath>

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
} // namespace


template <int dim>
bool Peridynamics<dim>::enlarge_zone()
{
  if (parameters.zone_growth == 0)
    return false;
  const std::size_t n_boxes = shape.boxes.size();
  const double h = lattice.zone.spacing();
  std::vector<Point<dim>> active;
  for (unsigned int i = 0; i < cells.size(); ++i)
    if (at_front[i])
      active.push_back(all_segments[i].centre);
  for (const SofteningBond &bond : softening_bonds)
  {
    const auto &[site, b] = bond.view;
    active.push_back(lattice.zone.position(lattice.zone.sites()[site].place) +
                     0.5 * lattice.coefficients[b].length * lattice.coefficients[b].direction);
  }

  const auto is_in_zone = [&](const BoundingBox<dim> &box)
  {
    const auto &[lower, upper] = box.get_boundary_points();
    if (std::any_of(shape.boxes.begin(), shape.boxes.end(),
                    [&](const BoundingBox<dim> &one)
                    { return one.point_inside(lower) && one.point_inside(upper); }))
      return true;
    std::array<unsigned int, dim> n;
    unsigned int n_points = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n_points *= n[d] = 2 + static_cast<unsigned int>(box.side_length(d) / h);
    for (unsigned int k = 0; k < n_points; ++k)
    {
      Point<dim> point;
      for (unsigned int d = 0, rest = k; d < dim; rest /= n[d++])
        point[d] = box.lower_bound(d) + box.side_length(d) * (rest % n[d]) / (n[d] - 1);
      if (!shape.contains(point, h))
        return false;
    }
    return true;
  };
  for (const Point<dim> &point : active)
  {
    const BoundingBox<dim> wanted = surroundings(point, parameters.margin * h, lattice.zone.room());
    if (is_in_zone(wanted))
      continue;
    // Ahead is away from where the fracture is, along it.
    Tensor<1, dim> ahead, normal;
    double nearest = 2. * parameters.margin * h;
    for (unsigned int i = 0; i < cells.size(); ++i)
    {
      const Tensor<1, dim> away = point - all_segments[i].centre;
      if (away.norm() < 2. * parameters.margin * h)
        ahead += away;
      if (away.norm() < nearest)
      {
        nearest = away.norm();
        normal = cells[i].normal;
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
