#include "case_checks.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "base/parameter_tree.h"
#include "scales.h"
#include "scene_estimates.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Section of the region that an entry belongs to, also in a subsection of it; empty: none.
std::string region_section(const DeclaredEntry &entry)
{
  if (entry.section.compare(0, 12, "Rock/Region ") != 0)
    return "";
  return entry.section.substr(0, entry.section.find('/', 12));
}


/// An open crack from side to side leaves two bodies, each of which must be held.
std::string body_in_two(const std::vector<InitialCrack<2>> &cracks, const Geometry<2> &geometry)
{
  for (const InitialCrack<2> &crack : cracks)
    if (crack.kind != InitialCrack<2>::Kind::cohesive && geometry.on_side(crack.points.front()) &&
        geometry.on_side(crack.points.back()))
      return "The open crack '" + crack.text +
             "' cuts the rock in two: sides of both parts must be held, or nothing resists the "
             "motion of one of them.";
  return "";
}


/// Refuse what holds in a region, at the region's own entry or where that is inherited from.
/// @param subsection of the rock's subsection; empty: the entry is in that itself
/// @throws EntryError
[[noreturn]] void refuse_in_region(ParameterHandler &prm,
                                   const types::material_id region,
                                   const std::string &name,
                                   const std::string &allowed,
                                   const std::string &subsection = "")
{
  const auto sections_in = [&](std::vector<std::string> sections)
  {
    if (!subsection.empty())
      sections.push_back(subsection);
    return sections;
  };
  std::vector<std::string> sections = sections_in({"Rock", "Region " + std::to_string(region)});
  if (region == 0 || value_of(prm, sections, name).empty())
    sections = sections_in({"Rock"});
  std::string path;
  for (const std::string &section : sections)
    path += section + "/";
  throw EntryError(path + name, value_of(prm, sections, name), allowed);
}


/// What has no scale of its own must be in the deck where it counts.
void require(ParameterHandler &prm,
             const std::string &section,
             const std::string &entry,
             const std::string &allowed)
{
  prm.enter_subsection(section);
  const bool missing = prm.get(entry).empty();
  prm.leave_subsection();
  if (missing)
    throw EntryError(section + "/" + entry, "", allowed);
}
} // namespace


template <int dim>
void refuse_incompressible(ParameterHandler &prm,
                           const Rock &rock,
                           const Geometry<dim> &geometry,
                           const BoundaryConditions<dim> &boundary_conditions)
{
  bool gives_way = rock.main().inverse_biot_modulus > 0.;
  for (const std::string &region : geometry.region_names())
    gives_way |= rock(geometry.region(region)).inverse_biot_modulus > 0.;
  std::vector<types::boundary_id> sides;
  for (const std::string &name : geometry.side_names())
    sides.push_back(geometry.side(name));
  if (gives_way || !boundary_conditions.seal(sides))
    return;
  prm.enter_subsection("Boundary conditions");
  const std::string entry = prm.get("Roller").empty() ? "Fixed" : "Roller", value = prm.get(entry);
  prm.leave_subsection();
  throw EntryError(
    "Boundary conditions/" + entry, value,
    "a side less, or one of them 'Drained', where 'Rock/Biot modulus' and "
    "'Fluid/Bulk modulus' are infinite: the pressure of a body that nothing leaves "
    "and nothing compresses is undetermined, and fluid that is injected has no place");
}


void refuse_regions(ParameterHandler &prm,
                    const Rock &rock,
                    const std::string &model_name,
                    const RegionalRock known_to_model)
{
  if (known_to_model == RegionalRock::any)
    return;
  const bool one_rock = known_to_model == RegionalRock::none;
  std::vector<std::string> refused = {"Fracture toughness", "Critical energy release rate",
                                      "Shear energy release rate", "Tensile strength"};
  if (one_rock)
    refused.insert(refused.end(),
                   {"Young modulus", "Poisson ratio", "Biot coefficient", "Solid bulk modulus"});
  for (const DeclaredEntry &entry : declared_entries(prm))
    if (entry.path().compare(0, 12, "Rock/Region ") == 0)
      if (!entry.value.empty() &&
          std::find(refused.begin(), refused.end(), entry.name) != refused.end())
        throw EntryError(entry.path(), entry.value,
                         "nothing (an empty entry) with the fracture model '" + model_name +
                           (one_rock
                              ? "', whose rock is one and the same everywhere; models whose cracks "
                                "cut cells know regions"
                              : "', which breaks all rock as it breaks outside of the regions"));
  for (types::material_id region = 1; region <= Rock::max_regions; ++region)
    if (one_rock && rock(region).stiffness)
      refuse_in_region(prm, region, "Law",
                       "that of an isotropic rock with the fracture model '" + model_name +
                         "', whose rock is one and the same everywhere");
}


template <int dim>
void refuse_absent_regions(ParameterHandler &prm, const Geometry<dim> &geometry)
{
  std::vector<std::string> present = {""};
  for (const std::string &name : geometry.region_names())
    present.push_back("Rock/Region " + std::to_string(geometry.region(name)));
  for (const DeclaredEntry &entry : declared_entries(prm))
    if (!entry.value.empty() &&
        std::find(present.begin(), present.end(), region_section(entry)) == present.end())
      throw EntryError(
        entry.path(), entry.value,
        "nothing (an empty entry), for the mesh has no such region: see 'Mesh/Region "
        "boxes'");
}


template <int dim>
std::vector<std::string> regions_without_rock(ParameterHandler &prm, const Geometry<dim> &geometry)
{
  std::set<std::string> described;
  for (const DeclaredEntry &entry : declared_entries(prm))
    if (!entry.value.empty())
      described.insert(region_section(entry));
  std::vector<std::string> others;
  for (const std::string &name : geometry.region_names())
    if (described.count("Rock/Region " + std::to_string(geometry.region(name))) == 0)
      others.push_back(name);
  return others;
}


template <int dim>
void check_layers(ParameterHandler &prm, const RockLaws &laws, const Rock &rock)
{
  for (const auto &[region, law] : laws.all())
  {
    const RockProperties &properties = rock(region);
    const auto refuse = [&, region = region](const std::string &name, const std::string &allowed)
    { refuse_in_region(prm, region, name, allowed); };
    const auto &normal = properties.layer_normal;
    const bool layered = properties.stiffness || properties.permeability_across > 0.;
    const double tilt = std::abs(normal[2]);
    const bool in_plane = tilt < 1e-12;
    const bool across = tilt > 1. - 1e-12;
    if (dim == 2 && layered && !in_plane && !across)
      refuse("Normal of the layers",
             "a direction in the plane of the run or across it: with any other the rock would move "
             "across the plane");
    if (properties.stiffness && laws.may_yield())
      refuse("Law", "'elastic' beside rock that may yield");
    const std::string leak_off = value_of(prm, {"Fracture flow"}, "Leak-off");
    if (!properties.has_isotropic_permeability() &&
        (leak_off == "resolved" || leak_off == "filter cake"))
      refuse("Permeability across the layers",
             "nothing (an empty entry) with 'Fracture flow/Leak-off = " + leak_off +
               "', which knows one permeability; or another law of leak-off");
  }
}


template <int dim>
void check_history(ParameterHandler &prm, const Case<dim> &the_case)
{
  if (the_case.laws.are_linear() || !the_case.elements.has_pore_pressure)
    return;
  if (the_case.scheme.kind() == TimeScheme::Kind::newmark)
    throw EntryError(
      "Rock/Law", value_of(prm, {"Rock"}, "Law"),
      "elastic where there are both inertia and a pore pressure; or leave out one of "
      "them ('Time/Inertia', 'Rock/Bulk model')");
  if (the_case.scheme.kind() != TimeScheme::Kind::backward_euler)
    throw EntryError("Time/Scheme", value_of(prm, {"Time"}, "Scheme"),
                     "backward Euler (or auto) in porous rock that is not linear (it may yield, or "
                     "its permeability hangs on the stress)");
  if (std::isfinite(the_case.control.error_tolerance))
    throw EntryError(
      "Time/Error tolerance", value_of(prm, {"Time"}, "Error tolerance"),
      "'inf' in porous rock that is not linear: its steps are backward Euler's, which "
      "are not chosen by error");
}


template <int dim>
void check_permeability(ParameterHandler &prm, const Case<dim> &the_case)
{
  for (const auto &[region, law] : the_case.laws.all())
    if (law->changes_permeability())
    {
      const auto refuse = [&, region = region](const std::string &allowed)
      { refuse_in_region(prm, region, "Permeability decay stress", allowed); };
      if (!the_case.elements.has_pore_pressure)
        refuse("nothing (an empty entry): no pore pressure is solved for, so permeability does not "
               "count; or 'Rock/Bulk model = poroelastic'");
      if (the_case.scheme.kind() == TimeScheme::Kind::newmark)
        refuse("nothing (an empty entry) with inertia");
      if (the_case.rock(region).plane_stress)
        refuse("nothing (an empty entry) in plane stress; or 'Rock/Plane state = plane strain'");
      const std::string leak_off = value_of(prm, {"Fracture flow"}, "Leak-off");
      // In the elements of the pore pressure, the rock's permeability is what it is there.
      if ((leak_off == "resolved" && !the_case.model->requirements().fluid_in_pores) ||
          leak_off == "filter cake")
        refuse("nothing (an empty entry) with 'Fracture flow/Leak-off = " + leak_off +
               "' from a network of cracks, which knows one permeability; or another law of "
               "leak-off; or 'Fluid = permeability tensor' with a fracture model that has it");
    }
}


template <int dim>
void check_random_rock(ParameterHandler &prm,
                       const Case<dim> &the_case,
                       std::vector<std::string> &warnings)
{
  if (!the_case.rock.is_random())
    return;
  const std::string leak_off = value_of(prm, {"Fracture flow"}, "Leak-off");
  for (const auto &[region, law] : the_case.laws.all())
  {
    const RockProperties &rock = the_case.rock(region);
    if (!rock.is_random())
      continue;
    const auto refuse = [&, region = region](const std::string &allowed)
    { refuse_in_region(prm, region, "Properties", allowed, "Random field"); };
    if (!the_case.model->requirements().random_rock)
      refuse("nothing (an empty entry) with the fracture model '" + the_case.model_name +
             "', which knows the rock by its region and not by its place");
    if (!law->is_linear() && rock.random->varies_in_bulk())
      refuse(
        "'tensile strength' or 'critical energy release rate' alone where the rock is not linear "
        "(it may yield, or its permeability hangs on the stress): its law knows one modulus and "
        "one permeability");
    if (std::isnan(rock.tensile_strength) && !std::isnan(rock.energy_release_rate) &&
        the_case.model->requirements().may_grow && is_cracked(the_case))
      warnings.push_back(
        "The rock varies from place to place, but its strength is the model's, and hangs on the "
        "size of the cells: with a deviation of a third the pressure of a fracture differed by "
        "17 % between cells of 0.2 and 0.1 m, with a strength that the deck gives by 3 %. For an "
        "answer that does not hang on the mesh give 'Rock/Tensile strength', with a model that "
        "takes one ('cohesive_xfem', 'damage').");
    if (rock.random->varies(RandomField::permeability) &&
        (leak_off == "resolved" || leak_off == "filter cake"))
      refuse("a list without 'permeability' with 'Fracture flow/Leak-off = " + leak_off +
             "', which knows one permeability; or another law of leak-off");
  }
  if (the_case.reference)
    throw EntryError("Verification/Reference", value_of(prm, {"Verification"}, "Reference"),
                     "'none' where 'Rock/Random field' says that the rock varies from place to "
                     "place: the solution is of rock that is the same everywhere");
}


namespace
{
/// Whether a solution tells how long a fracture is, and that it grows.
template <int dim>
bool is_of_growing_fracture(const ReferenceSolution<dim> &reference, const double time)
{
  const double last = std::min(time, reference.valid_until());
  const std::map<std::string, double> before = reference.values(0.5 * last),
                                      after = reference.values(last);
  const auto length = after.find("equivalent_length");
  return length != after.end() && length->second > before.at("equivalent_length");
}
} // namespace


template <int dim>
void check_reference(ParameterHandler &prm,
                     const Case<dim> &the_case,
                     std::vector<std::string> &warnings)
{
  if (the_case.reference &&
      std::any_of(the_case.laws.all().begin(), the_case.laws.all().end(),
                  [](const auto &law) { return law.second->changes_permeability(); }))
    throw EntryError(
      "Verification/Reference", value_of(prm, {"Verification"}, "Reference"),
      "'none' with a 'Rock/Permeability decay stress': the solution is of rock whose "
      "permeability does not hang on the stress");
  if (the_case.reference && the_case.laws.may_yield() && !the_case.reference->is_of_yielding_rock())
    throw EntryError(
      "Verification/Reference", value_of(prm, {"Verification"}, "Reference"),
      "'none' (or 'borehole', 'cavity' or 'footing') with a 'Rock/Law' that may yield: the "
      "solution is of linear rock");
  if (!the_case.reference)
    return;
  if (is_driven_on(the_case) && begins_on_an_edge(the_case) &&
      is_of_growing_fracture(*the_case.reference, the_case.control.end_time))
    throw EntryError(
      "Verification/Reference", value_of(prm, {"Verification"}, "Reference"),
      "'none': the crack begins on a side that is no plane of symmetry ('Boundary "
      "conditions/Roller'), and the solution is of a fracture in an unbounded body, of which "
      "symmetry shows a part");
  if (!the_case.reference->reaches(the_case.control.end_time))
    warnings.push_back(
      "The reference, " + the_case.reference->name() + ", holds until " +
      to_string(the_case.reference->valid_until(), dimension::time) +
      " only, for then its fracture is near to the walls, or no solution was found: errors are of "
      "the time before.");
  if (!the_case.scene.cracks.empty() && !the_case.model->requirements().may_grow &&
      is_of_growing_fracture(*the_case.reference, the_case.control.end_time))
    warnings.push_back("The reference, " + the_case.reference->name() +
                       ", is of a fracture that grows, which here none does ('Fracture/Model = " +
                       the_case.model_name + "'): errors against it tell nothing.");
  if constexpr (dim == 2)
    if (const double compressibility = the_case.rock.fluid().compressibility;
        compressibility > 0. && is_driven_on(the_case))
    {
      const Pumping pumping = first_pumping(the_case);
      const double share =
        compressibility *
        analytical::Kgd(plane_fracture(the_case, pumping)).inlet_pressure(pumping.duration);
      if (share > 0.01 && is_of_growing_fracture(*the_case.reference, the_case.control.end_time))
        warnings.push_back(
          "The reference, " + the_case.reference->name() +
          ", is of a fluid that nothing compresses; here the net pressure compresses it by " +
          to_string(100. * share, dimension::number) + " % ('Fluid/Bulk modulus').");
    }
  if (is_driven_on(the_case) &&
      half_length_at_start(the_case) > 0.5 * half_length_at_end(the_case) &&
      is_of_growing_fracture(*the_case.reference, the_case.control.end_time))
    warnings.push_back(
      "The reference, " + the_case.reference->name() +
      ", is of a fracture that has grown from nothing; the crack here is more than "
      "half as long as that is at the end: errors against it tell little.");
  // More than a deck's rounding of a direction: a tenth of a degree where stresses differ by half.
  constexpr double noticeable = 1e-3;
  for (const InitialCrack<dim> &crack : the_case.scene.cracks)
    if (const double shear = shear_stress(the_case.scene, crack);
        shear > noticeable * std::abs(closing_stress(the_case.scene, crack)) &&
        is_of_growing_fracture(*the_case.reference, the_case.control.end_time))
      warnings.push_back(
        "Crack '" + crack.text + "' has a shear stress of " + to_string(shear, dimension::stress) +
        " from the stress in situ and will turn. The reference, " + the_case.reference->name() +
        ", is of one that stays in its plane: errors against it tell nothing.");
}


void require_for_flow(ParameterHandler &prm, const bool in_pores, const bool in_fractures)
{
  if (in_pores)
    require(prm, "Rock", "Permeability",
            "a permeability > 0 m^2, such as '1 md', for the pore pressure is solved for; or 'Bulk "
            "model = elastic'");
  if (in_pores || in_fractures)
    require(prm, "Fluid", "Viscosity",
            "a viscosity > 0 Pa s, such as '1 cP', for there is flow in pores or fractures; or, "
            "where a fracture is dry, 'Cracks/Fluid pressure = 0'");
}


template <int dim>
void check_cracks(const Case<dim> &the_case, std::vector<std::string> &warnings)
{
  const auto &cracks = the_case.scene.cracks;
  if constexpr (dim == 2)
    if (const std::string text = body_in_two(cracks, the_case.geometry); !text.empty())
      warnings.push_back(text);
  the_case.network.check_perforations(cracks);
  for (const InitialCrack<dim> &crack : cracks)
    if (crack.kind == InitialCrack<dim>::Kind::propped &&
        the_case.network.leak_off_law() == LeakOff::carter)
      throw EntryError(crack.entry, crack.text,
                       "nothing (an empty entry) with 'Fracture flow/Leak-off = carter', which "
                       "knows how long faces have been bare and not what a well takes from them");
}


template <int dim>
void check_minimum_aperture(const Case<dim> &the_case, std::vector<std::string> &warnings)
{
  // A fracture may open by several times what its crack opens by when it sets out.
  constexpr double much_more = 10.;
  const Scales scales = scales_of(the_case.scene, the_case.network, the_case.boundary_conditions);
  const double given = the_case.network.smallest_hydraulic_aperture();
  if (given > much_more * scales.aperture)
    warnings.push_back(
      "Fracture flow/Minimum aperture, " + to_string(given, dimension::length) +
      ", is more than ten times what " + to_string(scales.pressure, dimension::pressure) + " (" +
      scales.source + ") open the first crack by, " +
      to_string(scales.aperture, dimension::length) +
      ": fluid moves as in a slot of that width, and hardly loses pressure. An empty entry takes a "
      "hundredth of what the crack opens by.");
}


template <int dim>
void check_vapour(ParameterHandler &prm,
                  const Case<dim> &the_case,
                  std::vector<std::string> &warnings)
{
  if (!the_case.network.may_cavitate())
    return;
  prm.enter_subsection("Fracture flow");
  const double vapour = get_quantity(prm, "Vapour pressure", dimension::pressure);
  prm.leave_subsection();
  constexpr double noticeable = 1e-3;
  for (const InitialCrack<dim> &crack : the_case.scene.cracks)
    if (const double closing = closing_stress(the_case.scene, crack);
        vapour - closing > noticeable * std::abs(closing))
    {
      warnings.push_back("Fracture flow/Vapour pressure, " +
                         to_string(vapour, dimension::pressure) +
                         ", is more than the stress in situ that presses the crack '" + crack.text +
                         "' together, " + to_string(closing, dimension::pressure) +
                         ": vapour opens it by itself, and where that is enough it grows without "
                         "end, without fluid.");
      return;
    }
}


/// BDF2 goes on from earlier states. Where a rate changes within a step, or what fills a segment,
/// the sum of its rates is not what has come, and no balance of a step shows that.
template <int dim>
void refuse_what_second_order_counts_wrongly(const Network<dim> &network)
{
  const auto refuse = [](const std::string &where)
  { throw EntryError("Time/Scheme", "BDF2", "backward Euler (or Newmark) " + where); };
  if (network.may_cavitate())
    refuse("with a finite 'Fracture flow/Vapour pressure'");
  if (network.maximum_pressure())
    refuse("where a well in a fracture has a given pressure");
  if (!network.minimum_well_pressures().empty() && !network.opens_into_rock())
    refuse(
      "where the rate of a well in a fracture may be negative (that of an expression may), for "
      "it may end at a least pressure");
}


template <int dim>
void check_scheme(const Deck &deck, ParameterHandler &prm, const Case<dim> &the_case)
{
  if (the_case.scheme.is_explicit() && the_case.elements.has_pore_pressure)
    throw EntryError("Time/Scheme", "explicit", "Newmark with a pore pressure ('Rock/Bulk model')");
  if (the_case.scheme.is_explicit() && !the_case.in_situ.is_zero())
    throw EntryError("Time/Scheme", "explicit",
                     "Newmark with a stress in situ or a pressure there");
  if (the_case.scheme.kind() == TimeScheme::Kind::newmark)
    require(prm, "Rock", "Density", "a density > 0 kg/m^3, such as '2500 kg/m^3', with inertia");
  if (std::isfinite(the_case.control.error_tolerance) &&
      the_case.scheme.kind() != TimeScheme::Kind::bdf2)
    throw EntryError(
      "Time/Error tolerance", *deck.peek("Time/Error tolerance"),
      "'inf', or 'Time/Scheme = BDF2', the only one whose steps are chosen by error");
  if (the_case.scheme.kind() == TimeScheme::Kind::bdf2)
    refuse_what_second_order_counts_wrongly(the_case.network);
  for (const InitialCrack<dim> &crack : the_case.scene.cracks)
    if (crack.proppant.aperture > 0. && the_case.scheme.kind() != TimeScheme::Kind::backward_euler)
      throw EntryError("Time/Scheme",
                       the_case.scheme.kind() == TimeScheme::Kind::bdf2 ? "BDF2" : "Newmark",
                       "backward Euler with a 'Cracks/Propped aperture' > 0: the faces jump apart "
                       "in the first step, and other schemes go on from how they have moved");
}


template <int dim>
void check_restarts(ParameterHandler &prm, const Case<dim> &the_case)
{
  const std::string with = " with 'Coupling/Scheme = as published'";
  const auto refuse = [&](const std::vector<std::string> &sections, const std::string &name,
                          const std::string &allowed)
  { throw EntryError(sections[0] + "/" + name, value_of(prm, sections, name), allowed + with); };
  if (!the_case.model->requirements().breaks_between_steps)
    refuse({"Fracture"}, "Model", "damage");
  if (the_case.scheme.kind() != TimeScheme::Kind::backward_euler)
    refuse({"Time"}, "Scheme", "auto or backward Euler");
  const bool in_pores = the_case.model->requirements().fluid_in_pores;
  if (the_case.elements.has_pore_pressure && !in_pores)
    refuse({"Rock"}, "Bulk model",
           "elastic (fluid in a network of cracks, none in pores), or 'Fracture/damage/Fluid = "
           "permeability tensor',");
  for (const auto &[region, law] : the_case.laws.all())
    if (law->changes_permeability())
      refuse_in_region(prm, region, "Permeability decay stress", "nothing (an empty entry)" + with);
  if (!the_case.laws.are_linear())
    refuse({"Rock"}, "Law", "elastic");
  if (the_case.network.leak_off_law() != LeakOff::none && !in_pores)
    refuse({"Fracture flow"}, "Leak-off", "none");
  // One pass does not find out when faces part: they have from the start.
  for (const InitialCrack<dim> &crack : the_case.scene.cracks)
  {
    const double closing = closing_stress(the_case.scene, crack),
                 pores = the_case.scene.in_situ_pore_pressure(crack.disc ? crack.disc->centre
                                                                         : crack.points.front());
    if (in_pores && std::abs(closing - pores) > 1e-3 * std::abs(closing))
      refuse({"In situ"}, "Pore pressure",
             "the stress across the crack '" + crack.text + "', " +
               to_string(closing, dimension::pressure) +
               ", where the elements of the pore pressure carry the fluid of fractures,");
  }
  if (the_case.network.may_cavitate())
    refuse({"Fracture flow"}, "Vapour pressure", "-inf");
  if (the_case.boundary_conditions.controlled_load())
    refuse({"Boundary conditions"}, "Controlled load", "nothing (an empty entry)");
}


#define INSTANTIATE(dim)                                                                           \
  template void refuse_incompressible(ParameterHandler &prm, const Rock &rock,                     \
                                      const Geometry<dim> &geometry,                               \
                                      const BoundaryConditions<dim> &boundary_conditions);         \
  template void refuse_absent_regions(ParameterHandler &prm, const Geometry<dim> &geometry);       \
  template std::vector<std::string> regions_without_rock(ParameterHandler &prm,                    \
                                                         const Geometry<dim> &geometry);           \
  template void check_layers<dim>(ParameterHandler & prm, const RockLaws &laws, const Rock &rock); \
  template void check_history(ParameterHandler &prm, const Case<dim> &the_case);                   \
  template void check_permeability(ParameterHandler &prm, const Case<dim> &the_case);              \
  template void check_random_rock(ParameterHandler &prm, const Case<dim> &the_case,                \
                                  std::vector<std::string> &warnings);                             \
  template void check_reference(ParameterHandler &prm, const Case<dim> &the_case,                  \
                                std::vector<std::string> &warnings);                               \
  template void check_cracks(const Case<dim> &the_case, std::vector<std::string> &warnings);       \
  template void check_minimum_aperture(const Case<dim> &the_case,                                  \
                                       std::vector<std::string> &warnings);                        \
  template void check_vapour(ParameterHandler &prm, const Case<dim> &the_case,                     \
                             std::vector<std::string> &warnings);                                  \
  template void check_restarts(ParameterHandler &prm, const Case<dim> &the_case);                  \
  template void check_scheme(const Deck &deck, ParameterHandler &prm, const Case<dim> &the_case);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork
