#pragma once

namespace stockwork
{
/// Spare a process that no launcher (mpirun, srun) has started the search for a network and for a
/// launcher's daemon, of which it has no use: half the time that a short run takes. To be called
/// before MPI_Init; Open MPI alone reads what it sets, and what the user has set stands.
void start_lone_process_quickly();
} // namespace stockwork
