#pragma once

namespace stockwork::analytical
{
/// The constants of linear, isotropic poroelasticity that the consolidation problems of this
/// folder need, and the groups formed from them in plane or uniaxial strain (Detournay & Cheng
/// 1993, Fundamentals of poroelasticity). SI units throughout.
struct PoroelasticMedium
{
  double youngs_modulus;       ///< drained, Pa
  double poisson_ratio;        ///< drained
  double biot_coefficient;     ///< alpha
  double inverse_biot_modulus; ///< 1/M in 1/Pa; 0 for incompressible constituents
  double permeability;         ///< m^2; 0 means undrained at all times
  double viscosity;            ///< of the pore fluid, Pa s

  double shear_modulus() const
  {
    return youngs_modulus / (2. * (1. + poisson_ratio));
  }

  /// lambda + 2 G: stress per strain when the strain is uniaxial, Pa.
  double uniaxial_modulus() const
  {
    return youngs_modulus * (1. - poisson_ratio) /
           ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
  }

  double bulk_modulus() const
  {
    return youngs_modulus / (3. * (1. - 2. * poisson_ratio));
  }

  /// Fluid volume taken up per volume and pressure when the strain is uniaxial, 1/Pa.
  double uniaxial_storage() const
  {
    return inverse_biot_modulus + biot_coefficient * biot_coefficient / uniaxial_modulus();
  }

  /// c = k / (mu S), m^2/s.
  double diffusivity() const
  {
    return permeability / (viscosity * uniaxial_storage());
  }

  /// Skempton's coefficient: pore pressure per mean total stress when no fluid moves.
  double skempton_coefficient() const
  {
    return biot_coefficient /
           (biot_coefficient * biot_coefficient + inverse_biot_modulus * bulk_modulus());
  }

  /// Poisson's ratio when no fluid moves; 1/2 for alpha = 1 and incompressible constituents.
  double undrained_poisson_ratio() const
  {
    const double x = biot_coefficient * skempton_coefficient() * (1. - 2. * poisson_ratio);
    return (3. * poisson_ratio + x) / (3. - x);
  }
};
} // namespace stockwork::analytical
