#pragma once

#include <deal.II/base/parameter_handler.h>

#include "stockwork/base/run_context.h"
#include "stockwork/fracture/model.h"

#include "coupling/forcing_term.h"
#include "coupling/residual_norms.h"
#include "coupling/system_assembly.h"
#include "coupling/unknown_numbering.h"
#include "flow/network.h"
#include "solvers/tangent_solver.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stockwork
{
/// What a solution is wanted for: to see whether the fracture grows, or to be kept.
enum class Accuracy
{
  rough,
  full
};

/// Subsection "Nonlinear solver".
struct NewtonParameters
{
  Accuracy accuracy = Accuracy::full;
  double tolerance;
  double fluid_tolerance = 1e-9; ///< of the fluid in fractures, in what is injected in the step
  std::optional<double> pressure_limit; ///< as the deck gives it
  unsigned int max_iterations;
  bool show_iterations;

  static void declare_parameters(dealii::ParameterHandler &prm);

  void parse_parameters(dealii::ParameterHandler &prm);

  /// Of a solution that is only asked whether the fracture grows.
  NewtonParameters rough() const;
};

struct NonlinearReport
{
  bool converged = false;
  unsigned int iterations = 0;
  unsigned int linear_iterations = 0;
  std::string reason; ///< why not, for the user
  std::string advice; ///< what may help against that
};

/// What Newton's method works with, the same in all solves of a run.
template <int dim>
struct NewtonTools
{
  RunContext &run;
  const NewtonParameters &parameters;
  const UnknownNumbering<dim> &unknowns;
  SystemAssembly<dim> &assembly;
  TangentSolver &solver;
  const Network<dim> &network;
  const std::function<bool()> &is_interrupted; ///< may be empty; see CoupledSystem
};

/// Newton's method for one solve.
///
/// Where the rock is linear and all that the fracture does to it goes through cut cells, Newton's
/// method runs in the extra unknowns alone (CondensedSystem). The bulk stays behind meanwhile, and
/// follows in one go when they have converged; the test is then made once more, with everything
/// evaluated as it stands. So nothing hangs on the bulk not being looked at meanwhile but the
/// number of iterations.
template <int dim>
class Newton : private NewtonTools<dim>
{
public:
  /// `current` is the start and, after solve(), the end; the assembly's linear part and residual
  /// are those of it.
  Newton(const NewtonTools<dim> &tools,
         const StepContext &context,
         Unknowns &current,
         const State &state);

  NonlinearReport solve();

private:
  using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;
  using Tools = NewtonTools<dim>;
  using Tools::assembly, Tools::is_interrupted, Tools::network, Tools::parameters, Tools::run,
    Tools::solver, Tools::unknowns;

  /// What mass in the pores is compared with. Where fluid goes into fractures, next to nothing of
  /// it may be on its way in the pores, and a linear system that is not solved exactly leaves more.
  double mass_scale() const
  {
    return parameters.accuracy == Accuracy::rough ? std::max(greatest.mass, injected)
                                                  : greatest.mass;
  }

  /// The greatest residuals that count as none.
  ResidualNorms allowed();

  bool is_solved(const ResidualNorms &allowed) const
  {
    // A bulk that stays behind has no say yet.
    const bool bulk_is = condensed || (norms.momentum <= allowed.momentum && //
                                       norms.mass <= allowed.mass);
    return bulk_is && norms.extra <= allowed.extra &&
           norms.fracture_fluid <= allowed.fracture_fluid;
  }

  /// Fill `dx_bulk` and `dx_extra`. Returns whether they can be used; else the report says why not.
  bool find_increment(NonlinearReport &report, const ResidualNorms &allowed);

  /// Where rock flows plastically without hardening, its tangent is singular in many directions,
  /// and iterations wander along them. One that has gained next to nothing is followed by one with
  /// a little of the linear rock's stiffness, which bounds them; the residual stays what it is.
  void stiffen_slow_rock();

  /// The residual that the next linear solve may leave, over what it was.
  double linear_tolerance(const ResidualNorms &allowed);

  /// Eliminate the bulk where that is possible.
  void condense();

  /// The same of a condensed system: `dx_extra` and `linear_change`.
  LinearReport solve_condensed();

  /// Let the bulk follow.
  void recover_bulk();

  /// The factor by which the increment is shortened so that pressures do not leap.
  double pressure_factor() const;

  /// Move by so many increments and evaluate the residual there.
  void move(double step);

  /// The residual of the unknowns as they are; `update` sees to the linear part of it.
  template <class Update>
  void evaluate(const Update &update);

  /// Move by the increment, or less.
  void take_increment(unsigned int iteration);

  void give_up(NonlinearReport &report, const ResidualNorms &allowed) const;

  /// Say which equation is left, how much of it and where, and what shortened the iterations.
  /// Collective.
  /// @param tolerances by equation
  void explain(NonlinearReport &report, const ResidualNorms &tolerances) const;

  /// Of the greatest residual of a block of the bulk. Collective.
  dealii::Point<dim> place_in_bulk(unsigned int block) const;

  const StepContext &context;
  Unknowns &current;
  const State &state;
  const bool linear; ///< one iteration does it
  const double injected;
  const std::vector<double> extra_at_start;

  BlockVector values; ///< of the bulk, owned
  ResidualNorms norms, greatest;
  double force = 0.;          ///< scale of residual forces
  unsigned int n_limited = 0; ///< iterations that 'Maximum pressure change' shortened
  unsigned int n_halved = 0;  ///< iterations that were shortened because the residual grew
  double last_imbalance = 0., last_but_one = 0.; ///< before increments
  unsigned int n_returns = 0; ///< imbalances that were those of two increments before
  double last_force = 0.;     ///< residual forces before the last iteration, where rock yields
  ForcingTerm forcing_term;   ///< of rock that yields
  BlockVector dx_bulk;
  std::vector<double> dx_extra;

  std::unique_ptr<CondensedSystem> condensed; ///< null: the bulk moves along
  unsigned int n_condensed = 0;               ///< times
  std::vector<double> behind;                 ///< change that the bulk has yet to follow
  std::vector<double> start_of_condensed;     ///< the linear residual of the extra rows then
  std::vector<double> linear_change;          ///< of that residual, by the last increment
};
} // namespace stockwork
