#include "fracture/peridynamics/peridynamics.h"

#include <limits>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;

template <int dim>
void Peridynamics<dim>::cut_initial_cracks()
{
  if constexpr (dim == 2)
    for (const auto &crack : scene.cracks)
    {
      if (crack.kind != InitialCrack<dim>::Kind::open)
        continue;
      const auto at_wall = [&](const Point<dim> &x)
      { return !zone.is_inside(x, 1e-6 * zone.spacing()); };
      for (unsigned int c = 0; c + 1 < crack.points.size(); ++c)
      {
        const Point<dim> &start = crack.points[c];
        const Tensor<1, dim> along = crack.points[c + 1] - start;
        const double length = along.norm(), reach = 1e-6 * zone.spacing();
        const auto side = [&](const Point<dim> &x)
        { return (along[0] * (x[1] - start[1]) - along[1] * (x[0] - start[0])) / length; };
        for (const unsigned int i : zone.peridynamic_sites())
          for (unsigned int b = 0; b < stencil.size(); ++b)
          {
            const Point<dim> from = zone.position(zone.sites()[i].place);
            const Tensor<1, dim> xi = zone.spacing() * stencil[b].length() * stencil[b].direction();
            // A node on the crack belongs to its left side.
            const double s = side(from), t = side(from + xi);
            if ((s >= -reach) == (t >= -reach) || !bonds.can_break(i, b))
              continue;
            const Point<dim> crossing = from + s / (s - t) * xi;
            const double place = (crossing - start) * along / length;
            // A bond right at a tip holds, or the crack would be longer by half a cell.
            const bool after_start = place > (c == 0 && !at_wall(start) ? reach : -reach);
            const bool before_end =
              place <
              length +
                (c + 2 == crack.points.size() && !at_wall(crack.points.back()) ? -reach : reach);
            if (after_start && before_end)
              bonds.set_broken(i, b);
          }
      }
    }
}


template <int dim>
void Peridynamics<dim>::set_initial_normals()
{
  if constexpr (dim == 2)
    for (const FractureCell<dim> &cell : find_fracture_cells(zone, bonds))
    {
      Point<dim> centre = zone.position(cell.place);
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] += 0.5 * zone.spacing();
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto &crack : scene.cracks)
        for (unsigned int c = 0; c + 1 < crack.points.size(); ++c)
        {
          const std::vector<Point<dim>> piece{crack.points[c], crack.points[c + 1]};
          const double distance = distance_from_polyline(centre, piece);
          if (crack.kind != InitialCrack<dim>::Kind::open || distance >= nearest)
            continue;
          nearest = distance;
          const Tensor<1, dim> along = (piece[1] - piece[0]) / piece[0].distance(piece[1]);
          const double upward = along[0] >= 0. ? 1. : -1.;
          committed_normals[cell.place] = {-upward * along[1], upward * along[0]};
        }
    }
}

#define INSTANTIATE(dim)                                 \
  template void Peridynamics<dim>::cut_initial_cracks(); \
  template void Peridynamics<dim>::set_initial_normals();
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
