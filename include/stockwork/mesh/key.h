#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/cell_id.h>

#include "stockwork/base/scrambled.h"

#include <cmath>
#include <cstdint>

namespace stockwork
{
/// A number by which a thing is recognised on every rank, on every mesh and after a restart. Made
/// of what the thing is (its place, its cell), never of an index. Keys are not in any order;
/// two things have the same key by accident with a probability of n^2/4e19 among n things.
///
///   const std::uint64_t key = Key().add(cell->id()).add(edge);
class Key
{
public:
  /// Mix in a number.
  Key &add(const std::uint64_t number)
  {
    state = scrambled(state + scrambling_step + number);
    return *this;
  }

  /// Mix in a place, rounded to multiples of @p resolution [m]. Let it be well below the distance
  /// of different things and well above the round-off of equal ones, e.g. 1e-6 of the cell size:
  /// a coordinate midway between two multiples is rounded up, round-off and all.
  template <int dim>
  Key &add(const dealii::Point<dim> &place, const double resolution)
  {
    // A third of a multiple of offset: mesh lines tend to lie at halves, quarters and so on.
    for (unsigned int d = 0; d < dim; ++d)
      add(static_cast<std::uint64_t>(
        static_cast<std::int64_t>(std::floor(place[d] / resolution + 1. / 3.))));
    return *this;
  }

  /// Mix in a cell.
  Key &add(const dealii::CellId &cell)
  {
    add(cell.get_coarse_cell_id());
    for (const std::uint8_t child : cell.get_child_indices())
      add(child);
    return add(0xffull); // a cell is not its first child
  }

  operator std::uint64_t() const
  {
    return state;
  }

private:
  std::uint64_t state = 0;
};
} // namespace stockwork
