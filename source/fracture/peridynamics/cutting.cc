#include "fracture/peridynamics/peridynamics.h"
#include "fracture/peridynamics/rows_of_nodes.h"

#include <cmath>
#include <functional>
#include <limits>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;

template <int dim>
void Peridynamics<dim>::cut_initial_cracks()
{
  for (const auto &crack : oriented_cracks(lattice))
  {
    const bool is_open = crack.kind == InitialCrack<dim>::Kind::open;
    if (crack.disc)
      cut_along_plane(crack.disc->centre, crack.disc->normal, is_open,
                      [&](const Point<dim> &crossing)
                      {
                        // As at a tip: a bond right at the edge holds.
                        return crossing.distance(crack.disc->centre) <
                               crack.disc->radius - same_place * lattice.zone.spacing();
                      });
    if constexpr (dim == 2)
    {
      const auto at_wall = [&](const Point<dim> &x)
      { return !lattice.zone.is_inside(x, same_place * lattice.zone.spacing()); };
      for (unsigned int c = 0; c + 1 < crack.points.size(); ++c)
      {
        const Point<dim> &start = crack.points[c];
        const Tensor<1, dim> along = crack.points[c + 1] - start;
        const double length = along.norm(), reach = same_place * lattice.zone.spacing();
        // A bond right at a tip holds, or the crack would be longer by half a cell.
        const double first = c == 0 && !at_wall(start) ? reach : -reach;
        const double last =
          length + (c + 2 == crack.points.size() && !at_wall(crack.points.back()) ? -reach : reach);
        Tensor<1, dim> normal;
        normal[0] = -along[1] / length;
        normal[1] = along[0] / length;
        cut_along_plane(start, normal, is_open,
                        [&](const Point<dim> &crossing)
                        {
                          const double place = (crossing - start) * along / length;
                          return place > first && place < last;
                        });
      }
    }
  }
}


template <int dim>
void Peridynamics<dim>::cut_along_plane(
  const Point<dim> &origin,
  const Tensor<1, dim> &normal,
  const bool is_open,
  const std::function<bool(const Point<dim> &crossing)> &is_on_crack)
{
  const double reach = same_place * lattice.zone.spacing();
  for (const unsigned int i : lattice.zone.peridynamic_sites())
    for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
    {
      const Point<dim> from = lattice.zone.position(lattice.zone.sites()[i].place);
      const Tensor<1, dim> xi =
        lattice.zone.spacing() * lattice.stencil[b].length() * lattice.stencil[b].direction();
      // A node on the crack belongs to the side that the normal points to.
      const double s = (from - origin) * normal, t = (from + xi - origin) * normal;
      if ((s >= -reach) != (t >= -reach) && lattice.bonds.can_break(i, b) &&
          is_on_crack(from + s / (s - t) * xi))
      {
        if (is_open)
          lattice.bonds.set_broken(i, b);
        cracked.set_broken(i, b);
      }
    }
}


template <int dim>
void Peridynamics<dim>::soften_cohesive_cracks()
{
  if (!parameters.in_bonds || !std::isnan(scene.crack_pressure))
    return;
  for (const unsigned int i : lattice.zone.peridynamic_sites())
    for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
      if (cracked.is_broken(i, b) && !lattice.bonds.is_broken(i, b) &&
          lattice.bonds.views_of(i, b).front() == BondView(i, b))
        softening_bonds.committed.bonds.push_back(
          {lattice.bonds.places(i, b),
           {{lattice.softening.stretch_of(SofteningLaw::damage_at_start), 0.}}});
  restore_softening();
}


template <int dim>
void Peridynamics<dim>::set_initial_normals()
{
  for (const FractureCell<dim> &cell : fracture_cells())
  {
    Point<dim> centre = lattice.zone.position(cell.place);
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] += 0.5 * lattice.zone.spacing();
    double nearest = std::numeric_limits<double>::infinity();
    const auto consider = [&](const InitialCrack<dim> &piece, const Tensor<1, dim> &normal)
    {
      const double distance = piece.distance(centre);
      if (distance >= nearest)
        return;
      nearest = distance;
      double sign = 1.;
      for (unsigned int d = 0; d < dim; ++d) // the last component that is not zero is positive
        if (std::abs(normal[d]) > 1e-12)
          sign = normal[d] > 0. ? 1. : -1.;
      const Tensor<1, dim> upward = sign * normal;
      committed_normals[cell.place].assign(upward.begin_raw(), upward.end_raw());
    };
    for (const auto &crack : scene.cracks)
    {
      if (crack.disc)
        consider(crack, crack.disc->normal);
      if constexpr (dim == 2)
        for (unsigned int c = 0; c + 1 < crack.points.size(); ++c)
        {
          InitialCrack<dim> piece;
          piece.points = {crack.points[c], crack.points[c + 1]};
          const Tensor<1, dim> along = (piece.points[1] - piece.points[0]) / piece.size();
          consider(piece, cross_product_2d(-along));
        }
    }
  }
}

#define INSTANTIATE(dim)                                     \
  template void Peridynamics<dim>::cut_initial_cracks();     \
  template void Peridynamics<dim>::cut_along_plane(          \
    const Point<dim> &, const Tensor<1, dim> &, bool,        \
    const std::function<bool(const Point<dim> &)> &);        \
  template void Peridynamics<dim>::soften_cohesive_cracks(); \
  template void Peridynamics<dim>::set_initial_normals();
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
