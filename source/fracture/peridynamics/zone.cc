#include "fracture/peridynamics/zone.h"

#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace stockwork::peridynamics
{
using dealii::Point;

namespace
{
template <int dim>
double distance_from_box(const Point<dim> &x, const dealii::BoundingBox<dim> &box)
{
  double sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
  {
    const double outside = std::max({box.lower_bound(d) - x[d], x[d] - box.upper_bound(d), 0.});
    sum += outside * outside;
  }
  return std::sqrt(sum);
}
} // namespace


template <int dim>
double ZoneShape<dim>::distance(const Point<dim> &point, const double spacing) const
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto &crack : cracks)
    nearest = std::min(nearest, crack.distance(point) - margin * spacing);
  for (const auto &box : boxes)
    nearest = std::min(nearest, distance_from_box(point, box));
  return nearest;
}


template <int dim>
bool ZoneShape<dim>::contains(const Point<dim> &point,
                              const double spacing,
                              const double enlarged_by) const
{
  return distance(point, spacing) <= (enlarged_by + same_place) * spacing;
}


template <int dim>
void Zone<dim>::set_origin(const Point<dim> &point)
{
  corner = point;
  has_corner = true;
}


template <int dim>
Point<dim> Zone<dim>::position(const Place<dim> &place) const
{
  Point<dim> point = corner;
  for (unsigned int d = 0; d < dim; ++d)
    point[d] += place[d] * h;
  return point;
}


template <int dim>
unsigned int Zone<dim>::find(const Place<dim> &place) const
{
  const auto found =
    std::lower_bound(all_sites.begin(), all_sites.end(), place,
                     [](const Site<dim> &site, const Place<dim> &p) { return site.place < p; });
  return found != all_sites.end() && found->place == place ? found - all_sites.begin()
                                                           : dealii::numbers::invalid_unsigned_int;
}


template <int dim>
unsigned int Zone<dim>::planes_of(const Place<dim> &place) const
{
  unsigned int planes = 0;
  for (unsigned int d = 0; d < dim; ++d)
    for (const int m : mirrors[d])
      if (m == place[d])
        planes |= 1u << d;
  return planes;
}


template <int dim>
void Zone<dim>::find_far_ends(const std::vector<StencilBond<dim>> &stencil,
                              const bool with_rim,
                              const Collectives &collectives)
{
  std::vector<Missing> missing;
  std::vector<FarEnd> ends;
  far_ends.reinit(all_sites.size(), stencil.size());
  inner_sites.clear();
  outer_sites.clear();
  std::vector<bool> is_outer(all_sites.size(), false);
  for (unsigned int i = 0; i < all_sites.size(); ++i)
  {
    const unsigned int planes = planes_of(all_sites[i].place);
    all_sites[i].share = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      if (planes >> d & 1)
        all_sites[i].share *= 0.5;
    if (!all_sites[i].has_bonds)
      continue;
    inner_sites.push_back(i);
    find_far_ends_of(i, stencil, ends, missing);
    if (with_rim)
      for (const FarEnd &end : ends)
        is_outer[end.site] = !all_sites[end.site].peridynamic;
  }
  for (unsigned int i = 0; i < all_sites.size(); ++i)
    if (is_outer[i])
    {
      outer_sites.push_back(i);
      find_far_ends_of(i, stencil, ends, missing);
    }
  missing = collectives.gather(missing);
  if (!missing.empty())
    throw unsuitable_mesh(
      std::min_element(missing.begin(), missing.end())->second +
      (with_rim ? " State-based bonds need two horizons in place of one." : ""));
}


template <int dim>
void Zone<dim>::find_volumes()
{
  for (Site<dim> &site : all_sites)
  {
    site.volume = 1.;
    const Point<dim> x = position(site.place);
    for (unsigned int d = 0; d < dim && has_free_boundaries && site.peridynamic; ++d)
      for (const unsigned int side : {0u, 1u})
        if (mirrors[d][side] == no_mirror &&
            std::abs(x[d] - (side == 0 ? domain.lower_bound(d) : domain.upper_bound(d))) <
              same_place * h)
          site.volume *= 0.5;
  }
}


template <int dim>
double Zone<dim>::absent_share(const unsigned int site,
                               const std::vector<StencilBond<dim>> &stencil) const
{
  double gone = 0., all = 0.;
  for (unsigned int b = 0; b < stencil.size(); ++b)
  {
    const FarEnd end = far_end(site, b);
    all += stencil[b].volume_fraction;
    gone += stencil[b].volume_fraction * (end.absent ? 1. : 1. - all_sites[end.site].volume);
  }
  return gone / all;
}


template <int dim>
void Zone<dim>::find_far_ends_of(const unsigned int i,
                                 const std::vector<StencilBond<dim>> &stencil,
                                 std::vector<FarEnd> &ends,
                                 std::vector<Missing> &missing)
{
  const Site<dim> &site = all_sites[i];
  ends.clear();
  const bool has_last = far_ends.n_lists() > 0; // most likely a site beside this one
  for (unsigned int b = 0; b < stencil.size(); ++b)
  {
    const StencilBond<dim> &bond = stencil[b];
    FarEnd end;
    Place<dim> place = site.place;
    for (unsigned int d = 0; d < dim; ++d)
    {
      place[d] += bond.offset[d];
      // Between two planes closer than the horizon there are images of images.
      for (bool again = true; again;)
      {
        again = false;
        for (const unsigned int side : {0u, 1u})
          if (const int m = mirrors[d][side];
              m != no_mirror && (side == 0 ? place[d] < m : place[d] > m))
          {
            place[d] = 2 * m - place[d];
            end.mirrored ^= 1 << d;
            again = true;
          }
      }
    }
    end.site = has_last ? far_ends.as_of_the_last(i, b).site : i;
    if (end.site >= all_sites.size() || all_sites[end.site].place != place)
      end.site = find(place);
    if (end.site == dealii::numbers::invalid_unsigned_int)
    {
      const Point<dim> far = position(place);
      bool outside = false;
      for (unsigned int d = 0; d < dim; ++d)
        outside |= far[d] < domain.lower_bound(d) - same_place * h ||
                   far[d] > domain.upper_bound(d) + same_place * h;
      if (outside && has_free_boundaries)
      {
        ends.push_back({i, 0, true});
        continue;
      }
      ends.push_back({i, 0, true});
      if (!missing.empty())
        continue;
      std::ostringstream message;
      message << "The horizon of the peridynamic node at (" << position(site.place) << ") m ";
      if (outside)
        message << "is cut by the boundary of the domain, which there is no plane of symmetry "
                   "('Roller'). Leave as many cells between zone and boundary as the horizon "
                   "has.";
      else
        message << "leaves the cells of size " << h
                << " m. Uniform cells must go on for the horizon around the zone; change the "
                   "spacing in subsection Mesh, or set 'Cell size'.";
      missing.emplace_back(site.place, message.str());
      continue;
    }
    ends.push_back(end);
  }
  far_ends.set(i, ends);
}


template <int dim>
void Zone<dim>::setup(const ZoneShape<dim> &shape,
                      const double spacing,
                      const std::vector<StencilBond<dim>> &stencil,
                      const bool with_rim,
                      const bool divided,
                      const std::function<bool(dealii::types::boundary_id)> &moves_side,
                      const bool free_boundaries,
                      const MeshView<dim> &mesh_view,
                      const Collectives &collectives)
{
  rank = collectives.rank();
  has_free_boundaries = free_boundaries;
  knows_own_part = divided;
  int reach = 0;
  for (const StencilBond<dim> &bond : stencil)
    for (unsigned int d = 0; d < dim; ++d)
      reach = std::max(reach, std::abs(bond.offset[d]));
  if (h == 0.)
  {
    h = spacing;
    if (h == 0.)
      find_spacing(shape, mesh_view, collectives);
  }
  gather_sites(shape, with_rim ? 2 * reach : reach, moves_side, mesh_view, collectives);
  for (Site<dim> &site : all_sites)
    site.has_bonds = site.peridynamic = shape.contains(position(site.place), h);
  if (divided)
    leave_what_is_needed(reach);
  n_inner_sites = static_cast<unsigned int>(collectives.sum(static_cast<double>(std::count_if(
    all_sites.begin(), all_sites.end(),
    [this](const Site<dim> &site) { return site.peridynamic && site.owner == rank; }))));
  find_volumes();
  find_far_ends(stencil, with_rim, collectives);

  patterns.assign(1u << (1u << dim), std::vector<bool>(1 << dim, false));
  for (unsigned int pattern = 0; pattern < patterns.size(); ++pattern)
    for (unsigned int v = 0; v < 1u << dim; ++v)
      patterns[pattern][v] = pattern >> v & 1;
  pattern_of_cell.assign(mesh_view.triangulation.n_active_cells(), 0);
  const auto corner_site = [&](const Place<dim> &cell, const unsigned int v)
  {
    Place<dim> place = cell;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] += v >> d & 1;
    return find(place);
  };
  for (const auto &[place, index] : owned_cells)
    for (unsigned int v = 0; v < 1u << dim; ++v)
      if (all_sites[corner_site(place, v)].peridynamic)
        pattern_of_cell[index] |= 1u << v;

  inner_cells.clear();
  for (const unsigned int i : inner_sites)
  {
    bool all = true;
    for (unsigned int v = 1; v < 1u << dim; ++v)
    {
      const unsigned int other = corner_site(all_sites[i].place, v);
      all &= other != dealii::numbers::invalid_unsigned_int && all_sites[other].has_bonds;
    }
    if (all)
      inner_cells.push_back(all_sites[i].place);
  }
}


template <int dim>
const std::vector<bool> *Zone<dim>::skipped_rows(const unsigned int active_cell_index) const
{
  if (active_cell_index >= pattern_of_cell.size() || pattern_of_cell[active_cell_index] == 0)
    return nullptr;
  return &patterns[pattern_of_cell[active_cell_index]];
}


template <int dim>
std::vector<double> Zone<dim>::displacement(const dealii::TrilinosWrappers::MPI::BlockVector &bulk,
                                            const Collectives &collectives) const
{
  std::vector<double> u(all_sites.size() * dim, 0.);
  for (unsigned int i = 0; i < all_sites.size(); ++i)
    if (all_sites[i].owner == rank)
      for (unsigned int d = 0; d < dim; ++d)
        u[i * dim + d] = bulk(all_sites[i].dofs[d]);
  collectives.sum(u);
  return u;
}


template struct ZoneShape<2>;
template struct ZoneShape<3>;
template class Zone<2>;
template class Zone<3>;
} // namespace stockwork::peridynamics
