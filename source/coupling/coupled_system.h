#pragma once

#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/full_matrix.h>

#include "stockwork/base/run_context.h"
#include "stockwork/fracture/model.h"

#include "biot/boundary_conditions.h"
#include "biot/bulk_assembly.h"
#include "biot/nonlinear_rock.h"
#include "coupling/extra_numbering.h"
#include "coupling/split_scheme.h"
#include "flow/network.h"
#include "solvers/linear_solver.h"
#include "solvers/linear_system.h"
#include "solvers/tangent_solver.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

namespace stockwork
{
/// How the displacement and the pore pressure are discretised.
struct ElementSettings
{
  unsigned int displacement_degree = 2;
  bool has_pore_pressure = false;
  PressureStabilisation stabilisation = PressureStabilisation::none;
};

struct NonlinearReport
{
  bool converged = false;
  unsigned int iterations = 0;
  unsigned int linear_iterations = 0;
  std::string reason; ///< why not, for the user
  std::string advice; ///< what may help against that
};

/// All unknowns of the run and the one nonlinear system that couples them: bulk, fracture model
/// and fracture fluid, solved monolithically by Newton's method.
///
/// The bulk is linear but for cells whose rock has left its linear range. Its matrix is kept from
/// one iteration, and where possible one step, to the next, and its residual is updated instead of
/// assembled again; only the terms of the fracture and of those cells are assembled in every
/// iteration.
template <int dim>
class CoupledSystem
{
public:
  static void declare_parameters(dealii::ParameterHandler &prm);

  CoupledSystem(RunContext &run,
                dealii::parallel::distributed::Triangulation<dim> &triangulation,
                const dealii::Mapping<dim> &mapping,
                const Scene<dim> &scene,
                const RockLaws &laws,
                const BoundaryConditions<dim> &boundary_conditions,
                FractureModel<dim> &model,
                Network<dim> &network,
                const ElementSettings &elements,
                dealii::ParameterHandler &prm);

  /// Whether the run shall stop: a solve then ends before its next iteration, without success. May
  /// be empty. Collective.
  std::function<bool()> is_interrupted;

  /// The mesh is new: number the bulk unknowns, tell the model, find the extra unknowns.
  void setup_mesh(double time);

  /// The fracture is new: number the extra unknowns again. The values of the unknowns handed over
  /// move along; the first of them gets initial values for new unknowns, the others too.
  void renumber_extra(const std::vector<std::vector<double> *> &values);

  /// As above with the keys of another numbering, after a change of mesh or a restart.
  void adopt_extra(const ExtraNumbering &from, const std::vector<std::vector<double> *> &values);

  /// Solve for `current` at the time of the context, starting from its present value.
  NonlinearReport solve(const StepContext &context,
                        Unknowns &current,
                        const Unknowns &committed,
                        const Unknowns &rate_reference,
                        const Unknowns &acceleration_reference);

  /// Zero vectors with ghost values / without.
  dealii::TrilinosWrappers::MPI::BlockVector ghosted_vector() const;
  dealii::TrilinosWrappers::MPI::BlockVector owned_vector() const;

  /// Let a transferred vector satisfy the hanging-node constraints (and essential conditions).
  void make_conforming(dealii::TrilinosWrappers::MPI::BlockVector &vector) const
  {
    constraints.distribute(vector);
  }

  MeshView<dim> mesh_view() const;

  const Loads<dim> &loads() const
  {
    return boundary_conditions.loads();
  }

  const dealii::DoFHandler<dim> &bulk_dofs() const
  {
    return dof_handler;
  }

  const ExtraNumbering &extra_numbering() const
  {
    return numbering;
  }

  unsigned int n_unknowns() const
  {
    return dof_handler.n_dofs() + numbering.size();
  }

  /// Rock that may leave its linear range; null: there is none.
  NonlinearRock<dim> *nonlinear_rock() const
  {
    return nonlinear.get();
  }

  /// The converged state of a step is accepted.
  void commit(const StepContext &context, const State &state)
  {
    if (nonlinear)
      nonlinear->commit(context, state);
  }

  const Collectives &collectives() const
  {
    return communication;
  }

  /// State as models and network see it.
  State state(const Unknowns &current,
              const Unknowns &committed,
              const Unknowns &rate_reference,
              const Unknowns &acceleration_reference) const;

  /// Content of fluid that the pores have gained since the references, and what has left through
  /// the boundary, in the step; and what they hold over what they held in situ [m^3 (/m)].
  struct PoreFluid
  {
    double stored = 0.;
    double outflow = 0.;
    double volume = 0.;
  };
  PoreFluid pore_fluid(const StepContext &context, const State &state) const;

  /// The residual at a state and the matrix that a solve would take there, until the next call.
  const LinearSystem &linearise(const StepContext &context, const State &state)
  {
    assemble_linear(context, state);
    assemble_nonlinear(context, state);
    return system;
  }

private:
  void assemble_bulk_matrix(const StepContext &context);

  /// Those of the time scheme that the matrix depends on.
  bool coefficients_changed(const StepContext &context) const;

  bool kept_terms_changed() const
  {
    const KeptTerms *const kept = model.kept_terms();
    return kept != nullptr && kept->version() != kept_version;
  }

  /// The rows of the bulk where the model's kept terms are not those in the matrix; nothing: any
  /// may be another, or has changed for other reasons. Collective.
  std::optional<dealii::IndexSet> changed_rows(const StepContext &context) const;

  void assemble_linear(const StepContext &context, const State &state);

  void assemble_nonlinear(const StepContext &context, const State &state);

  /// Add what rock beyond its linear range does.
  void assemble_rock(const StepContext &context, const State &state);

  /// The unknowns have moved by a step times an increment.
  void update_linear_residual(double step,
                              const dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                              const std::vector<double> &dx_extra);

  /// One solve: newton.cc.
  class Newton;

  struct Norms
  {
    double momentum = 0., mass = 0., extra = 0., fracture_fluid = 0.;

    void keep_greatest(const Norms &other)
    {
      momentum = std::max(momentum, other.momentum);
      mass = std::max(mass, other.mass);
      extra = std::max(extra, other.extra);
      fracture_fluid = std::max(fracture_fluid, other.fracture_fluid);
    }
  };
  Norms residual_norms() const;

  /// Say which equation is left, how much of it and where, and what shortened the iterations.
  /// Collective.
  /// @param tolerances by equation
  /// @param n_limited iterations that 'Maximum pressure change' shortened
  /// @param n_halved iterations that were shortened because the residual grew
  void explain(NonlinearReport &report,
               const Norms &norms,
               const Norms &tolerances,
               unsigned int n_limited,
               unsigned int n_halved) const;

  /// Of the greatest residual of a block of the bulk. Collective.
  dealii::Point<dim> place_in_bulk(unsigned int block) const;

  /// Bounds of what rounding leaves of the residuals of the bulk and of the fluid in the fracture:
  /// a solve that starts in equilibrium gets no further.
  Norms rounding_errors(const dealii::TrilinosWrappers::MPI::BlockVector &values,
                        const StepContext &,
                        const State &);

  RunContext &run;
  dealii::parallel::distributed::Triangulation<dim> &triangulation;
  const dealii::Mapping<dim> &mapping;
  const Scene<dim> &scene;
  const BoundaryConditions<dim> &boundary_conditions;
  FractureModel<dim> &model;
  Network<dim> &network;
  ElementSettings elements;
  Collectives communication;

  double tolerance;
  std::optional<double> pressure_limit; ///< as the deck gives it
  unsigned int max_iterations;
  bool show_iterations;

  dealii::FESystem<dim> fe;
  dealii::DoFHandler<dim> dof_handler;
  dealii::AffineConstraints<double> constraints; ///< with values
  dealii::AffineConstraints<double> increment_constraints;
  double constraints_time = 0.;
  std::vector<dealii::IndexSet> owned, relevant;

  ExtraNumbering numbering;
  unsigned int n_model_extra = 0;

  std::unique_ptr<BulkAssembly<dim>> bulk;
  LinearSolverParameters solver_parameters;
  CouplingParameters coupling_parameters;
  std::unique_ptr<TangentSolver> solver;
  std::unique_ptr<NonlinearRock<dim>> nonlinear; ///< null: the rock is linear whatever happens
  dealii::TrilinosWrappers::BlockSparseMatrix rock_change; ///< see LinearSystem
  bool has_rock_change = false;                            ///< memory, that is

  LinearSystem system;
  SystemStamps stamps;
  dealii::FullMatrix<double> matrix_norms; ///< l1 norms of the bulk's blocks,
  unsigned int stamp_of_norms = 0;         ///< formed when its values had this stamp

  // The part of the system that is linear in the unknowns, kept through the iteration.
  dealii::TrilinosWrappers::MPI::BlockVector linear_residual_bulk;
  std::vector<double> linear_residual_extra;
  Triplets linear_extra_extra;
  std::size_t n_linear_bulk_extra = 0, n_linear_extra_bulk = 0;

  bool matrix_is_current = false;
  bool bulk_was_touched = false;
  /// The terms that are assembled in every iteration have derivatives by the bulk, or in its rows.
  bool fracture_sees_bulk = false;
  unsigned int kept_version = 0; ///< of the model's terms in the kept matrix
  StepContext matrix_context;
};
} // namespace stockwork
