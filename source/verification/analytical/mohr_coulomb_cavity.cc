#include "verification/analytical/mohr_coulomb_cavity.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>

namespace stockwork::analytical
{
MohrCoulombCavity::MohrCoulombCavity(const Parameters &parameters)
  : p(parameters)
{
  const double sine = std::sin(p.friction_angle);
  N = (1. + sine) / (1. - sine);
  Y = 2. * p.cohesion * std::cos(p.friction_angle) / (1. - sine);
  H = Y / (N - 1.);
  set_wall_pressure(p.in_situ);
}


void MohrCoulombCavity::set_wall_pressure(const double pressure)
{
  wall = std::max(pressure, 0.); // rounding may have left less
  converges = wall <= p.in_situ;
  const double sine = std::sin(p.dilation_angle), flow = (1. + sine) / (1. - sine);
  k = converges ? flow : 1. / flow;
  const double at_outer =
    converges ? (2. * p.in_situ - Y) / (N + 1.) : (2. * N * p.in_situ + Y) / (N + 1.);
  const double exponent = converges ? 1. / (N - 1.) : N / (1. - N);
  outer = p.radius * std::max(1., std::pow((at_outer + H) / (wall + H), exponent));
  edge = p.radius;
  if (converges)
  {
    const double nu = p.poisson_ratio;
    const double at_edge = (p.in_situ * (1. - 2. * nu) - Y * (1. - nu)) / (N - nu * (1. + N));
    if (at_edge > wall)
      edge = p.radius * std::pow((at_edge + H) / (wall + H), exponent);
  }
}


double MohrCoulombCavity::source(const double r) const
{
  const double radial = (wall + H) * std::pow(r / p.radius, converges ? N - 1. : 1. / N - 1.) - H;
  const double hoop = converges ? N * radial + Y : (radial - Y) / N;
  const double nu = p.poisson_ratio;
  const bool flows_along = r < edge;
  const double along = flows_along ? hoop : p.in_situ + nu * (radial + hoop - 2. * p.in_situ);
  const auto strain = [&](const double s, const double other, const double another)
  { return -((s - p.in_situ) - nu * (other + another - 2. * p.in_situ)) / p.young_modulus; };
  double sum = strain(radial, hoop, along) + k * strain(hoop, radial, along);
  if (flows_along)
    sum += k * strain(along, radial, hoop);
  return std::pow(r, k) * sum;
}


double MohrCoulombCavity::displacement(const double r) const
{
  const double at_outer =
    outer > p.radius ? (converges ? (2. * p.in_situ - Y) : (2. * N * p.in_situ + Y)) / (N + 1.)
                     : wall;
  const auto elastic = [&](const double radius)
  {
    return (1. + p.poisson_ratio) / p.young_modulus * (at_outer - p.in_situ) * outer * outer /
           radius;
  };
  if (r >= outer)
    return elastic(r);
  using boost::math::quadrature::gauss_kronrod;
  const auto integral = [&](const double from, const double to)
  {
    return to > from
             ? gauss_kronrod<double, 15>::integrate(
                 [this](const double radius) { return source(radius); }, from, to, 10, 1e-11)
             : 0.;
  };
  const double between = std::clamp(edge, r, outer);
  return (std::pow(outer, k) * elastic(outer) - integral(r, between) - integral(between, outer)) /
         std::pow(r, k);
}
} // namespace stockwork::analytical
