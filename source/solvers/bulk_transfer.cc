#include "solvers/bulk_transfer.h"

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>

#include "stockwork/base/all_gather.h"

namespace stockwork
{
BulkTransfer::BulkTransfer(const dealii::TrilinosWrappers::MPI::BlockVector &layout,
                           const MPI_Comm communicator)
  : communicator(communicator)
  , is_root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
{
  int offset = 0;
  for (unsigned int b = 0; b < layout.n_blocks(); ++b)
  {
    const int mine = layout.block(b).trilinos_vector().MyLength();
    counts.push_back(all_gather(communicator, std::vector<int>{mine}));
    starts.emplace_back();
    for (const int count : counts.back())
    {
      starts.back().push_back(offset);
      offset += count;
    }
  }
}

void BulkTransfer::to_root(const dealii::TrilinosWrappers::MPI::BlockVector &v,
                           const dealii::TrilinosWrappers::MPI::BlockVector &scaling,
                           double *all) const
{
  for (unsigned int b = 0; b < v.n_blocks(); ++b)
  {
    const auto &epetra = v.block(b).trilinos_vector();
    const double *x = epetra[0], *d = scaling.block(b).trilinos_vector()[0];
    const int n = epetra.MyLength();
    buffer.resize(n);
    for (int i = 0; i < n; ++i)
      buffer[i] = d[i] * x[i];
    MPI_Gatherv(buffer.data(), n, MPI_DOUBLE, all, counts[b].data(), starts[b].data(), MPI_DOUBLE,
                0, communicator);
  }
}

void BulkTransfer::from_root(const double *all,
                             const dealii::TrilinosWrappers::MPI::BlockVector &scaling,
                             dealii::TrilinosWrappers::MPI::BlockVector &v) const
{
  for (unsigned int b = 0; b < v.n_blocks(); ++b)
  {
    auto &epetra = v.block(b).trilinos_vector();
    double *x = epetra[0];
    const double *d = scaling.block(b).trilinos_vector()[0];
    const int n = epetra.MyLength();
    buffer.resize(n);
    MPI_Scatterv(all, counts[b].data(), starts[b].data(), MPI_DOUBLE, buffer.data(), n, MPI_DOUBLE,
                 0, communicator);
    for (int i = 0; i < n; ++i)
      x[i] = d[i] * buffer[i];
  }
}

namespace
{
/// Call f(matrix, row block, column block, column index from one by local column) for each block.
template <class Function>
void for_each_block(const SystemOperator &op, const bool lower_triangle, const Function &f)
{
  const auto &bulk = op.system().bulk;
  for (unsigned int b = 0; b < bulk.n_block_rows(); ++b)
    for (unsigned int c = 0; c < (lower_triangle ? b + 1 : bulk.n_block_cols()); ++c)
    {
      const Epetra_CrsMatrix &matrix = bulk.block(b, c).trilinos_matrix();
      std::vector<int> global(matrix.NumMyCols());
      for (unsigned int j = 0; j < global.size(); ++j)
        global[j] = static_cast<int>(matrix.GCID64(j) + op.offset(c) + 1);
      f(matrix, b, c, global);
    }
}
} // namespace

void append_bulk_indices(const SystemOperator &op,
                         const bool lower_triangle,
                         std::vector<int> &rows,
                         std::vector<int> &columns)
{
  for_each_block(op, lower_triangle,
                 [&](const auto &matrix, auto b, auto c, const auto &global)
                 {
                   for (int i = 0; i < matrix.NumMyRows(); ++i)
                   {
                     const int row = static_cast<int>(matrix.GRID64(i) + op.offset(b) + 1);
                     int n_entries;
                     double *values;
                     int *indices;
                     matrix.ExtractMyRowView(i, n_entries, values, indices);
                     for (int k = 0; k < n_entries; ++k)
                       if (!lower_triangle || b != c || global[indices[k]] <= row)
                       {
                         rows.push_back(row);
                         columns.push_back(global[indices[k]]);
                       }
                   }
                 });
}

void append_bulk_values(const SystemOperator &op,
                        const bool lower_triangle,
                        std::vector<double> &result)
{
  const auto &scaling = op.scaling().bulk;
  for_each_block(op, lower_triangle,
                 [&](const auto &matrix, auto b, auto c, const auto &global)
                 {
                   const auto column_scaling = SystemOperator::at_columns(matrix, scaling.block(c));
                   const double *row_scaling = scaling.block(b).trilinos_vector()[0];
                   for (int i = 0; i < matrix.NumMyRows(); ++i)
                   {
                     const int row = static_cast<int>(matrix.GRID64(i) + op.offset(b) + 1);
                     int n_entries;
                     double *values;
                     int *indices;
                     matrix.ExtractMyRowView(i, n_entries, values, indices);
                     for (int k = 0; k < n_entries; ++k)
                       if (!lower_triangle || b != c || global[indices[k]] <= row)
                         result.push_back(row_scaling[i] * values[k] * column_scaling[indices[k]]);
                   }
                 });
}
} // namespace stockwork
