#include "exchange/cell_evaluator.h"

namespace stockwork
{
using namespace dealii;

template <int dim>
CellEvaluator<dim>::CellEvaluator(const Mapping<dim> &mapping,
                                  const FiniteElement<dim> &fe,
                                  const Quadrature<dim> &quadrature,
                                  const UpdateFlags flags)
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
    of_cut =
      std::make_unique<FEValues<dim>>(ordinary.get_mapping(), ordinary.get_fe(),
                                      Quadrature<dim>(cut->points), ordinary.get_update_flags());
    of_cut->reinit(cell);
  }
  values = of_cut.get();
}


template <int dim>
template <class Function>
void CellEvaluator<dim>::for_each_function(const Unknowns &unknowns, const Function &use) const
{
  const unsigned int n_ordinary = layout.u.size();
  for (unsigned int k = 0; k < n_functions(); ++k)
    use(k, k < n_ordinary ? double(unknowns.bulk(dof_indices[layout.u[k]]))
                          : unknowns.extra[cut_cell->extra[k - n_ordinary]]);
}


template <int dim>
void CellEvaluator<dim>::displacement(const Unknowns &unknowns,
                                      std::vector<Tensor<1, dim>> &result) const
{
  result.assign(n_points(), Tensor<1, dim>());
  for_each_function(unknowns,
                    [&](const unsigned int k, const double factor)
                    {
                      for (unsigned int q = 0; q < n_points(); ++q)
                        result[q][component(k)] += factor * value(k, q);
                    });
}


template <int dim>
void CellEvaluator<dim>::displacement_gradient(const Unknowns &unknowns,
                                               std::vector<Tensor<2, dim>> &result) const
{
  result.assign(n_points(), Tensor<2, dim>());
  for_each_function(unknowns,
                    [&](const unsigned int k, const double factor)
                    {
                      for (unsigned int q = 0; q < n_points(); ++q)
                        result[q][component(k)] += factor * gradient(k, q);
                    });
}


template <int dim>
void CellEvaluator<dim>::strain(const Unknowns &unknowns,
                                std::vector<SymmetricTensor<2, dim>> &result) const
{
  std::vector<Tensor<2, dim>> gradients;
  displacement_gradient(unknowns, gradients);
  result.resize(n_points());
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
