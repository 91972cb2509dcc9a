#include "simulation.h"

#include "stockwork/base/error.h"
#include "stockwork/base/progress.h"
#include "stockwork/base/quantity.h"
#include "stockwork/base/run_summary.h"
#include "stockwork/base/statistics.h"

#include "biot/boundary_conditions.h"
#include "biot/in_situ.h"
#include "coupling/coupled_system.h"
#include "coupling/initial_cracks.h"
#include "coupling/mesh_adaptation.h"
#include "coupling/stepper.h"
#include "flow/network.h"
#include "mesh/geometry.h"
#include "verification/error_record.h"

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


/// One row of the statistics; the same columns for every fracture model.
template <int dim>
std::map<std::string, double>
observe(const CoupledSystem<dim>      &system,
        const Stepper<dim>            &stepper,
        const FractureModel<dim>      &model,
        const Network<dim>            &network,
        const InSitu<dim>             &in_situ)
{
  std::map<std::string, double> values;
  const State                   state   = stepper.last_state();
  const FractureSummary         summary = model.summary(state, system.collectives());
  values["fracture_length"]             = summary.length;
  values["broken_length"]               = summary.broken_length;
  values["dissipated_energy"]           = summary.dissipated_energy;
  if (summary.stress_intensity_I)
    values["stress_intensity_I"] = *summary.stress_intensity_I;
  if (summary.stress_intensity_II)
    values["stress_intensity_II"] = *summary.stress_intensity_II;
  const FluidBalance &balance = stepper.fluid_balance();
  values["fracture_volume"]   = balance.fracture_volume;
  values["injected_volume"]   = balance.total.injected - balance.total.outflow;
  values["leaked_volume"]     = balance.total.leaked;
  const auto wells = network.wells(stepper.last_context(), state, system.collectives());
  if (!wells.empty())
    {
      values["inlet_aperture"] = wells[0].inlet_aperture;
      values["inlet_pressure"] = wells[0].inlet_pressure;
      // Over the in-situ stress across the fracture, which is what analytical solutions call p.
      const auto &inlet = network.segments()[wells[0].inlet_segment];
      values["net_inlet_pressure"] =
        wells[0].inlet_pressure + inlet.normal * (in_situ.stress(inlet.centre) * inlet.normal);
    }
  return values;
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

  // Output.
  StatisticsTable statistics;
  if (run.rank == 0)
    {
      std::filesystem::create_directories(options.output_directory);
      statistics.open(options.output_directory + "/statistics.csv");
    }
  RunSummary summary;
  summary.case_name      = deck.name();
  summary.fracture_model = model_name;
  summary.ranks          = run.n_ranks;
  std::unique_ptr<ErrorRecord<dim>> errors;
  if (reference)
    errors = std::make_unique<ErrorRecord<dim>>(*reference, control.start_time, control.end_time);

  run.out << triangulation.n_global_active_cells() << " cells, " << system.n_unknowns()
          << " unknowns on " << run.n_ranks << " rank(s)\n"
          << progress_header() << std::endl;

  // Time.
  double time = control.start_time, dt = control.initial_step;
  for (unsigned int step = 1; time < control.end_time * (1. - 1e-12); ++step)
    {
      const double     target = std::min(control.end_time, network.next_jump(time));
      const double     left   = target - time;
      const double     tried  = left < 1.5 * dt ? (left <= dt * (1. + 1e-9) ? left : 0.5 * left) : dt;
      const StepReport report = stepper.advance(time, tried, step);
      time                    = stepper.last_context().time;
      dt = report.dt < tried || tried == dt ? report.next_dt : std::max(dt, report.next_dt);

      ++summary.steps;
      summary.rejected_steps += report.rejected;
      summary.nonlinear_iterations += report.nonlinear_iterations;
      summary.linear_iterations += report.linear_iterations;

      const auto observed = observe(system, stepper, *model, network, in_situ);
      const auto pores = system.pore_fluid(stepper.last_context(), stepper.last_state());
      summary.fluid_balance.stored += pores.stored;
      summary.fluid_balance.outflow += pores.outflow + stepper.fluid_balance().step.outflow;
      summary.fluid_balance.relative_error =
        std::max(summary.fluid_balance.relative_error, stepper.fluid_balance().relative_error);
      if (errors)
        {
          errors->add_fields(
            time, report.dt, *mapping, system.bulk_dofs(), stepper.committed.bulk);
          errors->add_values(time, report.dt, observed);
        }
      statistics.set("step", step);
      statistics.set("time", time, "s");
      statistics.set("time_step", report.dt, "s");
      for (const auto &[name, value] : observed)
        statistics.set(name, value);
      if (errors)
        for (const auto &[name, error] : errors->errors())
          statistics.set("error_" + name, error.final);
      statistics.end_row();

      Progress progress;
      progress.step                 = step;
      progress.time                 = time;
      progress.start_time           = control.start_time;
      progress.end_time             = control.end_time;
      progress.time_step            = report.dt;
      progress.nonlinear_iterations = report.nonlinear_iterations;
      progress.linear_iterations    = report.linear_iterations;
      progress.rejected             = report.rejected;
      progress.fracture_length      = observed.at("fracture_length");
      if (observed.count("inlet_aperture"))
        {
          progress.inlet_aperture = observed.at("inlet_aperture");
          progress.inlet_pressure = observed.at("inlet_pressure");
        }
      progress.fluid_balance = stepper.fluid_balance().relative_error;
      progress.wall_seconds  = run.timers.total();
      run.out << progress_line(progress) << std::endl;

      for (const std::string &message : model->take_messages())
        run.warn(message);
      if (time < control.end_time)
        adaptation.adapt(system, stepper);
    }

  // What there is to say at the end.
  for (const auto &[name, value] : statistics.final_values())
    summary.final_values[name] = value;
  if (errors)
    for (const auto &[name, error] : errors->errors())
      summary.errors[name] = {error.final, error.mean(), reference->name()};
  const FluidVolumes total            = stepper.fluid_balance().total;
  summary.fluid_balance.injected      = total.injected;
  summary.fluid_balance.in_fractures  = total.in_fractures;
  summary.fluid_balance.leaked        = total.leaked;
  summary.cells                       = triangulation.n_global_active_cells();
  summary.unknowns                    = system.n_unknowns();
  summary.wall_seconds                = run.timers.seconds(run.communicator);
  summary.peak_memory_bytes           = peak_memory(run.communicator);
  summary.warnings                    = run.warnings;
  if (run.rank == 0)
    write_summary(options.output_directory + "/summary.json", summary);
  run.timers.print(run.out.get_stream(), run.communicator);
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
