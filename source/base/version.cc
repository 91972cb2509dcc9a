#include "stockwork/base/version.h"

#include "stockwork/base/blas.h"

#include <deal.II/base/config.h>

#include <Trilinos_version.h>

#include <mpi.h>

#include <sstream>

namespace stockwork
{
std::string version()
{
  return STOCKWORK_VERSION;
}

std::string dealii_version()
{
  return DEAL_II_PACKAGE_VERSION;
}

std::string version_report()
{
  char mpi[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(mpi, &length);
  // Open MPI's text goes on with builder and dates.
  const std::string mpi_text = std::string(mpi, length);

  std::ostringstream out;
  out << "Stockwork " << version() << '\n'
      << "deal.II   " << dealii_version() << '\n'
      << "Trilinos  " << TRILINOS_VERSION_STRING << '\n'
      << "MPI       " << mpi_text.substr(0, mpi_text.find_first_of(",\n")) << '\n'
      << "BLAS      " << blas_version() << '\n';
  if (blas_is_slow())
    out << "          slow: a direct solve takes 2 to 9 times as long as with OpenBLAS;\n"
           "          on Debian: apt-get install libopenblas0-serial\n";
  return out.str();
}
} // namespace stockwork
