#pragma once

#include <deal.II/base/point.h>

#include "rock/plane_elasticity.h"

namespace stockwork::analytical
{
/// A straight crack in an infinite anisotropic body in a plane state, under uniform load on its
/// faces: Lekhnitskii's (1963) two potentials
///
///   phi_1 = -(p mu_2 + t) / (2 (mu_1 - mu_2)) [sqrt(z_1^2 - a^2) - z_1],
///   phi_2 =  (p mu_1 + t) / (2 (mu_1 - mu_2)) [sqrt(z_2^2 - a^2) - z_2],
///
/// which leave sigma_yy = -p and sigma_xy = -t on the faces and nothing at infinity; stress
/// intensity p sqrt(pi a) and t sqrt(pi a) as in isotropic rock (Sih, Paris and Irwin 1965). Not
/// where mu_1 = mu_2.
class AnisotropicCrack
{
public:
  /// @param stiffness in the axes of the run [Pa]
  /// @param angle of the crack to the x axis [rad]
  /// @param net_pressure, shear as in LineCrackParameters [Pa]
  AnisotropicCrack(const dealii::SymmetricTensor<4, 2> &stiffness,
                   const dealii::Point<2> &centre,
                   double half_length,
                   double angle,
                   double net_pressure,
                   double shear);

  /// Full opening at the centre [m].
  double opening() const;

  /// Area of the open crack [m^2].
  double volume() const;

  /// K_I and K_II, the same at both tips [Pa m^1/2].
  double mode_I() const;
  double mode_II() const;

  double energy_release_rate() const; ///< [J/m^2]

  /// Displacement in the axes of the run, zero at infinity [m].
  dealii::Tensor<1, 2> displacement(const dealii::Point<2> &x) const;

private:
  dealii::Point<2> centre;
  double half_length;
  dealii::Tensor<1, 2> along;
  double net_pressure, shear;
  PlaneElasticity elasticity;
};
} // namespace stockwork::analytical
