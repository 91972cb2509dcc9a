#include "fracture/peridynamics/stencil.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
namespace
{
/// Area of the disc of radius @p r about the origin inside [0,x] x [0,y]; odd in x and y.
double area_from_centre(double x, double y, const double r)
{
  const double sign = (x < 0. ? -1. : 1.) * (y < 0. ? -1. : 1.);
  x = std::min(std::abs(x), r);
  y = std::min(std::abs(y), r);
  if (x * x + y * y <= r * r)
    return sign * x * y;
  // Up to the abscissa where the circle comes down to y the rectangle counts, then the circle.
  const auto below_circle = [r](const double t)
  { return 0.5 * (t * std::sqrt(std::max(0., r * r - t * t)) + r * r * std::asin(t / r)); };
  const double a = std::sqrt(std::max(0., r * r - y * y));
  return sign * (a * y + below_circle(x) - below_circle(a));
}

/// Area of a unit square at @p centre inside the disc.
double square_in_disc(const double cx, const double cy, const double r)
{
  return area_from_centre(cx + 0.5, cy + 0.5, r) - area_from_centre(cx - 0.5, cy + 0.5, r) -
         area_from_centre(cx + 0.5, cy - 0.5, r) + area_from_centre(cx - 0.5, cy - 0.5, r);
}

/// Volume of a unit cube inside the ball: slices, integrated from one change of the slice's shape
/// to the next. There the area starts or ends like a half-integer power, which becomes smooth in
/// phi with t = a + (b - a) sin^2(phi); hence exact up to rounding.
double cube_in_ball(const std::array<int, 3> &centre, const double r)
{
  const double low = centre[2] - 0.5, high = std::min(centre[2] + 0.5, r);
  std::vector<double> knots{low, high};
  const auto add = [&](const double square) { // of the slice's radius
    for (const double sign : {-1., 1.})
      if (square < r * r)
        if (const double t = sign * std::sqrt(r * r - square); t > low && t < high)
          knots.push_back(t);
  };
  for (const double x : {centre[0] - 0.5, centre[0] + 0.5})
  {
    add(x * x);
    for (const double y : {centre[1] - 0.5, centre[1] + 0.5})
    {
      add(y * y);
      add(x * x + y * y);
    }
  }
  std::sort(knots.begin(), knots.end());

  static const dealii::QGauss<1> rule(24);
  double volume = 0.;
  for (unsigned int k = 0; k + 1 < knots.size(); ++k)
    if (const double length = knots[k + 1] - knots[k]; length > 0.)
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double phi = 0.5 * M_PI * rule.point(q)[0];
        const double t = knots[k] + length * std::sin(phi) * std::sin(phi);
        const double slice =
          square_in_disc(centre[0], centre[1], std::sqrt(std::max(0., r * r - t * t)));
        volume += rule.weight(q) * 0.5 * M_PI * length * std::sin(2. * phi) * slice;
      }
  return volume;
}

/// Share of the unit cell at @p offset inside the horizon.
template <int dim>
double share_in_horizon(std::array<int, dim> offset, const double horizon)
{
  // Equal offsets up to symmetry shall have equal shares to the last digit.
  for (int &component : offset)
    component = std::abs(component);
  std::sort(offset.begin(), offset.end());
  const double share = [&]
  {
    if constexpr (dim == 2)
      return square_in_disc(offset[0], offset[1], horizon);
    else
      return cube_in_ball(offset, horizon);
  }();
  return share > 1e-10 ? share : 0.; // else rounding
}

/// Whether the last non-zero component is positive.
template <int dim>
bool is_forward(const std::array<int, dim> &offset)
{
  for (int d = dim - 1; d >= 0; --d)
    if (offset[d] != 0)
      return offset[d] > 0;
  return false;
}

/// sum_i n_i^4 less its mean over all directions.
template <int dim>
double cubic_harmonic(const dealii::Tensor<1, dim> &n)
{
  double sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    sum += n[d] * n[d] * n[d] * n[d];
  return sum - 3. / (dim + 2.);
}

/// VolumeRule::isotropic. The stiffness of a bond enters the moduli as beta |xi| n n n n, whose
/// part that is not isotropic is its projection on the cubic harmonic.
template <int dim>
void make_isotropic(std::vector<StencilBond<dim>> &bonds)
{
  double first = 0., second = 0.;
  for (const auto &bond : bonds)
  {
    const double h = cubic_harmonic(bond.direction());
    first += bond.volume_fraction * bond.length() * h;
    second += bond.volume_fraction * bond.length() * h * h;
  }
  for (auto &bond : bonds)
    bond.volume_fraction *= 1. - first / second * cubic_harmonic(bond.direction());
}
} // namespace

template <int dim>
double StencilBond<dim>::length() const
{
  double square = 0.;
  for (const int component : offset)
    square += component * component;
  return std::sqrt(square);
}

template <int dim>
dealii::Tensor<1, dim> StencilBond<dim>::direction() const
{
  dealii::Tensor<1, dim> n;
  for (unsigned int d = 0; d < dim; ++d)
    n[d] = offset[d] / length();
  return n;
}

template <int dim>
std::vector<StencilBond<dim>> horizon_stencil(const unsigned int m, const VolumeRule rule)
{
  const int reach = m + 1;
  const double horizon = m;
  std::vector<StencilBond<dim>> bonds;
  std::array<int, dim> offset;
  // From the site itself upwards, x fastest, the forward half comes in the order of memory.
  for (int z = (dim == 3 ? 0 : reach); z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
      {
        if constexpr (dim == 3)
          offset = {{x, y, z}};
        else
          offset = {{x, y}};
        if (!is_forward<dim>(offset))
          continue;
        StencilBond<dim> bond{offset, 0.};
        const double length = bond.length();
        const bool centre_inside = length <= horizon * (1. + 1e-12);
        switch (rule)
        {
        case VolumeRule::exact:
        case VolumeRule::isotropic:
          bond.volume_fraction = share_in_horizon<dim>(offset, horizon);
          break;
        case VolumeRule::full:
          bond.volume_fraction = centre_inside;
          break;
        case VolumeRule::ramp:
          bond.volume_fraction = centre_inside ? std::min(1., horizon + 0.5 - length) : 0.;
          break;
        }
        if (bond.volume_fraction > 0.)
          bonds.push_back(bond);
      }

  if (rule == VolumeRule::isotropic)
    make_isotropic(bonds);

  const unsigned int half = bonds.size();
  for (unsigned int b = 0; b < half; ++b)
  {
    StencilBond<dim> back = bonds[b];
    for (int &component : back.offset)
      component = -component;
    bonds.push_back(back);
  }
  return bonds;
}

template struct StencilBond<2>;
template struct StencilBond<3>;
template std::vector<StencilBond<2>> horizon_stencil<2>(const unsigned int, const VolumeRule);
template std::vector<StencilBond<3>> horizon_stencil<3>(const unsigned int, const VolumeRule);
} // namespace stockwork::peridynamics
