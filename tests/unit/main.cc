// The unit tests are one program. With MPI, because some of them run on several ranks.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "stockwork/base/lone_process.h"

#include <deal.II/base/mpi.h>

int main(int argc, char **argv)
{
  stockwork::start_lone_process_quickly();
  int n_arguments = 1; // the options are for doctest
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(n_arguments, argv, 1);
  return doctest::Context(argc, argv).run();
}
