#include "verification/analytical/half_crack_grid.h"
#include "verification/analytical/constants.h"

#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace stockwork::analytical
{
namespace
{
constexpr double zeta_prime_2 = -0.03044845705839327; // zeta'(-2)
constexpr double zeta_prime_4 = 0.00798381145026862;  // zeta'(-4)
constexpr double left_parameter = -3.;                // x = 2e-9

// Integral over one step from the eight values around it, in units of the step.
constexpr std::array<double, 8> one_step = {{-191. / 120960., 1879. / 120960., -9531. / 120960.,
                                             68323. / 120960., 68323. / 120960., -9531. / 120960.,
                                             1879. / 120960., -191. / 120960.}};

// Central differences over seven points, in units of the step: first and third derivative.
constexpr std::array<double, 7> first_difference = {
  {-1. / 60., 3. / 20., -3. / 4., 0., 3. / 4., -3. / 20., 1. / 60.}};
constexpr std::array<double, 7> second_difference = {
  {1. / 90., -3. / 20., 3. / 2., -49. / 18., 3. / 2., -3. / 20., 1. / 90.}};
constexpr std::array<double, 7> third_difference = {
  {1. / 8., -1., 13. / 8., 0., -13. / 8., 1., -1. / 8.}};

// A place on the crack, with what would cancel if it were computed from x.
struct Place
{
  double x;
  double tip;   // 1 - x
  double chord; // sqrt(1 - x^2)
};


double line_kernel(const Place &field, const Place &source)
{
  const double ahead = field.tip - source.tip; // s - x
  const double chords = field.chord + source.chord;
  double sum =
    -2. * field.x * std::log1p(-(field.chord * source.tip + source.chord * field.tip) / chords);
  if (ahead != 0.)
    sum += ahead * std::log(chords * chords / (std::abs(ahead) * (source.x + field.x)));
  return 4. / pi * sum;
}


// (8/pi) s int_0^acos(s) sqrt(1 - (x/s)^2 cos^2) for s > x,
// (8/pi) (s^2/x) int_0^acos(x) sin^2 / sqrt(1 - (s/x)^2 cos^2) for s < x, in Carlson's functions.
double penny_kernel(const Place &field, const Place &source)
{
  using boost::math::ellint_rd;
  using boost::math::ellint_rf;

  const double ahead = field.tip - source.tip;
  if (ahead == 0.)
    return 8. / pi * source.x * source.tip;
  const Place &outer = ahead > 0. ? source : field, &inner = ahead > 0. ? field : source;
  const double k2 = std::pow(inner.x / outer.x, 2);
  const double c2 = std::abs(ahead) * (outer.x + inner.x) / (outer.x * outer.x); // 1 - k2
  const double u = outer.chord;
  const double y = c2 * outer.x * outer.x, z = c2 + k2 * u * u;
  const double sine_squared = u * u * u * c2 / 3. * ellint_rd(y, z, c2);
  return 8. / pi *
         (ahead > 0. ? source.x * (c2 * u * ellint_rf(c2, y, z) + k2 * sine_squared)
                     : source.x * source.x / field.x * sine_squared);
}
} // namespace


HalfCrackGrid::HalfCrackGrid(const CrackShape shape, const double step, const double last)
  : crack(shape)
  , h(step)
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
    const Place field{position[i], tip_distance[i], chord[i]};
    for (std::size_t j = 0; j < n; ++j)
    {
      const Place source{position[j], tip_distance[j], chord[j]};
      matrix[i][j] =
        h * metric[j] *
        (shape == CrackShape::line ? line_kernel(field, source) : penny_kernel(field, source));
    }

    // The trapezoidal rule is exact to all orders but for the singularity
    // -(4/pi) d (1 + curvature d) ln|d| at d = s - x = 0, whose error is an expansion in zeta'(-2),
    // zeta'(-4), ... (Navot 1962) times derivatives by v of s and of m ds/dv.
    const double curvature = shape == CrackShape::line ? 0. : 0.25 / position[i];
    const double e = minus_log(i);
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
        metric[j] * (c2 * (d1 * f1 + (d2 / 2. + curvature * d1 * d1) * f0) +
                     c4 * (d1 * f3 / 6. + d2 / 2. * f2 / 2. + d3 / 6. * f1 + d4 / 24. * f0));
    }
  }
}


void HalfCrackGrid::integrate(const std::vector<double> &f, std::vector<double> &result) const
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


void HalfCrackGrid::integrate_to_tip(const std::vector<double> &f,
                                     std::vector<double> &result) const
{
  std::vector<double> weighted(f);
  for (std::size_t i = 0; i < size(); ++i)
    weighted[i] *= measure(i);
  integrate(weighted, result);
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
      result[k] += h * one_step[k - q + 3] * metric[k] * measure(k) * sum;
  }
}


std::vector<double> HalfCrackGrid::pressure(const double k, const std::vector<double> &m) const
{
  // p = p_k + int_x^1 m (1 - g) ds - int_0^x m g ds, where g is the uniform pressure with the
  // stress intensity of unit pressure on |x| < s, and p_k that with the intensity of k.
  const bool line = crack == CrackShape::line;
  const std::size_t n = size();
  std::vector<double> outer(n), inner(n), from_outer, from_inner;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double x = position[i];
    outer[i] = m[i] * (line ? 2. / pi * std::atan2(chord[i], x) : chord[i]);
    inner[i] = m[i] * (line ? 2. / pi * std::atan2(x, chord[i]) : x * x / (1. + chord[i]));
  }
  integrate(outer, from_outer);
  // The integrand falls as a power of 1 - x beyond the last point.
  const double last = outer[n - 1] * metric[n - 1], before = outer[n - 2] * metric[n - 2];
  const double tail = last > 0. && before > last ? h * last / std::log(before / last) : 0.;

  integrate(inner, from_inner);
  std::vector<double> p(n);
  for (std::size_t i = 0; i < n; ++i)
    p[i] = (line ? 0.25 : pi / 8.) * k + from_outer[i] + tail - (from_inner[0] - from_inner[i]);
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
