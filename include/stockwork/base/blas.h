#pragma once

#include <string>

namespace stockwork
{
/// An OpenBLAS older than the processor does not know it, and takes what every processor of the
/// kind can do (of 2004, on a processor of 2023). Have it take its routines for vectors of eight or
/// four numbers where the processor has them: runs with many direct solves take 0.7 to 0.85 of the
/// time (doc/performance.md). To be called before anything is computed; what the user has set
/// (OPENBLAS_CORETYPE) stands.
void choose_blas_for_processor();

/// The dense linear algebra this process has loaded, with the processor that it is written for if
/// it chooses between several, e.g. "OpenBLAS 0.3.21 for Haswell (libblas.so.3)".
std::string blas_version();

/// True if it is the reference BLAS, with which a direct solve takes two to nine times as long.
bool blas_is_slow();
} // namespace stockwork
