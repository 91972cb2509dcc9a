#include "biot/cell_evaluator.h"

namespace stockwork
{
using namespace dealii;

namespace
{
const UpdateFlags flags =
  update_values | update_gradients | update_quadrature_points | update_JxW_values;
}


template <int dim>
CellEvaluator<dim>::CellEvaluator(const Mapping<dim> &mapping,
                                  const FiniteElement<dim> &fe,
                                  const Quadrature<dim> &quadrature)
  : layout(fe)
  , ordinary(mapping, fe, quadrature, flags)
  , dof_indices(fe.n_dofs_per_cell())
{
}


template <int dim>
void CellEvaluator<dim>::reinit(const CellIterator &cell, const CutCell<dim> *cut)
{
  cut_cell = cut;
  cell->get_dof_indices(dof_indices);
  if (cut == nullptr)
  {
    ordinary.reinit(cell);
    values = &ordinary;
    return;
  }
  auto &of_cut = of_cuts[cell->active_cell_index()];
  if (!of_cut)
  {
    of_cut = std::make_unique<FEValues<dim>>(ordinary.get_mapping(), ordinary.get_fe(),
                                             Quadrature<dim>(cut->points), flags);
    of_cut->reinit(cell);
  }
  values = of_cut.get();
}


template <int dim>
void CellEvaluator<dim>::strain(const Unknowns &unknowns,
                                std::vector<SymmetricTensor<2, dim>> &result) const
{
  result.resize(n_points());
  std::vector<Tensor<2, dim>> gradients(n_points());
  for (unsigned int k = 0; k < n_functions(); ++k)
  {
    const double value = k < layout.u.size() ? unknowns.bulk(dof_indices[layout.u[k]])
                                             : unknowns.extra[cut_cell->extra[k - layout.u.size()]];
    for (unsigned int q = 0; q < n_points(); ++q)
      gradients[q][component(k)] += value * gradient(k, q);
  }
  for (unsigned int q = 0; q < n_points(); ++q)
    result[q] = symmetrize(gradients[q]);
}


template <int dim>
void CellEvaluator<dim>::pressure(const Unknowns &unknowns, std::vector<double> &result) const
{
  result.assign(n_points(), 0.);
  for (unsigned int a = 0; a < layout.n_p; ++a)
  {
    const double value = unknowns.bulk(dof_indices[layout.p[a]]);
    for (unsigned int q = 0; q < n_points(); ++q)
      result[q] += value * pressure_value(a, q);
  }
}


template <int dim>
void CellEvaluator<dim>::pressure_gradient(const Unknowns &unknowns,
                                           std::vector<Tensor<1, dim>> &result) const
{
  result.assign(n_points(), Tensor<1, dim>());
  for (unsigned int a = 0; a < layout.n_p; ++a)
  {
    const double value = unknowns.bulk(dof_indices[layout.p[a]]);
    for (unsigned int q = 0; q < n_points(); ++q)
      result[q] += value * pressure_gradient(a, q);
  }
}


template class CellEvaluator<2>;
template class CellEvaluator<3>;
} // namespace stockwork
