#include "rock/plane_elasticity.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <cmath>
#include <limits>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Compliance in Voigt's notation and the axes of the crack; shear strains count twice.
FullMatrix<double> compliance(const SymmetricTensor<4, 2> &stiffness, const Tensor<1, 2> &along)
{
  Tensor<2, 2> frame;
  frame[0] = along;
  frame[1][0] = -along[1];
  frame[1][1] = along[0];
  const std::array<std::pair<unsigned int, unsigned int>, 3> index = {{{0, 0}, {1, 1}, {0, 1}}};
  FullMatrix<double> result(3, 3);
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b < 3; ++b)
    {
      const auto [i, j] = index[a];
      const auto [k, l] = index[b];
      double sum = 0.;
      for (unsigned int m = 0; m < 2; ++m)
        for (unsigned int n = 0; n < 2; ++n)
          for (unsigned int r = 0; r < 2; ++r)
            for (unsigned int s = 0; s < 2; ++s)
              sum += frame[i][m] * frame[j][n] * frame[k][r] * frame[l][s] * stiffness[m][n][r][s];
      result(a, b) = sum;
    }
  result.gauss_jordan();
  return result;
}
} // namespace


Tensor<1, 2> direction(const double angle)
{
  Tensor<1, 2> result;
  result[0] = std::cos(angle);
  result[1] = std::sin(angle);
  return result;
}


PlaneElasticity::PlaneElasticity(const SymmetricTensor<4, 2> &stiffness, const Tensor<1, 2> &along)
{
  const FullMatrix<double> a = compliance(stiffness, along);
  // The roots are the eigenvalues of the polynomial's companion matrix.
  LAPACKFullMatrix<double> companion(4, 4);
  companion = 0.;
  for (unsigned int i = 1; i < 4; ++i)
    companion(i, i - 1) = 1.;
  companion(0, 3) = -a(1, 1) / a(0, 0);
  companion(1, 3) = 2. * a(1, 2) / a(0, 0);
  companion(2, 3) = -(2. * a(0, 1) + a(2, 2)) / a(0, 0);
  companion(3, 3) = 2. * a(0, 2) / a(0, 0);
  companion.compute_eigenvalues();
  unsigned int n = 0;
  for (unsigned int i = 0; i < 4 && n < 2; ++i)
    if (const Complex root = companion.eigenvalue(i); root.imag() > 0.)
      mu[n++] = root;
  for (unsigned int k = 0; k < 2; ++k)
  {
    p[k] = a(0, 0) * mu[k] * mu[k] + a(0, 1) - a(0, 2) * mu[k];
    q[k] = a(0, 1) * mu[k] + a(1, 1) / mu[k] - a(1, 2);
  }
  crack_compliance[0][0] = a(0, 0) * (mu[0] + mu[1]).imag();
  crack_compliance[0][1] = a(0, 0) * (mu[0] * mu[1]).imag();
  crack_compliance[1][1] = -a(1, 1) * ((mu[0] + mu[1]) / (mu[0] * mu[1])).imag();
}


double minimum_plane_modulus(const SymmetricTensor<4, 2> &stiffness)
{
  // E' changes slowly with direction; a degree is fine enough for what is a scale.
  constexpr unsigned int n = 180;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned int i = 0; i < n; ++i)
    least =
      std::min(least, PlaneElasticity(stiffness, direction(i * numbers::PI / n)).plane_modulus());
  return least;
}
} // namespace stockwork
