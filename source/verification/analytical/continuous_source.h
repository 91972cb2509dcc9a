#pragma once

#include "verification/analytical/poroelastic_medium.h"

namespace stockwork::analytical
{
/// Fluid that is injected at a constant rate from t = 0 on, along a line (in plane strain) or at a
/// point, in an unbounded poroelastic body at rest. The displacement has no rotation, so the
/// pressure diffuses with c = k/(mu S), S = 1/M + alpha^2/(lambda + 2G), as if the rock did not
/// move (Rudnicki 1986, Int. J. Solids Struct. 22; the line is Theis 1935, Trans. AGU 16):
///
///   line:   p = Q mu/(4 pi k) E_1(r^2/(4 c t))
///   point:  p = Q mu/(4 pi k r) erfc(r/sqrt(4 c t))
///   both:   (lambda + 2G) div u = alpha p
struct ContinuousSource
{
  enum class Shape
  {
    line,
    point
  };

  Shape shape;
  PoroelasticMedium medium;

  /// Over in situ, per rate [Pa s/m^2; Pa s/m^3 of a point], r > 0; zero for t <= 0.
  double pressure(double r, double t) const;

  /// Outward [m], per rate.
  double displacement(double r, double t) const;
};
} // namespace stockwork::analytical
