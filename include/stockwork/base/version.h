#pragma once

#include <string>

namespace stockwork
{
/// "0.1.0"
std::string version();

/// "9.4.1"
std::string dealii_version();

/// The dense linear algebra this process has loaded, e.g. "OpenBLAS 0.3.21 (libblas.so.3)".
std::string blas_version();

/// True if it is the reference BLAS, with which a direct solve takes two to nine times as long.
bool blas_is_slow();

/// Stockwork, deal.II, Trilinos, MPI and BLAS, one a line.
std::string version_report();
} // namespace stockwork
