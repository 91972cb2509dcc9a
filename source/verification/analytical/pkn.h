#pragma once

#include <vector>

namespace stockwork::analytical
{
/// A long fracture of constant height with elliptical cross sections and no leak-off, driven from
/// its middle at a constant rate (Perkins & Kern 1961, Nordgren 1972; similarity after Kemp 1990):
///   w_t = E'/(32 mu h) (w^3 w_x)_x,  p = E' w / (2 h),
/// w the opening in the middle of the section. Valid for lengths well above the height.
struct PknParameters
{
  double youngs_modulus; ///< Pa
  double poisson_ratio;
  double viscosity; ///< mu, Pa s
  double height;    ///< h, m
  double rate;      ///< into one wing, m^3/s
};


class Pkn
{
public:
  explicit Pkn(const PknParameters &);

  /// Length of one wing, m.
  double length(double t) const;

  /// In the middle of the section at x, m.
  double opening(double x, double t) const;
  double inlet_opening(double t) const;

  /// Net of the in-situ stress, Pa.
  double pressure(double x, double t) const;
  double inlet_pressure(double t) const;

  /// Of one wing, m^3.
  double volume(double t) const;

private:
  // w(x, t) over w scaled by t^(1/5), at theta = x/length.
  double similarity(double theta) const;

  PknParameters parameters;
  double modulus;
  double length_factor;  // length = length_factor t^(4/5)
  double opening_factor; // w = opening_factor t^(1/5) W(theta)

  // W^3 and its slope, from the tip to the inlet at equal distances.
  std::vector<double> cube, slope;
};
} // namespace stockwork::analytical
