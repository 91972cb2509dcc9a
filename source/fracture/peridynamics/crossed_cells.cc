#include "fracture/peridynamics/crossed_cells.h"

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
using dealii::Tensor;


template <int dim>
void CrossedCells<dim>::reinit(const Zone<dim> &zone,
                               const std::vector<StencilBond<dim>> &stencil,
                               const std::vector<FractureCell<dim>> &cells,
                               const unsigned int horizon)
{
  this->zone = &zone;
  this->stencil = stencil;
  if (this->horizon != horizon)
  {
    this->horizon = horizon;
    find_nearby();
  }
  cells_at.clear();
  for (unsigned int i = 0; i < cells.size(); ++i)
    zone.for_each_image(cells[i].place, 2 * horizon + 2,
                        [&](const Place<dim> &place, const unsigned int mirrored)
                        {
                          Image image{i, cells[i].normal};
                          for (unsigned int d = 0; d < dim; ++d)
                            if (mirrored >> d & 1)
                              image.normal[d] = -image.normal[d];
                          cells_at.emplace(place, image);
                        });
}


template <int dim>
void CrossedCells<dim>::find_nearby()
{
  double longest = 0.;
  for (const StencilBond<dim> &bond : stencil)
    longest = std::max(longest, bond.length());
  // A bond may cross a plane at its end.
  const double farthest = horizon + 1. + 0.5 * longest;
  const int reach = static_cast<int>(std::ceil(farthest));
  unsigned int n_places = 1;
  for (unsigned int d = 0; d < dim; ++d)
    n_places *= 2 * reach + 1;
  for (unsigned int halves = 0; halves < nearby.size(); ++halves)
  {
    nearby[halves].clear();
    for (unsigned int k = 0; k < n_places; ++k)
    {
      Nearby cell;
      Tensor<1, dim> away;
      for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= 2 * reach + 1)
      {
        cell.offset[d] = static_cast<int>(rest % (2 * reach + 1)) - reach;
        away[d] = cell.offset[d] + 0.5 - (halves >> d & 1 ? 0.5 : 0.);
      }
      cell.distance = away.norm();
      if (cell.distance <= farthest + same_place)
        nearby[halves].push_back(cell);
    }
    std::stable_sort(nearby[halves].begin(), nearby[halves].end(),
                     [](const Nearby &a, const Nearby &b) { return a.distance < b.distance; });
  }
}


template <int dim>
CellShares
CrossedCells<dim>::of(const unsigned int site, const unsigned int bond, const bool always) const
{
  CellShares nearest_cells;
  if (cells_at.empty())
    return nearest_cells;
  Tensor<1, dim> half, middle; // in spacings
  Place<dim> lowest;
  unsigned int halves = 0;
  for (unsigned int d = 0; d < dim; ++d)
  {
    half[d] = 0.5 * stencil[bond].offset[d];
    middle[d] = zone->sites()[site].place[d] + half[d];
    lowest[d] = static_cast<int>(std::floor(middle[d]));
    halves |= (middle[d] > lowest[d] ? 1u : 0u) << d;
  }

  const auto find = [&](const bool crossing)
  {
    double nearest = horizon + 1.;
    const auto consider = [&](const Place<dim> &place, const Image &image)
    {
      Tensor<1, dim> away = middle;
      for (unsigned int d = 0; d < dim; ++d)
        away[d] -= place[d] + 0.5;
      if (crossing)
      {
        const double here = away * image.normal, along = half * image.normal;
        if (std::abs(here) > std::abs(along) - same_place)
          return; // it does not cross this plane
        away -= here / along * half;
      }
      const double distance = away.norm();
      if (distance > nearest + same_place)
        return;
      if (distance < nearest - same_place)
      {
        nearest_cells.clear();
        nearest = distance;
      }
      // A cell and its image at a plane of symmetry are one.
      for (auto &[cell, number] : nearest_cells)
        if (cell == image.cell)
        {
          number += 1.;
          return;
        }
      if (nearest_cells.size() < nearest_cells.capacity())
        nearest_cells.emplace_back(image.cell, 1.);
    };
    // Where a bond crosses a plane is no farther from its middle than its ends.
    const double from_middle = crossing ? half.norm() : 0.;
    for (const Nearby &cell : nearby[halves])
    {
      if (cell.distance - from_middle > nearest + same_place)
        break;
      Place<dim> place = lowest;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] += cell.offset[d];
      if (const auto found = cells_at.find(place); found != cells_at.end())
        consider(place, found->second);
    }
  };
  find(true);
  if (nearest_cells.empty() && always)
    find(false);
  double sum = 0.;
  for (const auto &share : nearest_cells)
    sum += share.second;
  for (auto &share : nearest_cells)
    share.second /= sum;
  return nearest_cells;
}

template class CrossedCells<2>;
template class CrossedCells<3>;
} // namespace stockwork::peridynamics
