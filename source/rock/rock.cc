#include "stockwork/rock/rock.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/rock/linear_stiffness.h"

#include "base/parameter_tree.h"
#include "rock/plane_elasticity.h"

#include <algorithm>
#include <cmath>

namespace stockwork
{
using namespace dealii;

namespace
{
std::string region_section(const unsigned int region)
{
  return "Region " + std::to_string(region);
}


/// The entries of one kind of rock. In a region's own subsection an empty entry means "as the
/// rock at large".
void declare_properties(ParameterHandler &prm, const bool is_region)
{
  const auto declare = [&](const std::string &name, const std::string &value,
                           const Dimension &dimension, const Range &range, const std::string &text)
  {
    if (is_region)
      prm.declare_entry(name, "", Quantity(dimension, range, ""),
                        "As Rock/" + name + ", in this region only; empty: as there.");
    else if (value.empty())
      prm.declare_entry(name, "", Quantity(dimension, range, ""), text);
    else
      prm.declare_entry(name, value, Quantity(dimension, range), text);
  };
  const auto optional = [&](const std::string &name, const Dimension &dimension, const Range &range,
                            const std::string &text)
  { prm.declare_entry(name, "", Quantity(dimension, range, ""), text); };

  declare("Young modulus", "", dimension::stress, Range::positive(),
          "Drained. Required in isotropic rock.");
  declare("Poisson ratio", "0.25", dimension::number, Range::open(-1., 0.5), "Drained.");
  optional("Biot coefficient", dimension::number, Range::closed(0., 1.),
           "Empty: 1 - K/K_s if the solid's bulk modulus is given, else 1.");
  optional("Biot modulus", dimension::stress, Range{0., INFINITY, true, false},
           "M, 'inf' for incompressible constituents. Empty: from 1/M = (alpha-n)/K_s + n/K_f.");
  optional("Solid bulk modulus", dimension::stress, Range::positive(),
           "K_s of the grains; empty: incompressible grains.");
  declare("Porosity", "0.1", dimension::number, Range::closed(0., 1.),
          "Pore volume over bulk volume, n.");
  declare("Permeability", "", dimension::permeability, Range::positive(),
          "Intrinsic; required in poroelastic rock. Impermeable rock is Bulk model = elastic.");
  optional("Permeability across the layers", dimension::permeability, Range::positive(),
           "Along the normal of the layers; 'Permeability' is along the layers then. Empty: the "
           "same in all directions.");
  optional(
    "Permeability decay stress", dimension::stress, Range::positive(),
    "sigma_0/zeta in k = k_0 exp(-zeta sigma'_m/sigma_0): the mean effective stress that lowers "
    "the permeability by the factor e; 'Permeability' is k_0, that without any stress. In tension "
    "it "
    "grows, to 1e6 k_0 at most. Empty: "
    "the permeability does not hang on the stress.");
  prm.declare_entry("Normal of the layers", "",
                    Quantities(dimension::number, Range::finite(), 0, 3),
                    "Of any length, two or three numbers; required where stiffness or "
                    "permeability is another across the layers.");
  declare("Density", "", dimension::density, Range::positive(),
          "Of the saturated rock; required with inertia, not used without.");
  optional("Fracture toughness", dimension::toughness, Range::positive(),
           "K_Ic. This or the critical energy release rate.");
  optional("Critical energy release rate", dimension::energy_release_rate, Range::positive(),
           "G_c = K_Ic^2/E'.");
  optional("Shear energy release rate", dimension::energy_release_rate, Range::positive(),
           "G_IIc; empty: as in mode I.");
  optional("Tensile strength", dimension::stress, Range::positive(),
           "Empty: chosen by the fracture model, which says so.");
  RandomField::declare_parameters(prm, is_region);
}


/// What varies from place to place.
void parse_random_field(ParameterHandler &prm, const std::string &path, RockProperties &rock)
{
  RandomField field;
  field.parse_parameters(prm, path, rock.random ? *rock.random : RandomField());
  rock.random = std::make_shared<const RandomField>(field);
  const auto refuse_without = [&](const bool is_there, const RandomField::Property property)
  {
    if (field.varies(property) && !is_there)
      throw EntryError(path + "/Random field/Properties",
                       value_of(prm, {"Random field"}, "Properties"),
                       std::string("a list without '") + RandomField::name(property) +
                         "', which this rock does not have");
  };
  refuse_without(!rock.stiffness, RandomField::young_modulus);
  refuse_without(!std::isnan(rock.energy_release_rate), RandomField::energy_release_rate);
  refuse_without(rock.permeability > 0., RandomField::permeability);
}


/// The direction of the layers, and the permeability across them.
void parse_layers(const ParameterHandler &prm, const std::string &path, RockProperties &rock)
{
  const std::vector<double> normal = get_quantities(prm, "Normal of the layers", dimension::number);
  if (!normal.empty())
  {
    rock.layer_normal = Tensor<1, 3>();
    for (unsigned int d = 0; d < normal.size(); ++d)
      rock.layer_normal[d] = normal[d];
    const double greatest =
      std::max({std::abs(rock.layer_normal[0]), std::abs(rock.layer_normal[1]),
                std::abs(rock.layer_normal[2])});
    if (normal.size() == 1 || greatest == 0.)
      throw EntryError(path + "/Normal of the layers", prm.get("Normal of the layers"),
                       "two or three numbers that are not all zero, such as '0, 1'");
    rock.layer_normal /= greatest; // whose square may not be finite
    rock.layer_normal /= rock.layer_normal.norm();
  }
  const auto across =
    get_optional_quantity(prm, "Permeability across the layers", dimension::permeability);
  if (!across)
    return;
  rock.permeability_across = *across;
  if (rock.permeability <= 0.)
    throw EntryError(path + "/Permeability", "",
                     "the permeability along the layers, for 'Permeability across the layers' is "
                     "given");
  if (rock.layer_normal.norm() == 0.)
    throw EntryError(path + "/Normal of the layers", "",
                     "a direction, such as '0, 1', for 'Permeability across the layers' is given");
}


/// Young's modulus and Poisson's ratio, or the stiffness that stands in their place.
void parse_stiffness(const ParameterHandler &prm,
                     const std::string &path,
                     const bool is_region,
                     const std::optional<SymmetricTensor<4, 3>> &anisotropic,
                     RockProperties &rock)
{
  const std::string modulus = prm.get("Young modulus"), ratio = prm.get("Poisson ratio");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  rock.stiffness = anisotropic;
  if (anisotropic)
  {
    rock.young_modulus = rock.poisson_ratio = nan;
    rock.minimum_plane_modulus = minimum_plane_modulus(LinearStiffness<2>(rock).tensor());
    for (const auto &[name, text] :
         {std::make_pair("Young modulus", modulus), std::make_pair("Poisson ratio", ratio)})
      if (!text.empty() && text != "0.25")
        throw EntryError(path + "/" + name, text,
                         "nothing (an empty entry): the rock's law has its own constants");
    if (!prm.get("Fracture toughness").empty())
      throw EntryError(path + "/Fracture toughness", prm.get("Fracture toughness"),
                       "nothing (an empty entry): how K_Ic and energy are related hangs on the "
                       "direction of the crack in this rock; give 'Critical energy release rate'");
    return;
  }
  rock.young_modulus =
    get_optional_quantity(prm, "Young modulus", dimension::stress).value_or(rock.young_modulus);
  rock.poisson_ratio =
    get_optional_quantity(prm, "Poisson ratio", dimension::number).value_or(rock.poisson_ratio);
  if (!(rock.young_modulus > 0.))
    throw EntryError(
      path + "/Young modulus", modulus,
      std::string("a stress > 0 Pa, such as '20 GPa'") +
        (is_region ? ", for this region is isotropic and the rock at large is not" : ""));
  if (std::isnan(rock.poisson_ratio))
    throw EntryError(path + "/Poisson ratio", ratio,
                     "a number, for this region is isotropic and the rock at large is not");
}


/// @param rock what is inherited, or but the plane state
RockProperties parse_properties(ParameterHandler &prm,
                                const std::string &path,
                                const types::material_id region,
                                const Rock::Stiffness &stiffness,
                                RockProperties rock,
                                const double fluid_bulk_modulus)
{
  const bool inherited = region != 0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  // The patterns have checked the ranges.
  const auto get = [&](const std::string &entry, const Dimension &dimension, const double otherwise)
  { return get_optional_quantity(prm, entry, dimension).value_or(otherwise); };
  rock.porosity = get("Porosity", dimension::number, inherited ? rock.porosity : nan);
  rock.permeability =
    get("Permeability", dimension::permeability, inherited ? rock.permeability : 0.);
  rock.permeability_decay_stress = get("Permeability decay stress", dimension::stress,
                                       inherited ? rock.permeability_decay_stress : inf);
  rock.density = get("Density", dimension::density, inherited ? rock.density : 0.);
  rock.tensile_strength = get("Tensile strength", dimension::stress, rock.tensile_strength);

  parse_layers(prm, path, rock);
  parse_stiffness(prm, path, inherited, stiffness ? stiffness(region, rock) : std::nullopt, rock);

  if (inherited && !prm.get("Normal of the layers").empty() && !rock.stiffness &&
      rock.permeability_across == 0.)
    throw EntryError(path + "/Normal of the layers", prm.get("Normal of the layers"),
                     "nothing (an empty entry): this region has no layers");

  // Biot's constants, from either pair. K is the three-dimensional drained bulk modulus; in
  // anisotropic rock alpha is the mean of its tensor (Cheng 1997, Eq. 30), taken in all directions.
  const double bulk_modulus = rock.bulk_modulus();
  const double solid_modulus = get("Solid bulk modulus", dimension::stress, inf);
  const bool alpha_given = !prm.get("Biot coefficient").empty();
  const bool solid_given = !prm.get("Solid bulk modulus").empty();
  const bool modulus_given = !prm.get("Biot modulus").empty();
  if (!inherited || alpha_given || solid_given)
    rock.biot_coefficient =
      get("Biot coefficient", dimension::number, 1. - bulk_modulus / solid_modulus);
  if (rock.biot_coefficient < 0.)
    throw EntryError(path + "/Solid bulk modulus", prm.get("Solid bulk modulus"),
                     "a modulus above the drained bulk modulus of the rock, " +
                       to_string(bulk_modulus, dimension::stress));
  if (alpha_given && solid_given && !modulus_given)
  {
    const double consistent = 1. - bulk_modulus / solid_modulus;
    if (std::abs(rock.biot_coefficient - consistent) > 0.01)
      throw EntryError(path + "/Biot coefficient", prm.get("Biot coefficient"),
                       "about " + std::to_string(consistent) +
                         ", which is 1 - K/K_s of the moduli given. Leave one of the two out, or "
                         "give the Biot modulus as well to fix all constants by hand");
  }
  if (rock.biot_coefficient < rock.porosity)
    throw EntryError(path + "/Biot coefficient", std::to_string(rock.biot_coefficient),
                     "not below the porosity, " + std::to_string(rock.porosity));
  if (modulus_given)
    rock.inverse_biot_modulus = 1. / get("Biot modulus", dimension::stress, inf);
  else if (!inherited || alpha_given || solid_given || !prm.get("Porosity").empty())
    rock.inverse_biot_modulus =
      (rock.biot_coefficient - rock.porosity) / solid_modulus + rock.porosity / fluid_bulk_modulus;

  // Toughness by either name; given twice they must agree.
  const double toughness = get("Fracture toughness", dimension::toughness, nan);
  const double energy = get("Critical energy release rate", dimension::energy_release_rate, nan);
  const double from_toughness = toughness * toughness / rock.plane_modulus();
  // Where the rock outside of a region slides at the energy at which it opens, so does the region.
  const bool one_energy = std::isnan(rock.shear_energy_release_rate) ||
                          rock.shear_energy_release_rate == rock.energy_release_rate;
  if (!std::isnan(toughness) && !std::isnan(energy) &&
      std::abs(energy - from_toughness) > 1e-3 * from_toughness)
    throw EntryError(path + "/Critical energy release rate",
                     prm.get("Critical energy release rate"),
                     "K_Ic^2/E' = " + to_string(from_toughness, dimension::energy_release_rate) +
                       " if the fracture toughness is given as well; leave one of the two out");
  if (!std::isnan(energy))
    rock.energy_release_rate = energy;
  else if (!std::isnan(toughness))
    rock.energy_release_rate = from_toughness;
  rock.shear_energy_release_rate =
    get("Shear energy release rate", dimension::energy_release_rate,
        one_energy ? rock.energy_release_rate : rock.shear_energy_release_rate);
  parse_random_field(prm, path, rock);
  return rock;
}
} // namespace


double RockProperties::bulk_modulus() const
{
  return stiffness ? LinearStiffness<3>::mean_bulk_modulus(*stiffness)
                   : young_modulus / (3. * (1. - 2. * poisson_ratio));
}


void RockProperties::require_isotropic() const
{
  if (stiffness)
    throw InputError(
      "What this case asks for is there for isotropic rock only: choose a 'Rock/Law' "
      "that is isotropic, another 'Fracture/Model', or 'Verification/Reference = "
      "none'.");
}


double RockProperties::toughness() const
{
  return std::sqrt(plane_modulus() * energy_release_rate);
}


void Rock::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Rock");
  prm.declare_entry(
    "Bulk model", "auto", Patterns::Selection("auto|elastic|poroelastic"),
    "elastic: impermeable, dry rock without pore pressure unknowns. poroelastic: "
    "Biot. auto: poroelastic if a pore pressure condition, flux or resolved leak-off "
    "gives the pore fluid something to do.");
  prm.declare_entry("Plane state", "plane strain", Patterns::Selection("plane strain|plane stress"),
                    "Two-dimensional runs only.");
  declare_properties(prm, false);
  for (unsigned int region = 1; region <= max_regions; ++region)
  {
    prm.enter_subsection(region_section(region));
    declare_properties(prm, true);
    prm.leave_subsection();
  }
  prm.leave_subsection();

  prm.enter_subsection("Fluid");
  prm.declare_entry("Viscosity", "", Quantity(dimension::viscosity, Range::positive(), ""),
                    "Of the fluid in pores and fractures; required where there is flow in either.");
  prm.declare_entry("Bulk modulus", "inf",
                    Quantity(dimension::stress, Range{0., INFINITY, true, false}),
                    "K_f; 'inf' for an incompressible fluid.");
  prm.leave_subsection();
}


void Rock::parse_parameters(ParameterHandler &prm, const Stiffness &stiffness)
{
  prm.enter_subsection("Fluid");
  const double fluid_modulus = get_quantity(prm, "Bulk modulus", dimension::stress);
  pore_fluid = {get_optional_quantity(prm, "Viscosity", dimension::viscosity)
                  .value_or(std::numeric_limits<double>::infinity()),
                1. / fluid_modulus};
  prm.leave_subsection();

  prm.enter_subsection("Rock");
  model = prm.get("Bulk model");
  RockProperties blank;
  blank.young_modulus = blank.poisson_ratio = std::numeric_limits<double>::quiet_NaN();
  blank.plane_stress = prm.get("Plane state") == "plane stress";
  default_region = parse_properties(prm, "Rock", 0, stiffness, blank, fluid_modulus);
  for (unsigned int region = 1; region <= max_regions; ++region)
  {
    prm.enter_subsection(region_section(region));
    regions[region] = parse_properties(prm, "Rock/" + region_section(region), region, stiffness,
                                       default_region, fluid_modulus);
    prm.leave_subsection();
  }
  const auto is_layered = [](const RockProperties &rock)
  { return rock.stiffness || rock.permeability_across > 0.; };
  if (!prm.get("Normal of the layers").empty() && !is_layered(default_region) &&
      std::none_of(regions.begin(), regions.end(),
                   [&](const auto &region) { return is_layered(region.second); }))
    throw EntryError("Rock/Normal of the layers", prm.get("Normal of the layers"),
                     "nothing (an empty entry): neither 'Rock/Law' nor 'Permeability across the "
                     "layers' asks for layers");
  prm.enter_subsection("Random field");
  for (const char *const entry : {"Weibull modulus", "Lattice spacing", "Correlation length"})
    if (!is_random() && !prm.get(entry).empty())
      throw EntryError(std::string("Rock/Random field/") + entry, prm.get(entry),
                       "nothing (an empty entry), for 'Properties' says of no rock that anything "
                       "varies");
  prm.leave_subsection();
  prm.leave_subsection();
}


const RockProperties &Rock::operator()(const types::material_id region) const
{
  if (region == 0)
    return default_region;
  const auto position = regions.find(region);
  if (position == regions.end())
    throw InputError("The mesh has a region " + std::to_string(region) +
                     ", but subsection Rock describes regions 1 to " + std::to_string(max_regions) +
                     " only.");
  return position->second;
}


template <int dim>
RockProperties Rock::at(const types::material_id region, const Point<dim> &place) const
{
  RockProperties rock = (*this)(region);
  if (!rock.is_random())
    return rock;
  const auto factors = rock.random->factors(place);
  rock.young_modulus *= factors[RandomField::young_modulus];
  rock.tensile_strength *= factors[RandomField::tensile_strength];
  rock.energy_release_rate *= factors[RandomField::energy_release_rate];
  rock.shear_energy_release_rate *= factors[RandomField::energy_release_rate];
  rock.permeability *= factors[RandomField::permeability];
  rock.permeability_across *= factors[RandomField::permeability];
  rock.random.reset(); // nothing varies at a place
  return rock;
}


bool Rock::varies(const RandomField::Property property) const
{
  const auto varies_in = [property](const RockProperties &rock)
  { return rock.is_random() && rock.random->varies(property); };
  return varies_in(default_region) ||
         std::any_of(regions.begin(), regions.end(),
                     [&](const auto &region) { return varies_in(region.second); });
}


bool Rock::is_random() const
{
  return default_region.is_random() ||
         std::any_of(regions.begin(), regions.end(),
                     [](const auto &region) { return region.second.is_random(); });
}


const RockProperties &Rock::main() const
{
  return default_region;
}


const std::string &Rock::bulk_model() const
{
  return model;
}


const Fluid &Rock::fluid() const
{
  return pore_fluid;
}


template RockProperties Rock::at(types::material_id, const Point<2> &) const;
template RockProperties Rock::at(types::material_id, const Point<3> &) const;
} // namespace stockwork
