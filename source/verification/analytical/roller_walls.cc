#include "verification/analytical/roller_walls.h"
#include "verification/analytical/constants.h"

#include <cmath>

namespace stockwork::analytical
{
namespace
{
constexpr double near = 0.05; // where series replace differences of large numbers
constexpr double negligible_decay = 20.;

// Derivatives of cot(u) - 1/u.
double cot_excess_1(const double u)
{
  if (std::abs(u) < near)
    return -(1. / 3. + u * u / 15. + 2. * u * u * u * u / 189.);
  return 1. / (u * u) - 1. / std::pow(std::sin(u), 2);
}

double cot_excess_2(const double u)
{
  if (std::abs(u) < near)
    return -u * (2. / 15. + 8. * u * u / 189.);
  return 2. * std::cos(u) / std::pow(std::sin(u), 3) - 2. / (u * u * u);
}
} // namespace


RollerWalls::RollerWalls(const double half_width,
                         const double half_height,
                         const double poisson_ratio)
  : half_width(half_width)
  , half_height(half_height)
  , poisson_ratio(poisson_ratio)
{
}


double RollerWalls::layer_excess(const double h)
{
  // (h + sinh h cosh h) / sinh^2 h - 1
  const double e = std::exp(-2. * h);
  return (h + 0.5 * (1. - e)) * 4. * e / ((1. - e) * (1. - e));
}


double RollerWalls::uniaxial_ratio(const double poisson_ratio)
{
  return (1. - poisson_ratio) * (1. - poisson_ratio) / (1. - 2. * poisson_ratio);
}


unsigned int RollerWalls::n_waves() const
{
  return static_cast<unsigned int>(negligible_decay * half_width / (pi * half_height));
}


void RollerWalls::gradient_matrix(const HalfCrackGrid &grid,
                                  const double l,
                                  DenseMatrix &matrix) const
{
  const std::size_t n = grid.size();
  const std::vector<double> &xi = grid.x();
  const double a = 0.5 * pi * l / half_width;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      matrix[i][j] = a * a * a / (4. * pi) *
                     (cot_excess_2(a * (xi[i] - xi[j])) + cot_excess_2(a * (xi[i] + xi[j])));
  std::vector<double> cosine(n);
  for (unsigned int m = 1; m <= n_waves(); ++m)
  {
    const double k = m * pi / half_width;
    const double factor = -0.5 * l / half_width * k * k * l * l * layer_excess(k * half_height);
    for (std::size_t j = 0; j < n; ++j)
      cosine[j] = std::cos(k * l * xi[j]);
    for (std::size_t i = 0; i < n; ++i)
    {
      const double sine = factor * std::sin(k * l * xi[i]);
      for (std::size_t j = 0; j < n; ++j)
        matrix[i][j] += sine * cosine[j];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      matrix[i][j] *= grid.weight(j);
}


std::vector<double> RollerWalls::pressure(const HalfCrackGrid &grid,
                                          const double l,
                                          const std::vector<double> &omega) const
{
  const std::size_t n = grid.size();
  const std::vector<double> &xi = grid.x();
  const double a = 0.5 * pi * l / half_width;
  const double mean = uniaxial_ratio(poisson_ratio) * l * l / (2. * half_height * half_width);
  std::vector<double> result(n, 0.);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
    {
      double kernel =
        mean +
        a * a / (4. * pi) * (cot_excess_1(a * (xi[i] - xi[j])) + cot_excess_1(a * (xi[i] + xi[j])));
      result[i] += kernel * grid.weight(j) * omega[j];
    }
  for (unsigned int m = 1; m <= n_waves(); ++m)
  {
    const double k = m * pi / half_width;
    double amplitude = 0.;
    for (std::size_t j = 0; j < n; ++j)
      amplitude += 0.5 * l * l / half_width * k * layer_excess(k * half_height) *
                   std::cos(k * l * xi[j]) * grid.weight(j) * omega[j];
    for (std::size_t i = 0; i < n; ++i)
      result[i] += amplitude * std::cos(k * l * xi[i]);
  }
  return result;
}
} // namespace stockwork::analytical
