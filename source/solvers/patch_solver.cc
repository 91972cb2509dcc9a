#include "solvers/patch_solver.h"

#include "solvers/system_operator.h"
#include "stockwork/base/all_gather.h"
#include "stockwork/base/error.h"

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <cmath>

namespace stockwork
{
using namespace dealii;

PatchSolver::PatchSolver(const MPI_Comm communicator)
  : communicator(communicator)
{
}


void PatchSolver::build(const TrilinosWrappers::SparseMatrix &new_matrix,
                        const TrilinosWrappers::SparseMatrix &change,
                        const types::global_dof_index most_rows)
{
  matrix = &new_matrix;
  const Epetra_CrsMatrix &k = matrix->trilinos_matrix(), &dk = change.trilinos_matrix();
  rows.clear();
  columns.clear();
  values.clear();
  std::vector<int> mine;
  std::vector<double> scaling_of_column(k.NumMyCols(), 0.);
  for (int i = 0; i < k.NumMyRows(); ++i)
  {
    int n_entries, n_change_entries;
    double *k_values, *dk_values;
    int *indices, *dk_indices;
    dk.ExtractMyRowView(i, n_change_entries, dk_values, dk_indices);
    if (std::all_of(dk_values, dk_values + n_change_entries,
                    [](const double v) { return v == 0.; }))
      continue;
    k.ExtractMyRowView(i, n_entries, k_values, indices);
    mine.push_back(k.GRID(i));
    double diagonal = 0.;
    for (int j = 0; j < n_entries; ++j)
    {
      columns.push_back(indices[j]);
      values.push_back(k_values[j] + dk_values[j]);
      if (k.GCID(indices[j]) == mine.back())
        diagonal = std::abs(k_values[j]);
    }
    rows.push_back({i, 0, diagonal > 0. ? 1. / std::sqrt(diagonal) : 1., columns.size()});
  }
  patch = all_gather(communicator, mine);
  std::vector<double> scaling;
  for (const Row &row : rows)
    scaling.push_back(row.scaling);
  scaling = all_gather(communicator, scaling);
  // Ranks follow one another, so the rows are sorted.
  n_patch = patch.size();
  if (n_patch == 0 || n_patch > most_rows)
  {
    n_patch = 0;
    return;
  }
  const auto number = [&](const int global)
  {
    const auto found = std::lower_bound(patch.begin(), patch.end(), global);
    return found != patch.end() && *found == global ? static_cast<int>(found - patch.begin()) : -1;
  };
  std::vector<int> new_rows, new_columns;
  std::vector<double> entries;
  std::size_t begin = 0;
  for (Row &row : rows)
  {
    row.number = number(k.GRID(row.local));
    for (std::size_t j = begin; j < row.end; ++j)
      if (const int column = number(k.GCID(columns[j])); column >= 0)
      {
        new_rows.push_back(row.number + 1);
        new_columns.push_back(column + 1);
        entries.push_back(values[j] * row.scaling * scaling[column]);
      }
    begin = row.end;
  }
  const bool same = factor && new_rows == factor_rows && new_columns == factor_columns;
  try
  {
    if (Utilities::MPI::min(same ? 1 : 0, communicator) == 0)
    {
      factor_rows = new_rows;
      factor_columns = new_columns;
      factor = std::make_unique<Mumps>(communicator, Mumps::Kind::unsymmetric);
      factor->analyse(n_patch, std::move(new_rows), std::move(new_columns));
    }
    factor->factorise(entries);
  }
  catch (const SolveError &)
  {
    n_patch = 0; // rock that flows freely
    factor.reset();
  }
}


void PatchSolver::correct(TrilinosWrappers::MPI::Vector &x,
                          const TrilinosWrappers::MPI::Vector &b) const
{
  if (n_patch == 0)
    return;
  const std::vector<double> at_columns = SystemOperator::at_columns(matrix->trilinos_matrix(), x);
  std::vector<double> r(n_patch, 0.);
  const double *const load = b.trilinos_vector()[0];
  std::size_t j = 0;
  for (const Row &row : rows)
  {
    double sum = load[row.local];
    for (; j < row.end; ++j)
      sum -= values[j] * at_columns[columns[j]];
    r[row.number] = sum * row.scaling;
  }
  Utilities::MPI::sum(r, communicator, r);
  factor->solve(r);
  MPI_Bcast(r.data(), static_cast<int>(n_patch), MPI_DOUBLE, 0, communicator);
  double *const solution = x.trilinos_vector()[0];
  for (const Row &row : rows)
    solution[row.local] += r[row.number] * row.scaling;
}
} // namespace stockwork
