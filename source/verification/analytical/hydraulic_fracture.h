#pragma once

#include "verification/analytical/crack_shape.h"
#include "verification/analytical/kgd.h"

#include <limits>
#include <memory>

namespace stockwork::analytical
{
/// A fracture driven from its middle at a constant rate through an elastic body, with what breaks
/// the similarity of the impermeable plane-strain fracture: a circular shape, leak-off, walls.
struct HydraulicFractureParameters
{
  /// A radial fracture takes the rate as m^3/s.
  KgdParameters fracture;

  /// Each face takes up fluid at the rate C_L / sqrt(t - t0(x)), t0(x) the time at which the tip
  /// passed x (Carter 1957; Adachi & Detournay 2008). m/sqrt(s)
  double leak_off_coefficient = 0.;

  /// A line fracture lies on y = 0 in |x| <= half_width, |y| <= half_height with rollers (no normal
  /// displacement, no shear) all round, m; infinite by default.
  double half_width = std::numeric_limits<double>::infinity();
  double half_height = std::numeric_limits<double>::infinity();

  CrackShape shape = CrackShape::line;
};


/// Marched once in the logarithm of time, by the backward differentiation formula of second order,
/// when the first number is asked for (some 0.5 s). Valid from 1e-6 of the last time to
/// valid_until(); accurate to 2e-4 in length, opening and pressure. "Half length" is the radius of
/// a radial fracture; its pressure has a logarithmic singularity at the inlet, where inlet_pressure
/// means nothing.
class HydraulicFracture
{
public:
  HydraulicFracture(const HydraulicFractureParameters &, double last_time);
  ~HydraulicFracture();
  HydraulicFracture(HydraulicFracture &&) noexcept;
  HydraulicFracture &operator=(HydraulicFracture &&) noexcept;

  /// The last time, or that of the last step (a tenth of the time) at which the fracture is shorter
  /// than 0.8 of the width, and found [s].
  double valid_until() const;

  double half_length(double t) const;
  double inlet_opening(double t) const;

  /// Net of the in-situ stress.
  double inlet_pressure(double t) const;

  /// x is the distance from the inlet.
  double opening(double x, double t) const;
  double pressure(double x, double t) const;

  /// Of both wings, m^2 per unit thickness, or of the radial fracture, m^3.
  double injected_volume(double t) const;
  double fracture_volume(double t) const;
  double leaked_volume(double t) const;

private:
  struct Steps;
  const Steps &steps() const;

  HydraulicFractureParameters parameters;
  double last_time;
  mutable std::unique_ptr<const Steps> marched;
};
} // namespace stockwork::analytical
