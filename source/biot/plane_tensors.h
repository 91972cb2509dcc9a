#pragma once

#include <deal.II/base/symmetric_tensor.h>

namespace stockwork
{
/// A tensor of the run's dimensions in three: in two, nothing across the plane.
template <int dim>
dealii::SymmetricTensor<2, 3> in_space(const dealii::SymmetricTensor<2, dim> &t)
{
  dealii::SymmetricTensor<2, 3> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result[i][j] = t[i][j];
  return result;
}

/// What of a tensor lies in the dimensions of the run.
template <int dim>
dealii::SymmetricTensor<2, dim> in_plane(const dealii::SymmetricTensor<2, 3> &t)
{
  dealii::SymmetricTensor<2, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result[i][j] = t[i][j];
  return result;
}

template <int dim>
dealii::SymmetricTensor<4, dim> in_plane(const dealii::SymmetricTensor<4, 3> &t)
{
  dealii::SymmetricTensor<4, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int l = k; l < dim; ++l)
          result[i][j][k][l] = t[i][j][k][l];
  return result;
}
} // namespace stockwork
