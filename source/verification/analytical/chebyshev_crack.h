#pragma once

#include "verification/analytical/constants.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace stockwork::analytical
{
/// Points and formulas of the Gauss-Chebyshev solution of crack problems (Erdogan & Gupta 1972).
/// The slope of the jump across the crack |s| < 1 is written phi(s)/sqrt(1 - s^2); phi is known at
/// n points, the singular integral equation is required at n - 1 points between them, and the
/// jump closes at both ends when the sum of phi vanishes.
class ChebyshevCrack
{
public:
  explicit ChebyshevCrack(const std::size_t n)
    : n(n)
  {
  }

  std::size_t size() const
  {
    return n;
  }

  /// k = 0 ... n-1, from the tip s = 1 to the tip s = -1.
  double source(const std::size_t k) const
  {
    return std::cos((k + 0.5) * pi / n);
  }

  /// r = 0 ... n-2.
  double collocation(const std::size_t r) const
  {
    return std::cos((r + 1.) * pi / n);
  }

  /// Of an integral of phi(s) f(s) / sqrt(1 - s^2).
  double weight() const
  {
    return pi / n;
  }

  /// The jump at x, from phi at the sources: -int_x^1 phi/sqrt(1 - s^2) ds.
  double jump(const double *phi, const double x) const
  {
    double sum = 0.;
    const double theta = std::acos(x);
    for (std::size_t j = 1; j < n; ++j)
      sum -= coefficient(phi, j) * std::sin(j * theta) / j;
    return sum;
  }

  /// lim jump(x) / sqrt(1 - x^2) at the tip x = 1.
  double tip(const double *phi) const
  {
    double sum = 0.;
    for (std::size_t j = 1; j < n; ++j)
      sum -= coefficient(phi, j);
    return sum;
  }

  /// int_{-1}^{1} jump dx.
  double area(const double *phi) const
  {
    return -0.5 * pi * coefficient(phi, 1);
  }

private:
  // Of the Chebyshev polynomial T_j, j > 0, in phi.
  double coefficient(const double *phi, const std::size_t j) const
  {
    double sum = 0.;
    for (std::size_t k = 0; k < n; ++k)
      sum += phi[k] * std::cos(j * (k + 0.5) * pi / n);
    return 2. / n * sum;
  }

  std::size_t n;
};
} // namespace stockwork::analytical
