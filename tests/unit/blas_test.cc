// The dense linear algebra that the program has loaded.
#include "stockwork/base/blas.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <doctest/doctest.h>

#include <cstdlib>

namespace stockwork::blas_test
{
/// The greatest difference between BLAS's product of two matrices and that of a loop.
double error_of_product(const unsigned int n)
{
  dealii::LAPACKFullMatrix<double> a(n, n), b(n, n), by_blas(n, n);
  dealii::FullMatrix<double> by_loop(n, n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
    {
      a(i, j) = 1. / (1. + i + 2. * j);
      b(i, j) = 1. / (2. + 3. * i + j) - 0.1;
    }
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < n; ++k)
        by_loop(i, j) += a(i, k) * b(k, j);
  a.mmult(by_blas, b);
  double error = 0.;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      error = std::max(error, std::abs(by_blas(i, j) - by_loop(i, j)));
  return error;
}

TEST_CASE("BLAS that knows the processor multiplies as before")
{
  const bool set_by_user = std::getenv("OPENBLAS_CORETYPE") != nullptr;
  CHECK(error_of_product(301) < 1e-13);
  choose_blas_for_processor();
  CHECK(error_of_product(301) < 1e-13);
  const std::string name = blas_version();
  MESSAGE(name);
  CHECK(name.find("BLAS") != std::string::npos);
#if defined(__x86_64__)
  if (!set_by_user && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    CHECK(name.find("Prescott") == std::string::npos);
#endif
}
} // namespace stockwork::blas_test
