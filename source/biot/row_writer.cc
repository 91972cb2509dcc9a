#include "biot/row_writer.h"

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <algorithm>

namespace stockwork
{
using namespace dealii;

bool RowWriter::reinit(const TrilinosWrappers::SparseMatrix &matrix,
                       const std::vector<types::global_dof_index> &row_dofs,
                       const std::vector<types::global_dof_index> &column_dofs)
{
  const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
  rows.resize(row_dofs.size());
  for (unsigned int i = 0; i < rows.size(); ++i)
  {
    rows[i] = epetra.LRID(static_cast<int>(row_dofs[i]));
    if (rows[i] < 0)
      return false;
  }
  columns.resize(column_dofs.size());
  for (unsigned int j = 0; j < columns.size(); ++j)
    columns[j] = {epetra.LCID(static_cast<int>(column_dofs[j])), j};
  std::sort(columns.begin(), columns.end());
  return true;
}


void RowWriter::add(const FullMatrix<double> &local,
                    const std::vector<unsigned int> &local_rows,
                    const std::vector<unsigned int> &local_columns,
                    TrilinosWrappers::SparseMatrix &matrix) const
{
  const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
  for (unsigned int i = 0; i < rows.size(); ++i)
  {
    int n_entries, *indices;
    double *values;
    epetra.ExtractMyRowView(rows[i], n_entries, values, indices);
    const double *const from = &local(local_rows[i], 0);
    int k = 0;
    for (const auto &[column, j] : columns)
    {
      while (indices[k] < column)
        ++k;
      values[k] += from[local_columns[j]];
    }
  }
}
} // namespace stockwork
