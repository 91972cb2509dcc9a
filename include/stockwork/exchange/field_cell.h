#pragma once

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include "stockwork/mesh/mesh_view.h"
#include "stockwork/mesh/nodal_fields.h"

#include <vector>

namespace stockwork
{
/// A cell with both kinds of functions at the same points, those of the bulk and those of a model's
/// nodal fields: for terms in which both stand.
template <int dim>
struct FieldCell
{
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;
  using Dofs = std::vector<dealii::types::global_dof_index>;

  FieldCell(const MeshView<dim> &mesh, const NodalFields<dim> &fields)
    : bulk(mesh.mapping,
           mesh.dof_handler.get_fe(),
           dealii::QGauss<dim>(mesh.dof_handler.get_fe().degree + 1),
           dealii::update_values | dealii::update_gradients | dealii::update_JxW_values |
             dealii::update_quadrature_points)
    , own(mesh.mapping,
          fields.dof_handler().get_fe(),
          bulk.get_quadrature(),
          dealii::update_values | dealii::update_gradients)
    , displacement(bulk[dealii::FEValuesExtractors::Vector(0)])
    , bulk_dofs(bulk.dofs_per_cell)
    , own_dofs(own.dofs_per_cell)
    , fields(fields)
  {
  }

  /// Find the unknowns of a cell that this rank owns.
  /// @param of_bulk one of the bulk's DoFHandler
  void find(const CellIterator &of_bulk)
  {
    cell = of_bulk;
    twin =
      CellIterator(&cell->get_triangulation(), cell->level(), cell->index(), &fields.dof_handler());
    cell->get_dof_indices(bulk_dofs);
    twin->get_dof_indices(own_dofs);
  }

  /// And the functions at its points.
  void evaluate()
  {
    bulk.reinit(cell);
    own.reinit(twin);
  }

  CellIterator cell;
  dealii::FEValues<dim> bulk, own;
  const dealii::FEValuesViews::Vector<dim> &displacement; ///< that of `bulk`
  Dofs bulk_dofs, own_dofs;

private:
  const NodalFields<dim> &fields;
  CellIterator twin; ///< among the fields' cells
};
} // namespace stockwork
