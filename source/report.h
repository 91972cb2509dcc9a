#pragma once

#include "stockwork/base/run_summary.h"
#include "stockwork/base/statistics.h"

#include "biot/in_situ.h"
#include "coupling/stepper.h"
#include "outcome_audit.h"
#include "physics_choice/left_out.h"
#include "verification/error_record.h"

#include <boost/serialization/set.hpp>

#include <map>
#include <memory>
#include <set>
#include <string>

namespace stockwork
{
/// What a run tells: a line per step on the terminal, a row per step in statistics.csv, errors
/// against the reference, and summary.json at the end.
template <int dim>
class Report
{
public:
  /// `reference` may be null. `audits_energy`: see Case.
  Report(RunContext &run,
         const CoupledSystem<dim> &system,
         const Stepper<dim> &stepper,
         const FractureModel<dim> &model,
         const Network<dim> &network,
         const InSitu<dim> &in_situ,
         const Rock &rock,
         const bool audits_energy,
         const dealii::Mapping<dim> &mapping,
         const ReferenceSolution<dim> *reference,
         const StepControl &control,
         const std::string &directory);

  std::string case_name, model_name;
  std::string deck;                                  ///< its path
  std::map<std::string, std::string> before_physics; ///< RunSummary

  /// Open statistics.csv; after a restart keep its rows up to `time`.
  void open(bool restarted, double time);

  /// Print the head of the columns.
  void header() const;

  /// After an accepted step. Collective.
  void add_step(unsigned int step, const StepReport &step_report);

  /// What the state now says of physics that is left out.
  void watch(const LeftOut &now)
  {
    shown.kinetic_share = std::max(shown.kinetic_share, now.kinetic_share);
    shown.strength_used = std::max(shown.strength_used, now.strength_used);
  }

  /// For the audit of the assumptions.
  const Outcome &outcome() const
  {
    return shown;
  }

  /// Write summary.json and the table of times. Collective.
  void finish(unsigned long n_cells);

  /// Write summary.json of a run that ends before its time. Collective.
  void fail(unsigned long n_cells, const std::string &reason);

  /// Sums and error averages, for checkpoints.
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &summary.steps &summary.rejected_steps &summary.nonlinear_iterations &summary
      .linear_iterations &summary.fluid_balance.stored &summary.fluid_balance.outflow &summary
      .fluid_balance.relative_error &external_work &peak_load &maximum_inlet_aperture &greatest_rate
        &shown &dry_wells &reached_wells;
    if (errors)
      archive &*errors;
  }

private:
  /// Warn of results that cannot be, once for each kind.
  void watch(const WellReport &well, double net_pressure);

  /// Fill in and write summary.json.
  /// By the published sequence, which may not do it without a word.
  void say_what_is_lost() const;

  void summarise(unsigned long n_cells);

  /// Scalars of the last step by column name.
  using Values = std::map<std::string, double>;
  Values observe();

  // Its parts.
  void observe_fracture(const FractureSummary &summary, Values &values);
  /// Returns the work that the rock has not stored, by the trapezoidal rule [J (/m)].
  double observe_rock(Values &values) const;
  void observe_energy(const State &state,
                      const FractureSummary &summary,
                      double not_stored_in_rock,
                      Values &values);
  void observe_shape(Values &values) const;
  void observe_fluid(const State &state, Values &values);
  void observe_well(unsigned int number, const WellReport &report, bool is_alone, Values &values);

  /// Of the fluid that entered the pores in the last step, what is missing in them, over what
  /// moved; where wells open into the rock.
  double pore_balance_error(const typename CoupledSystem<dim>::PoreFluid &pores) const;

  /// At a place, of the last accepted step. Collective.
  dealii::Tensor<1, dim> displacement_at(const dealii::Point<dim> &point) const;

  RunContext &run;
  const CoupledSystem<dim> &system;
  const Stepper<dim> &stepper;
  const FractureModel<dim> &model;
  const Network<dim> &network;
  const InSitu<dim> &in_situ;
  const Rock &rock;
  bool audits_energy;
  double external_work = 0.;          ///< since the start [J/m]
  double peak_load = 0.;              ///< greatest so far [N/m]
  double maximum_inlet_aperture = 0.; ///< so far [m]
  double greatest_rate = 0.;          ///< of the first well, so far [m^2/s]
  std::string cost_of_fracture;       ///< see FractureSummary
  const dealii::Mapping<dim> &mapping;
  const ReferenceSolution<dim> *reference;
  StepControl control;
  std::string directory;
  StatisticsTable statistics;
  Outcome shown;
  std::set<unsigned int> dry_wells, reached_wells,
    fracturing_wells; ///< of which this has been said
  bool warned_of_aperture = false, warned_of_volume = false, warned_of_pressure = false;
  RunSummary summary;
  double start_of_run;
  unsigned int steps_of_run = 0; ///< a restarted run has more in its summary
  std::unique_ptr<ErrorRecord<dim>> errors;
};
} // namespace stockwork
