#include "biot/merged_pores.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/cell_data_transfer.templates.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Evaluates what the content of a cell takes.
template <int dim>
FEValues<dim> content_evaluator(const MeshView<dim> &mesh_view)
{
  const auto &fe = mesh_view.dof_handler.get_fe();
  return FEValues<dim>(mesh_view.mapping, fe, QGauss<dim>(fe.base_element(0).degree + 1),
                       update_values | update_gradients | update_JxW_values);
}
} // namespace


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
  const FEValuesExtractors::Scalar pressure(dim);
  const QTrapezoid<dim> vertices;
  FEValues<dim> at_vertices(mesh_view.mapping, fe, vertices, update_values);
  std::vector<double> p(vertices.size());
  double greatest = 0.;
  // The mean of the parent's corners, and what its middle has: a corner of every child.
  std::vector<std::pair<typename DoFHandler<dim>::cell_iterator, double>> uneven;
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    at_vertices.reinit(cell);
    at_vertices[pressure].get_function_values(values, p);
    for (const double value : p)
      greatest = std::max(greatest, std::abs(value));
    if (!cell->coarsen_flag_set() || cell->parent()->child(0) != cell)
      continue;
    double mean = 0., middle = 0.;
    const unsigned int n = cell->parent()->n_children();
    for (unsigned int c = 0; c < n; ++c)
    {
      at_vertices.reinit(cell->parent()->child(c));
      at_vertices[pressure].get_function_values(values, p);
      mean += p[c] / n;
      middle = p[n - 1 - c];
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
std::vector<double> MergedPores<dim>::contents(const MeshView<dim> &mesh_view,
                                               const BlockVector &values) const
{
  std::vector<double> result(mesh_view.triangulation.n_active_cells());
  FEValues<dim> evaluator = content_evaluator(mesh_view);
  const FEValuesExtractors::Vector displacement(0);
  const FEValuesExtractors::Scalar pressure(dim);
  std::vector<double> p(evaluator.n_quadrature_points), div_u(p.size());
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      evaluator.reinit(cell);
      evaluator[displacement].get_function_divergences(values, div_u);
      evaluator[pressure].get_function_values(values, p);
      const RockProperties here = rock.at(cell->material_id(), cell->center());
      double &content = result[cell->active_cell_index()];
      for (unsigned int q = 0; q < p.size(); ++q)
        content +=
          (here.biot_coefficient * div_u[q] + here.inverse_biot_modulus * p[q]) * evaluator.JxW(q);
    }
  return result;
}


template <int dim>
void MergedPores<dim>::prepare(const Mesh &mesh,
                               const MeshView<dim> &mesh_view,
                               const BlockVector &values)
{
  using Parent = typename Triangulation<dim>::cell_iterator;
  before = contents(mesh_view, values);
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
                              BlockVector &values)
{
  const std::vector<double> of_fields = contents(mesh_view, carried_over),
                            now = contents(mesh_view, conforming);
  before.assign(now.size(), 0.);
  transfer->unpack(before);
  transfer.reset();

  FEValues<dim> evaluator = content_evaluator(mesh_view);
  const FEValuesExtractors::Scalar pressure(dim);
  const unsigned int n_dofs = evaluator.dofs_per_cell;
  std::vector<types::global_dof_index> dofs(n_dofs);
  Vector<double> storage_of_cell(n_dofs), missing_of_cell(n_dofs);
  BlockVector storage = values, missing = values;
  storage = 0.;
  missing = 0.;
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int c = cell->active_cell_index();
      evaluator.reinit(cell);
      const double inverse_biot_modulus =
        rock.at(cell->material_id(), cell->center()).inverse_biot_modulus;
      double all = 0.;
      for (unsigned int i = 0; i < n_dofs; ++i)
      {
        storage_of_cell(i) = 0.;
        for (unsigned int q = 0; q < evaluator.n_quadrature_points; ++q)
          storage_of_cell(i) +=
            inverse_biot_modulus * evaluator[pressure].value(i, q) * evaluator.JxW(q);
        all += storage_of_cell(i);
      }
      missing_of_cell = storage_of_cell;
      missing_of_cell *= ((std::isnan(before[c]) ? of_fields[c] : before[c]) - now[c]) / all;
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
