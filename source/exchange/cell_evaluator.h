#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/fe/fe_values.h>

#include "stockwork/exchange/cell_role.h"
#include "stockwork/exchange/state.h"

#include "exchange/bulk_layout.h"

#include <map>
#include <memory>
#include <vector>

namespace stockwork
{
/// Points of a cell, cut or not, and everything that the unknowns are there. The displacement is a
/// sum of functions of one component each: those of the cell's nodes, and where a crack cuts the
/// cell those that jump in it.
template <int dim>
class CellEvaluator
{
public:
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;

  /// @param quadrature of an ordinary cell; a cut one has its own
  /// @param flags what will be asked for, weights being JxW
  CellEvaluator(const dealii::Mapping<dim> &mapping,
                const dealii::FiniteElement<dim> &fe,
                const dealii::Quadrature<dim> &quadrature,
                dealii::UpdateFlags flags = dealii::update_values | dealii::update_gradients |
                                            dealii::update_quadrature_points |
                                            dealii::update_JxW_values);

  /// @param cut null: an ordinary cell. It is the one that was given for this cell before, until
  /// forget_cuts().
  void reinit(const CellIterator &cell, const CutCell<dim> *cut);

  /// The cuts of cells may have changed: what is kept of them is let go.
  void forget_cuts()
  {
    of_cuts.clear();
  }

  unsigned int n_points() const
  {
    return values->n_quadrature_points;
  }

  const std::vector<dealii::Point<dim>> &unit_points() const
  {
    return values->get_quadrature().get_points();
  }

  const dealii::Point<dim> &point(const unsigned int q) const
  {
    return values->quadrature_point(q);
  }

  /// Its share of the cell's volume.
  double weight(const unsigned int q) const
  {
    return cut_cell != nullptr ? cut_cell->weights[q] : values->JxW(q);
  }

  /// Functions of the displacement: first layout.u of the cell's dofs, then the extra columns.
  unsigned int n_functions() const
  {
    return layout.u.size() + n_extra();
  }

  unsigned int n_extra() const
  {
    return cut_cell != nullptr ? cut_cell->n_columns() : 0;
  }

  unsigned int component(const unsigned int function) const
  {
    return function < layout.u.size() ? function % dim
                                      : cut_cell->component[function - layout.u.size()];
  }

  /// Of the function's one component.
  double value(const unsigned int function, const unsigned int q) const
  {
    return function < layout.u.size()
             ? values->shape_value(layout.u[function], q)
             : cut_cell->values[q * n_extra() + function - layout.u.size()];
  }

  dealii::Tensor<1, dim> gradient(const unsigned int function, const unsigned int q) const
  {
    return function < layout.u.size()
             ? values->shape_grad(layout.u[function], q)
             : cut_cell->gradients[q * n_extra() + function - layout.u.size()];
  }

  dealii::SymmetricTensor<2, dim> strain_of(const unsigned int function, const unsigned int q) const
  {
    dealii::Tensor<2, dim> of_displacement;
    of_displacement[component(function)] = gradient(function, q);
    return symmetrize(of_displacement);
  }

  /// Of pressure node a.
  double pressure_value(const unsigned int a, const unsigned int q) const
  {
    return values->shape_value(layout.p[a], q);
  }

  dealii::Tensor<1, dim> pressure_gradient(const unsigned int a, const unsigned int q) const
  {
    return values->shape_grad(layout.p[a], q);
  }

  /// The cell's dofs, in the order of the element.
  const std::vector<dealii::types::global_dof_index> &dofs() const
  {
    return dof_indices;
  }

  /// Indices of the extra unknowns.
  const std::vector<unsigned int> &extra() const
  {
    return cut_cell != nullptr ? cut_cell->extra : none;
  }

  /// At all points.
  void displacement(const Unknowns &unknowns, std::vector<dealii::Tensor<1, dim>> &result) const;
  /// [i][j] = u_i,j
  void displacement_gradient(const Unknowns &unknowns,
                             std::vector<dealii::Tensor<2, dim>> &result) const;
  void strain(const Unknowns &unknowns, std::vector<dealii::SymmetricTensor<2, dim>> &result) const;
  void pressure(const Unknowns &unknowns, std::vector<double> &result) const;
  void pressure_gradient(const Unknowns &unknowns,
                         std::vector<dealii::Tensor<1, dim>> &result) const;

  const BulkLayout<dim> layout;

private:
  /// Call use(function, its value) for all functions of the displacement.
  template <class Function>
  void for_each_function(const Unknowns &unknowns, const Function &use) const;

  dealii::FEValues<dim> ordinary;
  /// Of cut cells, by active cell index: dear to make, and asked for in every iteration.
  std::map<unsigned int, std::unique_ptr<dealii::FEValues<dim>>> of_cuts;
  const dealii::FEValues<dim> *values = nullptr;
  const CutCell<dim> *cut_cell = nullptr;
  std::vector<dealii::types::global_dof_index> dof_indices;
  const std::vector<unsigned int> none;
};
} // namespace stockwork
