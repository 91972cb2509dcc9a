#include "fracture/peridynamics/fracture_cells.h"

#include <deal.II/base/symmetric_tensor.h>

#include "stockwork/mesh/key.h"

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

template <int dim>
Place<dim> corner(const Place<dim> &cell, const unsigned int v)
{
  Place<dim> place = cell;
  for (unsigned int d = 0; d < dim; ++d)
    place[d] += v >> d & 1;
  return place;
}

template <int dim>
dealii::Point<dim> centre(const Zone<dim> &zone, const Place<dim> &cell)
{
  dealii::Point<dim> point = zone.position(cell);
  for (unsigned int d = 0; d < dim; ++d)
    point[d] += 0.5 * zone.spacing();
  return point;
}

template <int dim>
double sum_of_components(const Tensor<1, dim> &normal)
{
  double sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    sum += std::abs(normal[d]);
  return sum;
}

/// The places of the cells that have one of these sites at a corner, in their order. There may be
/// no cell.
template <int dim>
std::vector<Place<dim>> cells_at(const Zone<dim> &zone, const std::vector<unsigned int> &sites)
{
  std::vector<Place<dim>> places;
  for (const unsigned int i : sites)
    for (unsigned int v = 0; v < 1u << dim; ++v)
    {
      Place<dim> place = zone.sites()[i].place;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] -= static_cast<int>(v >> d & 1);
      places.push_back(place);
    }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

/// Planes of symmetry that a cell lies at; beyond them the fracture goes on.
template <int dim>
unsigned int planes_at(const Zone<dim> &zone, const Place<dim> &cell)
{
  unsigned int planes = 0, number = 0;
  for (unsigned int v = 0; v < 1u << dim; ++v)
    planes |= zone.planes_of(corner<dim>(cell, v));
  for (unsigned int d = 0; d < dim; ++d)
    number += planes >> d & 1;
  return number;
}

/// Unit vector along which a second moment is greatest or least, rounded so that the order of the
/// sum does not show.
template <int dim>
Tensor<1, dim> axis(SymmetricTensor<2, dim> moment, const bool greatest)
{
  const double scale = trace(moment);
  for (unsigned int i = 0; i < moment.n_independent_components; ++i)
    moment.access_raw_entry(i) = std::round(1e9 * moment.access_raw_entry(i) / scale) * 1e-9;
  Tensor<1, dim> normal = eigenvectors(moment)[greatest ? 0 : dim - 1].second;
  for (unsigned int d = 0; d < dim; ++d)
    if (std::abs(normal[d]) < 1e-8)
      normal[d] = 0.;
  for (int d = dim - 1; d >= 0; --d)
    if (normal[d] != 0.)
      return (normal[d] > 0. ? 1. : -1.) * normal / normal.norm();
  return normal;
}

/// From the place of one cell to that of another.
template <int dim>
Tensor<1, dim> offset_between(const FractureCell<dim> &from, const FractureCell<dim> &to)
{
  Tensor<1, dim> offset;
  for (unsigned int d = 0; d < dim; ++d)
    offset[d] = to.place[d] - from.place[d];
  return offset;
}

/// Number of the cell at a place, of cells in the order of places; none: there is no such cell.
template <int dim>
unsigned int number_of(const std::vector<FractureCell<dim>> &cells, const Place<dim> &place)
{
  const auto found = std::lower_bound(cells.begin(), cells.end(), place,
                                      [](const FractureCell<dim> &cell, const Place<dim> &p)
                                      { return cell.place < p; });
  return found != cells.end() && found->place == place ? found - cells.begin() : none;
}

/// The cells that have a corner in common with one, itself included.
template <int dim>
std::vector<unsigned int> neighbours_of(const std::vector<FractureCell<dim>> &cells,
                                        const FractureCell<dim> &cell)
{
  std::vector<unsigned int> neighbours;
  constexpr int n_beside = dim == 2 ? 9 : 27;
  for (int n = 0; n < n_beside; ++n)
  {
    Place<dim> place = cell.place;
    for (int d = 0, rest = n; d < dim; ++d, rest /= 3)
      place[d] += rest % 3 - 1;
    if (const unsigned int i = number_of<dim>(cells, place); i != none)
      neighbours.push_back(i);
  }
  return neighbours;
}

/// A bond between two corners of a cell.
template <int dim>
struct OwnBond
{
  unsigned int corner, bond; ///< as that corner sees it
  Tensor<1, dim> direction;
};

/// Those that the stencil has, each from one of its ends.
template <int dim>
std::vector<OwnBond<dim>> own_bonds(const BondSet<dim> &bonds)
{
  std::vector<OwnBond<dim>> result;
  for (unsigned int v = 0; v < 1u << dim; ++v)
    for (unsigned int w = v + 1; w < 1u << dim; ++w)
    {
      Place<dim> offset;
      for (unsigned int d = 0; d < dim; ++d)
        offset[d] = static_cast<int>(w >> d & 1) - static_cast<int>(v >> d & 1);
      if (const unsigned int b = bonds.bond(offset); b != none)
        result.push_back({v, b, bonds.bonds()[b].direction()});
    }
  return result;
}
} // namespace


template <int dim>
std::vector<FractureCell<dim>> find_fracture_cells(const Zone<dim> &zone, const BondSet<dim> &bonds)
{
  constexpr unsigned int n_corners = 1 << dim;
  constexpr double crossing = 0.3; // |e.n| of a bond that counts as crossing
  // So many are broken where a plane has passed the cell's centre, or cuts off one of its corners:
  // of the 4 (16) bonds that cross a plane along the lattice, 2 (7).
  constexpr unsigned int enough = dim == 2 ? 2 : 7;
  const std::vector<OwnBond<dim>> own = own_bonds(bonds);
  std::vector<SymmetricTensor<2, dim>> moment_of;
  for (const StencilBond<dim> &bond : bonds.bonds())
    moment_of.push_back(symmetrize(outer_product(bond.direction(), bond.direction())));
  std::vector<FractureCell<dim>> cells;
  std::array<unsigned int, n_corners> site;
  for (const Place<dim> &place : cells_at(zone, bonds.damaged_sites()))
  {
    if (zone.is_divided() && !zone.owns(place))
      continue;
    bool is_inside = true;
    for (unsigned int v = 0; v < n_corners; ++v)
    {
      site[v] = zone.find(corner<dim>(place, v));
      is_inside = is_inside && site[v] != none && zone.sites()[site[v]].has_bonds;
    }
    if (!is_inside)
      continue;
    const auto n_broken_where = [&](const auto &counts)
    {
      unsigned int n = 0;
      for (const OwnBond<dim> &bond : own)
        n += bonds.is_broken(site[bond.corner], bond.bond) && counts(bond.direction);
      return n;
    };
    if (n_broken_where([](const Tensor<1, dim> &) { return true; }) < enough)
      continue;

    SymmetricTensor<2, dim> moment;
    for (const unsigned int i : site)
      bonds.for_each_broken(i, [&](const unsigned int b) { moment += moment_of[b]; });
    const FractureCell<dim> cell{place, axis(moment, true)};
    if (n_broken_where([&](const Tensor<1, dim> &e)
                       { return std::abs(e * cell.normal) > crossing; }) >= enough)
      cells.push_back(cell);
  }
  return cells;
}


template <int dim>
void align_normals(std::vector<FractureCell<dim>> &cells,
                   const unsigned int radius,
                   const std::function<bool(const Place<dim> &)> &is_settled)
{
  constexpr double thin = 0.3; // of what is a band: its width over its length, squared
  std::vector<std::vector<unsigned int>> beside(cells.size()); // of those looked at
  // The cells around that are joined to this one: another crack nearby does not count.
  std::vector<unsigned int> joined, joined_to(cells.size(), none);
  for (unsigned int i = 0; i < cells.size(); ++i)
  {
    FractureCell<dim> &cell = cells[i];
    if (is_settled(cell.place))
      continue;
    joined.assign(1, i);
    joined_to[i] = i;
    std::vector<Tensor<1, dim>> around;
    Tensor<1, dim> mean;
    for (unsigned int k = 0; k < joined.size(); ++k)
    {
      around.push_back(offset_between(cell, cells[joined[k]]));
      mean += around.back();
      if (beside[joined[k]].empty())
        beside[joined[k]] = neighbours_of(cells, cells[joined[k]]);
      for (const unsigned int j : beside[joined[k]])
        if (joined_to[j] != i && offset_between(cell, cells[j]).norm() < radius + 0.5)
        {
          joined.push_back(j);
          joined_to[j] = i;
        }
    }
    mean /= around.size();
    SymmetricTensor<2, dim> spread;
    for (const Tensor<1, dim> &offset : around)
      spread += symmetrize(outer_product(offset - mean, offset - mean));
    if (around.size() < dim || trace(spread) == 0.)
      continue;
    const auto values = eigenvalues(spread);
    if (values[dim - 1] < thin * values[dim - 2])
      cell.normal = axis(spread, false);
  }
}


template <int dim>
double broken_share(const Zone<dim> &zone,
                    const std::vector<StencilBond<dim>> &stencil,
                    const FractureCell<dim> &cell,
                    const std::function<double(unsigned int, unsigned int)> &damage)
{
  double broken = 0.;
  unsigned int n_crossing = 0;
  for (unsigned int v = 0; v < 1u << dim; ++v)
  {
    const unsigned int site = zone.find(corner<dim>(cell.place, v));
    if (site == dealii::numbers::invalid_unsigned_int)
      continue;       // beyond the rim there are no bonds
    double here = 0.; // distances from the fracture, in spacings
    for (unsigned int d = 0; d < dim; ++d)
      here += cell.normal[d] * ((v >> d & 1) != 0u ? 0.5 : -0.5);
    for (unsigned int b = 0; b < stencil.size(); ++b)
    {
      double there = here;
      for (unsigned int d = 0; d < dim; ++d)
        there += cell.normal[d] * stencil[b].offset[d];
      if ((here > 0.) == (there > 0.))
        continue;
      ++n_crossing;
      broken += damage(site, b);
    }
  }
  return n_crossing > 0 ? broken / n_crossing : 0.;
}


template <int dim>
bool is_beside(const std::vector<FractureCell<dim>> &cells,
               const std::vector<double> &apertures,
               const double reach,
               const unsigned int i)
{
  constexpr double small = 0.1, same_direction = 0.9;
  for (unsigned int j = 0; j < cells.size(); ++j)
  {
    if (!(apertures[i] < small * apertures[j]) ||
        std::abs(cells[i].normal * cells[j].normal) < same_direction)
      continue;
    const Tensor<1, dim> away = offset_between(cells[j], cells[i]); // [cells]
    const double across = std::abs(away * cells[j].normal);
    if (across > 0.75 && across < reach && away.norm_square() - across * across < 0.75 * 0.75)
      return true;
  }
  return false;
}


template <int dim>
double fracture_area(const Tensor<1, dim> &normal, const double spacing)
{
  return std::pow(spacing, dim - 1) / sum_of_components(normal);
}


template <int dim>
std::vector<Tensor<1, dim>> jumps(const Zone<dim> &zone, const FractureCell<dim> &cell)
{
  constexpr unsigned int n_corners = 1 << dim;
  const double h = zone.spacing(), width = h * sum_of_components(cell.normal);
  const Tensor<1, dim> &n = cell.normal;
  std::vector<Tensor<1, dim>> result;
  for (unsigned int v = 0; v < n_corners; ++v)
  {
    Tensor<1, dim> gradient; // of the shape function at the centre
    for (unsigned int d = 0; d < dim; ++d)
      gradient[d] = ((v >> d & 1) != 0u ? 1. : -1.) / (h * (n_corners / 2));
    const double across = n * gradient;
    for (unsigned int d = 0; d < dim; ++d)
    {
      Tensor<1, dim> jump = n[d] * (gradient - across * n);
      jump[d] += across;
      result.push_back(width * jump);
    }
  }
  return result;
}


template <int dim>
std::vector<Segment<dim>> make_segments(const Zone<dim> &zone,
                                        const std::vector<FractureCell<dim>> &cells)
{
  const double h = zone.spacing();
  std::vector<Segment<dim>> segments(cells.size());
  for (unsigned int i = 0; i < cells.size(); ++i)
  {
    Segment<dim> &segment = segments[i];
    segment.centre = centre<dim>(zone, cells[i].place);
    segment.key = Key().add(segment.centre, 1e-4 * h);
    segment.normal = cells[i].normal;
    segment.area = fracture_area(cells[i].normal, h);
    if (zone.is_divided() && !zone.owns(cells[i].place))
      continue; // the rest is its owner's affair
    for (const Tensor<1, dim> &jump : jumps(zone, cells[i]))
      segment.opening.bulk_coefficients.push_back(jump * segment.normal);
    for (unsigned int v = 0; v < 1u << dim; ++v)
    {
      const Site<dim> &site = zone.sites()[zone.find(corner<dim>(cells[i].place, v))];
      segment.opening.bulk.insert(segment.opening.bulk.end(), site.dofs.begin(), site.dofs.end());
      if (site.pressure_dof == dealii::numbers::invalid_dof_index)
        continue;
      segment.pore_pressure.bulk.push_back(site.pressure_dof);
      segment.pore_pressure.bulk_coefficients.push_back(1. / (1 << dim));
      segment.pore_distance +=
        std::abs((zone.position(site.place) - segment.centre) * segment.normal) / (1 << dim);
    }
  }

  // Neighbours share a face; or an edge (a corner in 2-D), if no third one has a face in common
  // with both.
  for (unsigned int i = 0; i < cells.size(); ++i)
  {
    const Place<dim> &here = cells[i].place;
    const auto moved = [](Place<dim> place, const unsigned int d, const int step)
    {
      place[d] += step;
      return place;
    };
    const auto connect = [&](const Place<dim> &place)
    {
      const unsigned int found = number_of<dim>(cells, place);
      if (found == none)
        return;
      const Segment<dim> &other = segments[found];
      if (dim == 2)
      {
        segments[i].neighbours.push_back({other.key, 0.5 * segments[i].area, 1.});
        return;
      }
      // Along the fracture, and what it is wide across that in this cell. Cells above one another
      // are as near as that.
      const Tensor<1, dim> to = other.centre - segments[i].centre;
      const double distance =
        std::max((to - (to * cells[i].normal) * cells[i].normal).norm(), 0.3 * h);
      segments[i].neighbours.push_back({other.key, 0.5 * distance, segments[i].area / distance});
    };
    for (unsigned int d = 0; d < dim; ++d)
      for (const int step : {-1, 1})
        connect(moved(here, d, step));
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = d + 1; e < dim; ++e)
        for (const int dx : {-1, 1})
          for (const int dy : {-1, 1})
          {
            const Place<dim> first = moved(here, d, dx), second = moved(here, e, dy);
            if (number_of<dim>(cells, first) == none && number_of<dim>(cells, second) == none)
              connect(moved(first, e, dy));
          }
    segments[i].at_tip =
      dim == 2 && segments[i].neighbours.size() <= 1 && planes_at<dim>(zone, cells[i].place) == 0;
  }
  return segments;
}


template <int dim>
bool is_at_front(const Zone<dim> &zone, const FractureCell<dim> &cell, const Segment<dim> &segment)
{
  return dim == 2 ? segment.at_tip
                  : segment.neighbours.size() + planes_at<dim>(zone, cell.place) < 2 * (dim - 1);
}


#define INSTANTIATE(dim)                                                                       \
  template std::vector<FractureCell<dim>> find_fracture_cells(const Zone<dim> &,               \
                                                              const BondSet<dim> &);           \
  template void align_normals<dim>(std::vector<FractureCell<dim>> &, const unsigned int,       \
                                   const std::function<bool(const Place<dim> &)> &);           \
  template double broken_share(const Zone<dim> &, const std::vector<StencilBond<dim>> &,       \
                               const FractureCell<dim> &,                                      \
                               const std::function<double(unsigned int, unsigned int)> &);     \
  template bool is_beside(const std::vector<FractureCell<dim>> &, const std::vector<double> &, \
                          const double, const unsigned int);                                   \
  template double fracture_area(const Tensor<1, dim> &, const double);                         \
  template std::vector<Tensor<1, dim>> jumps(const Zone<dim> &, const FractureCell<dim> &);    \
  template std::vector<Segment<dim>> make_segments(const Zone<dim> &,                          \
                                                   const std::vector<FractureCell<dim>> &);    \
  template bool is_at_front(const Zone<dim> &, const FractureCell<dim> &, const Segment<dim> &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
