#pragma once

#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include <memory>
#include <vector>

class Epetra_Import;

namespace stockwork
{
/// Brings ghost values up to date: ghosted = owned, for vectors of one numbering. deal.II's
/// assignment does the same, and finds out in each call which rank needs what of which.
class GhostValues
{
public:
  using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;

  /// Collective.
  void reinit(const BlockVector &owned, const BlockVector &ghosted);

  /// Of vectors with the layouts given to reinit(). Collective.
  void update(BlockVector &ghosted, const BlockVector &owned) const;

private:
  std::vector<std::shared_ptr<Epetra_Import>> imports; ///< by block
};

/// What this rank owns of a vector with ghost values, without communication.
void copy_owned(dealii::TrilinosWrappers::MPI::Vector &owned,
                const dealii::TrilinosWrappers::MPI::Vector &ghosted);
void copy_owned(dealii::TrilinosWrappers::MPI::BlockVector &owned,
                const dealii::TrilinosWrappers::MPI::BlockVector &ghosted);
} // namespace stockwork
