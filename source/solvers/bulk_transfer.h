#pragma once

#include "solvers/mumps.h"
#include "solvers/system_operator.h"

namespace stockwork
{
/// Moves bulk vectors between the ranks' owned parts and one array on rank 0, in the order of the
/// global dof indices, as MUMPS wants its right-hand sides.
class BulkTransfer
{
public:
  BulkTransfer(const dealii::TrilinosWrappers::MPI::BlockVector &layout, MPI_Comm);

  /// `all` (rank 0) = scaling times v; the array must be large enough.
  void to_root(const dealii::TrilinosWrappers::MPI::BlockVector &v,
               const dealii::TrilinosWrappers::MPI::BlockVector &scaling,
               double *all) const;

  /// v = scaling times `all` (rank 0).
  void from_root(const double *all,
                 const dealii::TrilinosWrappers::MPI::BlockVector &scaling,
                 dealii::TrilinosWrappers::MPI::BlockVector &v) const;

private:
  MPI_Comm communicator;
  bool is_root;
  std::vector<std::vector<int>> counts, starts; ///< [block][rank]
  mutable std::vector<double> buffer;
};

/// Append the indices (from one) of this rank's bulk entries: all, or those of the lower triangle.
void append_bulk_indices(const SystemOperator &,
                         bool lower_triangle,
                         std::vector<int> &rows,
                         std::vector<int> &columns);

/// Append their values, scaled from both sides, in the same order.
void append_bulk_values(const SystemOperator &, bool lower_triangle, std::vector<double> &values);
} // namespace stockwork
