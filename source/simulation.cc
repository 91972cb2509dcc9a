#include "simulation.h"

#include "stockwork/base/error.h"
#include "stockwork/base/parameters.h"
#include "stockwork/base/quantity.h"
#include "stockwork/base/version.h"

#include "base/parameter_tree.h"
#include "case.h"
#include "cost_estimate.h"
#include "coupling/mesh_adaptation.h"
#include "output/checkpoint.h"
#include "output/directory.h"
#include "output/field_output.h"
#include "output/signals.h"
#include "physics_choice/left_out.h"
#include "physics_choice/physics_choice.h"
#include "report.h"
#include "scene_audit.h"
#include "scene_estimates.h"
#include "scene_numbers.h"

#include <deal.II/numerics/vector_tools.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

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


/// Entries that a restart may give another value.
const std::vector<std::string> may_change = {"Time/End time", "Output directory", "Output",
                                             "Checkpoint"};


/// Where a run stands between two steps.
struct Clock
{
  double time = 0.;
  double dt = 0.;        ///< proposed for the next step
  unsigned int step = 0; ///< the last one

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &time &dt &step;
  }
};


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
  void save();

  /// Rock that yields before anything happens, and roles of cells that such rock cannot have.
  void check_rock(ParameterHandler &prm) const;

  /// What laws of the rock remark on the last step, each remark once in a run.
  void pass_on_remarks();

  /// What 'Physics = auto' has left out, now and then.
  void watch_what_is_left_out();

  /// What has become of the rock's strength, for people.
  void say_how_far_rock_went() const;

  std::pair<CostEstimate, ExpectedSteps> expected_cost(const MeshSizes<dim> &mesh);

  /// Before memory is taken for the unknowns of a mesh.
  void refuse_too_large() const;
  double unknowns_per_cell() const;

  bool finished() const
  {
    return clock.time >= the_case.control.end_time * (1. - 1e-12);
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
  Checkpoint checkpoint;
  CheckpointSchedule schedule;
  std::string comparable_deck;
  std::uint64_t deck_fingerprint;
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
  , stepper(run, system, *the_case.model, the_case.network, the_case.scheme, the_case.control)
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
  , checkpoint(options.output_directory + "/checkpoint", run.communicator)
  , comparable_deck(comparable_text(prm, may_change))
  , deck_fingerprint(fingerprint(prm, may_change))
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
  schedule.parse_parameters(prm);
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
  // What an earlier run has left here belongs to another table.
  if (!options.restart)
    checkpoint.remove();
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
  refuse_too_large();
  the_case.boundary_conditions.check(triangulation,
                                     the_case.scheme.kind() == TimeScheme::Kind::newmark);
  system.setup_mesh(clock.time);
  check_rock(prm);
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
void Simulation<dim>::check_rock(ParameterHandler &prm) const
{
  NonlinearRock<dim> *const rock = system.nonlinear_rock();
  if (rock == nullptr)
    return;
  std::pair<std::string, types::material_id> replaced; // law and region
  bool flows = false;
  for (const auto &cell : system.bulk_dofs().active_cell_iterators())
    if (cell->is_locally_owned() && rock->answers(cell) &&
        the_case.model->role(cell).skip_stiffness != nullptr)
    {
      replaced = {rock->laws.name(cell->material_id()), cell->material_id()};
      flows = rock->law(cell).n_history() == 0;
    }
  if (Utilities::MPI::max(flows ? 1 : 0, run.communicator) == 1)
    throw EntryError("Rock/Permeability decay stress",
                     value_of(prm, {"Rock"}, "Permeability decay stress"),
                     "nothing (an empty entry) where the fracture model '" + the_case.model_name +
                       "' provides the stiffness of the rock itself: the elements do not know the "
                       "stress there");
  for (const auto &[law, number] : Utilities::MPI::all_gather(run.communicator, replaced))
    if (const std::string region = "Region " + std::to_string(number); !law.empty())
      throw EntryError(number == 0 || value_of(prm, {"Rock", region}, "Law").empty()
                         ? "Rock/Law"
                         : "Rock/" + region + "/Law",
                       law,
                       "elastic where the fracture model '" + the_case.model_name +
                         "' provides the stiffness of the rock itself: give the region that it "
                         "works in, or all rock, the law 'elastic', or take a model whose cracks "
                         "cut cells");

  const auto shares = Utilities::MPI::all_gather(run.communicator,
                                                 [&]()
                                                 {
                                                   const auto mine = rock->in_situ_share();
                                                   return std::make_pair(mine.used, mine.place);
                                                 }());
  const auto worst = *std::max_element(
    shares.begin(), shares.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  constexpr double rounding = 1e-10; // on the surface is not beyond it
  if (worst.first <= 1. + rounding)
    return;
  std::ostringstream allowed;
  allowed << "a state that the rock can bear: at (" << worst.second
          << ") m the in-situ stress and pore pressure take " << 100. * worst.first
          << " per cent of the strength given in 'Rock/" << rock->laws.name(0)
          << "' (see also 'In situ/Stress across the plane')";
  throw EntryError("In situ/Stress", value_of(prm, {"In situ"}, "Stress"), allowed.str());
}


template <int dim>
void Simulation<dim>::pass_on_remarks()
{
  NonlinearRock<dim> *const rock = system.nonlinear_rock();
  if (rock == nullptr)
    return;
  const std::set<std::string> &mine = rock->totals().remarks;
  if (Utilities::MPI::max(mine.size(), run.communicator) == 0)
    return;
  const std::vector<std::string> here(mine.begin(), mine.end());
  for (const auto &of_rank : Utilities::MPI::all_gather(run.communicator, here))
    for (const std::string &remark : of_rank)
      if (remarks.insert(remark).second)
        run.warn(remark);
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
void Simulation<dim>::say_how_far_rock_went() const
{
  NonlinearRock<dim> *const rock = system.nonlinear_rock();
  if (rock == nullptr || !rock->remembers())
    return;
  const double volume = Utilities::MPI::sum(rock->totals().yielded_volume, run.communicator);
  const double used = Utilities::MPI::max(rock->totals().maximum_used, run.communicator);
  if (volume > 0.)
    run.out << "The rock has yielded in " << volume << (dim == 2 ? " m^2" : " m^3") << "."
            << std::endl;
  else
    run.out << "The rock has stayed linear: at most " << 100. * used
            << " per cent of its strength were used at the end." << std::endl;
}


template <int dim>
double Simulation<dim>::unknowns_per_cell() const
{
  const auto &d = the_case.elements;
  return dim * std::pow(d.displacement_degree, dim) + d.has_pore_pressure;
}


template <int dim>
void Simulation<dim>::refuse_too_large() const
{
  const double n_cells = triangulation.n_global_active_cells();
  const double n_unknowns = n_cells * unknowns_per_cell();
  CostlyPhysics physics = costly_physics(the_case);
  double needed = explicit_cost({}, n_unknowns, physics.memory_per_unknown, run.n_ranks).memory;
  if (!the_case.scheme.is_explicit())
  {
    physics.memory_per_unknown = 0.; // which a model takes in its part of the mesh alone
    needed = estimate_cost(dim, n_unknowns, physics, run.n_ranks).memory;
  }
  const double available = physical_memory(run.communicator);
  if (needed > available)
    throw EntryError(
      "Mesh/Maximum number of cells", std::to_string(the_case.geometry.maximum_number_of_cells()),
      "a mesh that fits into memory: this one has " +
        std::to_string(triangulation.n_global_active_cells()) + " cells and would take about " +
        in_bytes(needed) + ", there are " + in_bytes(available));
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
  const auto [cost, steps] = expected_cost(mesh);
  run.out << "  " << in_words(cost, steps, run.n_ranks) << std::endl;
}


template <int dim>
std::pair<CostEstimate, ExpectedSteps> Simulation<dim>::expected_cost(const MeshSizes<dim> &mesh)
{
  const CostlyPhysics physics = costly_physics(the_case);
  const double duration = the_case.control.end_time - clock.time;
  if (ExplicitMarch<dim> *const march = stepper.explicit_march())
    return {explicit_cost(
              {static_cast<double>(march->n_parts(std::min(clock.dt, duration))), march->n_terms()},
              system.n_unknowns(), physics.memory_per_unknown, run.n_ranks),
            {std::ceil(duration / clock.dt), the_case.control.growth > 1.}};
  const bool cracked = is_cracked(the_case);
  const double at_end =
    unknowns_at_end(the_case, mesh, system.n_unknowns(), the_case.network.segments().size());
  const double cells =
    !cracked   ? 0.
    : dim == 3 ? std::numeric_limits<double>::quiet_NaN() // not all of a front comes on at once
               : (half_length_at_end(the_case) - half_length_at_start(the_case)) / mesh.smallest;
  return {estimate_cost(dim, at_end, physics, run.n_ranks),
          expected_steps(the_case.control, duration, clock.dt, cracked, cells)};
}


template <int dim>
void Simulation<dim>::save()
{
  const auto scope = run.timers.scope("output");
  std::ostringstream bytes;
  {
    boost::archive::binary_oarchive archive(bytes);
    const std::vector<std::uint64_t> keys = system.extra_numbering().keys();
    archive << clock << the_case.scheme << keys;
    for (const std::vector<double> *values : stepper.extra_vectors())
      archive << *values;
    the_case.model->save(archive);
    the_case.network.save(archive);
    archive << report << fields << run.warnings;
  }
  std::vector<const TrilinosWrappers::MPI::BlockVector *> vectors;
  for (const auto *vector : stepper.bulk_vectors())
    vectors.push_back(vector);
  std::uint64_t attached_bytes = 0;
  NodalFields<dim> *const own_fields = system.nodal_fields();
  if (own_fields != nullptr)
  {
    own_fields->prepare_for_save();
    attached_bytes += triangulation.n_locally_owned_active_cells() * own_fields->names.size() *
                      GeometryInfo<dim>::vertices_per_cell * sizeof(double);
  }
  NonlinearRock<dim> *const rock = system.nonlinear_rock();
  if (rock != nullptr)
  {
    rock->history().prepare_for_save(triangulation);
    attached_bytes += rock->history().bytes();
  }
  checkpoint.save(triangulation, system.bulk_dofs(), vectors, bytes.str(), deck_fingerprint,
                  comparable_deck, attached_bytes);
  if (own_fields != nullptr)
    own_fields->finish_save();
  if (rock != nullptr)
    rock->history().finish_save();
}


template <int dim>
void Simulation<dim>::resume()
{
  if (!options.check_only)
    lock = std::make_unique<DirectoryLock>(options.output_directory, run.communicator);
  std::istringstream bytes(checkpoint.read(deck_fingerprint, comparable_deck));
  if (!checkpoint.why_not_newest().empty())
    run.warn("The newest checkpoint cannot be used; the one before it is taken. " +
             checkpoint.why_not_newest());
  the_case.geometry.create_coarse(triangulation);
  checkpoint.load_mesh(triangulation);

  boost::archive::binary_iarchive archive(bytes);
  std::vector<std::uint64_t> keys;
  archive >> clock >> the_case.scheme >> keys;
  looked_at = clock.time;
  if (finished())
    throw EntryError("Time/End time", to_string(the_case.control.end_time, dimension::time),
                     "a time after that of the checkpoint, " +
                       to_string(clock.time, dimension::time) + ", where a restart goes on");
  std::vector<ExtraUnknown> unknowns;
  for (const std::uint64_t key : keys)
    unknowns.push_back({key});
  for (std::vector<double> *values : stepper.extra_vectors())
    archive >> *values;
  the_case.model->load(archive);
  the_case.network.load(archive);
  std::vector<std::string> warnings;
  archive >> report >> fields >> warnings;
  run.recall(warnings);

  // In the order in which they were saved; the model looks at its fields in setup().
  if (NodalFields<dim> *const own_fields = system.nodal_fields())
    own_fields->load(triangulation);
  system.setup_mesh(clock.time);
  system.adopt_extra(ExtraNumbering(unknowns), stepper.extra_vectors());
  if (NonlinearRock<dim> *const rock = system.nonlinear_rock())
    rock->history().load(triangulation);
  const auto targets = stepper.bulk_vectors();
  std::vector<TrilinosWrappers::MPI::BlockVector> values(targets.size(), system.owned_vector());
  std::vector<TrilinosWrappers::MPI::BlockVector *> loaded;
  for (auto &vector : values)
    loaded.push_back(&vector);
  checkpoint.load_vectors(system.bulk_dofs(), loaded);
  for (unsigned int i = 0; i < targets.size(); ++i)
  {
    *targets[i] = system.ghosted_vector();
    *targets[i] = values[i];
  }
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
    const double target =
      std::min({the_case.control.end_time, the_case.network.next_jump(clock.time),
                fields.next_time(clock.time)});
    const double tried = step_towards(target - clock.time, clock.dt);
    StepReport taken;
    try
    {
      taken = stepper.advance(clock.time, tried, clock.step + 1);
    }
    catch (const SolveError &error)
    {
      save();
      report.fail(triangulation.n_global_active_cells(), error.what());
      throw SolveError(error.what() + std::string("\nThe state at t = ") +
                       std::to_string(clock.time) + " s is in the checkpoint in '" +
                       options.output_directory + "'; --restart goes on from there.");
    }
    clock.time = stepper.last_context().time;
    // A step shortened to meet a time says nothing about the next.
    clock.dt =
      taken.dt < tried || tried == clock.dt ? taken.next_dt : std::max(clock.dt, taken.next_dt);
    // Nor does one of rest say anything about the start of a well.
    if (the_case.network.starts_at(clock.time))
      clock.dt = std::min(clock.dt, the_case.control.initial_step);
    ++clock.step;
    report.add_step(clock.step, taken);
    pass_on_remarks();
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
      save();
      report.fail(triangulation.n_global_active_cells(), "stopped by a signal");
      throw SolveError("Stopped by a signal at t = " + std::to_string(clock.time) +
                       " s; --restart goes on from there.");
    }
    if (schedule.due(clock.step, run.communicator))
      save();
  }
  audit_outcome(run, the_case, report.outcome());
  say_how_far_rock_went();
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
