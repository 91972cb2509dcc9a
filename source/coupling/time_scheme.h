#pragma once

#include <deal.II/base/parameter_handler.h>

#include "stockwork/exchange/state.h"

namespace stockwork
{
/// How rates are formed from the unknowns, and which history that takes.
///
/// Quasi-static: backward Euler, or BDF2 with variable steps (second order; the default for smooth
/// consolidation). With inertia: Newmark for the displacement and the theta scheme for the
/// pressure, both collocated at the end of the step. Explicit: Newmark's with beta = 0, in as many
/// equal parts of a step as it takes to be stable (ExplicitMarch).
class TimeScheme
{
public:
  enum class Kind
  {
    backward_euler,
    bdf2,
    newmark
  };

  static void declare_parameters(dealii::ParameterHandler &prm);

  /// `smooth`: nothing in the run changes abruptly, so `auto` may choose second order.
  void parse_parameters(dealii::ParameterHandler &prm, bool smooth);

  /// The vectors of the history get the layout of `unknowns` and are zero; call once at the start.
  void initialise(const Unknowns &unknowns);

  /// Coefficients of a step from the last accepted time.
  StepContext context(double time, double dt, unsigned int step, unsigned int attempt) const;

  /// Fill the references that go with `context`.
  void references(const StepContext &context,
                  const Unknowns &committed,
                  Unknowns &rate_reference,
                  Unknowns &acceleration_reference) const;

  /// The step is accepted; `committed` is the state at its start, `current` at its end.
  /// @param new_unknowns extra ones have appeared in it
  void accept(const StepContext &context,
              const Unknowns &committed,
              const Unknowns &current,
              bool new_unknowns);

  /// From here on loads are others at once, as where the rate of a well jumps. Schemes that go on
  /// from rates or from earlier states would take something of the old ones along: BDF2 had 8 % of
  /// the fluid too much in a fracture that was shut in. It starts again with a step of backward
  /// Euler.
  void forget_past()
  {
    if (scheme == Kind::bdf2)
      n_accepted = 0;
  }

  /// The local error of the step relative to the size of the solution, the greater of displacement
  /// and pressure; relative to 1e-4 of the greatest size so far where less is left. Of order
  /// order()+1 in dt; negative while there is not enough history.
  double error_estimate(const StepContext &context,
                        const Unknowns &committed,
                        const Unknowns &current) const;

  /// Extrapolated start of the iteration, in place of the committed state `unknowns`: a quarter
  /// fewer iterations where a fracture grows steadily.
  void predict(const StepContext &context, Unknowns &unknowns) const;

  unsigned int order() const;

  /// Whether Newmark's scheme damps high frequencies.
  bool damps() const
  {
    return gamma > 0.5;
  }

  Kind kind() const
  {
    return scheme;
  }

  /// A kind of Newmark's.
  bool is_explicit() const
  {
    return explicit_steps;
  }

  double newmark_gamma() const
  {
    return gamma;
  }

  /// What an explicit step goes on from, and leaves (Newmark).
  dealii::TrilinosWrappers::MPI::BlockVector &bulk_velocity()
  {
    return velocity.bulk;
  }
  dealii::TrilinosWrappers::MPI::BlockVector &bulk_acceleration()
  {
    return acceleration.bulk;
  }

  /// Whether the loads of the start have been there for ever.
  bool starts_in_equilibrium() const
  {
    return in_equilibrium;
  }

  /// Vectors of history that must move with the mesh and into checkpoints.
  std::vector<dealii::TrilinosWrappers::MPI::BlockVector *> bulk_history();

  /// The extra unknowns of the history, for renumbering.
  std::vector<std::vector<double> *> extra_history();

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &previous_dt &earlier_dt &n_accepted &has_new_unknowns &maximum_size;
  }

private:
  Kind scheme = Kind::backward_euler;
  double beta = 0.25;
  double gamma = 0.5;
  double theta = 0.5;
  bool explicit_steps = false;
  bool in_equilibrium = false;

  double previous_dt = 0., earlier_dt = 0.;
  unsigned int n_accepted = 0;
  bool has_new_unknowns = false;     ///< since the last step
  double maximum_size[2] = {0., 0.}; ///< of displacement and pressure so far, as norms (BDF2)

  Unknowns previous;     ///< the state before the committed one (not Newmark)
  Unknowns earlier;      ///< the one before that (BDF2, for the error estimate)
  Unknowns velocity;     ///< first derivative of the committed state (Newmark, theta)
  Unknowns acceleration; ///< second derivative (Newmark)
};
} // namespace stockwork
