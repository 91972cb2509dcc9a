#include "exchange/bulk_layout.h"

namespace stockwork
{
using namespace dealii;

template <int dim>
BulkLayout<dim>::BulkLayout(const FiniteElement<dim> &fe)
{
  n_u = fe.base_element(0).n_dofs_per_cell();
  n_p = fe.n_components() > dim ? fe.base_element(1).n_dofs_per_cell() : 0;
  u.resize(n_u * dim);
  p.resize(n_p);
  for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
  {
    const auto [component, node] = fe.system_to_component_index(i);
    if (component < dim)
      u[node * dim + component] = i;
    else
      p[node] = i;
  }
}


template struct BulkLayout<2>;
template struct BulkLayout<3>;
} // namespace stockwork
