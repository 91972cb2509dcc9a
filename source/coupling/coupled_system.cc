#include "coupling/coupled_system.h"

#include "stockwork/base/error.h"

namespace stockwork
{
using namespace dealii;

template <int dim>
void CoupledSystem<dim>::declare_parameters(ParameterHandler &prm)
{
  LinearSolverParameters::declare_parameters(prm);
  CouplingParameters::declare_parameters(prm);
  NewtonParameters::declare_parameters(prm);
}


template <int dim>
CoupledSystem<dim>::CoupledSystem(RunContext &run,
                                  parallel::distributed::Triangulation<dim> &triangulation,
                                  const Mapping<dim> &mapping,
                                  const Scene<dim> &scene,
                                  const RockLaws &laws,
                                  const BoundaryConditions<dim> &boundary_conditions,
                                  FractureModel<dim> &model,
                                  Network<dim> &network,
                                  const ElementSettings &elements,
                                  ParameterHandler &prm)
  : run(run)
  , scene(scene)
  , laws(laws)
  , prescribed_loads(boundary_conditions.loads())
  , model(model)
  , network(network)
  , unknowns(triangulation, mapping, boundary_conditions, model, network, elements)
  , assembly(run, unknowns, scene, laws, prescribed_loads, model, network)
{
  solver_parameters.parse_parameters(prm);
  coupling_parameters.parse_parameters(prm);
  newton_parameters.parse_parameters(prm);
}


template <int dim>
void CoupledSystem<dim>::make_solver()
{
  BulkStructure structure;
  structure.dim = dim;
  structure.has_pore_pressure = unknowns.elements.has_pore_pressure;
  structure.yields = laws.may_yield();
  const auto make = [this, structure]() -> std::unique_ptr<LinearSolver>
  {
    if (coupling_parameters.scheme == CouplingParameters::Scheme::monolithic)
      return make_linear_solver(solver_parameters, structure, run.communicator);
    return std::make_unique<SplitScheme>(coupling_parameters, solver_parameters, structure,
                                         run.communicator,
                                         [this](TrilinosWrappers::SparseMatrix &matrix)
                                         { assembly.bulk_assembly().undrained_term(matrix); });
  };
  solver = std::make_unique<TangentSolver>(make, run.communicator);
}


template <int dim>
void CoupledSystem<dim>::setup_mesh(const double time)
{
  unknowns.number_bulk(time);
  network.set_mesh(unknowns.mesh_view(), scene, unknowns.communication);
  assembly.mesh_changed();
  if (!solver)
    make_solver();
  if (solver->wants_hierarchy(unknowns.n_bulk()))
    assembly.linear_system().displacement_hierarchy = make_displacement_hierarchy(
      unknowns.mapping, unknowns.dof_handler(), unknowns.increment_constraints());
}


template <int dim>
void CoupledSystem<dim>::adopt_extra(const ExtraNumbering &from,
                                     const std::vector<std::vector<double> *> &values)
{
  unknowns.adopt_extra(from, values);
  assembly.topology_changed();
}


template <int dim>
State CoupledSystem<dim>::state(const Unknowns &current,
                                const Unknowns &committed,
                                const Unknowns &rate_reference,
                                const Unknowns &acceleration_reference) const
{
  return {current,
          committed,
          rate_reference,
          acceleration_reference,
          [this, &current](const std::uint64_t key) { return network.pressure(key, current); },
          [this](const std::uint64_t key) { return network.unknown(key); }};
}


template <int dim>
void CoupledSystem<dim>::begin_step(const StepContext &context)
{
  unknowns.constrain(context.time);
  assembly.begin_step(context);
}


template <int dim>
NonlinearReport CoupledSystem<dim>::solve(const StepContext &context,
                                          Unknowns &current,
                                          const Unknowns &committed,
                                          const Unknowns &rate_reference,
                                          const Unknowns &acceleration_reference,
                                          const Accuracy accuracy)
{
  // Essential conditions hold from the start, so that increments satisfy them with zero values.
  auto values = unknowns.owned_vector();
  copy_owned(values, current.bulk);
  unknowns.constrain(values, current.bulk);

  if (restarts())
    return pass_as_published(context, current, committed);

  const State state = this->state(current, committed, rate_reference, acceleration_reference);
  assembly.assemble_linear(context, state);
  assembly.assemble_nonlinear(context, state);
  const NewtonParameters parameters =
    accuracy == Accuracy::rough ? newton_parameters.rough() : newton_parameters;
  const NewtonTools<dim> tools{run,     parameters, unknowns,      assembly,
                               *solver, network,    is_interrupted};
  return Newton<dim>(tools, context, current, state).solve();
}


template <int dim>
Unknowns CoupledSystem<dim>::start() const
{
  Unknowns result{ghosted_vector(), std::vector<double>(unknowns.n_extra(), 0.)};
  network.set_start(result.extra);
  return result;
}


template <int dim>
TrilinosWrappers::MPI::BlockVector CoupledSystem<dim>::residual_at_rest(const double time)
{
  StepContext context;
  context.time = time;
  context.dt = context.rate = context.pressure_rate = 1.;
  begin_step(context);
  const Unknowns at_rest = start();
  auto result = unknowns.owned_vector();
  copy_owned(result, assembly.residual_at_rest(context, state(at_rest, at_rest, at_rest, at_rest)));
  return result;
}


template <int dim>
NonlinearReport CoupledSystem<dim>::pass_as_published(const StepContext &context,
                                                      Unknowns &current,
                                                      const Unknowns &start)
{
  // Pressures of the start, apertures of the last step. A trace below these a crack is unloaded,
  // where it has the stiffness that it was left with, and no other.
  constexpr double trace = 1e-9;
  for (unsigned int i = 0; i < unknowns.n_extra(); ++i)
    current.extra[i] =
      i < unknowns.n_mechanical_extra() ? (1. - trace) * current.extra[i] : start.extra[i];
  auto values = unknowns.owned_vector();
  copy_owned(values, current.bulk);
  // What the stress that the step before has left presses into the pores, less than none where it
  // is a compression: Q_pc of Eq. 37, alpha div u - alpha^2/K_dr p.
  auto pressed_in = unknowns.owned_vector();
  const bool has_pores = values.n_blocks() > 1;
  if (has_pores)
  {
    const LinearSystem &system = assembly.linear_system();
    const auto pressures = values.block(1);
    values.block(1) = 0.;
    unknowns.constrain(values, current.bulk);
    assembly.assemble_linear(context, this->state(current, current, start, start));
    system.fixed_stress_mass.vmult(pressed_in.block(1), pressures);
    pressed_in.block(1) += system.residual_bulk.block(1);
    assembly.assemble_linear(context, this->state(current, current, current, current));
    pressed_in.block(1) -= system.residual_bulk.block(1);
  }
  const State state = this->state(current, current, current, current);
  assembly.assemble_linear(context, state);
  assembly.assemble_nonlinear(context, state);
  if (has_pores)
    assembly.linear_system().residual_bulk.block(1) += pressed_in.block(1);

  NonlinearReport report;
  auto dx_bulk = unknowns.owned_vector();
  std::vector<double> dx_extra;
  try
  {
    const auto scope = run.timers.scope("solve");
    const LinearReport linear =
      solver->solve(assembly.linear_system(), assembly.stamps(), 0., dx_bulk, dx_extra);
    run.timers.move("solve", "preconditioner", linear.setup_seconds);
    report.linear_iterations = linear.iterations;
  }
  catch (const SolveError &error)
  {
    report.reason = error.what();
    return report;
  }
  values.add(1., dx_bulk);
  unknowns.constrain(values, current.bulk);
  for (unsigned int i = 0; i < dx_extra.size(); ++i)
    current.extra[i] += dx_extra[i];
  report.converged = true;
  report.iterations = 1;
  return report;
}


template <int dim>
void CoupledSystem<dim>::commit(const StepContext &context, const State &state)
{
  if (NonlinearRock<dim> *const rock = assembly.nonlinear_rock())
    rock->commit(context, state);
}


template class CoupledSystem<2>;
template class CoupledSystem<3>;
} // namespace stockwork
