#include "base/ghost_values.h"

#include <deal.II/base/exceptions.h>

#include <Epetra_Import.h>

#include <algorithm>

namespace stockwork
{
void GhostValues::reinit(const BlockVector &owned, const BlockVector &ghosted)
{
  imports.clear();
  for (unsigned int b = 0; b < owned.n_blocks(); ++b)
    imports.push_back(std::make_shared<Epetra_Import>(ghosted.block(b).trilinos_vector().Map(),
                                                      owned.block(b).trilinos_vector().Map()));
}


void GhostValues::update(BlockVector &ghosted, const BlockVector &owned) const
{
  for (unsigned int b = 0; b < imports.size(); ++b)
  {
    const int error = ghosted.block(b).trilinos_vector().Import(owned.block(b).trilinos_vector(),
                                                                *imports[b], Insert);
    AssertThrow(error == 0, dealii::ExcInternalError());
  }
}


void copy_owned(dealii::TrilinosWrappers::MPI::Vector &owned,
                const dealii::TrilinosWrappers::MPI::Vector &ghosted)
{
  auto &to = owned.trilinos_vector();
  const auto &from = ghosted.trilinos_vector();
  const int n = to.MyLength();
  if (n == 0)
    return;
  // Numbers of a rank are contiguous, and ghosts come before and after them.
  const int begin = from.Map().LID(to.Map().MinMyGID64());
  Assert(begin >= 0 && from.Map().GID64(begin + n - 1) == to.Map().MaxMyGID64(),
         dealii::ExcInternalError());
  std::copy(from[0] + begin, from[0] + begin + n, to[0]);
}


void copy_owned(dealii::TrilinosWrappers::MPI::BlockVector &owned,
                const dealii::TrilinosWrappers::MPI::BlockVector &ghosted)
{
  for (unsigned int b = 0; b < owned.n_blocks(); ++b)
    copy_owned(owned.block(b), ghosted.block(b));
}
} // namespace stockwork
