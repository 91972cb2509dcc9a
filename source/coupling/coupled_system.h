#pragma once

#include "coupling/newton.h"
#include "coupling/split_scheme.h"
#include "coupling/system_assembly.h"
#include "coupling/unknown_numbering.h"
#include "solvers/tangent_solver.h"

#include <functional>
#include <memory>
#include <vector>

namespace stockwork
{
/// All unknowns of the run and the one nonlinear system that couples them: bulk, fracture model
/// and fracture fluid, solved monolithically by Newton's method.
///
/// The parts do the work: UnknownNumbering numbers, SystemAssembly fills residual and matrix,
/// Newton solves. This tells each of them what has happened.
template <int dim>
class CoupledSystem
{
public:
  using PoreFluid = typename SystemAssembly<dim>::PoreFluid;

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
  void renumber_extra(const std::vector<std::vector<double> *> &values)
  {
    adopt_extra(unknowns.extra(), values);
  }

  /// As above with the keys of another numbering, after a change of mesh or a restart.
  void adopt_extra(const ExtraNumbering &from, const std::vector<std::vector<double> *> &values);

  /// A step, or another attempt at it.
  void begin_step(const StepContext &context);

  /// Solve for `current` in the step that has begun, starting from its present value.
  NonlinearReport solve(const StepContext &context,
                        Unknowns &current,
                        const Unknowns &committed,
                        const Unknowns &rate_reference,
                        const Unknowns &acceleration_reference,
                        Accuracy accuracy);

  /// Whether rough solutions cost less: systems are solved iteratively.
  bool gains_by_rough_solutions() const
  {
    return !restarts() && solver->wants_hierarchy(unknowns.n_bulk());
  }

  /// Of a linear solver that chooses: what it has chosen, in words; else empty.
  std::string solver_choices() const
  {
    return solver->choices();
  }

  /// Every step starts at the start of the run: 'Coupling/Scheme = as published'.
  bool restarts() const
  {
    return coupling_parameters.restarts();
  }

  /// What restarts() makes of a step over so much time since the start.
  void adapt(StepContext &context) const
  {
    const double full = coupling_parameters.full_rate_time;
    context.share_of_rates = context.dt < full ? context.dt / full : 1.;
    context.restarts = true;
    context.damaged_pores = coupling_parameters.damaged_pores;
  }

  /// The unknowns at the start of the run, in the present numbering: nothing is open.
  Unknowns start() const;

  /// The residual of the bulk where nothing has moved: less than nothing, what loads it at a time.
  /// Essential conditions are those of this time from then on. Collective.
  dealii::TrilinosWrappers::MPI::BlockVector residual_at_rest(double time);

  /// Of the rock in a cell [kg/m^3].
  double density(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell) const
  {
    return scene.rock.at(cell->material_id(), cell->center()).density;
  }

  /// The converged state of a step is accepted.
  void commit(const StepContext &context, const State &state);

  /// Zero vectors with ghost values / without.
  dealii::TrilinosWrappers::MPI::BlockVector ghosted_vector() const
  {
    return unknowns.ghosted_vector();
  }
  dealii::TrilinosWrappers::MPI::BlockVector owned_vector() const
  {
    return unknowns.owned_vector();
  }

  /// Ghosted = owned, of vectors of the bulk. Collective.
  void update_ghosted(dealii::TrilinosWrappers::MPI::BlockVector &ghosted,
                      const dealii::TrilinosWrappers::MPI::BlockVector &owned) const
  {
    unknowns.update_ghosted(ghosted, owned);
  }

  /// Of the bulk, of this rank, and neither hanging nor given.
  dealii::types::global_dof_index n_free_unknowns() const
  {
    const dealii::IndexSet &owned = bulk_dofs().locally_owned_dofs();
    return std::count_if(owned.begin(), owned.end(),
                         [this](const auto i)
                         { return !unknowns.constraints().is_constrained(i); });
  }

  /// Let a transferred vector satisfy the hanging-node constraints (and essential conditions).
  void make_conforming(dealii::TrilinosWrappers::MPI::BlockVector &vector) const
  {
    unknowns.constraints().distribute(vector);
  }

  MeshView<dim> mesh_view() const
  {
    return unknowns.mesh_view();
  }

  const Loads<dim> &loads() const
  {
    return prescribed_loads;
  }

  /// Whether fluid of a well in the rock enters a piece of this size about a place.
  bool wells_reach(const dealii::Point<dim> &place, const double size) const
  {
    return network.sources_reach(place, size);
  }

  /// Whether what the deck says of the boundary is the same at all times.
  bool boundary_is_constant() const
  {
    return prescribed_loads.constant_in_time() && unknowns.boundary_is_constant();
  }

  const dealii::DoFHandler<dim> &bulk_dofs() const
  {
    return unknowns.dof_handler();
  }

  const ExtraNumbering &extra_numbering() const
  {
    return unknowns.extra();
  }

  unsigned int n_unknowns() const
  {
    return unknowns.n_bulk() + unknowns.n_extra();
  }

  /// Rock that may leave its linear range; null: there is none.
  NonlinearRock<dim> *nonlinear_rock() const
  {
    return assembly.nonlinear_rock();
  }

  /// A load that an opening controls; null: there is none.
  const OpeningControl<dim> *opening_control() const
  {
    return assembly.opening_control();
  }

  unsigned int index_of_control() const
  {
    return assembly.index_of_control();
  }

  /// Of the fracture model; null: it has none.
  NodalFields<dim> *nodal_fields() const
  {
    return model.nodal_fields();
  }

  const Collectives &collectives() const
  {
    return unknowns.communication;
  }

  /// State as models and network see it.
  State state(const Unknowns &current,
              const Unknowns &committed,
              const Unknowns &rate_reference,
              const Unknowns &acceleration_reference) const;

  PoreFluid pore_fluid(const StepContext &context, const State &state) const
  {
    return assembly.pore_fluid(context, state);
  }

  /// The residual at a state of any step and the matrix that a solve would take there, until the
  /// next call.
  const LinearSystem &linearise(const StepContext &context, const State &state)
  {
    assembly.begin_step(context);
    assembly.assemble_linear(context, state);
    assembly.assemble_nonlinear(context, state);
    return assembly.linear_system();
  }

private:
  void make_solver();

  /// Zhang et al. (2022), section 4.2: the flow since the start through the apertures of the last
  /// step, with what the cracks of that step yield by as storage; the rock with the pressures found
  /// and the stiffness of that step. Both are linear, and that is all.
  NonlinearReport
  pass_as_published(const StepContext &context, Unknowns &current, const Unknowns &start);

  RunContext &run;
  const Scene<dim> &scene;
  const RockLaws &laws;
  const Loads<dim> &prescribed_loads;
  FractureModel<dim> &model;
  Network<dim> &network;

  LinearSolverParameters solver_parameters;
  CouplingParameters coupling_parameters;
  NewtonParameters newton_parameters;

  UnknownNumbering<dim> unknowns;
  SystemAssembly<dim> assembly;
  std::unique_ptr<TangentSolver> solver;
};
} // namespace stockwork
