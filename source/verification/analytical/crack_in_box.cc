#include "verification/analytical/crack_in_box.h"

#include "verification/analytical/chebyshev_crack.h"
#include "verification/analytical/constants.h"
#include "verification/analytical/dense_matrix.h"
#include "verification/analytical/roller_walls.h"

#include <cmath>

namespace stockwork::analytical
{
namespace
{
constexpr std::size_t n_points = 64;
} // namespace


CrackInBox::CrackInBox(const CrackInBoxParameters &parameters)
  : parameters(parameters)
  , modulus(parameters.youngs_modulus / (1. - parameters.poisson_ratio * parameters.poisson_ratio))
  , slope(n_points, 1.)
{
  // Lengths in a, stresses in the pressure, opening in 4 p a / E'.
  const ChebyshevCrack points(n_points);
  const double width = parameters.half_width / parameters.half_length;
  const double height = parameters.half_height / parameters.half_length;
  const double uniaxial = RollerWalls::uniaxial_ratio(parameters.poisson_ratio);

  DenseMatrix matrix(n_points);
  for (std::size_t r = 0; r + 1 < n_points; ++r)
  {
    const double x = points.collocation(r);
    for (std::size_t k = 0; k < n_points; ++k)
    {
      const double s = points.source(k);
      double kernel = 0.5 / width / std::tan(0.5 * pi * (x - s) / width);
      for (unsigned int m = 1; m * pi * height / width < 20.; ++m)
      {
        const double wave_number = m * pi / width;
        kernel -= RollerWalls::layer_excess(wave_number * height) / width *
                  std::cos(wave_number * x) * std::sin(wave_number * s);
      }
      kernel -= uniaxial / (height * width) * s;
      matrix[r][k] = points.weight() * kernel;
    }
  }
  for (std::size_t k = 0; k < n_points; ++k)
    matrix[n_points - 1][k] = 1.;
  slope[n_points - 1] = 0.;
  solve_in_place(matrix, slope);
}


double CrackInBox::opening(const double x) const
{
  const double unit = 4. * parameters.net_pressure * parameters.half_length / modulus;
  return unit * ChebyshevCrack(n_points).jump(slope.data(), x / parameters.half_length);
}


double CrackInBox::volume() const
{
  const double unit =
    4. * parameters.net_pressure * parameters.half_length * parameters.half_length / modulus;
  return unit * ChebyshevCrack(n_points).area(slope.data());
}


double CrackInBox::stress_intensity() const
{
  return parameters.net_pressure * std::sqrt(pi * parameters.half_length) *
         ChebyshevCrack(n_points).tip(slope.data());
}
} // namespace stockwork::analytical
