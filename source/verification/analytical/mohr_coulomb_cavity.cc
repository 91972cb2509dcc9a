#include "verification/analytical/mohr_coulomb_cavity.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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
  const double sine = std::sin(p.dilation_angle), dilates = (1. + sine) / (1. - sine);
  const double m = p.n_hoop;
  flow = converges ? dilates : 1. / dilates;
  k = m * flow;
  outer = p.radius; // until it is known that the rock yields
  const double exponent = (converges ? 1. / (N - 1.) : N / (1. - N)) / m;
  const auto reach = [&](const double stress)
  { return p.radius * std::pow((stress + H) / (wall + H), exponent); };
  edge = p.n_hoop == 2 ? std::numeric_limits<double>::infinity() : p.radius;
  if (converges && p.n_hoop == 1)
  {
    const double nu = p.poisson_ratio;
    const double at_edge = (p.in_situ * (1. - 2. * nu) - Y * (1. - nu)) / (N - nu * (1. + N));
    if (at_edge > wall)
      edge = reach(at_edge);
  }
  outer = std::max(p.radius, reach(at_outer()));
}


double MohrCoulombCavity::at_outer() const
{
  // Elastic: the stresses across the radius lie as far on the other side of the in-situ one, m-th.
  const double m = p.n_hoop;
  return converges ? ((m + 1.) * p.in_situ - m * Y) / (m * N + 1.)
                   : (N * (m + 1.) * p.in_situ + m * Y) / (N + m);
}


double MohrCoulombCavity::source(const double r) const
{
  const double exponent = p.n_hoop * (converges ? N - 1. : 1. / N - 1.);
  const double radial = (wall + H) * std::pow(r / p.radius, exponent) - H;
  const double hoop = converges ? N * radial + Y : (radial - Y) / N;
  const double nu = p.poisson_ratio;
  const bool flows_along = r < edge;
  const double along = flows_along ? hoop : p.in_situ + nu * (radial + hoop - 2. * p.in_situ);
  const auto strain = [&](const double s, const double other, const double another)
  { return -((s - p.in_situ) - nu * (other + another - 2. * p.in_situ)) / p.young_modulus; };
  double sum = strain(radial, hoop, along) + flow * strain(hoop, radial, along);
  if (flows_along)
    sum += flow * strain(along, radial, hoop);
  return std::pow(r, k) * sum;
}


double MohrCoulombCavity::displacement(const double r) const
{
  const double m = p.n_hoop, stress = outer > p.radius ? at_outer() : wall;
  const auto elastic = [&](const double radius)
  {
    return (1. + p.poisson_ratio) / (m * p.young_modulus) * (stress - p.in_situ) * outer *
           std::pow(outer / radius, m);
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
