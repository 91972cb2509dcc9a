#include "rock/mohr_coulomb/hardening.h"
#include "rock/mohr_coulomb/law.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <cmath>
#include <limits>

namespace stockwork
{
namespace mohr_coulomb
{
void register_law(RockLawRegistry &registry);

namespace
{
void declare_parameters(dealii::ParameterHandler &prm)
{
  prm.declare_entry("Cohesion", "", Quantity(dimension::stress, Range::positive(), ""),
                    "c of the effective stress (total plus pore pressure). Required.");
  prm.declare_entry("Friction angle", "",
                    Quantity(dimension::angle, Range{0., dealii::numbers::PI_2, false, true}, ""),
                    "phi. Required.");
  prm.declare_entry("Dilation angle", "",
                    Quantity(dimension::angle, Range{0., dealii::numbers::PI_2, false, true}, ""),
                    "psi, from 0 to the friction angle. Required. With 0 a tension beyond c cot "
                    "phi has no return along the flow and is put to the apex all the same.");
  prm.declare_entry("Tension cut-off", "", Quantity(dimension::stress, Range::non_negative(), ""),
                    "T, the greatest tension of the effective stress, below c cot phi; changes in "
                    "proportion to the cohesion where that does. Empty: none.");
  prm.declare_entry("Hardening modulus", "", Quantity(dimension::stress, Range::finite(), ""),
                    "By how much the cohesion grows per equivalent plastic strain, the sum of "
                    "sqrt(2/3 de:de). Below 0 the rock softens, and the answer depends on the "
                    "mesh: a band that yields is as wide as the cells. Empty or 0: perfectly "
                    "plastic.");
  prm.declare_entry("Final cohesion", "", Quantity(dimension::stress, Range::non_negative(), ""),
                    "Where hardening or softening ends. Required with softening; empty with "
                    "hardening: it does not end.");
}


Strength parse(const dealii::ParameterHandler &prm, const std::string &path)
{
  const auto get =
    [&](const std::string &entry, const Dimension &dimension, const std::string &allowed)
  {
    const auto value = get_optional_quantity(prm, entry, dimension);
    if (!value)
      throw EntryError(path + "/" + entry, "", allowed);
    return *value;
  };
  Strength strength{get("Cohesion", dimension::stress, "a stress > 0 Pa, such as '3 MPa'"),
                    get("Friction angle", dimension::angle, "an angle, such as '27 deg'"),
                    get("Dilation angle", dimension::angle, "an angle, such as '8 deg'")};
  const auto get_optional = [&](const std::string &entry, double &value)
  { value = get_optional_quantity(prm, entry, dimension::stress).value_or(value); };
  get_optional("Tension cut-off", strength.tension_cut_off);
  get_optional("Hardening modulus", strength.hardening_modulus);
  get_optional("Final cohesion", strength.final_cohesion);
  return strength;
}


void check_surface(const Strength &strength,
                   const dealii::ParameterHandler &prm,
                   const std::string &path)
{
  if (strength.dilation_angle > strength.friction_angle)
    throw EntryError(path + "/Dilation angle", prm.get("Dilation angle"),
                     "an angle from 0 to the friction angle, " + prm.get("Friction angle") +
                       ": rock that dilates more would gain energy by sliding");
  const double apex = strength.cohesion / std::tan(strength.friction_angle);
  if (strength.has_cut_off() && strength.tension_cut_off >= apex)
    throw EntryError(path + "/Tension cut-off", prm.get("Tension cut-off"),
                     "a stress from 0 Pa to below c cot phi, " +
                       to_string(apex, dimension::stress) +
                       ": more tension the rock does not bear in any case");
}


void check_final_cohesion(const Strength &strength,
                          const dealii::ParameterHandler &prm,
                          const std::string &path)
{
  const std::string entry = path + "/Final cohesion", value = prm.get("Final cohesion"),
                    cohesion = prm.get("Cohesion");
  const bool is_given = strength.final_cohesion < std::numeric_limits<double>::infinity();
  const double modulus = strength.hardening_modulus;
  if (modulus == 0. && is_given)
    throw EntryError(entry, value,
                     "nothing (an empty entry) without a 'Hardening modulus': the cohesion stays "
                     "what it is");
  if (modulus > 0. && strength.final_cohesion <= strength.cohesion)
    throw EntryError(entry, value,
                     "a stress above the cohesion, " + cohesion +
                       ", with a 'Hardening modulus' above 0, or nothing: hardening without end");
  if (modulus < 0. && !(strength.final_cohesion < strength.cohesion))
    throw EntryError(entry, value,
                     "a stress from 0 Pa to below the cohesion, " + cohesion +
                       ", with a 'Hardening modulus' below 0: what is left when it has softened");
  if (strength.final_cohesion == 0. && strength.friction_angle == 0.)
    throw EntryError(entry, value,
                     "a stress > 0 Pa with a friction angle of 0: nothing else would be left that "
                     "resists shear");
}


void check_modulus(const Strength &strength,
                   const RockProperties &rock,
                   const dealii::ParameterHandler &prm,
                   const std::string &path)
{
  const bool softens = strength.hardening_modulus < 0.;
  const double limit = hardening_limit(
    principal_stiffness(rock.lame_lambda(), rock.shear_modulus()), strength, softens ? -1 : 1);
  if (std::abs(strength.hardening_modulus) < limit)
    return;
  const std::string text = to_string(softens ? -limit : limit, dimension::stress);
  throw EntryError(path + "/Hardening modulus", prm.get("Hardening modulus"),
                   softens
                     ? "a stress above " + text +
                         " for this rock: if it softens faster, a point snaps back (one "
                         "strain has several stresses)"
                     : "a stress below " + text +
                         " for this rock: if it hardens faster, a point has no single answer");
}


std::unique_ptr<RockLaw> create(const dealii::ParameterHandler &prm,
                                const std::string &path,
                                const RockProperties &properties)
{
  const Strength strength = parse(prm, path);
  check_surface(strength, prm, path);
  check_final_cohesion(strength, prm, path);
  if (properties.plane_stress)
    throw EntryError("Rock/Plane state", "plane stress",
                     "'plane strain' with the law 'mohr coulomb': the strain across the plane "
                     "would have to be solved for");
  if (!strength.is_perfectly_plastic())
    check_modulus(strength, properties, prm, path);
  return std::make_unique<MohrCoulomb>(properties, strength);
}
} // namespace


void register_law(RockLawRegistry &registry)
{
  RockLawEntry entry;
  entry.description = "Elastic, plastic by Mohr and Coulomb, with a dilation angle.";
  entry.declare_parameters = declare_parameters;
  entry.create = create;
  registry.add("mohr coulomb", entry);
}
} // namespace mohr_coulomb
} // namespace stockwork
