#include "run_checkpoint.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "base/parameter_tree.h"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Entries that a restart may give another value.
const std::vector<std::string> may_change = {"Time/End time", "Output directory", "Output",
                                             "Checkpoint"};
} // namespace


template <int dim>
RunCheckpoint<dim>::RunCheckpoint(RunContext &run,
                                  Case<dim> &the_case,
                                  ParameterHandler &prm,
                                  parallel::distributed::Triangulation<dim> &triangulation,
                                  CoupledSystem<dim> &system,
                                  Stepper<dim> &stepper,
                                  Report<dim> &report,
                                  FieldOutput<dim> &fields,
                                  const std::string &output_directory)
  : run(run)
  , the_case(the_case)
  , triangulation(triangulation)
  , system(system)
  , stepper(stepper)
  , report(report)
  , fields(fields)
  , files(output_directory + "/checkpoint", run.communicator)
  , comparable_deck(comparable_text(prm, may_change))
  , deck_fingerprint(fingerprint(prm, may_change))
{
  schedule.parse_parameters(prm);
}


template <int dim>
bool RunCheckpoint<dim>::exists() const
{
  return files.exists();
}


template <int dim>
void RunCheckpoint<dim>::forget_earlier_run()
{
  files.remove();
}


template <int dim>
void RunCheckpoint<dim>::save_if_due(const Clock &clock)
{
  if (schedule.due(clock.step, run.communicator))
    save(clock);
}


template <int dim>
void RunCheckpoint<dim>::save(const Clock &clock)
{
  const auto scope = run.timers.scope("output");
  std::ostringstream bytes;
  {
    boost::archive::binary_oarchive archive(bytes);
    const std::vector<std::uint64_t> keys = system.extra_numbering().keys();
    archive << clock << the_case.scheme << stepper.wave_steps() << keys;
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
  files.save(triangulation, system.bulk_dofs(), vectors, bytes.str(), deck_fingerprint,
             comparable_deck, attached_bytes);
  if (own_fields != nullptr)
    own_fields->finish_save();
  if (rock != nullptr)
    rock->history().finish_save();
}


template <int dim>
Clock RunCheckpoint<dim>::load()
{
  std::istringstream bytes(files.read(deck_fingerprint, comparable_deck));
  if (!files.why_not_newest().empty())
    run.warn("The newest checkpoint cannot be used; the one before it is taken. " +
             files.why_not_newest());
  the_case.geometry.create_coarse(triangulation);
  files.load_mesh(triangulation);

  boost::archive::binary_iarchive archive(bytes);
  std::vector<std::uint64_t> keys;
  Clock clock;
  archive >> clock >> the_case.scheme >> stepper.wave_steps() >> keys;
  if (has_ended(clock, the_case.control))
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
  files.load_vectors(system.bulk_dofs(), loaded);
  for (unsigned int i = 0; i < targets.size(); ++i)
  {
    *targets[i] = system.ghosted_vector();
    *targets[i] = values[i];
  }
  return clock;
}


template class RunCheckpoint<2>;
template class RunCheckpoint<3>;
} // namespace stockwork
