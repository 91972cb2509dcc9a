#pragma once

#include "verification/analytical/kgd.h"

namespace stockwork::analytical
{
/// Half length of a fracture of constant width that leaks by C/sqrt(t - t0) through each face, t0
/// the time at which the tip passed (Carter 1957, in Howard & Fast, Drilling and Production
/// Practice, API):
///
///   l = Q w / (8 pi C^2) (exp(S^2) erfc(S) + 2 S/sqrt(pi) - 1),     S = 2 C sqrt(pi t) / w.
///
/// Without leak-off l = Q t/(2 w); with no width l = Q sqrt(t)/(2 pi C).
/// @param rate Q, of both wings [m^2/s]
/// @param width w [m]
/// @param coefficient C of one face [m/s^(1/2)]
double carter_half_length(double rate, double width, double coefficient, double t);

/// Linear in the net pressure: of rock that resists by its own pore fluid, C is in proportion to
/// the excess of the fracture's pressure over that of the pores.
struct LeakOffCoefficient
{
  double at_closure = 0.;       ///< at no net pressure [m/s^(1/2)]
  double per_net_pressure = 0.; ///< [m/(s^(1/2) Pa)]
};

struct LeakingFracture
{
  double half_length; ///< [m]
  double efficiency;  ///< volume of the fracture over what has been injected
};

/// About how long a plane-strain fracture is that leaks, and how much of the fluid is in it:
/// Carter's length with the mean width that the impermeable fracture (Kgd, whatever its toughness
/// and viscosity) has at this length. Exact without leak-off; with it, within 3 % in length and 5 %
/// in efficiency of Adachi & Detournay (2008) for any toughness and any share leaked (tests).
LeakingFracture
leaking_kgd(const KgdParameters &parameters, const LeakOffCoefficient &leak_off, double t);
} // namespace stockwork::analytical
