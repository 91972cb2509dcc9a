#include "biot/bulk_assembly.h"

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace stockwork
{
using namespace dealii;

namespace
{
using Dofs = std::vector<types::global_dof_index>;

/// Zero the entries of a row that this rank has.
void clear_row(TrilinosWrappers::SparseMatrix &matrix, const types::global_dof_index row)
{
  const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
  const int local_row = epetra.LRID(static_cast<int>(row));
  if (local_row < 0)
    return;
  int n_entries, *indices;
  double *values;
  epetra.ExtractMyRowView(local_row, n_entries, values, indices);
  std::fill(values, values + n_entries, 0.);
}


bool touch(const Dofs &dofs, const IndexSet &rows)
{
  return std::any_of(dofs.begin(), dofs.end(),
                     [&](const auto dof) { return rows.is_element(dof); });
}


/// Whether one of these hangs on others, and any of all of them is in the rows.
bool hang_at(const Dofs &dofs, const IndexSet &rows, const AffineConstraints<double> &constraints)
{
  const bool in_rows = touch(dofs, rows);
  for (const auto dof : dofs)
    if (const auto *masters = constraints.get_constraint_entries(dof))
      for (const auto &[master, weight] : *masters)
        if (in_rows || rows.is_element(master))
          return true;
  return false;
}
} // namespace


template <int dim>
void BulkAssembly<dim>::add_rows(const Dofs &dofs,
                                 const IndexSet &rows,
                                 TrilinosWrappers::BlockSparseMatrix &matrix)
{
  const auto &constraints = mesh_view.constraints;
  const auto &layout = matrices.layout();
  const auto add = [&](const unsigned int i, const std::vector<unsigned int> &columns)
  {
    for (const unsigned int j : columns)
      if (!constraints.is_constrained(dofs[j]))
        matrix.add(dofs[i], dofs[j], matrices.whole(i, j));
  };
  const auto is_wanted = [&](const unsigned int i)
  { return rows.is_element(dofs[i]) && !constraints.is_constrained(dofs[i]); };
  for (const unsigned int i : layout.u)
    if (is_wanted(i))
    {
      add(i, layout.u);
      add(i, layout.p);
    }
  for (const unsigned int i : layout.p)
    if (is_wanted(i))
      add(i, layout.u);
  if (layout.n_p > 0)
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (rows.is_element(dofs[i]))
        content(dofs[i]) += matrices.content(i);
}


template <int dim>
bool BulkAssembly<dim>::rows(const StepContext &context,
                             const IndexSet &rows,
                             TrilinosWrappers::BlockSparseMatrix &matrix)
{
  const auto &dof_handler = mesh_view.dof_handler;
  const auto &constraints = mesh_view.constraints;
  const bool has_pressure = matrices.layout().n_p > 0;
  Dofs dofs(dof_handler.get_fe().n_dofs_per_cell());

  bool hangs = false;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && !hangs)
    {
      cell->get_dof_indices(dofs);
      hangs = hang_at(dofs, rows, constraints);
    }
  if (Utilities::MPI::max(hangs ? 1 : 0, matrix.block(0, 0).get_mpi_communicator()) == 1)
    return false;

  const types::global_dof_index n_displacement = owned[0].size();
  for (const types::global_dof_index row : rows)
    if (!dof_handler.locally_owned_dofs().is_element(row))
      continue;
    else if (row >= n_displacement)
      clear_row(matrix.block(1, 0), row - n_displacement);
    else if (!constraints.is_constrained(row))
    {
      clear_row(matrix.block(0, 0), row);
      if (has_pressure)
        clear_row(matrix.block(0, 1), row);
    }
  if (has_pressure)
  {
    for (const types::global_dof_index row : rows)
      if (dof_handler.locally_owned_dofs().is_element(row))
        content(row) = 0.;
    content.compress(VectorOperation::insert);
  }

  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(dofs);
      if (!touch(dofs, rows))
      {
        matrices.pass_over(cell);
        continue;
      }
      matrices.reinit(cell, context);
      add_rows(dofs, rows, matrix);
    }
  matrix.compress(VectorOperation::add);
  if (has_pressure)
    content.compress(VectorOperation::add);
  return true;
}


template void
BulkAssembly<2>::add_rows(const Dofs &, const IndexSet &, TrilinosWrappers::BlockSparseMatrix &);
template void
BulkAssembly<3>::add_rows(const Dofs &, const IndexSet &, TrilinosWrappers::BlockSparseMatrix &);
template bool
BulkAssembly<2>::rows(const StepContext &, const IndexSet &, TrilinosWrappers::BlockSparseMatrix &);
template bool
BulkAssembly<3>::rows(const StepContext &, const IndexSet &, TrilinosWrappers::BlockSparseMatrix &);
} // namespace stockwork
