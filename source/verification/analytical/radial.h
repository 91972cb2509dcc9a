#pragma once

#include "verification/analytical/kgd.h"

namespace stockwork::analytical
{
/// Of a radial fracture in impermeable rock, kappa = K' (t^2/(mu'^5 Q0^3 E'^13))^(1/18) with K' = 4
/// sqrt(2/pi) K_Ic and mu' = 12 mu, which grows with time: below 1 viscosity governs, above 3.5
/// toughness (Savitski & Detournay 2002). Takes the rate as m^3/s.
double radial_toughness(const KgdParameters &parameters, double t);

/// Its radius [m], from those of the vertices, 0.6976 (E' Q0^3 t^4/mu')^(1/9) and 0.8546 (E' Q0
/// t/K')^(2/5), to 0.5 % of HydraulicFracture for any toughness (test), and in no time.
double radial_radius(const KgdParameters &parameters, double t);
} // namespace stockwork::analytical
