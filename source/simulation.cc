#include "simulation.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/base/version.h"

#include "biot/boundary_conditions.h"
#include "biot/in_situ.h"
#include "coupling/coupled_system.h"
#include "coupling/initial_cracks.h"
#include "coupling/mesh_adaptation.h"
#include "coupling/stepper.h"
#include "flow/network.h"
#include "mesh/geometry.h"
#include "report.h"

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/vector_tools.h>

#include <filesystem>

namespace stockwork
{
using namespace dealii;

namespace
{
template <int dim>
void
declare_for_dimension(ParameterHandler &prm)
{
  Geometry<dim>::declare_parameters(prm);
  InSitu<dim>::declare_parameters(prm);
  BoundaryConditions<dim>::declare_parameters(prm);
  Network<dim>::declare_parameters(prm);
  CoupledSystem<dim>::declare_parameters(prm);
}


/// Displacement and pressure elements, and whether there is a pore pressure at all.
template <int dim>
Discretisation
parse_discretisation(ParameterHandler              &prm,
                     const Rock                    &rock,
                     const BoundaryConditions<dim> &boundary_conditions,
                     const Network<dim>            &network,
                     const Requirements            &requirements)
{
  Discretisation discretisation;
  const bool     asked = boundary_conditions.mentions_pore_pressure() ||
                     network.needs_pore_pressure() || requirements.pore_pressure;
  if (rock.bulk_model() == "elastic" && (network.needs_pore_pressure() || requirements.pore_pressure))
    throw EntryError("Rock/Bulk model",
                     "elastic",
                     "poroelastic or auto, because the fracture model or its leak-off needs the pore "
                     "pressure");
  discretisation.has_pore_pressure =
    rock.bulk_model() == "poroelastic" || (rock.bulk_model() == "auto" && asked);

  prm.enter_subsection("Discretisation");
  const std::string elements    = prm.get("Elements");
  discretisation.displacement_degree = elements.substr(0, 2) == "Q2" ? 2 : 1;
  if (elements == "Q1-Q1 stabilised")
    discretisation.stabilisation = PressureStabilisation::projection;
  prm.leave_subsection();
  return discretisation;
}
} // namespace


void
declare_all_parameters(ParameterHandler &prm, const FractureModelRegistry &registry)
{
  Deck::declare_parameters(prm);
  prm.declare_entry("Title", "", Patterns::Anything(), "For people; appears in the log.");
  prm.declare_entry("Dimension", "2", Patterns::Selection("2|3"), "Of space.");
  prm.declare_entry("Output directory",
                    "output",
                    Patterns::Anything(),
                    "Where results go; --output overrides it.");
  prm.declare_entry("Additional shared libraries",
                    "",
                    Patterns::Anything(),
                    "Files, separated by commas, that bring fracture models of their own; relative "
                    "to the deck.");
  Rock::declare_parameters(prm);
  declare_for_dimension<2>(prm);
  TimeScheme::declare_parameters(prm);
  StepControl::declare_parameters(prm);
  declare_reference_parameters(prm);
  declare_initial_cracks(prm);
  declare_mesh_adaptation(prm);

  prm.enter_subsection("Discretisation");
  prm.declare_entry("Elements",
                    "Q2-Q1",
                    Patterns::Selection("Q2-Q1|Q1-Q1 stabilised|Q1-Q1"),
                    "Displacement and pore pressure. Plain Q1-Q1 oscillates in the undrained limit "
                    "and is here to show it. In elastic rock only the first counts.");
  prm.leave_subsection();

  prm.enter_subsection("Fracture");
  std::string names;
  for (const auto &[name, entry] : registry.all())
    names += (names.empty() ? "" : "|") + name;
  prm.declare_entry("Model", "none", Patterns::Selection(names), "The fracture model.");
  for (const auto &[name, entry] : registry.all())
    {
      prm.enter_subsection(name);
      entry.declare_parameters(prm);
      prm.leave_subsection();
    }
  prm.leave_subsection();
}


namespace
{
template <int dim>
const auto &
create_function(const FractureModelEntry &entry)
{
  if constexpr (dim == 2)
    return entry.create_2d;
  else
    return entry.create_3d;
}


template <int dim>
std::unique_ptr<FractureModel<dim>>
make_model(ParameterHandler &prm, const FractureModelRegistry &registry, const Scene<dim> &scene)
{
  prm.enter_subsection("Fracture");
  const std::string name   = prm.get("Model");
  const auto       &create = create_function<dim>(registry.find(name));
  if (!create)
    throw EntryError("Fracture/Model", name, "a model that exists in " + std::to_string(dim) + "-D");
  prm.enter_subsection(name);
  auto model = create(prm, scene);
  prm.leave_subsection();
  prm.leave_subsection();
  return model;
}


/// The next step towards a time that must be met: dt, or what is left, or half of it where dt would
/// leave a crumb.
double
step_towards(const double left, const double dt)
{
  if (left <= dt * (1. + 1e-9))
    return left;
  return left < 1.5 * dt ? 0.5 * left : dt;
}
} // namespace


template <int dim>
void
simulate(RunContext                  &run,
         const Deck                  &deck,
         ParameterHandler            &prm,
         const FractureModelRegistry &registry,
         const SimulationOptions     &options)
{
  // From parameters to objects. Everything that can be wrong with a deck is found here.
  Geometry<dim> geometry;
  geometry.parse_parameters(prm, std::filesystem::path(deck.file()).parent_path().string());
  Rock rock;
  rock.parse_parameters(prm);
  InSitu<dim> in_situ;
  in_situ.parse_parameters(prm);
  BoundaryConditions<dim> boundary_conditions;
  boundary_conditions.parse_parameters(prm, [&](const std::string &name) {
    return geometry.side(name);
  });
  Network<dim> network;
  network.parse_parameters(prm);
  network.set_fluid(rock.fluid().viscosity,
                    rock.fluid().compressibility,
                    rock.main().permeability / rock.fluid().viscosity);

  Scene<dim> scene{rock,
                   parse_initial_cracks<dim>(prm, geometry.lower(), geometry.upper()),
                   false,
                   [&](const Point<dim> &x) { return in_situ.stress(x); },
                   [&](const Point<dim> &x) { return in_situ.pore_pressure(x); },
                   geometry.diameter()};
  const auto model = make_model<dim>(prm, registry, scene);

  const Discretisation discretisation = parse_discretisation<dim>(
    prm, rock, boundary_conditions, network, model->requirements());
  scene.has_pore_pressure = discretisation.has_pore_pressure;

  StepControl control;
  control.parse_parameters(prm);
  TimeScheme scheme;
  prm.enter_subsection("Fracture");
  const std::string model_name = prm.get("Model");
  prm.leave_subsection();
  scheme.parse_parameters(prm, model_name == "none" && discretisation.has_pore_pressure);

  ReferenceInput<dim> reference_input{rock, geometry.lower(), geometry.upper()};
  if (!scene.cracks.empty())
    reference_input.crack = scene.cracks[0].points;
  reference_input.injection_rate = network.rate_of_first_well(control.end_time);
  const auto reference           = make_reference<dim>(prm, reference_input);
  if (boundary_conditions.uses_reference() && reference)
    boundary_conditions.set_reference(reference->field());

  if (options.check_only)
    {
      run.out << "The deck is in order." << std::endl;
      return;
    }

  // Mesh and unknowns.
  parallel::distributed::Triangulation<dim> triangulation(
    run.communicator,
    Triangulation<dim>::limit_level_difference_at_vertices,
    parallel::distributed::Triangulation<dim>::no_automatic_repartitioning);
  geometry.create(triangulation);
  const auto         mapping = geometry.mapping();
  CoupledSystem<dim> system(
    run, triangulation, *mapping, rock, boundary_conditions, *model, network, discretisation, prm);
  MeshAdaptation<dim> adaptation(prm, geometry, triangulation, *model);
  adaptation.prepare(system, control.start_time);

  Stepper<dim> stepper(run, system, *model, network, scheme, control);
  stepper.committed.bulk = system.ghosted_vector();
  system.adopt_extra(ExtraNumbering(), {&stepper.committed.extra});
  if (reference && starts_from_reference(prm))
    {
      auto values = system.owned_vector();
      reference->field()->set_time(control.start_time);
      VectorTools::interpolate(*mapping, system.bulk_dofs(), *reference->field(), values);
      stepper.committed.bulk = values;
    }
  scheme.initialise(stepper.committed);

  // Time.
  if (run.rank == 0)
    std::filesystem::create_directories(options.output_directory);
  run.out << triangulation.n_global_active_cells() << " cells, " << system.n_unknowns()
          << " unknowns, " << run.n_ranks << " rank(s), " << blas_version() << std::endl;
  Report<dim> report(run,
                     system,
                     stepper,
                     *model,
                     network,
                     in_situ,
                     *mapping,
                     reference.get(),
                     control,
                     options.output_directory);
  report.case_name  = deck.name();
  report.model_name = model_name;
  report.open(false, control.start_time);

  double time = control.start_time, dt = control.initial_step;
  for (unsigned int step = 1; time < control.end_time * (1. - 1e-12); ++step)
    {
      const double target = std::min(control.end_time, network.next_jump(time));
      const double tried  = step_towards(target - time, dt);
      const auto   taken  = stepper.advance(time, tried, step);
      time                = stepper.last_context().time;
      dt = taken.dt < tried || tried == dt ? taken.next_dt : std::max(dt, taken.next_dt);
      report.add_step(step, taken);
      for (const std::string &message : model->take_messages())
        run.warn(message);
      if (time < control.end_time * (1. - 1e-12))
        adaptation.adapt(system, stepper);
    }
  report.finish(triangulation.n_global_active_cells());
}


template void
simulate<2>(RunContext &,
            const Deck &,
            ParameterHandler &,
            const FractureModelRegistry &,
            const SimulationOptions &);
template void
simulate<3>(RunContext &,
            const Deck &,
            ParameterHandler &,
            const FractureModelRegistry &,
            const SimulationOptions &);
} // namespace stockwork
