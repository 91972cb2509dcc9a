#include "coupling/system_sink.h"

namespace stockwork
{
using namespace dealii;

namespace
{
/// Call `add(dof, weight)` for the unconstrained dofs that a dof depends on.
template <class Function>
void resolve(const AffineConstraints<double> &constraints,
             const types::global_dof_index dof,
             const Function &add)
{
  if (!constraints.is_constrained(dof))
    add(dof, 1.);
  else if (const auto *entries = constraints.get_constraint_entries(dof))
    for (const auto &[master, weight] : *entries)
      add(master, weight);
}
} // namespace


SystemSink::SystemSink(const AffineConstraints<double> &constraints,
                       LinearSystem &system,
                       TrilinosWrappers::BlockSparseMatrix &bulk,
                       TrilinosWrappers::MPI::BlockVector &residual_bulk,
                       std::vector<double> &residual_extra,
                       Triplets &extra_extra)
  : constraints(constraints)
  , system(system)
  , bulk(bulk)
  , residual_bulk(residual_bulk)
  , residual_extra(residual_extra)
  , extra_extra(extra_extra)
{
}


void SystemSink::add(const LocalSystem &local)
{
  const unsigned int n_bulk = local.bulk.size(), n_extra = local.extra.size();

  for (unsigned int i = 0; i < n_bulk; ++i)
    if (local.residual(i) != 0.)
    {
      residual_touched = true;
      resolve(constraints, local.bulk[i],
              [&](const auto dof, const double weight)
              { residual_bulk(dof) += weight * local.residual(i); });
    }
  for (unsigned int i = 0; i < n_extra; ++i)
    residual_extra[local.extra[i]] += local.residual(n_bulk + i);

  for (unsigned int i = 0; i < n_bulk; ++i)
  {
    // A row at once: to find its place in the matrix takes as long as to add to it.
    row_columns.clear();
    row_values.clear();
    for (unsigned int j = 0; j < n_bulk; ++j)
      if (const double value = local.matrix(i, j); value != 0.)
        resolve(constraints, local.bulk[j],
                [&](const auto column, const double weight)
                {
                  row_columns.push_back(column);
                  row_values.push_back(weight * value);
                });
    bulk_touched |= !row_values.empty();
    resolve(constraints, local.bulk[i],
            [&](const auto row, const double weight)
            {
              if (row_values.empty() || (rows != nullptr && !rows->is_element(row)))
                return;
              weighted_values.clear();
              for (const double value : row_values)
                weighted_values.push_back(weight * value);
              bulk.add(row, row_columns.size(), row_columns.data(), weighted_values.data(), false);
            });
  }
  for (unsigned int i = 0; i < n_bulk; ++i)
    for (unsigned int e = 0; e < n_extra; ++e)
    {
      const double down = local.matrix(i, n_bulk + e), across = local.matrix(n_bulk + e, i);
      if (down != 0. || across != 0.)
        resolve(constraints, local.bulk[i],
                [&](const auto dof, const double weight)
                {
                  if (down != 0.)
                    system.bulk_extra.add(dof, local.extra[e], weight * down);
                  if (across != 0.)
                    system.extra_bulk.add(local.extra[e], dof, weight * across);
                });
    }
  for (unsigned int d = 0; d < n_extra; ++d)
    for (unsigned int e = 0; e < n_extra; ++e)
      if (local.matrix(n_bulk + d, n_bulk + e) != 0.)
        extra_extra.add(local.extra[d], local.extra[e], local.matrix(n_bulk + d, n_bulk + e));
}
} // namespace stockwork
