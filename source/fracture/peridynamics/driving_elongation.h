#pragma once

#include <cmath>

namespace stockwork::peridynamics
{
/// What drives the damage D of a bond, or breaks it: the energy that it would set free. With k and
/// e its stiffness and elongation, and F the force that the dilatations of its ends exert on it,
/// that is
///
///   -dW/dD = 1/2 k e^2 + e F,
///
/// which a mere spring has at the elongation E = sqrt(e^2 + 2 e F/k). A bond softens by E as a
/// spring does by e. So it dissipates what a spring does, whatever the dilatations are on the way,
/// and a fracture takes what the springs across it take. By e itself it would take 3 to 5 per cent
/// more or less at Poisson's ratios of 0.35 and 0.15, and that by the stress along the fracture
/// (doc/laboratory/bonds_any_rock.md).
struct DrivingElongation
{
  double value;         ///< E [m]
  double by_elongation; ///< dE/de
  double by_force;      ///< dE/dF [m/N]
};

/// @param elongation e [m] @param force F [N] @param stiffness k [N/m]
inline DrivingElongation
driving_elongation(const double elongation, const double force, const double stiffness)
{
  if (force == 0. || elongation <= 0.)
    return {elongation, 1., 0.};
  const double square = elongation * (elongation + 2. * force / stiffness);
  if (square <= 0.)
    return {-std::sqrt(-square), 0., 0.}; // nothing would be set free
  const double value = std::sqrt(square);
  return {value, (elongation + force / stiffness) / value, elongation / (stiffness * value)};
}
} // namespace stockwork::peridynamics
