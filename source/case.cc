#include "case.h"

#include "case_checks.h"
#include "idle_entries.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "base/parameter_tree.h"
#include "coupling/initial_cracks.h"
#include "output/checkpoint.h"
#include "output/field_output.h"

#include <algorithm>
#include <filesystem>
#include <map>
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
                     network.needs_pore_pressure() || network.opens_into_rock() ||
                     requirements.pore_pressure;
  if (rock.bulk_model() == "elastic" &&
      (network.needs_pore_pressure() || requirements.pore_pressure))
    throw EntryError(
      "Rock/Bulk model", "elastic",
      "poroelastic or auto, because the fracture model or its leak-off needs the pore "
      "pressure");
  if (rock.bulk_model() == "elastic" && network.opens_into_rock())
    throw EntryError(
      "Rock/Bulk model", "elastic",
      "poroelastic or auto, because a well opens into the rock ('Opens into'), whose "
      "pores take its fluid");
  if (rock.bulk_model() == "elastic" && boundary_conditions.mentions_pore_pressure())
    throw EntryError("Rock/Bulk model", "elastic",
                     "poroelastic or auto, because 'Boundary conditions' gives pore pressures or "
                     "fluxes, which an elastic rock does not have: leave one of them out");
  elements.has_pore_pressure =
    rock.bulk_model() == "poroelastic" || (rock.bulk_model() == "auto" && asked);

  prm.enter_subsection("Discretisation");
  const std::string pair = prm.get("Elements");
  elements.displacement_degree = pair.substr(0, 2) == "Q2" ? 2 : 1;
  if (pair == "Q1-Q1 stabilised")
    elements.stabilisation = PressureStabilisation::projection;
  prm.leave_subsection();
  return elements;
}


/// The greatest of the first well within a run, where pieces or a constant give it.
template <int dim>
double maximum_rate(const Network<dim> &network, const StepControl &control)
{
  double greatest = network.rate_of_first_well(control.end_time);
  for (double t = control.start_time; t < control.end_time; t = network.next_jump(t))
    greatest = std::max(greatest, network.rate_of_first_well(t));
  return greatest;
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


/// The entries of the fracture model that are 'auto', with their sections.
std::vector<std::string> automatic_entries(const ParameterHandler &prm, const std::string &model)
{
  std::vector<std::string> names;
  for (const DeclaredEntry &entry : declared_entries(prm))
    if (entry.section == "Fracture/" + model && entry.value == "auto")
      names.push_back(entry.name);
  return names;
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
  {
    std::string those;
    for (const auto &[other, entry] : plug_ins.fracture_models.all())
      if (create_function<dim>(entry))
        those += (those.empty() ? "" : ", ") + other;
    throw EntryError("Fracture/Model", name,
                     "one that exists in " + std::to_string(dim) + "-D: " + those);
  }
  const bool has_section = prm.subsection_path_exists({name});
  if (has_section)
    prm.enter_subsection(name);
  try
  {
    std::unique_ptr<FractureModel<dim>> model = create(prm, scene);
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
  prm.declare_entry("Physics", "as the deck says", Patterns::Selection("as the deck says|auto"),
                    "auto: inertia, plasticity, and the pore pressure with its diffusion are left "
                    "out where the numbers of the scene promise that this changes the answer by no "
                    "more than Accuracy. The scene audit says what and why, or why not.");
  prm.declare_entry("Accuracy", "2 %", Quantity(dimension::number, Range::positive()),
                    "What Physics = auto may change the answer by, and Fracture/Model = auto or "
                    "Resolution = auto may err by.");
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
  prm.declare_entry("Model", "none", Patterns::Selection("auto|" + names),
                    "The fracture model. auto: the cheapest for which the charts that ship promise "
                    "Accuracy, with the settings of models/<model>.part.prm, which is read after "
                    "the deck.");
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


/// Wells in the rock and what they pump from when on, as far as that is in pieces.
template <int dim>
std::vector<ReferenceSource<dim>> sources_in_rock(const Network<dim> &network,
                                                  const StepControl &control)
{
  std::vector<ReferenceSource<dim>> sources;
  for (const auto &well : network.sources_in_rock())
  {
    ReferenceSource<dim> source{well.number,          well.points,           well.fraction,
                                well.borehole_radius, well.minimum_pressure, {}};
    for (double t = control.start_time; well.rate.is_in_pieces() && t < control.end_time;)
    {
      const double next = std::min(well.rate.next_jump(t), control.end_time);
      source.rates.emplace_back(t, well.rate(next, next)); // a piece holds until its end
      t = next;
    }
    sources.push_back(source);
  }
  return sources;
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
  input.rate_is_constant = wells_are_constant(the_case);
  input.n_wells = the_case.network.n_wells();
  input.sources = sources_in_rock(the_case.network, the_case.control);
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
  input.maximum_displacement = [&the_case](const double time)
  { return the_case.boundary_conditions.maximum_displacement(time); };
  const Point<dim> centre =
    the_case.geometry.lower() + 0.5 * (the_case.geometry.upper() - the_case.geometry.lower());
  input.law = &the_case.laws(0);
  input.in_situ_stress = the_case.in_situ.tensor(centre, the_case.rock.main());
  input.in_situ_pressure = the_case.in_situ.pore_pressure(centre);
  input.hole_radius = the_case.geometry.hole_radius();
  return input;
}


/// Whether the energies of the rock can be compared with the work done on it: without fluid, and
/// where the work is that of what is prescribed (with inertia: of nothing).
template <int dim>
bool can_audit_energy(const Case<dim> &the_case)
{
  bool moved = the_case.boundary_conditions.controlled_load().has_value();
  // At some time, for a cycle of load may end where it began.
  for (unsigned int i = 0; i <= 100; ++i)
    moved |= the_case.boundary_conditions.maximum_displacement(
               the_case.control.start_time +
               0.01 * i * (the_case.control.end_time - the_case.control.start_time)) > 0.;
  return !the_case.elements.has_pore_pressure && the_case.in_situ.is_zero() &&
         (the_case.scene.cracks.empty() || the_case.scene.crack_pressure == 0. ||
          (the_case.scheme.is_explicit() && !std::isnan(the_case.scene.crack_pressure))) &&
         (the_case.scheme.kind() == TimeScheme::Kind::newmark
            ? !moved || the_case.scheme.is_explicit()
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
  scene.moves_side = [this](const types::boundary_id side)
  { return boundary_conditions.moves(side); };
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
  scene.leaks_by_carter = network.leak_off_law() == LeakOff::carter;
  network.set_fluid(rock.fluid().viscosity, rock.fluid().compressibility,
                    rock.main().permeability / rock.fluid().viscosity);
  for (const types::material_id region : regions)
    network.set_mobility(region, rock(region).permeability / rock.fluid().viscosity);

  scene.cracks = parse_initial_cracks<dim>(prm, geometry.lower(), geometry.upper());
  scene.domain_size = geometry.diameter();
  check_cracks(*this, warnings);
  scene.crack_pressure = given_crack_pressure(prm);
  network.set_pressures(scene.crack_pressure, scene.in_situ_stress);
  control.parse_parameters(prm);
  network.check_wells(control.start_time, control.end_time);
  scene.injection_rate = maximum_rate(network, control);
  in_situ.check(prm, rock.main().density,
                std::isnan(scene.crack_pressure) ? scene.cracks : std::vector<InitialCrack<dim>>(),
                warnings);
  prm.enter_subsection("Fracture");
  model_name = prm.get("Model");
  prm.leave_subsection();
  const std::vector<ChosenValue> chosen_for_flow = set_flow_scales(prm, *this);
  const std::vector<std::string> automatic = automatic_entries(prm, model_name);
  model = make_model<dim>(prm, plug_ins, scene);
  const std::map<std::string, std::string> reasons = model->reasons();
  for (const std::string &entry : automatic)
    if (const std::string value = value_of(prm, {"Fracture", model_name}, entry); value != "auto")
      chosen.push_back({"Fracture/" + model_name + "/" + entry, value,
                        reasons.count(entry) > 0
                          ? reasons.at(entry)
                          : "what 'auto' comes to with the deck's other entries"});
  const bool has_fracture = model->requirements().has_fracture;
  const bool solves_for_flow = has_fracture && std::isnan(scene.crack_pressure);
  if (solves_for_flow)
  {
    chosen.insert(chosen.begin(), chosen_for_flow.begin(), chosen_for_flow.end());
    check_minimum_aperture(*this, warnings);
    check_vapour(prm, *this, warnings);
  }
  refuse_regions(prm, rock, model_name, model->requirements().regional_rock);
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

  scheme.parse_parameters(prm, !has_fracture && elements.has_pore_pressure && laws.are_linear() &&
                                 !network.may_cavitate());
  elements.numbered_along_rows = scheme.is_explicit(); // steps sweep the lattice

  linear_solver.parse_parameters(prm);
  check_history(prm, *this);
  check_permeability(prm, *this);
  check_scheme(deck, prm, *this);
  CouplingParameters coupling;
  coupling.parse_parameters(prm);
  coupling.check(rock.main(), elements.has_pore_pressure, has_fracture, network.has_wells());
  if (coupling.restarts())
    check_restarts(prm, *this);

  reference = make_reference<dim>(prm, reference_input(prm, *this));
  starts_from_reference = stockwork::starts_from_reference(prm);
  check_random_rock(prm, *this, warnings);
  check_reference(prm, *this, warnings);
  audits_energy = !coupling.restarts() && can_audit_energy(*this);
  if (const std::string &entry = boundary_conditions.entry_with_reference(); !entry.empty())
  {
    if (!reference || !reference->field())
      throw EntryError(entry, *deck.peek(entry),
                       "a quantity or a function, for subsection Verification names no reference "
                       "that gives fields");
    boundary_conditions.set_reference(reference->field());
    walls_follow_reference = true;
  }
  for (const std::string &warning : idle_entries(prm, *this))
    warnings.push_back(warning);
}


template struct Case<2>;
template struct Case<3>;
} // namespace stockwork
