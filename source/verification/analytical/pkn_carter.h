#pragma once

#include "verification/analytical/pkn.h"

namespace stockwork::analytical
{
/// A long fracture of constant height with elliptical cross sections and Carter leak-off (Nordgren
/// 1972), which in length, time and opening of its own,
///   t* = (pi^3 mu Q^2 / (16 C_L^5 h E'))^(2/3), w* = (8 C_L/pi) t*^(1/2), x* = pi E' w*^4/(512 mu
///   Q),
/// has no parameter: W_T = (W^4)_XX - 1/sqrt(T - T0(X)), -(W^4)_X(0) = 1. Valid for lengths well
/// above the height.
class PknCarter
{
public:
  /// @param leak_off_coefficient C_L of one face, m/sqrt(s)
  PknCarter(const PknParameters &, double leak_off_coefficient);

  /// Length of one wing, m.
  double length(double t) const;

  /// In the middle of the section, m.
  double inlet_opening(double t) const;

  /// Net of the in-situ stress, Pa.
  double inlet_pressure(double t) const;

  /// Of one wing, m^3.
  double volume(double t) const;
  double leaked_volume(double t) const;

private:
  PknParameters parameters;
  double modulus;
  double time_scale, opening_scale, length_scale; // t*, w*, x*
};
} // namespace stockwork::analytical
