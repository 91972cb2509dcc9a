#include "stockwork/base/run_context.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iostream>

namespace stockwork
{
RunContext::RunContext(const MPI_Comm communicator)
  : RunContext(communicator, std::cout)
{
}

RunContext::RunContext(const MPI_Comm communicator, std::ostream &stream)
  : communicator(communicator)
  , rank(dealii::Utilities::MPI::this_mpi_process(communicator))
  , n_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator))
  , out(stream, rank == 0)
{
}

void RunContext::warn(const std::string &message)
{
  if (std::find(warnings.begin(), warnings.end(), message) != warnings.end())
    return;
  warnings.push_back(message);
  out << "Warning: " << message << std::endl;
}

void RunContext::recall(const std::vector<std::string> &earlier)
{
  for (const std::string &message : earlier)
    if (std::find(warnings.begin(), warnings.end(), message) == warnings.end())
      warnings.push_back(message);
}
} // namespace stockwork
