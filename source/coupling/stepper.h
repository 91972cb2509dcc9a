#pragma once

#include <deal.II/base/parameter_handler.h>

#include "coupling/coupled_system.h"
#include "coupling/explicit_march.h"
#include "coupling/time_scheme.h"
#include "coupling/wave_steps.h"
#include "flow/fluid_balance.h"

namespace stockwork
{
/// Subsection "Time", as far as it chooses steps.
struct StepControl
{
  double start_time, end_time;
  double initial_step, minimum_step, maximum_step;
  double growth;                  ///< greatest ratio of successive steps
  double error_tolerance;         ///< of the local error estimate; infinite: not used
  unsigned int rejected_step = 0; ///< its first attempt is thrown away, to test that; 0: none
  WaveSteps waves;

  static void declare_parameters(dealii::ParameterHandler &prm);

  void parse_parameters(dealii::ParameterHandler &prm);
};

/// Greatest ratio of successive steps where the fracture chooses them and the deck gives none.
constexpr double growth_beside_fractures = 1.3;

/// The longest that the next step may be, by what the model says of the one it has accepted [s].
/// @param dt of that step, @p first_dt of its first attempt [s]
double step_limit(const Verdict &verdict, double dt, double first_dt);

/// What a step took.
struct StepReport
{
  double dt = 0.;            ///< as accepted
  double next_dt = 0.;       ///< proposed
  unsigned int rejected = 0; ///< attempts
  unsigned int nonlinear_iterations = 0;
  unsigned int linear_iterations = 0;
  bool held_back = false; ///< Verdict::held_back
};

/// Carries the unknowns through one time step: solve, let the fracture grow, solve again; accept,
/// or roll everything back and try a shorter step.
template <int dim>
class Stepper
{
public:
  Stepper(RunContext &run,
          CoupledSystem<dim> &system,
          FractureModel<dim> &model,
          Network<dim> &network,
          const Rock &rock,
          TimeScheme &scheme,
          const StepControl &control);

  /// The unknowns at the last accepted time.
  Unknowns committed;

  /// From `time`, a step of at most `dt`. Throws SolveError if not even the shortest step succeeds,
  /// or the system is interrupted; the unknowns are then those of the last accepted step.
  StepReport advance(double time, double dt, unsigned int step);

  /// If steps are explicit.
  /// @throws InputError where the model cannot be moved so
  void make_explicit_march();

  /// What 'Time/Start' asks for.
  void start(double time);

  /// Null: steps are not explicit.
  ExplicitMarch<dim> *explicit_march()
  {
    return march.get();
  }
  const ExplicitMarch<dim> *explicit_march() const
  {
    return march.get();
  }

  /// The state at the end of the last step, for reports: references are those of that step.
  State last_state() const;

  /// See TimeScheme.
  void forget_past()
  {
    scheme.forget_past();
  }

  const StepContext &last_context() const
  {
    return context;
  }

  const FluidBalance &fluid_balance() const
  {
    return balance;
  }

  /// Whether the model wants setup() before the next step, see FractureModel::commit().
  bool wants_setup() const
  {
    return model_wants_setup;
  }

  /// Whether a step's rates are taken from the last state alone.
  bool starts_from_last_state() const
  {
    return scheme.kind() == TimeScheme::Kind::backward_euler;
  }

  /// The longest step that resolves waves [s]; infinite: there are none of a fracture that grows.
  double wave_step();

  /// What the length of steps hangs on besides, for checkpoints.
  WaveSteps &wave_steps()
  {
    return control.waves;
  }
  const WaveSteps &wave_steps() const
  {
    return control.waves;
  }

  /// All bulk vectors that must move with the mesh, and all lists of extra unknowns.
  std::vector<dealii::TrilinosWrappers::MPI::BlockVector *> bulk_vectors();
  std::vector<std::vector<double> *> extra_vectors();

private:
  enum class Outcome
  {
    accepted,
    rejected,
    hopeless ///< no shorter step does better
  };
  /// Of the step [time, time + dt], or of all the time until then.
  StepContext make_context(double time, double dt, unsigned int step, unsigned int attempt) const;

  /// What the step's rates are differences from.
  void set_references();

  Outcome attempt(StepReport &report, std::string &advice, Verdict &verdict);

  /// In an attempt that has succeeded, over that of Rayleigh waves; zero where there are no waves
  /// of a fracture that grows.
  double speed_of_tips(const Verdict &verdict, double dt);

  StepReport advance_explicitly(double time, double dt, unsigned int step);

  /// The step is accepted, with `current`.
  void commit(const State &state);

  RunContext &run;
  CoupledSystem<dim> &system;
  FractureModel<dim> &model;
  Network<dim> &network;
  const Rock &rock;
  TimeScheme &scheme;
  StepControl control;

  StepContext context;
  Unknowns current, before, rate_reference, acceleration_reference;
  FluidBalance balance;
  bool model_wants_setup = false;
  std::unique_ptr<ExplicitMarch<dim>> march;
};
} // namespace stockwork
