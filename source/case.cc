#include "case.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "base/parameter_tree.h"
#include "coupling/initial_cracks.h"
#include "output/checkpoint.h"
#include "output/field_output.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace stockwork
{
using namespace dealii;

namespace
{
template <int dim>
void declare_for_dimension(ParameterHandler &prm)
{
  Geometry<dim>::declare_parameters(prm);
  InSitu<dim>::declare_parameters(prm);
  BoundaryConditions<dim>::declare_parameters(prm);
  Network<dim>::declare_parameters(prm);
  CoupledSystem<dim>::declare_parameters(prm);
}


/// Displacement and pressure elements, and whether there is a pore pressure at all.
template <int dim>
ElementSettings parse_elements(ParameterHandler &prm,
                               const Rock &rock,
                               const BoundaryConditions<dim> &boundary_conditions,
                               const Network<dim> &network,
                               const Requirements &requirements)
{
  ElementSettings elements;
  const bool asked = boundary_conditions.mentions_pore_pressure() ||
                     network.needs_pore_pressure() || requirements.pore_pressure;
  if (rock.bulk_model() == "elastic" &&
      (network.needs_pore_pressure() || requirements.pore_pressure))
    throw EntryError(
      "Rock/Bulk model", "elastic",
      "poroelastic or auto, because the fracture model or its leak-off needs the pore "
      "pressure");
  if (rock.bulk_model() == "elastic" && boundary_conditions.mentions_pore_pressure())
    throw EntryError("Rock/Bulk model", "elastic",
                     "poroelastic or auto, because 'Boundary conditions' gives pore pressures or "
                     "fluxes, which an elastic rock does not have: leave one of them out");
  elements.has_pore_pressure =
    rock.bulk_model() == "poroelastic" || (rock.bulk_model() == "auto" && asked);

  prm.enter_subsection("Discretisation");
  const std::string pair = prm.get("Elements");
  elements.displacement_degree = pair.substr(0, 2) == "Q2" ? 2 : 1;
  if (requirements.linear_elements && elements.displacement_degree > 1)
    throw EntryError("Discretisation/Elements", pair,
                     "Q1-Q1 stabilised or Q1-Q1, because the nodes of the fracture model are the "
                     "vertices of cells");
  if (pair == "Q1-Q1 stabilised")
    elements.stabilisation = PressureStabilisation::projection;
  prm.leave_subsection();
  return elements;
}


/// Where nothing gives way, neither rock nor fluid nor boundary, the level of the pore pressure is
/// anything, and what is injected has no place.
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


/// What a region may not have of its own: what it breaks at where the fracture model knows one
/// strength, and its stiffness as well where the model knows one rock only. Pores, their fluid and
/// the mass are the elements' everywhere.
void refuse_regions(ParameterHandler &prm,
                    const std::string &model_name,
                    const Requirements &requirements)
{
  std::vector<std::string> refused = {"Fracture toughness", "Critical energy release rate",
                                      "Shear energy release rate", "Tensile strength"};
  if (requirements.uniform_rock)
    refused.insert(refused.end(),
                   {"Young modulus", "Poisson ratio", "Biot coefficient", "Solid bulk modulus"});
  for (const DeclaredEntry &entry : declared_entries(prm))
    if (entry.path().compare(0, 12, "Rock/Region ") == 0)
      if (!entry.value.empty() &&
          std::find(refused.begin(), refused.end(), entry.name) != refused.end())
        throw EntryError(entry.path(), entry.value,
                         "nothing (an empty entry) with the fracture model '" + model_name +
                           (requirements.uniform_rock
                              ? "', whose rock is one and the same everywhere; 'cohesive_xfem' and "
                                "'prescribed' know "
                                "regions"
                              : "', which breaks all rock as it breaks outside of the regions"));
}


/// Section of the region that an entry belongs to, also in a subsection of it; empty: none.
std::string region_section(const DeclaredEntry &entry)
{
  if (entry.section.compare(0, 12, "Rock/Region ") != 0)
    return "";
  return entry.section.substr(0, entry.section.find('/', 12));
}


/// Rock of a region that the mesh does not have would be nowhere.
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


/// Regions that the deck names and says nothing of.
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


/// An open crack from side to side leaves two bodies, each of which must be held.
std::string body_in_two(const std::vector<InitialCrack<2>> &cracks, const Geometry<2> &geometry)
{
  for (const InitialCrack<2> &crack : cracks)
    if (crack.kind == InitialCrack<2>::Kind::open && geometry.on_side(crack.points.front()) &&
        geometry.on_side(crack.points.back()))
      return "The open crack '" + crack.text +
             "' cuts the rock in two: sides of both parts must be held, or nothing resists the "
             "motion of one of them.";
  return "";
}


/// The greatest of the first well within a run, where pieces or a constant give it.
template <int dim>
double greatest_rate(const Network<dim> &network, const StepControl &control)
{
  double greatest = network.rate_of_first_well(control.end_time);
  for (double t = control.start_time; t < control.end_time; t = network.next_jump(t))
    greatest = std::max(greatest, network.rate_of_first_well(t));
  return greatest;
}


/// Refuse what holds in a region, at the region's own entry or where that is inherited from.
/// @throws EntryError
[[noreturn]] void refuse_in_region(ParameterHandler &prm,
                                   const types::material_id region,
                                   const std::string &name,
                                   const std::string &allowed)
{
  if (region != 0)
  {
    const std::string section = "Region " + std::to_string(region);
    if (const std::string own = value_of(prm, {"Rock", section}, name); !own.empty())
      throw EntryError("Rock/" + section + "/" + name, own, allowed);
  }
  throw EntryError("Rock/" + name, value_of(prm, {"Rock"}, name), allowed);
}


/// What layers of the rock cannot be.
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
    const bool stress_counts = std::isfinite(properties.permeability_decay_stress);
    if ((!properties.has_isotropic_permeability() || stress_counts) &&
        (leak_off == "resolved" || leak_off == "filter cake"))
      refuse(stress_counts ? "Permeability decay stress" : "Permeability across the layers",
             "nothing (an empty entry) with 'Fracture flow/Leak-off = " + leak_off +
               "', which knows one permeability; or another law of leak-off");
  }
}


/// The fluid in the pores of rock with a history is balanced from one step to the next.
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


/// Permeability that hangs on the stress, where nobody looks at it.
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
    }
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


/// The scales of the case, handed to the flow in fractures, and the entries that follow from them.
template <int dim>
std::vector<ChosenValue> set_flow_scales(ParameterHandler &prm, Case<dim> &the_case)
{
  const Scales scales = scales_of(the_case.scene, the_case.network, the_case.boundary_conditions);
  const std::vector<ChosenValue> chosen = fill_in_flow(prm, scales);
  prm.enter_subsection("Fracture flow");
  const double minimum_aperture = get_quantity(prm, "Minimum aperture", dimension::length);
  prm.leave_subsection();
  the_case.network.set_scales(minimum_aperture, scales.pressure, scales.aperture, scales.length);
  return chosen;
}


template <int dim>
const auto &create_function(const FractureModelEntry &entry)
{
  if constexpr (dim == 2)
    return entry.create_2d;
  else
    return entry.create_3d;
}


template <int dim>
std::unique_ptr<FractureModel<dim>>
make_model(ParameterHandler &prm, const PlugIns &plug_ins, const Scene<dim> &scene)
{
  prm.enter_subsection("Fracture");
  const std::string name = prm.get("Model");
  const auto &create = create_function<dim>(plug_ins.fracture_models.find(name));
  if (!create)
    throw EntryError("Fracture/Model", name,
                     "a model that exists in " + std::to_string(dim) + "-D");
  const bool has_section = prm.subsection_path_exists({name});
  if (has_section)
    prm.enter_subsection(name);
  try
  {
    auto model = create(prm, scene);
    if (has_section)
      prm.leave_subsection();
    prm.leave_subsection();
    return model;
  }
  catch (const EntryError &)
  {
    throw;
  }
  catch (const InputError &error)
  {
    throw EntryError("Fracture/Model", name,
                     std::string("a model that suits the case. ") + error.what());
  }
}
} // namespace


void declare_all_parameters(ParameterHandler &prm, const PlugIns &plug_ins)
{
  Deck::declare_parameters(prm);
  prm.declare_entry("Title", "", Patterns::Anything(), "For people; appears in the log.");
  prm.declare_entry("Dimension", "2", Patterns::Selection("2|3"), "Of space.");
  prm.declare_entry("Output directory", "output", Patterns::Anything(),
                    "Where results go; --output overrides it.");
  prm.declare_entry("Additional shared libraries", "", Patterns::Anything(),
                    "Files, separated by commas, that bring fracture models of their own; relative "
                    "to the deck.");
  Rock::declare_parameters(prm);
  RockLaws::declare_parameters(prm, plug_ins.rock_laws);
  declare_for_dimension<2>(prm);
  TimeScheme::declare_parameters(prm);
  StepControl::declare_parameters(prm);
  declare_reference_parameters(prm);
  declare_initial_cracks(prm);
  FieldOutput<2>::declare_parameters(prm);
  CheckpointSchedule::declare_parameters(prm);

  prm.enter_subsection("Discretisation");
  prm.declare_entry("Elements", "Q2-Q1", Patterns::Selection("Q2-Q1|Q1-Q1 stabilised|Q1-Q1"),
                    "Displacement and pore pressure. Plain Q1-Q1 oscillates in the undrained limit "
                    "and is here to show it. In elastic rock only the first counts.");
  prm.leave_subsection();

  prm.enter_subsection("Fracture");
  std::string names;
  for (const auto &[name, entry] : plug_ins.fracture_models.all())
    names += (names.empty() ? "" : "|") + name;
  prm.declare_entry("Model", "none", Patterns::Selection(names), "The fracture model.");
  for (const auto &[name, entry] : plug_ins.fracture_models.all())
  {
    // An empty section would be printed, and is none when it is read again.
    ParameterHandler own;
    entry.declare_parameters(own);
    if (declared_entries(own).empty())
      continue;
    prm.enter_subsection(name);
    entry.declare_parameters(prm);
    prm.leave_subsection();
  }
  prm.leave_subsection();
}


namespace
{
/// What loads the first crack: the fluid's pressure less the in-situ stress across it, and the
/// in-situ shear stress along it.
template <int dim>
void set_crack_load(const Scene<dim> &scene, ReferenceInput<dim> &input)
{
  input.crack_pressure = scene.crack_pressure;
  if (const auto &disc = scene.cracks[0].disc)
    input.crack_pressure += disc->normal * (scene.in_situ_stress(disc->centre) * disc->normal);
  if constexpr (dim == 2)
  {
    const auto &crack = scene.cracks[0].points;
    const Tensor<1, 2> along =
      (crack.back() - crack.front()) / crack.back().distance(crack.front());
    const Tensor<1, 2> normal = Point<2>(-along[1], along[0]);
    const auto traction =
      scene.in_situ_stress(crack.front() + 0.5 * (crack.back() - crack.front())) * normal;
    input.crack_pressure += traction * normal;
    input.crack_shear = traction * along;
  }
}


/// What the reference solution is told of the case.
template <int dim>
ReferenceInput<dim> reference_input(ParameterHandler &prm, const Case<dim> &the_case)
{
  ReferenceInput<dim> input{the_case.rock, the_case.geometry.lower(), the_case.geometry.upper()};
  input.has_pore_pressure = the_case.elements.has_pore_pressure;
  input.start_time = the_case.control.start_time;
  input.end_time = the_case.control.end_time;
  for (const InitialCrack<dim> &crack : the_case.scene.cracks)
  {
    input.cracks.push_back(crack.points);
    if (crack.disc)
      input.discs.push_back(*crack.disc);
  }
  input.injection_rate = the_case.network.rate_of_first_well(the_case.control.end_time);
  input.rate_is_constant = std::isinf(the_case.network.next_jump(the_case.control.start_time));
  input.n_wells = the_case.network.n_wells();
  if (the_case.network.has_wells())
  {
    input.fraction_in_model = the_case.network.fraction_of_first_well();
    input.perforations = the_case.network.perforations_of_first_well();
  }
  input.layered = !the_case.geometry.region_names().empty();
  input.has_stress_gradient = the_case.in_situ.has_gradient();
  prm.enter_subsection("Fracture flow");
  input.leaks = prm.get("Leak-off") != "none";
  if (prm.get("Leak-off") == "carter")
    input.carter_coefficient = get_quantity(prm, "Carter coefficient", dimension::carter);
  prm.leave_subsection();
  if (!the_case.scene.cracks.empty())
    set_crack_load(the_case.scene, input);
  input.normal_traction = [&the_case](const std::string &side, const double time)
  {
    return the_case.boundary_conditions.loads().uniform_normal_traction(
      the_case.geometry.side(side), time);
  };
  input.is_roller = [&the_case](const std::string &side)
  { return the_case.boundary_conditions.is_roller(the_case.geometry.side(side)); };
  input.greatest_displacement = [&the_case](const double time)
  { return the_case.boundary_conditions.greatest_displacement(time); };
  const Point<dim> centre =
    the_case.geometry.lower() + 0.5 * (the_case.geometry.upper() - the_case.geometry.lower());
  input.law = &the_case.laws(0);
  input.in_situ_stress = the_case.in_situ.tensor(centre, the_case.rock.main());
  input.in_situ_pressure = the_case.in_situ.pore_pressure(centre);
  input.hole_radius = the_case.geometry.hole_radius();
  return input;
}


/// What a reference solution cannot be of.
template <int dim>
void check_reference(ParameterHandler &prm, const Case<dim> &the_case)
{
  if (the_case.reference &&
      std::any_of(the_case.laws.all().begin(), the_case.laws.all().end(),
                  [](const auto &law) { return law.second->changes_permeability(); }))
    throw EntryError(
      "Verification/Reference", value_of(prm, {"Verification"}, "Reference"),
      "'none' with a 'Rock/Permeability decay stress': the solution is of rock whose "
      "permeability does not hang on the stress");
  if (the_case.reference && the_case.laws.may_yield() && !the_case.reference->is_of_yielding_rock())
    throw EntryError("Verification/Reference", value_of(prm, {"Verification"}, "Reference"),
                     "'none' (or 'borehole' or 'footing') with a 'Rock/Law' that may yield: the "
                     "solution is of linear rock");
}


/// What flow in pores and in fractures cannot do without.
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


/// What cracks cannot be in this body, with these wells and this leak-off.
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


/// What a scheme in time needs, and what it cannot be with.
template <int dim>
void check_scheme(const Deck &deck, ParameterHandler &prm, const Case<dim> &the_case)
{
  if (the_case.scheme.kind() == TimeScheme::Kind::newmark)
    require(prm, "Rock", "Density", "a density > 0 kg/m^3, such as '2500 kg/m^3', with inertia");
  if (std::isfinite(the_case.control.error_tolerance) &&
      the_case.scheme.kind() != TimeScheme::Kind::bdf2)
    throw EntryError(
      "Time/Error tolerance", *deck.peek("Time/Error tolerance"),
      "'inf', or 'Time/Scheme = BDF2', the only one whose steps are chosen by error");
  if (the_case.network.may_boil() && the_case.scheme.kind() == TimeScheme::Kind::bdf2)
    throw EntryError("Time/Scheme", "BDF2",
                     "backward Euler (or Newmark) with a finite 'Fracture flow/Vapour pressure'");
  for (const InitialCrack<dim> &crack : the_case.scene.cracks)
    if (crack.proppant.aperture > 0. && the_case.scheme.kind() != TimeScheme::Kind::backward_euler)
      throw EntryError("Time/Scheme",
                       the_case.scheme.kind() == TimeScheme::Kind::bdf2 ? "BDF2" : "Newmark",
                       "backward Euler with a 'Cracks/Propped aperture' > 0: the faces jump apart "
                       "in the first step, and other schemes go on from how they have moved");
}


/// Whether the energies of the rock can be compared with the work done on it: without fluid, and
/// where the work is that of what is prescribed (with inertia: of nothing).
template <int dim>
bool can_audit_energy(const Case<dim> &the_case)
{
  bool moved = false; // at some time, for a cycle of load may end where it began
  for (unsigned int i = 0; i <= 100; ++i)
    moved |= the_case.boundary_conditions.greatest_displacement(
               the_case.control.start_time +
               0.01 * i * (the_case.control.end_time - the_case.control.start_time)) > 0.;
  return !the_case.elements.has_pore_pressure && the_case.in_situ.is_zero() &&
         (the_case.scene.cracks.empty() || the_case.scene.crack_pressure == 0.) &&
         (the_case.scheme.kind() == TimeScheme::Kind::newmark
            ? !moved
            : moved && the_case.boundary_conditions.loads().empty());
}
} // namespace


template <int dim>
Case<dim>::Case(const Deck &deck, ParameterHandler &prm, const PlugIns &plug_ins)
  : name(deck.name())
  , scene{rock,
          {},
          false,
          [this](const Point<dim> &x) { return in_situ.stress(x); },
          [this](const Point<dim> &x) { return in_situ.pore_pressure(x); },
          0.}
{
  scene.rock_law = [this](const types::material_id region) -> const RockLaw &
  { return laws(region); };
  scene.in_situ_tensor = [this](const Point<dim> &x, const RockProperties &properties)
  { return in_situ.tensor(x, properties); };
  geometry.parse_parameters(prm, std::filesystem::path(deck.file()).parent_path().string());
  std::vector<types::material_id> regions;
  for (const std::string &region : geometry.region_names())
    regions.push_back(geometry.region(region));
  laws.parse_parameters(prm, plug_ins.rock_laws, regions, rock);
  check_layers<dim>(prm, laws, rock);
  if (dim == 3 && rock.main().plane_stress)
    throw EntryError("Rock/Plane state", "plane stress", "'plane strain' (or nothing) in 3-D");
  in_situ.parse_parameters(prm);
  boundary_conditions.parse_parameters(prm, [this](const std::string &side)
                                       { return geometry.side(side); });
  network.parse_parameters(prm);
  network.set_fluid(rock.fluid().viscosity, rock.fluid().compressibility,
                    rock.main().permeability / rock.fluid().viscosity);

  scene.cracks = parse_initial_cracks<dim>(prm, geometry.lower(), geometry.upper());
  scene.domain_size = geometry.diameter();
  check_cracks(*this, warnings);
  scene.crack_pressure = given_crack_pressure(prm);
  control.parse_parameters(prm);
  network.check_wells(control.start_time, control.end_time);
  scene.injection_rate = greatest_rate(network, control);
  in_situ.check(prm, rock.main().density,
                std::isnan(scene.crack_pressure) ? scene.cracks : std::vector<InitialCrack<dim>>(),
                warnings);
  prm.enter_subsection("Fracture");
  model_name = prm.get("Model");
  prm.leave_subsection();
  const std::vector<ChosenValue> chosen_for_flow = set_flow_scales(prm, *this);
  model = make_model<dim>(prm, plug_ins, scene);
  const bool has_fracture = model->requirements().has_fracture;
  const bool solves_for_flow = has_fracture && std::isnan(scene.crack_pressure);
  if (solves_for_flow)
    chosen = chosen_for_flow;
  if (model->requirements().uniform_rock || model->requirements().uniform_strength)
    refuse_regions(prm, model_name, model->requirements());
  refuse_absent_regions(prm, geometry);
  for (const std::string &region : regions_without_rock(prm, geometry))
    warnings.push_back("Region '" + region +
                       "' of the mesh is rock as everywhere else: subsection "
                       "'Rock/Region " +
                       std::to_string(geometry.region(region)) + "' is empty.");
  elements = parse_elements<dim>(prm, rock, boundary_conditions, network, model->requirements());
  scene.has_pore_pressure = elements.has_pore_pressure;
  require_for_flow(prm, elements.has_pore_pressure, solves_for_flow);
  if (elements.has_pore_pressure)
    refuse_incompressible(prm, rock, geometry, boundary_conditions);

  scheme.parse_parameters(prm, !has_fracture && elements.has_pore_pressure && laws.are_linear());

  check_history(prm, *this);
  check_permeability(prm, *this);
  check_scheme(deck, prm, *this);
  CouplingParameters coupling;
  coupling.parse_parameters(prm);
  coupling.check(rock.main(), elements.has_pore_pressure, has_fracture, network.has_wells());

  reference = make_reference<dim>(prm, reference_input(prm, *this));
  starts_from_reference = stockwork::starts_from_reference(prm);
  check_reference(prm, *this);
  audits_energy = can_audit_energy(*this);
  if (const std::string &entry = boundary_conditions.entry_with_reference(); !entry.empty())
  {
    if (!reference || !reference->field())
      throw EntryError(entry, *deck.peek(entry),
                       "a quantity or a function, for subsection Verification names no reference "
                       "that gives fields");
    boundary_conditions.set_reference(reference->field());
    walls_follow_reference = true;
  }
}


template struct Case<2>;
template struct Case<3>;
} // namespace stockwork
