#pragma once

#include <mpi.h>

namespace stockwork
{
/// From now on SIGTERM (what batch systems send before they kill) and SIGINT (Ctrl-C) do not end
/// the program but make stop_requested() true; a second SIGINT ends it at once. Writing more than
/// the limit of `ulimit -f` becomes an error instead of a signal.
void catch_stop_signals();

/// Has any rank been told to stop? Collective.
bool stop_requested(MPI_Comm communicator);
} // namespace stockwork
