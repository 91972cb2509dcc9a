#include "stockwork/base/version.h"

#include <deal.II/base/config.h>

#include <Trilinos_version.h>

#include <dlfcn.h>
#include <mpi.h>

#include <filesystem>
#include <sstream>

namespace stockwork
{
namespace
{
/// File name of the shared library that a loaded function lives in, links followed.
std::string library_of(void *function)
{
  Dl_info info;
  if (function == nullptr || dladdr(function, &info) == 0 || info.dli_fname == nullptr)
    return "";
  std::error_code error;
  const auto path = std::filesystem::canonical(info.dli_fname, error);
  return error ? info.dli_fname : path.string();
}

struct Blas
{
  std::string name;
  bool slow = false;
};

/// The function that a call of dgemm reaches tells the library; OpenBLAS also tells its version.
Blas find_blas()
{
  void *const dgemm = dlsym(RTLD_DEFAULT, "dgemm_");
  const std::string path = library_of(dgemm);
  const std::string file = std::filesystem::path(path).filename().string();
  const std::string library = file.empty() ? "" : " (" + file + ")";
  if (auto *const config = dlsym(RTLD_DEFAULT, "openblas_get_config"))
  {
    // "OpenBLAS 0.3.21 NO_AFFINITY ..."
    std::istringstream words(reinterpret_cast<const char *(*)()>(config)());
    std::string name, number;
    words >> name >> number;
    return {name + " " + number + library, false};
  }
  for (const char *known : {"openblas", "mkl", "blis", "atlas", "flexiblas", "Accelerate"})
    if (path.find(known) != std::string::npos)
      return {known + library, false};
  if (path.empty())
    return {"unknown BLAS", false};
  return {"reference BLAS" + library, true};
}
} // namespace

std::string version()
{
  return STOCKWORK_VERSION;
}

std::string dealii_version()
{
  return DEAL_II_PACKAGE_VERSION;
}

std::string blas_version()
{
  return find_blas().name;
}

bool blas_is_slow()
{
  return find_blas().slow;
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
