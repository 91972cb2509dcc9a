#include "biot/bulk_assembly.h"

#include "base/ghost_values.h"
#include "biot/prescribed_part.h"
#include "biot/row_writer.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <numeric>

namespace stockwork
{
using namespace dealii;

namespace
{
using BlockVector = TrilinosWrappers::MPI::BlockVector;

/// The owned entries of a vector with ghost values.
BlockVector owned_part(const BlockVector &ghosted, const std::vector<IndexSet> &owned)
{
  BlockVector result;
  result.reinit(owned, ghosted.block(0).get_mpi_communicator());
  copy_owned(result, ghosted);
  return result;
}
} // namespace


template <int dim>
BulkAssembly<dim>::BulkAssembly(const Rock &rock,
                                const Loads<dim> &loads,
                                const PressureStabilisation stabilisation,
                                const MeshView<dim> mesh_view,
                                const Role &role)
  : rock(rock)
  , loads(loads)
  , mesh_view(mesh_view)
  , matrices(mesh_view.mapping, mesh_view.dof_handler.get_fe(), rock, stabilisation, role)
  , cut_evaluator(mesh_view.mapping, mesh_view.dof_handler.get_fe(), QMidpoint<dim>())
  , face_values(mesh_view.mapping,
                mesh_view.dof_handler.get_fe(),
                QGauss<dim - 1>(mesh_view.dof_handler.get_fe().base_element(0).degree + 1),
                update_values | update_quadrature_points | update_normal_vectors |
                  update_JxW_values)
{
  set_up();
}


template <int dim>
void BulkAssembly<dim>::set_up()
{
  const auto &dof_handler = mesh_view.dof_handler;
  const auto &constraints = mesh_view.constraints;
  const auto &layout = matrices.layout();

  std::vector<unsigned int> blocks(dof_handler.get_fe().n_components(), 0);
  if (layout.n_p > 0)
    blocks[dim] = 1;
  const auto sizes = DoFTools::count_dofs_per_fe_block(dof_handler, blocks);
  IndexSet all_relevant;
  DoFTools::extract_locally_relevant_dofs(dof_handler, all_relevant);
  owned = dof_handler.locally_owned_dofs().split_by_block(sizes);
  relevant = all_relevant.split_by_block(sizes);
  types::global_dof_index offset = 0;
  for (unsigned int b = 0; b < owned.size(); offset += sizes[b], ++b)
  {
    constrained.emplace_back();
    int local = 0;
    for (const auto i : owned[b])
    {
      if (constraints.is_constrained(offset + i))
        constrained[b].push_back(local);
      ++local;
    }
  }

  if (layout.n_p > 0)
  {
    const types::global_dof_index first = sizes[0];
    pressure_constraints.reinit(relevant[1]);
    for (const auto &line : constraints.get_lines())
      if (line.index >= first && relevant[1].is_element(line.index - first))
      {
        pressure_constraints.add_line(line.index - first);
        for (const auto &[master, weight] : line.entries)
          pressure_constraints.add_entry(line.index - first, master - first, weight);
      }
    pressure_constraints.close();
  }

  std::vector<types::global_dof_index> dofs(dof_handler.get_fe().n_dofs_per_cell());
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(dofs);
      const auto constrained = [&](const auto i) { return constraints.is_constrained(i); };
      if ((!loads.empty() && cell->at_boundary()) ||
          std::any_of(dofs.begin(), dofs.end(), constrained))
        edge_cells.push_back(cell);
      if (std::any_of(layout.p.begin(), layout.p.end(),
                      [&](const unsigned int i)
                      { return prescribed_share(mesh_view.constraints, dofs[i]) > 0.; }))
        drained_cells.push_back(cell);
    }
}


template <int dim>
void BulkAssembly<dim>::visit_cells(const StepContext &context,
                                    TrilinosWrappers::BlockSparseMatrix &matrix,
                                    TrilinosWrappers::SparseMatrix *fixed_stress_mass)
{
  const auto &fe = mesh_view.dof_handler.get_fe();
  const auto &layout = matrices.layout();
  const unsigned int n_p = layout.n_p;
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell()),
    displacement_dofs(layout.u.size()), pressure_dofs(n_p);
  std::vector<unsigned int> pressure_nodes(n_p);
  std::iota(pressure_nodes.begin(), pressure_nodes.end(), 0u);
  RowWriter writer, pressure_writer;
  matrix = 0.;
  if (n_p > 0)
  {
    storage.reinit(matrix.block(1, 1));
    diffusion.reinit(matrix.block(1, 1));
    storage = 0.;
    diffusion = 0.;
    if (fixed_stress_mass != nullptr)
      *fixed_stress_mass = 0.;
    content.reinit(owned, relevant, matrix.block(0, 0).get_mpi_communicator(), true);
  }
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      matrices.reinit(cell, context);
      cell->get_dof_indices(dofs);
      for (unsigned int k = 0; k < layout.u.size(); ++k)
        displacement_dofs[k] = dofs[layout.u[k]];
      for (unsigned int a = 0; a < n_p; ++a)
        pressure_dofs[a] = dofs[layout.p[a]] - owned[0].size();

      const bool in_place =
        std::none_of(dofs.begin(), dofs.end(),
                     [&](const auto i) { return mesh_view.constraints.is_constrained(i); }) &&
        writer.reinit(matrix.block(0, 0), displacement_dofs, displacement_dofs) &&
        (n_p == 0 || pressure_writer.reinit(storage, pressure_dofs, pressure_dofs));
      if (in_place)
      {
        writer.add(matrices.whole, layout.u, layout.u, matrix.block(0, 0));
        if (n_p == 0)
          continue;
        writer.reinit(matrix.block(0, 1), displacement_dofs, pressure_dofs);
        writer.add(matrices.whole, layout.u, layout.p, matrix.block(0, 1));
        writer.reinit(matrix.block(1, 0), pressure_dofs, displacement_dofs);
        writer.add(matrices.whole, layout.p, layout.u, matrix.block(1, 0));
        pressure_writer.add(matrices.storage, pressure_nodes, pressure_nodes, storage);
        pressure_writer.add(matrices.diffusion, pressure_nodes, pressure_nodes, diffusion);
        if (fixed_stress_mass != nullptr)
          pressure_writer.add(matrices.fixed_stress, pressure_nodes, pressure_nodes,
                              *fixed_stress_mass);
      }
      else
      {
        mesh_view.constraints.distribute_local_to_global(matrices.whole, dofs, matrix);
        if (n_p == 0)
          continue;
        pressure_constraints.distribute_local_to_global(matrices.storage, pressure_dofs, storage);
        pressure_constraints.distribute_local_to_global(matrices.diffusion, pressure_dofs,
                                                        diffusion);
        if (fixed_stress_mass != nullptr)
          pressure_constraints.distribute_local_to_global(matrices.fixed_stress, pressure_dofs,
                                                          *fixed_stress_mass);
      }
      content.add(dofs, matrices.content);
    }
  matrix.compress(VectorOperation::add);
  if (n_p > 0)
  {
    storage.compress(VectorOperation::add);
    diffusion.compress(VectorOperation::add);
    content.compress(VectorOperation::add);
    if (fixed_stress_mass != nullptr)
      fixed_stress_mass->compress(VectorOperation::add);
  }
}


template <int dim>
bool BulkAssembly<dim>::matrix(const StepContext &context,
                               const bool anew,
                               TrilinosWrappers::BlockSparseMatrix &matrix,
                               TrilinosWrappers::SparseMatrix *fixed_stress_mass)
{
  const bool visits_cells = anew || context.acceleration != acceleration;
  if (visits_cells)
  {
    visit_cells(context, matrix, fixed_stress_mass);
    acceleration = context.acceleration;
  }
  if (matrices.layout().n_p > 0)
  {
    auto &pressure = matrix.block(1, 1);
    pressure = 0.;
    pressure.add(-context.pressure_rate / context.rate, storage);
    pressure.add(-context.effective_dt(), diffusion);
  }
  return visits_cells;
}


template <int dim>
void BulkAssembly<dim>::undrained_term(TrilinosWrappers::SparseMatrix &matrix) const
{
  const auto &fe = mesh_view.dof_handler.get_fe();
  CellIntegrals<dim> integrals(mesh_view.mapping, fe);
  const auto &layout = integrals.layout;
  const unsigned int n_u = layout.n_u, n = n_u * dim;
  FullMatrix<double> local(n);
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell()), displacement_dofs(n);
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const RockProperties &properties = rock(cell->material_id());
      const double stiffening =
        properties.biot_coefficient * properties.biot_coefficient / properties.inverse_biot_modulus;
      integrals.reinit(cell);
      cell->get_dof_indices(dofs);
      for (unsigned int k = 0; k < n; ++k)
        displacement_dofs[k] = dofs[layout.u[k]];
      for (unsigned int a = 0; a < n_u; ++a)
        for (unsigned int b = 0; b < n_u; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              local(a * dim + i, b * dim + j) =
                stiffening * integrals.gradients[((i * dim + j) * n_u + a) * n_u + b];
      mesh_view.constraints.distribute_local_to_global(local, displacement_dofs, matrix);
    }
  matrix.compress(VectorOperation::add);
}


template <int dim>
void BulkAssembly<dim>::subtract_history(const StepContext &context,
                                         const LocalVector &rate_reference,
                                         LocalVector &residual) const
{
  const auto &layout = matrices.layout();
  for (unsigned int a = 0; a < layout.n_p; ++a)
  {
    double history = 0.;
    for (const unsigned int i : layout.u)
      history += matrices.whole(layout.p[a], i) * rate_reference(i);
    for (unsigned int b = 0; b < layout.n_p; ++b)
      history -=
        context.pressure_rate / context.rate * matrices.storage(a, b) * rate_reference(layout.p[b]);
    residual(layout.p[a]) -= history;
  }
}


template <int dim>
void BulkAssembly<dim>::subtract_loads(const StepContext &context,
                                       const CellIterator &cell,
                                       LocalVector &residual) const
{
  const auto &layout = matrices.layout();
  for (const unsigned int f : cell->face_indices())
    if (cell->face(f)->at_boundary())
    {
      const auto id = cell->face(f)->boundary_id();
      const auto traction = loads.traction.find(id);
      const auto normal = loads.normal_traction.find(id);
      const auto flux = loads.flux.find(id);
      if (traction == loads.traction.end() && normal == loads.normal_traction.end() &&
          (flux == loads.flux.end() || layout.n_p == 0))
        continue;
      face_values.reinit(cell, f);
      for (const unsigned int q : face_values.quadrature_point_indices())
      {
        const Point<dim> &x = face_values.quadrature_point(q);
        Tensor<1, dim> t;
        if (traction != loads.traction.end())
          for (unsigned int d = 0; d < dim; ++d)
            t[d] += traction->second[d].value(x, context.time);
        if (normal != loads.normal_traction.end())
          t += normal->second.value(x, context.time) * face_values.normal_vector(q);
        for (unsigned int a = 0; a < layout.n_u; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            residual(layout.u[a * dim + d]) -=
              t[d] * face_values.shape_value(layout.u[a * dim + d], q) * face_values.JxW(q);
        if (layout.n_p > 0 && flux != loads.flux.end())
        {
          const double volume =
            context.effective_dt() * flux->second.value(x, context.time) * face_values.JxW(q);
          for (unsigned int a = 0; a < layout.n_p; ++a)
            residual(layout.p[a]) += volume * face_values.shape_value(layout.p[a], q);
        }
      }
    }
}

template <int dim>
void BulkAssembly<dim>::add_inertia(const StepContext &context,
                                    const State &state,
                                    BlockVector &residual) const
{
  const auto &layout = matrices.layout();
  std::vector<types::global_dof_index> dofs(mesh_view.dof_handler.get_fe().n_dofs_per_cell());
  Vector<double> local(dofs.size()), reference(dofs.size());
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      matrices.reinit(cell, context);
      cell->get_dof_indices(dofs);
      for (const unsigned int i : layout.u)
        reference(i) = state.acceleration_reference.bulk(dofs[i]);
      local = 0.;
      const double inertia = context.acceleration * matrices.properties().density;
      for (unsigned int a = 0; a < layout.n_u; ++a)
        for (unsigned int b = 0; b < layout.n_u; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            local(layout.u[a * dim + i]) -=
              inertia * matrices.mass(a, b) * reference(layout.u[b * dim + i]);
      mesh_view.constraints.distribute_local_to_global(local, dofs, residual);
    }
}


template <int dim>
void BulkAssembly<dim>::residual(const StepContext &context,
                                 const State &state,
                                 const TrilinosWrappers::BlockSparseMatrix *const matrix,
                                 BlockVector &residual) const
{
  const auto &layout = matrices.layout();

  // What the free dofs do to one another. The matrix knows neither rows nor columns of constrained
  // ones, apart from their diagonal.
  if (matrix == nullptr)
    residual = 0.;
  else
  {
    BlockVector x = owned_part(state.current.bulk, owned);
    matrix->block(0, 0).vmult(residual.block(0), x.block(0));
    if (layout.n_p > 0)
    {
      const BlockVector reference = owned_part(state.rate_reference.bulk, owned);
      matrix->block(0, 1).vmult_add(residual.block(0), x.block(1));
      x.block(0) -= reference.block(0);
      matrix->block(1, 0).vmult(residual.block(1), x.block(0));
      matrix->block(1, 1).vmult_add(residual.block(1), x.block(1));
      storage.vmult(x.block(1), reference.block(1));
      residual.block(1).add(context.pressure_rate / context.rate, x.block(1));
    }
    for (unsigned int b = 0; b < residual.n_blocks(); ++b)
      for (const int i : constrained[b])
        residual.block(b).trilinos_vector()[0][i] = 0.;
  }

  // What prescribed values and loads do to them.
  std::vector<types::global_dof_index> dofs(mesh_view.dof_handler.get_fe().n_dofs_per_cell());
  Vector<double> local(dofs.size()), x(dofs.size()), reference(dofs.size());
  for (const CellIterator &cell : edge_cells)
  {
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      x(i) = prescribed_part(mesh_view.constraints, dofs[i], state.current.bulk);
      reference(i) = layout.n_p > 0
                       ? prescribed_part(mesh_view.constraints, dofs[i], state.rate_reference.bulk)
                       : 0.;
    }
    local = 0.;
    if (!x.all_zero() || !reference.all_zero())
    {
      matrices.reinit(cell, context);
      matrices.whole.vmult(local, x);
      subtract_history(context, reference, local);
    }
    subtract_loads(context, cell, local);
    mesh_view.constraints.distribute_local_to_global(local, dofs, residual);
  }
  if (context.acceleration > 0.)
    add_inertia(context, state, residual);
  residual.compress(VectorOperation::add);
}


template <int dim>
double BulkAssembly<dim>::stored_fluid(const StepContext &context,
                                       const State &state,
                                       const Role &role) const
{
  BlockVector gain = owned_part(state.current.bulk, owned);
  gain -= owned_part(state.rate_reference.bulk, owned);
  if (gain.n_blocks() > 1)
    gain.block(1) *= context.pressure_rate / context.rate;
  std::vector<double> extra = state.current.extra;
  for (unsigned int k = 0; k < extra.size(); ++k)
    extra[k] -= state.rate_reference.extra[k];
  return fluid_content(gain, extra, role);
}


template <int dim>
double BulkAssembly<dim>::pore_volume(const Unknowns &unknowns, const Role &role) const
{
  return fluid_content(owned_part(unknowns.bulk, owned), unknowns.extra, role);
}


template <int dim>
double BulkAssembly<dim>::fluid_content(const BlockVector &bulk,
                                        const std::vector<double> &extra,
                                        const Role &role) const
{
  const auto &layout = matrices.layout();
  double volume = 0.;
  for (unsigned int b = 0; b < bulk.n_blocks(); ++b)
  {
    const auto &values = bulk.block(b).trilinos_vector();
    const double *per_unknown = content.block(b).trilinos_vector()[0];
    for (int i = 0; i < values.MyLength(); ++i)
      volume += per_unknown[i] * values[0][i];
  }
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const CutCell<dim> *cut = role(cell).cut;
      if (cut == nullptr)
        continue;
      cut_evaluator.reinit(cell, cut);
      const unsigned int n_ordinary = layout.u.size();
      for (unsigned int q = 0; q < cut_evaluator.n_points(); ++q)
        for (unsigned int c = 0; c < cut_evaluator.n_extra(); ++c)
          volume += rock(cell->material_id()).biot_coefficient * cut_evaluator.weight(q) *
                    trace(cut_evaluator.strain_of(n_ordinary + c, q)) *
                    extra[cut_evaluator.extra()[c]];
    }
  return volume;
}


template <int dim>
typename BulkAssembly<dim>::BoundaryFlow BulkAssembly<dim>::outflow(const StepContext &context,
                                                                    const State &state) const
{
  const auto &layout = matrices.layout();
  std::vector<types::global_dof_index> dofs(mesh_view.dof_handler.get_fe().n_dofs_per_cell());
  Vector<double> local(dofs.size()), x(dofs.size()), reference(dofs.size());
  BoundaryFlow flow;
  const auto add = [&flow](const double volume)
  {
    flow.out += volume;
    flow.through += std::abs(volume);
  };
  for (const CellIterator &cell : drained_cells)
  {
    matrices.reinit(cell, context);
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      x(i) = state.current.bulk(dofs[i]);
      reference(i) = state.rate_reference.bulk(dofs[i]);
    }
    matrices.whole.vmult(local, x);
    subtract_history(context, reference, local);
    subtract_loads(context, cell, local);
    for (const unsigned int i : layout.p)
      add(prescribed_share(mesh_view.constraints, dofs[i]) * local(i));
  }
  if (!loads.flux.empty())
  {
    const auto &fe = mesh_view.dof_handler.get_fe();
    FEFaceValues<dim> face_values(mesh_view.mapping, fe,
                                  QGauss<dim - 1>(fe.base_element(0).degree + 1),
                                  update_quadrature_points | update_JxW_values);
    for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
          {
            const auto flux = loads.flux.find(cell->face(f)->boundary_id());
            if (flux == loads.flux.end())
              continue;
            face_values.reinit(cell, f);
            for (const unsigned int q : face_values.quadrature_point_indices())
              add(-context.effective_dt() * face_values.JxW(q) *
                  flux->second.value(face_values.quadrature_point(q), context.time));
          }
  }
  return flow;
}


template class BulkAssembly<2>;
template class BulkAssembly<3>;
} // namespace stockwork
