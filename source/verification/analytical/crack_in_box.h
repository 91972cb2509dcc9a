#pragma once

#include <vector>

namespace stockwork::analytical
{
/// A pressurised crack |x| <= a, y = 0 in the rectangle |x| <= W, |y| <= H in plane strain, with
/// rollers (no normal displacement, no shear) on all four sides. A model of the half x >= 0 with a
/// symmetry plane at x = 0 is the same problem.
struct CrackInBoxParameters
{
  double youngs_modulus; ///< Pa
  double poisson_ratio;
  double half_length;  ///< a, m
  double half_width;   ///< W > a, m
  double half_height;  ///< H, m
  double net_pressure; ///< Pa
};

/// The walls mirror the crack, so that the pressure is a Fourier series of the opening with the
/// stiffness of an elastic layer; its leading part is the closed kernel of a row of collinear
/// cracks, the rest is smooth. Solved once by Chebyshev collocation, accurate to 1e-7 for
/// a <= 0.8 W and H >= W/4.
class CrackInBox
{
public:
  explicit CrackInBox(const CrackInBoxParameters &);

  /// Full opening at the distance x from the centre, m.
  double opening(double x) const;

  /// m^2 per unit thickness.
  double volume() const;

  /// Mode I, Pa sqrt(m).
  double stress_intensity() const;

private:
  CrackInBoxParameters parameters;
  double modulus; // E', Pa
  std::vector<double> slope;
};
} // namespace stockwork::analytical
