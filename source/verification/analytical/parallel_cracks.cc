#include "verification/analytical/parallel_cracks.h"

#include "verification/analytical/chebyshev_crack.h"
#include "verification/analytical/constants.h"
#include "verification/analytical/dense_matrix.h"

#include <algorithm>
#include <cmath>

namespace stockwork::analytical
{
namespace
{
// Enough points that the poles of the neighbours' stress, one distance away from the crack, do
// not spoil the quadrature.
unsigned int number_of_points(const double relative_distance)
{
  return static_cast<unsigned int>(std::clamp(20. / relative_distance, 32., 200.));
}
} // namespace


ParallelCracks::ParallelCracks(const ParallelCracksParameters &parameters)
  : parameters(parameters)
  , n_points(number_of_points(parameters.distance / parameters.half_length))
  , modulus(parameters.youngs_modulus / (1. - parameters.poisson_ratio * parameters.poisson_ratio))
  , slopes(2 * parameters.n_cracks * n_points, 0.)
{
  // Lengths in a, stresses in the pressure, jumps in 4 p a / E'.
  const ChebyshevCrack points(n_points);
  const unsigned int n = n_points;
  const double distance = parameters.distance / parameters.half_length;
  const double factor = points.weight() / pi;
  DenseMatrix matrix(slopes.size());
  for (unsigned int i = 0; i < parameters.n_cracks; ++i)
  {
    const unsigned int normal_row = 2 * i * n, shear_row = normal_row + n;
    for (unsigned int r = 0; r + 1 < n; ++r)
    {
      slopes[normal_row + r] = 1.;
      for (unsigned int j = 0; j < parameters.n_cracks; ++j)
        for (unsigned int k = 0; k < n; ++k)
        {
          const unsigned int opening = 2 * j * n + k, slip = opening + n;
          const double x = points.collocation(r) - points.source(k);
          const double y = distance * (static_cast<double>(i) - j);
          const double r4 = std::pow(x * x + y * y, 2);
          const double cross = y * (x * x - y * y) / r4;
          matrix[normal_row + r][opening] = factor * x * (x * x + 3. * y * y) / r4;
          matrix[normal_row + r][slip] = factor * cross;
          matrix[shear_row + r][opening] = factor * cross;
          matrix[shear_row + r][slip] = factor * x * (x * x - y * y) / r4;
        }
    }
    // Both jumps close.
    for (unsigned int k = 0; k < n; ++k)
    {
      matrix[normal_row + n - 1][normal_row + k] = 1.;
      matrix[shear_row + n - 1][shear_row + k] = 1.;
    }
  }
  solve_in_place(matrix, slopes);
}


double ParallelCracks::opening(const unsigned int crack, const double x) const
{
  const double unit = 4. * parameters.net_pressure * parameters.half_length / modulus;
  return unit *
         ChebyshevCrack(n_points).jump(&slopes[2 * crack * n_points], x / parameters.half_length);
}


double ParallelCracks::volume(const unsigned int crack) const
{
  const double unit =
    4. * parameters.net_pressure * parameters.half_length * parameters.half_length / modulus;
  return unit * ChebyshevCrack(n_points).area(&slopes[2 * crack * n_points]);
}


StressIntensity ParallelCracks::stress_intensity(const unsigned int crack) const
{
  const ChebyshevCrack points(n_points);
  const double unit = parameters.net_pressure * std::sqrt(pi * parameters.half_length);
  return {unit * points.tip(&slopes[2 * crack * n_points]),
          unit * points.tip(&slopes[(2 * crack + 1) * n_points])};
}
} // namespace stockwork::analytical
