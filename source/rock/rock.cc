#include "stockwork/rock/rock.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

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

  declare("Young modulus", "", dimension::stress, Range::positive(), "Drained. Required.");
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
          "Intrinsic, isotropic; required in poroelastic rock. Impermeable rock is Bulk model = "
          "elastic.");
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
}


RockProperties parse_properties(const ParameterHandler &prm,
                                const std::string &path,
                                const RockProperties *inherited,
                                const double fluid_bulk_modulus)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  RockProperties rock = inherited ? *inherited : RockProperties();
  // The patterns have checked the ranges.
  const auto get = [&](const std::string &entry, const Dimension &dimension, const double otherwise)
  { return get_optional_quantity(prm, entry, dimension).value_or(otherwise); };
  rock.young_modulus =
    get("Young modulus", dimension::stress, inherited ? rock.young_modulus : nan);
  rock.poisson_ratio =
    get("Poisson ratio", dimension::number, inherited ? rock.poisson_ratio : nan);
  rock.porosity = get("Porosity", dimension::number, inherited ? rock.porosity : nan);
  rock.permeability =
    get("Permeability", dimension::permeability, inherited ? rock.permeability : 0.);
  rock.density = get("Density", dimension::density, inherited ? rock.density : 0.);
  rock.tensile_strength = get("Tensile strength", dimension::stress, rock.tensile_strength);

  // Biot's constants, from either pair. K is the three-dimensional drained bulk modulus.
  const double bulk_modulus = rock.young_modulus / (3. * (1. - 2. * rock.poisson_ratio));
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
        std::isnan(rock.shear_energy_release_rate) ? rock.energy_release_rate
                                                   : rock.shear_energy_release_rate);
  return rock;
}
} // namespace


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


void Rock::parse_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Fluid");
  const double fluid_modulus = get_quantity(prm, "Bulk modulus", dimension::stress);
  pore_fluid = {get_optional_quantity(prm, "Viscosity", dimension::viscosity)
                  .value_or(std::numeric_limits<double>::infinity()),
                1. / fluid_modulus};
  prm.leave_subsection();

  prm.enter_subsection("Rock");
  model = prm.get("Bulk model");
  default_region.plane_stress = prm.get("Plane state") == "plane stress";
  if (prm.get("Young modulus").empty())
    throw EntryError("Rock/Young modulus", "", "a stress > 0 Pa, such as '20 GPa'");
  RockProperties blank = parse_properties(prm, "Rock", nullptr, fluid_modulus);
  const bool plane_stress = default_region.plane_stress;
  if (plane_stress)
  {
    // E' differs, so the toughness must be read again with it.
    blank.plane_stress = true;
    const std::string toughness = prm.get("Fracture toughness");
    if (!toughness.empty())
      blank.energy_release_rate =
        std::pow(parse_finite_quantity(toughness, dimension::toughness), 2) / blank.plane_modulus();
  }
  default_region = blank;
  for (unsigned int region = 1; region <= max_regions; ++region)
  {
    prm.enter_subsection(region_section(region));
    regions[region] =
      parse_properties(prm, "Rock/" + region_section(region), &default_region, fluid_modulus);
    prm.leave_subsection();
  }
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
} // namespace stockwork
