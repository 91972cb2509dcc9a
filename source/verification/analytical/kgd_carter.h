#pragma once

#include "verification/analytical/kgd.h"

#include <memory>

namespace stockwork::analytical
{
/// A KGD fracture whose walls take up fluid at the rate C_L / sqrt(t - t0(x)) per face (Carter
/// 1957; Adachi & Detournay 2008), t0(x) the time at which the tip passed x.
struct KgdCarterParameters
{
  KgdParameters fracture;
  double leak_off_coefficient; ///< C_L of one face, m/sqrt(s)
};


/// Marched once in the logarithm of time (some 1 s when made), from 1e-10 to 1 of the last time,
/// by the backward differentiation formula of second order. Valid from 1e-6 of the last time to the
/// last time; accurate to 2e-4 in length, opening and pressure.
class KgdCarter
{
public:
  KgdCarter(const KgdCarterParameters &, double last_time);
  ~KgdCarter();
  KgdCarter(KgdCarter &&) noexcept;
  KgdCarter &operator=(KgdCarter &&) noexcept;

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
  struct History;
  std::unique_ptr<const History> history;
};
} // namespace stockwork::analytical
