#pragma once

#include "stockwork/exchange/sink.h"

#include "solvers/linear_system.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace stockwork
{
/// Adds local contributions to a LinearSystem, with the constraints of the bulk dofs resolved.
/// Terms of the bulk block go into its matrix; `bulk_touched` tells whether there were any, since a
/// matrix that is kept from one iteration to the next must not collect them twice.
class SystemSink : public Sink
{
public:
  /// The residual of the extra rows is added to `residual_extra`, this rank's part only.
  SystemSink(const dealii::AffineConstraints<double> &constraints,
             LinearSystem &system,
             dealii::TrilinosWrappers::BlockSparseMatrix &bulk,
             dealii::TrilinosWrappers::MPI::BlockVector &residual_bulk,
             std::vector<double> &residual_extra,
             Triplets &extra_extra);

  void add(const LocalSystem &local) override;

  bool bulk_touched = false;

  /// There were terms of the bulk's residual, which has to be compressed.
  bool residual_touched = false;

  /// Rows of the bulk block that terms are taken for; null: all.
  const dealii::IndexSet *rows = nullptr;

private:
  const dealii::AffineConstraints<double> &constraints;
  LinearSystem &system;
  dealii::TrilinosWrappers::BlockSparseMatrix &bulk;
  dealii::TrilinosWrappers::MPI::BlockVector &residual_bulk;
  std::vector<double> &residual_extra;
  Triplets &extra_extra;

  // One row of a local matrix.
  std::vector<dealii::types::global_dof_index> row_columns;
  std::vector<double> row_values, weighted_values;
};
} // namespace stockwork
