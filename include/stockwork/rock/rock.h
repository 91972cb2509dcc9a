#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/types.h>

#include <cstdint>
#include <limits>
#include <map>
#include <string>

namespace stockwork
{
/// Constants of one kind of isotropic rock. Stresses and moduli in Pa.
struct RockProperties
{
  double young_modulus = 0.;
  double poisson_ratio = 0.;
  double biot_coefficient = 1.;
  double inverse_biot_modulus = 0.; ///< 1/M = (alpha-n)/K_s + n/K_f [1/Pa]
  double permeability = 0.;         ///< [m^2]; zero where the deck gives none
  double porosity = 0.;
  double density = 0.; ///< of the saturated mixture [kg/m^3]; zero where the deck gives none
  double energy_release_rate = std::numeric_limits<double>::quiet_NaN();       ///< G_c [J/m^2]
  double shear_energy_release_rate = std::numeric_limits<double>::quiet_NaN(); ///< G_IIc [J/m^2]
  double tensile_strength = std::numeric_limits<double>::quiet_NaN();          ///< [Pa]
  bool plane_stress = false;

  double shear_modulus() const
  {
    return young_modulus / (2. * (1. + poisson_ratio));
  }

  /// Lame's first constant; in plane stress the one that gives sigma_zz = 0.
  double lame_lambda() const
  {
    return plane_stress
             ? young_modulus * poisson_ratio / (1. - poisson_ratio * poisson_ratio)
             : young_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
  }

  /// E' of a crack: E/(1-nu^2) in plane strain and 3-D, E in plane stress.
  double plane_modulus() const
  {
    return plane_stress ? young_modulus : young_modulus / (1. - poisson_ratio * poisson_ratio);
  }

  /// K_Ic = sqrt(E' G_c) [Pa m^1/2].
  double toughness() const;
};

/// The pore and fracture fluid.
struct Fluid
{
  /// [Pa s]; infinite where the deck gives none
  double viscosity = std::numeric_limits<double>::infinity();
  double compressibility = 0.; ///< 1/K_f, in the fracture [1/Pa]
};

/// All kinds of rock in the scene, by region (material id of the mesh).
class Rock
{
public:
  /// Regions that a deck can describe, numbered from 1.
  static constexpr unsigned int max_regions = 8;

  static void declare_parameters(dealii::ParameterHandler &prm);

  /// Throws InputError for constants that contradict one another.
  void parse_parameters(dealii::ParameterHandler &prm);

  const RockProperties &operator()(const dealii::types::material_id region) const;

  /// Constants of the region that the deck describes first (the only one of most decks).
  const RockProperties &main() const;

  /// `auto`, `elastic` or `poroelastic`, as the deck says.
  const std::string &bulk_model() const;

  const Fluid &fluid() const;

private:
  std::map<dealii::types::material_id, RockProperties> regions;
  RockProperties default_region;
  Fluid pore_fluid;
  std::string model;
};
} // namespace stockwork
