#include "simulation.h"

#include "stockwork/base/blas.h"
#include "stockwork/base/error.h"
#include "stockwork/base/parameters.h"
#include "stockwork/base/quantity.h"

#include "case.h"
#include "cost_of_run.h"
#include "coupling/mesh_adaptation.h"
#include "output/directory.h"
#include "output/field_output.h"
#include "output/signals.h"
#include "physics_choice/left_out.h"
#include "physics_choice/physics_choice.h"
#include "report.h"
#include "rock_of_run.h"
#include "run_checkpoint.h"
#include "scene_audit.h"
#include "scene_estimates.h"
#include "scene_numbers.h"

#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <new>
#include <set>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// The next step towards a time that must be met: dt, or what is left, or half of it where dt would
/// leave a crumb.
double step_towards(const double left, const double dt)
{
  if (left <= dt * (1. + 1e-9))
    return left;
  return left < 1.5 * dt ? 0.5 * left : dt;
}


/// The objects of a run on one case.
template <int dim>
class Simulation
{
public:
  Simulation(RunContext &run,
             Case<dim> &the_case,
             ParameterHandler &prm,
             const SimulationOptions &options);

  void start(ParameterHandler &prm);

  /// From the last checkpoint.
  void resume();

  /// What can be said before the first step.
  void announce();

  /// Nothing is written before this, so that a refused deck leaves nothing behind.
  void open_output(ParameterHandler &prm);

  void march();

  MeshSizes<dim> mesh_sizes() const
  {
    return MeshSizes<dim>(triangulation);
  }

private:
  /// What 'Physics = auto' has left out, now and then.
  void watch_what_is_left_out();

  bool finished() const
  {
    return has_ended(clock, the_case.control);
  }

  RunContext &run;
  Case<dim> &the_case;
  const SimulationOptions &options;

  parallel::distributed::Triangulation<dim> triangulation;
  std::unique_ptr<Mapping<dim>> mapping;
  CoupledSystem<dim> system;
  MeshAdaptation<dim> adaptation;
  Stepper<dim> stepper;
  Report<dim> report;
  FieldOutput<dim> fields;
  RunCheckpoint<dim> checkpoint;
  std::unique_ptr<DirectoryLock> lock;
  Clock clock;
  std::set<std::string> remarks; ///< passed on already
  double looked_at;              ///< what is left out, the last time
};


template <int dim>
Simulation<dim>::Simulation(RunContext &run,
                            Case<dim> &the_case,
                            ParameterHandler &prm,
                            const SimulationOptions &options)
  : run(run)
  , the_case(the_case)
  , options(options)
  , triangulation(run.communicator,
                  Triangulation<dim>::limit_level_difference_at_vertices,
                  parallel::distributed::Triangulation<dim>::no_automatic_repartitioning)
  , mapping(the_case.geometry.mapping())
  , system(run,
           triangulation,
           *mapping,
           the_case.scene,
           the_case.laws,
           the_case.boundary_conditions,
           *the_case.model,
           the_case.network,
           the_case.elements,
           prm)
  , adaptation(run, the_case.geometry, the_case.rock, triangulation, *the_case.model)
  , stepper(run,
            system,
            *the_case.model,
            the_case.network,
            the_case.rock,
            the_case.scheme,
            the_case.control)
  , report(run,
           system,
           stepper,
           *the_case.model,
           the_case.network,
           the_case.in_situ,
           the_case.rock,
           the_case.audits_energy,
           *mapping,
           the_case.reference.get(),
           the_case.control,
           options.output_directory)
  , checkpoint(
      run, the_case, prm, triangulation, system, stepper, report, fields, options.output_directory)
{
  system.is_interrupted = [&run]() { return stop_requested(run.communicator); };
  report.case_name = the_case.name;
  report.model_name = the_case.model_name;
  report.deck = options.deck;
  for (const PhysicsDecision &decision : the_case.decisions)
    report.before_physics.insert(decision.replaced.begin(), decision.replaced.end());
  fields.parse_parameters(prm);
  std::string never;
  for (const double time :
       fields.times_outside(the_case.control.start_time, the_case.control.end_time))
    never += (never.empty() ? "" : ", ") + to_string(time, dimension::time);
  if (!never.empty())
    run.warn("Output/Times of fields: nothing is written at " + never +
             ", not between 'Time/Start time' and 'Time/End time'.");
  if (options.restart && !checkpoint.exists())
    throw InputError("There is no checkpoint in '" + options.output_directory +
                     "' to restart from. Name the directory of the run with --output; a run that "
                     "shall be continued after its end must have written one on its way: see "
                     "'Checkpoint/Steps between' and 'Checkpoint/Time between'.");
}


template <int dim>
void Simulation<dim>::open_output(ParameterHandler &prm)
{
  prepare_output_directory(options.output_directory, run.communicator);
  if (!lock)
    lock = std::make_unique<DirectoryLock>(options.output_directory, run.communicator);
  if (!options.restart)
    checkpoint.forget_earlier_run();
  fields.open(options.output_directory, run.communicator);
  on_root(run.communicator,
          [&]() { write_effective_deck(prm, options.output_directory + "/effective.prm"); });
  report.open(options.restart, clock.time);
  catch_stop_signals();
}


template <int dim>
void Simulation<dim>::start(ParameterHandler &prm)
{
  clock = {the_case.control.start_time, the_case.control.initial_step, 0};
  looked_at = clock.time;
  {
    const auto scope = run.timers.scope("adaptation");
    the_case.geometry.create(triangulation);
    adaptation.refine_initial_mesh(the_case.elements.displacement_degree);
  }
  the_case.geometry.check_boxes(triangulation);
  for (const std::string &text : the_case.geometry.misfits_of_regions(triangulation))
    run.warn(text);
  refuse_too_large(run, the_case, triangulation);
  the_case.boundary_conditions.check(triangulation,
                                     the_case.scheme.kind() == TimeScheme::Kind::newmark);
  // So many take from seconds to a minute, in which nothing else is printed.
  constexpr unsigned int many_cells = 200000;
  if (triangulation.n_global_active_cells() > many_cells)
    run.out << "Setting up " << triangulation.n_global_active_cells() << " cells" << std::endl;
  system.setup_mesh(clock.time);
  check_rock(run, the_case, system, prm);
  stepper.committed.bulk = system.ghosted_vector();
  system.adopt_extra(ExtraNumbering(), {&stepper.committed.extra});
  if (the_case.reference && the_case.starts_from_reference)
  {
    const auto field = the_case.reference->field();
    auto values = system.owned_vector();
    field->set_time(clock.time);
    VectorTools::interpolate(*mapping, system.bulk_dofs(), *field, values);
    stepper.committed.bulk = values;
  }
  the_case.scheme.initialise(stepper.committed);
  stepper.make_explicit_march();
}


template <int dim>
void Simulation<dim>::watch_what_is_left_out()
{
  constexpr unsigned int n_looks = 20;
  const double duration = the_case.control.end_time - the_case.control.start_time;
  if (clock.time < looked_at + duration / n_looks && !finished())
    return;
  looked_at = clock.time;
  if (std::none_of(the_case.decisions.begin(), the_case.decisions.end(),
                   [](const PhysicsDecision &decision) { return decision.left_out; }))
    return;
  report.watch(observe_left_out(the_case, system, stepper));
}


template <int dim>
void Simulation<dim>::announce()
{
  const MeshSizes<dim> mesh = mesh_sizes();
  print_scene_audit(run, the_case, mesh, system.n_unknowns());
  for (const std::string &message : the_case.model->take_messages())
    run.warn(message);
  run.out << triangulation.n_global_active_cells() << " cells, " << system.n_unknowns()
          << " unknowns, " << run.n_ranks << " rank(s), " << blas_version() << std::endl;
  const auto [cost, steps] = expected_cost(run, the_case, mesh, system, stepper, clock);
  run.out << "  " << in_words(cost, steps, run.n_ranks) << std::endl;
  const double resolved = stepper.wave_step();
  if (the_case.control.waves.are_wanted() && resolved < the_case.control.maximum_step)
    run.out << "  steps are of " << to_string(resolved, dimension::time)
            << ", and there are more of them, while a tip runs fast against waves ('Time/Waves "
               "resolved above')"
            << std::endl;
  if (the_case.control.waves.are_wanted() && resolved < the_case.control.minimum_step)
    run.warn("Time/Minimum step: " + to_string(the_case.control.minimum_step, dimension::time) +
             " is longer than the steps that resolve waves, " +
             to_string(resolved, dimension::time) +
             "; 'Time/Waves resolved above' asks for those.");
  compare_with_memory(run, the_case, triangulation, cost.memory);
}


template <int dim>
void Simulation<dim>::resume()
{
  if (!options.check_only)
    lock = std::make_unique<DirectoryLock>(options.output_directory, run.communicator);
  clock = checkpoint.load();
  looked_at = clock.time;
  stepper.make_explicit_march();
  run.out << "Restarted at t = " << clock.time << " s, after step " << clock.step << "."
          << std::endl;
}


template <int dim>
void Simulation<dim>::march()
{
  report.header();
  if (clock.step == 0)
    stepper.start(clock.time);
  while (!finished())
  {
    const double jump = the_case.network.next_jump(clock.time),
                 target = std::min({the_case.control.end_time, jump, fields.next_time(clock.time)});
    const double tried = step_towards(target - clock.time, clock.dt);
    StepReport taken;
    try
    {
      taken = stepper.advance(clock.time, tried, clock.step + 1);
    }
    catch (const SolveError &error)
    {
      checkpoint.save(clock);
      report.fail(triangulation.n_global_active_cells(), error.what());
      throw SolveError(error.what() + std::string("\nThe state at t = ") +
                       std::to_string(clock.time) + " s is in the checkpoint in '" +
                       options.output_directory + "'; --restart goes on from there.");
    }
    clock.time = stepper.last_context().time;
    if (clock.time > jump - 1e-6 * stepper.last_context().dt)
      stepper.forget_past();
    // A step shortened to meet a time says nothing about the next.
    clock.dt =
      taken.dt < tried || tried == clock.dt ? taken.next_dt : std::max(clock.dt, taken.next_dt);
    // Nor does one of rest say anything about the start of a well.
    if (the_case.network.starts_at(clock.time))
      clock.dt = std::min(clock.dt, the_case.control.initial_step);
    ++clock.step;
    report.add_step(clock.step, taken);
    pass_on_remarks(run, system, remarks);
    watch_what_is_left_out();
    for (const std::string &message : the_case.model->take_messages())
      run.warn(message);
    if (fields.due(clock.step, clock.time, finished()))
    {
      const auto scope = run.timers.scope("output");
      fields.write(clock.time, system.mesh_view(), the_case.scene, *the_case.model,
                   stepper.last_state(), system.nonlinear_rock(), system.nodal_fields());
    }
    if (!finished())
    {
      const auto scope = run.timers.scope("adaptation");
      adaptation.adapt(system, stepper);
    }
    if (stop_requested(run.communicator))
    {
      checkpoint.save(clock);
      report.fail(triangulation.n_global_active_cells(), "stopped by a signal");
      throw SolveError("Stopped by a signal at t = " + std::to_string(clock.time) +
                       " s; --restart goes on from there.");
    }
    checkpoint.save_if_due(clock);
  }
  audit_outcome(run, the_case, report.outcome());
  say_how_far_rock_went(run, system);
  report.finish(triangulation.n_global_active_cells());
}
} // namespace


namespace
{
template <int dim>
void start_only(Simulation<dim> &simulation, ParameterHandler &prm)
{
  try
  {
    simulation.start(prm);
  }
  catch (const SolveError &error)
  {
    throw InputError(error.what()); // nothing has been computed
  }
}


/// The tensile strength that the fracture model takes with some entries set, for the cells that the
/// run would start on.
template <int dim>
double strength_with(const RunContext &run,
                     const Deck &deck,
                     const PlugIns &plug_ins,
                     const Settings &settings)
{
  std::ostringstream nobody_reads;
  RunContext quiet(run.communicator, nobody_reads);
  ParameterHandler prm;
  declare_all_parameters(prm, plug_ins);
  deck.parse_into(prm);
  set_entries(prm, settings);
  Case<dim> the_case(deck, prm, plug_ins);
  const SimulationOptions options;
  Simulation<dim> simulation(quiet, the_case, prm, options);
  start_only(simulation, prm);
  return the_case.model->tensile_strength();
}


/// What 'Physics = auto' leaves out.
template <int dim>
std::vector<PhysicsDecision> decide_physics(const RunContext &run,
                                            const Deck &deck,
                                            ParameterHandler &prm,
                                            const PlugIns &plug_ins)
{
  if (prm.get("Physics") != "auto")
    return {};
  return leave_out_physics<dim>(deck, prm, plug_ins,
                                [&](const Settings &settings)
                                { return strength_with<dim>(run, deck, plug_ins, settings); });
}
} // namespace


template <int dim>
TriedDeck
try_deck(RunContext &run, const Deck &deck, ParameterHandler &prm, const PlugIns &plug_ins)
{
  decide_physics<dim>(run, deck, prm, plug_ins);
  Case<dim> the_case(deck, prm, plug_ins);
  const SimulationOptions options;
  Simulation<dim> simulation(run, the_case, prm, options);
  start_only(simulation, prm);
  const MeshSizes<dim> mesh = simulation.mesh_sizes();
  TriedDeck tried{cells_in_half_length(the_case, mesh),
                  is_driven_on(the_case),
                  the_case.walls_follow_reference ? 0. : effect_of_walls(the_case),
                  {}};
  for (const SceneNumber &number : scene_numbers(the_case, mesh))
    if (number.spoils)
      tried.warnings.push_back(number.consequence);
  return tried;
}


namespace
{
template <int dim>
void run_case(RunContext &run,
              const Deck &deck,
              ParameterHandler &prm,
              const PlugIns &plug_ins,
              const SimulationOptions &options)
{
  const std::vector<PhysicsDecision> decisions = decide_physics<dim>(run, deck, prm, plug_ins);
  Case<dim> the_case(deck, prm, plug_ins);
  the_case.decisions = decisions;
  the_case.chosen.insert(the_case.chosen.begin(), options.chosen.begin(), options.chosen.end());
  for (const std::string &message : the_case.model->take_messages())
    run.warn(message);
  for (const std::string &warning : the_case.warnings)
    run.warn(warning);
  Simulation<dim> simulation(run, the_case, prm, options);
  try
  {
    if (options.restart)
      simulation.resume();
    else
      simulation.start(prm);
  }
  catch (const SolveError &error)
  {
    throw InputError(error.what()); // nothing has been computed
  }
  simulation.announce();
  if (options.check_only)
  {
    run.out << "The deck is in order." << std::endl;
    return;
  }
  simulation.open_output(prm);
  simulation.march();
}
} // namespace


template <int dim>
void simulate(RunContext &run,
              const Deck &deck,
              ParameterHandler &prm,
              const PlugIns &plug_ins,
              const SimulationOptions &options)
{
  try
  {
    run_case<dim>(run, deck, prm, plug_ins, options);
  }
  catch (const std::bad_alloc &)
  {
    const std::string sentence =
      "There is not enough memory: the run has taken " + in_bytes(resident_memory()) + " on rank " +
      std::to_string(run.rank) + " of " + std::to_string(run.n_ranks) +
      " and needs more; 'stockwork --check' estimates how much. Use larger cells, more machines or "
      "'Linear solver/Type = iterative'.";
    if (run.n_ranks == 1)
      throw SolveError(sentence);
    // The other ranks wait for this one.
    std::cerr << sentence << std::endl;
    MPI_Abort(run.communicator, 2);
  }
}


template TriedDeck try_deck<2>(RunContext &, const Deck &, ParameterHandler &, const PlugIns &);
template TriedDeck try_deck<3>(RunContext &, const Deck &, ParameterHandler &, const PlugIns &);
template void simulate<2>(
  RunContext &, const Deck &, ParameterHandler &, const PlugIns &, const SimulationOptions &);
template void simulate<3>(
  RunContext &, const Deck &, ParameterHandler &, const PlugIns &, const SimulationOptions &);
} // namespace stockwork
