#pragma once

#include "verification/analytical/kgd.h"

#include <limits>
#include <memory>

namespace stockwork::analytical
{
/// A KGD fracture with what breaks its similarity: leak-off, walls, or both.
struct KgdHistoryParameters
{
  KgdParameters fracture;

  /// Each face takes up fluid at the rate C_L / sqrt(t - t0(x)), t0(x) the time at which the tip
  /// passed x (Carter 1957; Adachi & Detournay 2008). m/sqrt(s)
  double leak_off_coefficient = 0.;

  /// The fracture lies on y = 0 in |x| <= half_width, |y| <= half_height with rollers (no normal
  /// displacement, no shear) all round, m; infinite by default.
  double half_width = std::numeric_limits<double>::infinity();
  double half_height = std::numeric_limits<double>::infinity();
};


/// Marched once in the logarithm of time when made (some 0.5 s), by the backward differentiation
/// formula of second order. Valid from 1e-6 of the last time to the last time; accurate to 2e-4 in
/// length, opening and pressure, with walls as long as the fracture stays below 0.8 of the width.
class KgdHistory
{
public:
  KgdHistory(const KgdHistoryParameters &, double last_time);
  ~KgdHistory();
  KgdHistory(KgdHistory &&) noexcept;
  KgdHistory &operator=(KgdHistory &&) noexcept;

  double half_length(double t) const;
  double inlet_opening(double t) const;

  /// Net of the in-situ stress.
  double inlet_pressure(double t) const;

  /// x is the distance from the inlet, either wing.
  double opening(double x, double t) const;
  double pressure(double x, double t) const;

  /// Volumes of both wings, m^2 per unit thickness.
  double injected_volume(double t) const;
  double fracture_volume(double t) const;
  double leaked_volume(double t) const;

private:
  struct Steps;
  std::unique_ptr<const Steps> steps;
};
} // namespace stockwork::analytical
