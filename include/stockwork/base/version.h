#pragma once

#include <string>

namespace stockwork
{
/// "0.1.0"
std::string version();

/// "9.4.1"
std::string dealii_version();

/// Stockwork, deal.II, Trilinos, MPI and BLAS, one a line.
std::string version_report();
} // namespace stockwork
