#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "stockwork/base/error.h"

namespace stockwork::analytical
{
/// A square matrix by rows, for the few hundred unknowns of the collocation schemes here.
class DenseMatrix
{
public:
  explicit DenseMatrix(const std::size_t n)
    : n(n)
    , values(n * n, 0.)
  {
  }

  double *operator[](const std::size_t row)
  {
    return values.data() + row * n;
  }

  const double *operator[](const std::size_t row) const
  {
    return values.data() + row * n;
  }

  std::size_t size() const
  {
    return n;
  }

private:
  std::size_t n;
  std::vector<double> values;
};


/// C = A B.
inline void multiply(const DenseMatrix &A, const DenseMatrix &B, DenseMatrix &C)
{
  const std::size_t n = A.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    std::fill(C[i], C[i] + n, 0.);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j)
        C[i][j] += A[i][k] * B[k][j];
  }
}


/// Overwrites b with the solution of A x = b; A is consumed. Gauss elimination with row pivoting.
inline void solve_in_place(DenseMatrix &A, std::vector<double> &b)
{
  const std::size_t n = A.size();
  for (std::size_t k = 0; k < n; ++k)
  {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(A[i][k]) > std::abs(A[pivot][k]))
        pivot = i;
    if (!(std::abs(A[pivot][k]) > 0.))
      throw InputError("Its equations are singular with the numbers of this case.");
    if (pivot != k)
    {
      std::swap_ranges(A[k] + k, A[k] + n, A[pivot] + k);
      std::swap(b[k], b[pivot]);
    }
    for (std::size_t i = k + 1; i < n; ++i)
    {
      const double factor = A[i][k] / A[k][k];
      const double *above = A[k];
      double *row = A[i];
      for (std::size_t j = k + 1; j < n; ++j)
        row[j] -= factor * above[j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;)
  {
    for (std::size_t j = k + 1; j < n; ++j)
      b[k] -= A[k][j] * b[j];
    b[k] /= A[k][k];
  }
}
} // namespace stockwork::analytical
