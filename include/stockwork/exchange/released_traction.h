#pragma once

#include <deal.II/base/array_view.h>
#include <deal.II/lac/vector.h>

#include "stockwork/exchange/scene.h"

namespace stockwork
{
/// Faces that part no longer carry what the rock there carried in situ, n.sigma_0: external virtual
/// work -A (sigma_0 n) . [u], with the jump [u], the mean over the faces, from the minus to the
/// plus side. For cracks whose opening is no strain of a law that carries the total stress itself.
/// @param centre, normal, area of the faces, see Segment
/// @param jumps that one of each unknown makes, in the order of the rows of @p residual
template <int dim>
void add_released_traction(const Scene<dim> &scene,
                           const dealii::Point<dim> &centre,
                           const dealii::Tensor<1, dim> &normal,
                           const double area,
                           const dealii::ArrayView<const dealii::Tensor<1, dim>> &jumps,
                           dealii::Vector<double> &residual)
{
  const dealii::Tensor<1, dim> traction = scene.in_situ_stress(centre) * normal;
  for (unsigned int i = 0; i < jumps.size(); ++i)
    residual(i) -= area * (traction * jumps[i]);
}
} // namespace stockwork
