#pragma once

#include "stockwork/base/timers.h"

#include <deal.II/base/conditional_ostream.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace stockwork
{
/// What every part of a run shares: who computes, where to talk, how long it took and what the
/// user should be warned of.
struct RunContext
{
  /// @param stream where rank 0 talks; the other ranks are silent
  explicit RunContext(MPI_Comm communicator);
  RunContext(MPI_Comm communicator, std::ostream &stream);

  /// Print a warning on rank 0 and keep it for summary.json; a warning said before is not
  /// repeated. To be called on all ranks, or on rank 0 only.
  void warn(const std::string &message);

  /// Keep the warnings of the part of a run that was before its restart; they have been printed.
  void recall(const std::vector<std::string> &earlier);

  MPI_Comm communicator;
  unsigned int rank;
  unsigned int n_ranks;
  dealii::ConditionalOStream out;
  PhaseTimers timers;
  std::vector<std::string> warnings;
};
} // namespace stockwork
