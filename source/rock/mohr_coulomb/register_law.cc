#include "rock/mohr_coulomb/law.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

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
}


std::unique_ptr<RockLaw> create(const dealii::ParameterHandler &prm,
                                const std::string &path,
                                const RockProperties &properties)
{
  const auto get =
    [&](const std::string &entry, const Dimension &dimension, const std::string &allowed)
  {
    const auto value = get_optional_quantity(prm, entry, dimension);
    if (!value)
      throw EntryError(path + "/" + entry, "", allowed);
    return *value;
  };
  const Strength strength{get("Cohesion", dimension::stress, "a stress > 0 Pa, such as '3 MPa'"),
                          get("Friction angle", dimension::angle, "an angle, such as '27 deg'"),
                          get("Dilation angle", dimension::angle, "an angle, such as '8 deg'")};
  if (strength.dilation_angle > strength.friction_angle)
    throw EntryError(path + "/Dilation angle", prm.get("Dilation angle"),
                     "an angle from 0 to the friction angle, " + prm.get("Friction angle") +
                       ": rock that dilates more would gain energy by sliding");
  if (properties.plane_stress)
    throw EntryError("Rock/Plane state", "plane stress",
                     "'plane strain' with the law 'mohr coulomb': the strain across the plane "
                     "would have to be solved for");
  return std::make_unique<MohrCoulomb>(properties, strength);
}
} // namespace


void register_law(RockLawRegistry &registry)
{
  RockLawEntry entry;
  entry.description = "Elastic, perfectly plastic by Mohr and Coulomb, with a dilation angle.";
  entry.declare_parameters = declare_parameters;
  entry.create = create;
  registry.add("mohr coulomb", entry);
}
} // namespace mohr_coulomb
} // namespace stockwork
