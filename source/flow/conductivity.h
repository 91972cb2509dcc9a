#pragma once

#include <cmath>

namespace stockwork
{
/// A value that depends on one number, and its derivative.
struct ValueAndSlope
{
  double value;
  double slope;
};

/// Cube of the hydraulic aperture, w_h^3 [m^3], with
///
///   w_h = (w^4 + w_min^4)^(1/4) for w > 0, w_min else.
///
/// The smooth maximum leaves an open fracture alone: at w = 3 w_min it adds 0.3 %, where the sum
/// w + w_min would add 33 %. The floor keeps a closed fracture from being a perfect seal; it
/// belongs in the conductivity only, never in the storage. Continuous with two derivatives at w =
/// 0.
inline ValueAndSlope hydraulic_aperture_cubed(const double w, const double w_min)
{
  if (w <= 0.)
    return {w_min * w_min * w_min, 0.};
  // The larger of the two is taken out of the root, so that nothing underflows.
  const double large = std::max(w, w_min), a = w / large, b = w_min / large;
  const double w_h = large * std::sqrt(std::sqrt(a * a * a * a + b * b * b * b));
  return {w_h * w_h * w_h, 3. * w * w * w / w_h};
}

/// What the pressure gradient between the last segment of a fracture and the one before it is, over
/// the difference quotient of their mean pressures. Near the tip of a fracture that is driven
/// through viscous fluid, p - p_0 ~ -x^(-1/3) at the distance x from the tip (w ~ x^(2/3),
/// Desroches et al. 1994), and the quotient is nearly twice the gradient at the edge (0.538 for
/// equal lengths). Without this the tip takes in fluid too easily and has too little suction, and
/// the fracture becomes too long, by more than a segment. Where toughness dominates, the pressure
/// at the tip hardly varies and the factor does not matter.
/// @param d_tip, d_next distances from the centres to the shared edge [m]: half the lengths
inline double tip_gradient_factor(const double d_tip, const double d_next)
{
  const double a = 2. * d_tip, end = a + 2. * d_next;
  const double mean_tip = 1.5 / std::cbrt(a);
  const double mean_next = 1.5 * (std::cbrt(end * end) - std::cbrt(a * a)) / (end - a);
  return (d_tip + d_next) / (3. * a * std::cbrt(a)) / (mean_tip - mean_next);
}

/// Transmissibility T of the cubic law between two segments, flow = T (p_i - p_j) [m^3/s; m^2/s per
/// unit thickness in 2-D], and its derivatives with respect to both apertures.
struct Transmissibility
{
  double value; ///< [m^3/(Pa s)]
  double slope_i;
  double slope_j;
};

/// Poiseuille flow between two centres with the aperture that their linear interpolation has at the
/// shared edge. The harmonic mean, which suits layers of different rock, would let a closed tip
/// seal itself: what it lets in would be limited by its own aperture, although an open segment
/// is next to it, and a fracture in viscous fluid would only creep on.
/// @param w_i, w_j apertures [m]
/// @param d_i, d_j distances from the centres to the edge [m]
inline Transmissibility cubic_law(const double w_i,
                                  const double w_j,
                                  const double d_i,
                                  const double d_j,
                                  const double width,
                                  const double viscosity,
                                  const double w_min)
{
  const double distance = d_i + d_j, share_i = d_j / distance, share_j = d_i / distance;
  const ValueAndSlope cube = hydraulic_aperture_cubed(share_i * w_i + share_j * w_j, w_min);
  const double factor = width / (12. * viscosity * distance);
  return {factor * cube.value, factor * cube.slope * share_i, factor * cube.slope * share_j};
}
} // namespace stockwork
