#pragma once

#include "case.h"
#include "clock.h"
#include "output/checkpoint.h"
#include "output/field_output.h"
#include "report.h"

#include <cstdint>
#include <string>

namespace stockwork
{
/// The checkpoint of a run: what belongs to it, and in which order. All functions are collective.
template <int dim>
class RunCheckpoint
{
public:
  /// The objects must outlive this, all but `prm`.
  RunCheckpoint(RunContext &run,
                Case<dim> &the_case,
                dealii::ParameterHandler &prm,
                dealii::parallel::distributed::Triangulation<dim> &triangulation,
                CoupledSystem<dim> &system,
                Stepper<dim> &stepper,
                Report<dim> &report,
                FieldOutput<dim> &fields,
                const std::string &output_directory);

  bool exists() const;

  /// What an earlier run has left belongs to another table.
  void forget_earlier_run();

  /// @throws OutputError if it cannot be written; the one before is left as it was
  void save(const Clock &clock);

  /// To be called once after each step.
  void save_if_due(const Clock &clock);

  /// Into the objects, of which the triangulation is still empty.
  /// @throws InputError if there is none to go on from, as Checkpoint::read(), and EntryError if
  /// the run has ended there
  Clock load();

private:
  RunContext &run;
  Case<dim> &the_case;
  dealii::parallel::distributed::Triangulation<dim> &triangulation;
  CoupledSystem<dim> &system;
  Stepper<dim> &stepper;
  Report<dim> &report;
  FieldOutput<dim> &fields;
  Checkpoint files;
  CheckpointSchedule schedule;
  std::string comparable_deck;
  std::uint64_t deck_fingerprint;
};
} // namespace stockwork
