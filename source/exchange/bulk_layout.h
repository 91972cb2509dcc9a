#pragma once

#include <deal.II/fe/fe.h>

#include <vector>

namespace stockwork
{
/// Local numbering of the bulk element: displacement nodes a = 0 … n_u-1 with dim components each,
/// pressure nodes 0 … n_p-1.
template <int dim>
struct BulkLayout
{
  explicit BulkLayout(const dealii::FiniteElement<dim> &fe);

  unsigned int n_u;
  unsigned int n_p;            ///< zero without pore pressure
  std::vector<unsigned int> u; ///< [a * dim + component] -> dof of the cell
  std::vector<unsigned int> p; ///< [a] -> dof of the cell
};
} // namespace stockwork
