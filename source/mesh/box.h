#pragma once

#include <deal.II/base/point.h>

#include <cmath>

namespace stockwork
{
/// Whether a point lies on a side of the box between two corners, to 1e-8 of its diameter.
template <int dim>
bool on_side_of_box(const dealii::Point<dim> &point,
                    const dealii::Point<dim> &lower,
                    const dealii::Point<dim> &upper)
{
  const double tolerance = 1e-8 * lower.distance(upper);
  for (unsigned int d = 0; d < dim; ++d)
    if (std::abs(point[d] - lower[d]) < tolerance || std::abs(point[d] - upper[d]) < tolerance)
      return true;
  return false;
}
} // namespace stockwork
