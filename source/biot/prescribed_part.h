#pragma once

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>

namespace stockwork
{
/// Part of the value of a dof that constraints prescribe: all of a prescribed one's, a share of
/// that of a hanging node beside one that is, zero where the dof is free.
inline double prescribed_part(const dealii::AffineConstraints<double> &constraints,
                              const dealii::types::global_dof_index dof,
                              const dealii::TrilinosWrappers::MPI::BlockVector &values)
{
  if (!constraints.is_constrained(dof))
    return 0.;
  double value = values(dof);
  for (const auto &[master, weight] : *constraints.get_constraint_entries(dof))
    value -= weight * values(master);
  return value;
}

/// How much of a value is prescribed: all, or a half of that of a hanging node beside one that is;
/// its equation is that share of the prescribed one's.
inline double prescribed_share(const dealii::AffineConstraints<double> &constraints,
                               const dealii::types::global_dof_index dof)
{
  if (!constraints.is_constrained(dof))
    return 0.;
  double share = 1.;
  for (const auto &[master, weight] : *constraints.get_constraint_entries(dof))
    share -= weight;
  return share < 1e-10 ? 0. : share;
}
} // namespace stockwork
