#include "biot/merged_pores.h"

#include "biot/cell_integrals.h"
#include "exchange/bulk_layout.h"

#include <deal.II/distributed/cell_data_transfer.templates.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace stockwork
{
using namespace dealii;

template <int dim>
bool MergedPores<dim>::can_take_up(const MeshView<dim> &mesh_view) const
{
  bool all = true;
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      all = all && rock(cell->material_id()).inverse_biot_modulus > 0.;
  return Utilities::MPI::min(all ? 1 : 0, mesh_view.triangulation.get_communicator()) == 1;
}


template <int dim>
void MergedPores<dim>::keep_uneven(Mesh &mesh,
                                   const MeshView<dim> &mesh_view,
                                   const BlockVector &values) const
{
  const auto &fe = mesh_view.dof_handler.get_fe();
  const BulkLayout<dim> layout(fe);
  constexpr unsigned int n_vertices = GeometryInfo<dim>::vertices_per_cell;
  Vector<double> dofs(fe.n_dofs_per_cell());
  const auto pressure = [&](const unsigned int vertex) { return dofs(layout.p[vertex]); };
  double greatest = 0.;
  std::vector<std::pair<typename DoFHandler<dim>::cell_iterator, double>> uneven;
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    cell->get_dof_values(values, dofs);
    for (unsigned int v = 0; v < n_vertices; ++v)
      greatest = std::max(greatest, std::abs(pressure(v)));
    if (!cell->coarsen_flag_set() || cell->parent()->child(0) != cell)
      continue;
    // The middle of the parent is the first child's last vertex; each child has one of its corners.
    const double middle = pressure(n_vertices - 1);
    double mean = 0.;
    for (unsigned int c = 0; c < n_vertices; ++c)
    {
      cell->parent()->child(c)->get_dof_values(values, dofs);
      mean += pressure(c) / n_vertices;
    }
    uneven.emplace_back(cell->parent(), std::abs(mean - middle));
  }
  greatest = Utilities::MPI::max(greatest, mesh.get_communicator());
  for (const auto &[parent, difference] : uneven)
    if (difference > 0.01 * greatest)
      for (unsigned int c = 0; c < parent->n_children(); ++c)
        parent->child(c)->clear_coarsen_flag();
}


template <int dim>
double MergedPores<dim>::content(const typename DoFHandler<dim>::active_cell_iterator &cell,
                                 const types::material_id region,
                                 const CellIntegrals<dim> &integrals,
                                 const BlockVector &values) const
{
  const BulkLayout<dim> &layout = integrals.layout;
  Vector<double> dofs(cell->get_fe().n_dofs_per_cell());
  cell->get_dof_values(values, dofs);
  double opening = 0., pressed_in = 0.;
  for (unsigned int a = 0; a < layout.n_p; ++a)
  {
    pressed_in += integrals.pressure_means[a] * dofs(layout.p[a]);
    for (unsigned int b = 0; b < layout.n_u; ++b)
      for (unsigned int i = 0; i < dim; ++i)
        opening += integrals.divergences[(i * layout.n_p + a) * layout.n_u + b] *
                   dofs(layout.u[b * dim + i]);
  }
  const RockProperties here = rock.at(region, cell->center());
  return here.biot_coefficient * opening + here.inverse_biot_modulus * pressed_in;
}


template <int dim>
void MergedPores<dim>::prepare(const Mesh &mesh,
                               const MeshView<dim> &mesh_view,
                               const BlockVector &values)
{
  using Parent = typename Triangulation<dim>::cell_iterator;
  CellIntegrals<dim> integrals(mesh_view.mapping, mesh_view.dof_handler.get_fe());
  before.assign(mesh.n_active_cells(), 0.);
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      integrals.reinit(cell);
      before[cell->active_cell_index()] = content(cell, cell->material_id(), integrals, values);
    }
  transfer =
    std::make_unique<parallel::distributed::CellDataTransfer<dim, dim, std::vector<double>>>(
      mesh, false,
      // A child's content is known from the fields, which are the same in it.
      [](const Parent &parent, const double) {
        return std::vector<double>(parent->n_children(), std::numeric_limits<double>::quiet_NaN());
      },
      [](const Parent &, const std::vector<double> &children)
      { return std::accumulate(children.begin(), children.end(), 0.); });
  transfer->prepare_for_coarsening_and_refinement(before);
}


template <int dim>
void MergedPores<dim>::finish(const MeshView<dim> &mesh_view,
                              const BlockVector &carried_over,
                              const BlockVector &conforming,
                              BlockVector &values,
                              const RegionOf &region_of_parent)
{
  before.assign(mesh_view.triangulation.n_active_cells(), 0.);
  transfer->unpack(before);
  transfer.reset();

  const auto &fe = mesh_view.dof_handler.get_fe();
  CellIntegrals<dim> integrals(mesh_view.mapping, fe);
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  Vector<double> storage_of_cell(dofs.size()), missing_of_cell(dofs.size());
  BlockVector storage = values, missing = values;
  storage = 0.;
  missing = 0.;
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      integrals.reinit(cell);
      double was = before[cell->active_cell_index()];
      if (std::isnan(was)) // of a cell that has been split
        was = content(cell, region_of_parent(cell->parent()), integrals, carried_over);
      const double inverse_biot_modulus =
        rock.at(cell->material_id(), cell->center()).inverse_biot_modulus;
      for (unsigned int a = 0; a < integrals.layout.n_p; ++a)
        storage_of_cell(integrals.layout.p[a]) = inverse_biot_modulus * integrals.pressure_means[a];
      missing_of_cell.equ((was - content(cell, cell->material_id(), integrals, conforming)) /
                            (inverse_biot_modulus * integrals.volume),
                          storage_of_cell);
      cell->get_dof_indices(dofs);
      mesh_view.constraints.distribute_local_to_global(storage_of_cell, dofs, storage);
      mesh_view.constraints.distribute_local_to_global(missing_of_cell, dofs, missing);
    }
  storage.compress(VectorOperation::add);
  missing.compress(VectorOperation::add);
  for (const auto i : values.block(1).locally_owned_elements())
    if (const double here = storage.block(1)(i); here > 0.)
      values.block(1)(i) += missing.block(1)(i) / here;
  values.compress(VectorOperation::add);
  before.clear();
}


template class MergedPores<2>;
template class MergedPores<3>;
} // namespace stockwork
