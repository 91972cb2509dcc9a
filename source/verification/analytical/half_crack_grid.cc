#include "verification/analytical/half_crack_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stockwork::analytical
{
namespace
{
constexpr double pi = 3.14159265358979323846;
constexpr double zeta_prime_2 = -0.03044845705839327; // zeta'(-2)
constexpr double zeta_prime_4 = 0.00798381145026862;  // zeta'(-4)
constexpr double left_parameter = -3.;                // x = 2e-9

// Integral over one step from the eight values around it, in units of the step.
constexpr std::array<double, 8> one_step = {-191. / 120960.,  1879. / 120960.,  -9531. / 120960.,
                                            68323. / 120960., 68323. / 120960., -9531. / 120960.,
                                            1879. / 120960.,  -191. / 120960.};

// Central differences over seven points, in units of the step: first and third derivative.
constexpr std::array<double, 7> first_difference = {-1. / 60., 3. / 20.,  -3. / 4., 0.,
                                                    3. / 4.,   -3. / 20., 1. / 60.};
constexpr std::array<double, 7> second_difference = {1. / 90., -3. / 20., 3. / 2., -49. / 18.,
                                                     3. / 2.,  -3. / 20., 1. / 90.};
constexpr std::array<double, 7> third_difference = {1. / 8.,   -1., 13. / 8., 0.,
                                                    -13. / 8., 1.,  -1. / 8.};

double kernel(const double x,
              const double x_tip,
              const double a,
              const double s,
              const double s_tip,
              const double b)
{
  const double ahead = x_tip - s_tip; // s - x
  double sum = -2. * x * std::log1p(-(a * s_tip + b * x_tip) / (a + b));
  if (ahead != 0.)
    sum += ahead * std::log((a + b) * (a + b) / (std::abs(ahead) * (s + x)));
  return 4. / pi * sum;
}
} // namespace


HalfCrackGrid::HalfCrackGrid(const double step, const double last)
  : h(step)
  , first(left_parameter)
  , matrix(static_cast<std::size_t>(std::lround((last - left_parameter) / step)) + 1)
{
  const std::size_t n = matrix.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const double e = std::exp(-(first + i * h)); // -ln x
    position.push_back(std::exp(-e));
    tip_distance.push_back(-std::expm1(-e));
    metric.push_back(position[i] * e);
    chord.push_back(std::sqrt(tip_distance[i] * (1. + position[i])));
  }

  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = 0; j < n; ++j)
      matrix[i][j] =
        h * metric[j] *
        kernel(position[i], tip_distance[i], chord[i], position[j], tip_distance[j], chord[j]);

    // The trapezoidal rule is exact to all orders but for the singularity -(4/pi)(s - x) ln|s - x|
    // at s = x, whose error is an expansion in zeta'(-2), zeta'(-4), ... (Navot 1962) times
    // derivatives by v of s and of m ds/dv.
    const double e = std::exp(-(first + i * h));
    const double d1 = metric[i];
    const double d2 = d1 * (e - 1.);
    const double d3 = d1 * (e * e - 3. * e + 1.);
    const double d4 = d1 * (e * e * e - 6. * e * e + 7. * e - 1.);
    const double c2 = 2. * zeta_prime_2 * 4. / pi * h * h * h;
    const double c4 = 2. * zeta_prime_4 * 4. / pi * h * h * h * h * h;
    for (int k = -3; k <= 3; ++k)
    {
      const long j = static_cast<long>(i) + k;
      if (j < 0 || j >= static_cast<long>(n))
        continue;
      const double f0 = k == 0 ? 1. : 0.;
      const double f1 = first_difference[k + 3] / h;
      const double f2 = second_difference[k + 3] / (h * h);
      const double f3 = third_difference[k + 3] / (h * h * h);
      matrix[i][j] -=
        metric[j] * (c2 * (d1 * f1 + d2 / 2. * f0) +
                     c4 * (d1 * f3 / 6. + d2 / 2. * f2 / 2. + d3 / 6. * f1 + d4 / 24. * f0));
    }
  }
}


void HalfCrackGrid::integrate_to_tip(const std::vector<double> &f,
                                     std::vector<double> &result) const
{
  const long n = size();
  result.resize(n);
  double sum = 0.;
  for (long q = n - 1; q >= 0; --q) // the step from q to q + 1; f vanishes beyond the points
  {
    for (long k = std::max(0L, q - 3); k <= std::min(n - 1, q + 4); ++k)
      sum += h * one_step[k - q + 3] * f[k] * metric[k];
    result[q] = sum;
  }
}


void HalfCrackGrid::transpose_integrate(const double *g, std::vector<double> &result) const
{
  const long n = size();
  result.assign(n, 0.);
  double sum = 0.;
  for (long q = 0; q < n; ++q)
  {
    sum += g[q];
    for (long k = std::max(0L, q - 3); k <= std::min(n - 1, q + 4); ++k)
      result[k] += h * one_step[k - q + 3] * metric[k] * sum;
  }
}


std::vector<double> HalfCrackGrid::pressure(const double k, const std::vector<double> &m) const
{
  // p = k/4 + int_x^1 m (2/pi) acos(s) ds - int_0^x m (2/pi) asin(s) ds.
  const std::size_t n = size();
  std::vector<double> outer(n), inner(n), from_outer, from_inner;
  for (std::size_t i = 0; i < n; ++i)
  {
    outer[i] = 2. / pi * m[i] * std::atan2(chord[i], position[i]);
    inner[i] = 2. / pi * m[i] * std::atan2(position[i], chord[i]);
  }
  integrate_to_tip(outer, from_outer);
  // The integrand falls as a power of 1 - x beyond the last point.
  const double last = outer[n - 1] * metric[n - 1], before = outer[n - 2] * metric[n - 2];
  const double tail = last > 0. && before > last ? h * last / std::log(before / last) : 0.;
  for (std::size_t i = 0; i < n; ++i)
    from_outer[i] += tail;

  // Summed from the inlet.
  from_inner.assign(n, 0.);
  for (std::size_t i = 1; i < n; ++i)
  {
    double step = 0.;
    const long q = static_cast<long>(i) - 1;
    for (long j = std::max(0L, q - 3); j <= std::min(static_cast<long>(n) - 1, q + 4); ++j)
      step += h * one_step[j - q + 3] * inner[j] * metric[j];
    from_inner[i] = from_inner[i - 1] + step;
  }

  std::vector<double> p(n);
  for (std::size_t i = 0; i < n; ++i)
    p[i] = 0.25 * k + from_outer[i] - from_inner[i];
  return p;
}


double HalfCrackGrid::parameter(const double x) const
{
  if (x <= position.front())
    return first;
  if (x >= position.back())
    return first + (size() - 1) * h;
  return std::clamp(-std::log(-std::log(x)), first, first + (size() - 1) * h);
}
} // namespace stockwork::analytical
