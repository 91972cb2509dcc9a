#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/types.h>

#include "stockwork/rock/random_field.h"
#include <cstdint>
#include <functional>

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace stockwork
{
/// Constants of one kind of rock. Stresses and moduli in Pa.
struct RockProperties
{
  double young_modulus = 0.; ///< of isotropic rock, like the next; NaN in any other
  double poisson_ratio = 0.;

  /// Of rock that is not isotropic: the drained stiffness in the axes of the run. What only
  /// isotropic rock has must not be asked for then: InputError.
  std::optional<dealii::SymmetricTensor<4, 3>> stiffness;
  double minimum_plane_modulus = 0.; ///< of such rock: E' of the softest direction of a crack [Pa]

  /// Unit normal of the layers of transversely isotropic rock; zero where the deck gives none.
  dealii::Tensor<1, 3> layer_normal;
  double permeability_across = 0.; ///< the layers; zero: as along them [m^2]

  double biot_coefficient = 1.;
  double inverse_biot_modulus = 0.; ///< 1/M = (alpha-n)/K_s + n/K_f [1/Pa]
  double permeability = 0.;         ///< [m^2], along the layers; zero where the deck gives none
  /// Mean effective stress, compression positive, that lowers the permeability by the factor e,
  /// from `permeability` without any; infinite: it does not hang on the stress [Pa].
  double permeability_decay_stress = std::numeric_limits<double>::infinity();
  double porosity = 0.;
  double density = 0.; ///< of the saturated mixture [kg/m^3]; zero where the deck gives none
  double energy_release_rate = std::numeric_limits<double>::quiet_NaN();       ///< G_c [J/m^2]
  double shear_energy_release_rate = std::numeric_limits<double>::quiet_NaN(); ///< G_IIc [J/m^2]
  double tensile_strength = std::numeric_limits<double>::quiet_NaN();          ///< [Pa]
  bool plane_stress = false;

  /// How these vary from place to place, if they do: see Rock::at().
  std::shared_ptr<const RandomField> random;

  bool is_random() const
  {
    return random && random->is_random();
  }

  double shear_modulus() const
  {
    require_isotropic();
    return young_modulus / (2. * (1. + poisson_ratio));
  }

  /// Lame's first constant; in plane stress the one that gives sigma_zz = 0.
  double lame_lambda() const
  {
    require_isotropic();
    return plane_stress
             ? young_modulus * poisson_ratio / (1. - poisson_ratio * poisson_ratio)
             : young_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
  }

  /// E' of a crack: E/(1-nu^2) in plane strain and 3-D, E in plane stress; in anisotropic rock
  /// that of the softest direction.
  double plane_modulus() const
  {
    if (stiffness)
      return minimum_plane_modulus;
    return plane_stress ? young_modulus : young_modulus / (1. - poisson_ratio * poisson_ratio);
  }

  /// K_Ic = sqrt(E' G_c) [Pa m^1/2].
  double toughness() const;

  /// Drained, in three dimensions: mean stress per volumetric strain when all directions are
  /// strained alike (C_iijj / 9) [Pa].
  double bulk_modulus() const;

  /// k as a tensor [m^2].
  template <int dim>
  dealii::SymmetricTensor<2, dim> permeability_tensor() const
  {
    auto result = permeability * dealii::unit_symmetric_tensor<dim>();
    if (permeability_across > 0.)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          result[i][j] += (permeability_across - permeability) * layer_normal[i] * layer_normal[j];
    return result;
  }

  bool has_isotropic_permeability() const
  {
    return permeability_across == 0. || permeability_across == permeability;
  }

private:
  /// @throws InputError
  void require_isotropic() const;
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

  /// The stiffness of a region, nothing where it is isotropic; from the layers' normal and the
  /// plane state among these constants.
  using Stiffness = std::function<std::optional<dealii::SymmetricTensor<4, 3>>(
    dealii::types::material_id, const RockProperties &)>;

  static void declare_parameters(dealii::ParameterHandler &prm);

  /// Throws InputError for constants that contradict one another.
  void parse_parameters(dealii::ParameterHandler &prm, const Stiffness &stiffness = {});

  const RockProperties &operator()(const dealii::types::material_id region) const;

  /// Constants at a place in a region; in a cell of the mesh, that is its centre.
  template <int dim>
  RockProperties at(dealii::types::material_id region, const dealii::Point<dim> &place) const;

  /// Whether a constant varies from place to place anywhere.
  bool varies(RandomField::Property property) const;

  /// Whether any does.
  bool is_random() const;

  /// Constants of the region that the deck describes first (the only one of most decks). Where they
  /// vary from place to place, the scales of their distributions.
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
