#include "stockwork/exchange/diffuse_crack.h"

#include "stockwork/mesh/key.h"

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork
{
using dealii::Point;
using dealii::Tensor;

template <int dim>
void DiffuseCrack<dim>::begin(const std::vector<InitialCrack<dim>> &cracks,
                              const double new_distance,
                              const double new_reach)
{
  distance = new_distance;
  reach = new_reach;
  places.clear();
  for (const auto &crack : cracks)
    for (unsigned int i = 0; i + 1 < crack.points.size(); ++i)
    {
      const Tensor<1, dim> along = crack.points[i + 1] - crack.points[i];
      const unsigned int n = std::max(1., std::round(along.norm() / distance));
      for (unsigned int k = 0; k < n; ++k)
        places.push_back(crack.points[i] + (k + 0.5) / n * along);
    }
  n_committed = places.size();
}


template <int dim>
void DiffuseCrack<dim>::extend(const std::vector<Point<dim>> &broken,
                               const Triangulation &triangulation,
                               const Collectives &collectives)
{
  // Round-off must not choose between places that are as near as one another.
  constexpr double clearly = 1. - 1e-10;
  std::vector<Point<dim>> all = collectives.gather(broken);
  std::sort(all.begin(), all.end(), // the same on any number of ranks
            [](const Point<dim> &a, const Point<dim> &b)
            {
              unsigned int d = 0;
              while (d + 1 < dim && a[d] == b[d])
                ++d;
              return a[d] < b[d];
            });
  while (true)
  {
    double nearest = std::numeric_limits<double>::infinity();
    Point<dim> next;
    for (const Point<dim> &place : all)
    {
      double away = std::numeric_limits<double>::infinity();
      for (const Point<dim> &station : places)
        away = std::min(away, station.distance(place));
      if (away > 0.999 * distance && away < nearest * clearly)
      {
        nearest = away;
        next = place;
      }
    }
    if (!std::isfinite(nearest))
      break;
    places.push_back(next);
  }

  of_cells.assign(triangulation.n_active_cells(), -1);
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    double nearest = reach;
    for (unsigned int k = 0; k < places.size() && !cell->is_artificial(); ++k)
      if (const double away = places[k].distance(cell->center()); away < nearest * clearly)
      {
        nearest = away;
        of_cells[cell->active_cell_index()] = k;
      }
  }
}


template <int dim>
std::uint64_t DiffuseCrack<dim>::key(const unsigned int station) const
{
  return Key().add(places[station], 1e-6 * distance);
}


/// Stations whose cells have a face in common, no farther than two next to one another.
template <int dim>
std::vector<std::vector<typename Segment<dim>::Neighbour>>
DiffuseCrack<dim>::neighbours(const Triangulation &triangulation,
                              const Collectives &collectives) const
{
  std::vector<std::pair<int, int>> pairs;
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->is_locally_owned() && !cell->at_boundary(f) && cell->neighbor(f)->is_active())
        pairs.push_back(std::minmax(
          {of_cells[cell->active_cell_index()], of_cells[cell->neighbor(f)->active_cell_index()]}));
  pairs = collectives.gather(pairs);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<std::vector<typename Segment<dim>::Neighbour>> result(places.size());
  for (const auto &[a, b] : pairs)
    if (a >= 0 && a != b && places[a].distance(places[b]) < 2. * distance)
    {
      const double half = 0.5 * places[a].distance(places[b]);
      result[a].push_back({key(b), half, 1.});
      result[b].push_back({key(a), half, 1.});
    }
  return result;
}


template <int dim>
void DiffuseCrack<dim>::list_segments(
  const std::vector<Piece> &pieces,
  const Triangulation &triangulation,
  const std::function<double(const Point<dim> &)> &pore_pressure,
  const Collectives &collectives)
{
  constexpr unsigned int n_components = dealii::SymmetricTensor<2, dim>::n_independent_components;
  std::vector<double> sums; // area and across, of each station
  for (const Piece &piece : pieces)
  {
    sums.push_back(piece.area);
    for (unsigned int i = 0; i < n_components; ++i)
      sums.push_back(piece.across.access_raw_entry(i));
  }
  collectives.sum(sums);
  const auto beside = neighbours(triangulation, collectives);
  normals.clear();
  all_segments.clear();
  for (unsigned int k = 0; k < places.size(); ++k)
  {
    const double *const sum = sums.data() + k * (1 + n_components);
    dealii::SymmetricTensor<2, dim> across;
    for (unsigned int i = 0; i < n_components; ++i)
      across.access_raw_entry(i) = sum[1 + i];
    normals.push_back(eigenvectors(across)[0].second);
    if (pieces[k].volume.empty())
      continue;
    Segment<dim> segment;
    segment.key = key(k);
    segment.centre = places[k];
    segment.normal = normals[k];
    segment.area = sum[0];
    segment.neighbours = beside[k];
    for (const auto &[dof, volume] : pieces[k].volume)
    {
      segment.opening.bulk.push_back(dof);
      segment.opening.bulk_coefficients.push_back(volume / segment.area);
    }
    segment.pore_pressure.constant = pieces[k].area / segment.area * pore_pressure(segment.centre);
    all_segments.push_back(std::move(segment));
  }
}


template <int dim>
bool passes(const InitialCrack<dim> &crack, const Point<dim> &centre, const double size)
{
  Tensor<1, dim> aside;
  for (unsigned int d = 0; d < dim; ++d)
    aside[d] = 1e-6 * size;
  for (unsigned int i = 0; i + 1 < crack.points.size(); ++i)
  {
    const Tensor<1, dim> along = crack.points[i + 1] - crack.points[i],
                         off = centre - crack.points[i] - aside;
    const double t = off * along / along.norm_square();
    if (t > 0. && t < 1. && (off - t * along).norm() < 0.5 * size)
      return true;
  }
  return false;
}


template class DiffuseCrack<2>;
template bool passes(const InitialCrack<2> &, const Point<2> &, const double);
} // namespace stockwork
