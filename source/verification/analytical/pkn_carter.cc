#include "verification/analytical/pkn_carter.h"

#include "verification/analytical/constants.h"

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stockwork::analytical
{
namespace
{
constexpr double ln_10 = 2.302585092994046, first_exponent = -12., rows_per_decade = 2.;

// Length, opening at the inlet and share of the fluid that is in the fracture at T = 1e-12 ... 1e9,
// two in a decade: the project's numerical solution of Nordgren's equation, on a grid that moves
// with the tip. It keeps to the storage limit within 2e-8 and to the leak-off limit within 5e-11 in
// length, both extrapolated with their known corrections, and to a second method, with cells that
// stay, within 1e-5 at T = 0.9.
constexpr double rows[][3] = {
  {3.316681e-10, 0.004001076, 0.9995307}, {8.329954e-10, 0.00503683, 0.9993372},
  {2.091974e-09, 0.006340589, 0.9990639}, {5.253327e-09, 0.007981611, 0.9986781},
  {1.319053e-08, 0.01004698, 0.9981334},  {3.311458e-08, 0.01264613, 0.9973647},
  {8.311435e-08, 0.0159165, 0.9962803},   {2.085409e-07, 0.02003053, 0.9947511},
  {5.230063e-07, 0.02520422, 0.9925964},  {1.310813e-06, 0.03170766, 0.9895635},
  {3.282294e-06, 0.03987755, 0.9853004},  {8.208318e-06, 0.05013194, 0.9793204},
  {2.049003e-05, 0.06298691, 0.9709561},  {5.101788e-05, 0.07907438, 0.9593041},
  {0.0001265747, 0.09915905, 0.9431646},  {0.0003124612, 0.1241511, 0.9209886},
  {0.0007659775, 0.155108, 0.8908618},    {0.001859722, 0.1932168, 0.8505792},
  {0.004456079, 0.2397444, 0.7979004},    {0.01048961, 0.2959486, 0.7310951},
  {0.02412636, 0.3629553, 0.6498449},     {0.05389868, 0.4416465, 0.5563427},
  {0.1163401, 0.5326513, 0.4559954},      {0.241909, 0.636535, 0.3567843},
  {0.4848814, 0.7541631, 0.266926},       {0.9408965, 0.8870433, 0.1920667},
  {1.778871, 1.037454, 0.133994},         {3.29847, 1.208386, 0.0913656},
  {6.032505, 1.403446, 0.06130148},       {10.92887, 1.62682, 0.04067844},
  {19.6739, 1.883295, 0.02679417},        {35.26725, 2.17833, 0.01756236},
  {63.04412, 2.518162, 0.01147418},       {112.4931, 2.909934, 0.007480678},
  {200.4887, 3.361848, 0.004870346},      {357.04, 3.883334, 0.003168016},
  {635.5131, 4.485254, 0.002059493},      {1130.809, 5.180129, 0.001338343},
  {2011.691, 5.982398, 0.000869495},      {3578.27, 6.908725, 0.0005648027},
  {6364.227, 7.97834, 0.0003668436},      {11318.6, 9.213445, 0.0002382515},
  {20129.06, 10.63967, 0.0001547288},
};

enum Column
{
  length_column,
  opening_column,
  efficiency_column
};


/// One of these, as its logarithm over that of time; beyond the table by the power of its limit.
class PowerLike
{
public:
  /// @param first, last powers of time in the storage and in the leak-off limit
  PowerLike(const Column column, const double first, const double last)
    : first(first)
    , last(last)
    , spline(make_spline(column, first, last))
  {
  }

  double operator()(const double time) const
  {
    const double x = std::log(time), inside = std::clamp(x, first_logarithm, last_logarithm);
    return std::exp(spline(inside) + (x < inside ? first : last) * (x - inside));
  }

private:
  using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;

  static Spline make_spline(const Column column, const double first, const double last)
  {
    std::vector<double> logarithms;
    for (const auto &row : rows)
      logarithms.push_back(std::log(row[column]));
    return Spline(logarithms.begin(), logarithms.end(), first_logarithm, step, first, last);
  }

  static constexpr double step = ln_10 / rows_per_decade, first_logarithm = first_exponent * ln_10,
                          last_logarithm = first_logarithm + (std::size(rows) - 1) * step;

  double first, last;
  Spline spline;
};


double dimensionless_length(const double time)
{
  static const PowerLike values(length_column, 0.8, 0.5);
  return values(time);
}


double dimensionless_opening(const double time)
{
  static const PowerLike values(opening_column, 0.2, 0.125);
  return values(time);
}


double efficiency(const double time)
{
  static const PowerLike values(efficiency_column, 0., -0.375);
  return values(time);
}
} // namespace


PknCarter::PknCarter(const PknParameters &parameters, const double leak_off_coefficient)
  : parameters(parameters)
  , modulus(parameters.youngs_modulus / (1. - parameters.poisson_ratio * parameters.poisson_ratio))
  , time_scale(std::pow(pi * pi * pi * parameters.viscosity * parameters.rate * parameters.rate /
                          (16. * std::pow(leak_off_coefficient, 5) * parameters.height * modulus),
                        2. / 3.))
  , opening_scale(8. * leak_off_coefficient / pi * std::sqrt(time_scale))
  , length_scale(pi * modulus * std::pow(opening_scale, 4) /
                 (512. * parameters.viscosity * parameters.rate))
{
}


double PknCarter::length(const double t) const
{
  return length_scale * dimensionless_length(t / time_scale);
}


double PknCarter::inlet_opening(const double t) const
{
  return opening_scale * dimensionless_opening(t / time_scale);
}


double PknCarter::inlet_pressure(const double t) const
{
  return modulus * inlet_opening(t) / (2. * parameters.height);
}


double PknCarter::volume(const double t) const
{
  return efficiency(t / time_scale) * parameters.rate * t;
}


double PknCarter::leaked_volume(const double t) const
{
  return parameters.rate * t - volume(t);
}
} // namespace stockwork::analytical
