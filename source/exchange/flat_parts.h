#pragma once

#include "stockwork/exchange/scene.h"

#include <utility>
#include <vector>

namespace stockwork
{
/// Middles and unit normals of the flat parts of a crack: a disc, or the pieces of a polyline that
/// have a length.
template <int dim>
std::vector<std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>>
flat_parts(const InitialCrack<dim> &crack)
{
  std::vector<std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>> parts;
  if (crack.disc)
    parts.emplace_back(crack.disc->centre, crack.disc->normal);
  if constexpr (dim == 2)
    for (unsigned int i = 0; i + 1 < crack.points.size(); ++i)
      if (const dealii::Tensor<1, dim> along = crack.points[i + 1] - crack.points[i];
          along.norm() > 0.)
        parts.emplace_back(crack.points[i] + 0.5 * along, cross_product_2d(along) / along.norm());
  return parts;
}
} // namespace stockwork
