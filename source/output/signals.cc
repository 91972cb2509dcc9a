#include "output/signals.h"

#include <deal.II/base/mpi.h>

#include <csignal>

namespace stockwork
{
namespace
{
/// The one thing a signal handler may touch.
volatile std::sig_atomic_t stop_flag = 0;

void request_stop(const int signal)
{
  stop_flag = 1;
  if (signal == SIGINT)
    std::signal(SIGINT, SIG_DFL);
}
} // namespace

void catch_stop_signals()
{
  std::signal(SIGTERM, request_stop);
  std::signal(SIGINT, request_stop);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool stop_requested(MPI_Comm communicator)
{
  return dealii::Utilities::MPI::max(static_cast<int>(stop_flag), communicator) != 0;
}
} // namespace stockwork
