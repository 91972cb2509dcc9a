#include "coupling/coupled_system.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "coupling/system_sink.h"
#include "coupling/visible_constraints.h"

#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/block_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace stockwork
{
using namespace dealii;

namespace
{
template <int dim>
FESystem<dim> make_element(const ElementSettings &elements)
{
  const FE_Q<dim> displacement(elements.displacement_degree), pressure(1);
  if (elements.has_pore_pressure)
    return FESystem<dim>(displacement, dim, pressure, 1);
  return FESystem<dim>(displacement, dim);
}


void truncate(Triplets &triplets, const std::size_t size)
{
  triplets.rows.resize(size);
  triplets.columns.resize(size);
  triplets.values.resize(size);
}
} // namespace


template <int dim>
void CoupledSystem<dim>::declare_parameters(ParameterHandler &prm)
{
  LinearSolverParameters::declare_parameters(prm);
  CouplingParameters::declare_parameters(prm);
  prm.enter_subsection("Nonlinear solver");
  prm.declare_entry("Tolerance", "1e-8", Quantity(dimension::number, Range::open(0., 1.)),
                    "Reduction of the residual of each field against its greatest in the solve.");
  prm.declare_entry("Maximum iterations", "25", Patterns::Integer(1),
                    "A solve that takes more has failed, and the step is cut.");
  prm.declare_entry("Maximum pressure change", "",
                    Quantity(dimension::pressure, Range::positive(), ""),
                    "An iteration that would change a fracture pressure by more is shortened. "
                    "Empty: the net pressure with which the first crack sets out, by "
                    "toughness or viscosity, or what pressures have changed by so far in the "
                    "solve, if that is more.");
  prm.declare_entry("Show iterations", "false", Patterns::Bool(),
                    "Print the residuals of every iteration: forces of the bulk and of the "
                    "fracture, mass in pores and in the fracture.");
  prm.leave_subsection();
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
  , triangulation(triangulation)
  , mapping(mapping)
  , scene(scene)
  , boundary_conditions(boundary_conditions)
  , model(model)
  , network(network)
  , elements(elements)
  , communication(run.communicator)
  , fe(make_element<dim>(elements))
  , dof_handler(triangulation)
{
  if (const RockLaw *of_model = model.requirements().law; of_model != nullptr || !laws.are_linear())
    nonlinear = std::make_unique<NonlinearRock<dim>>(
      laws, scene, [this](const auto &cell) { return this->model.role(cell); }, of_model);
  solver_parameters.parse_parameters(prm);
  coupling_parameters.parse_parameters(prm);
  prm.enter_subsection("Nonlinear solver");
  tolerance = get_quantity(prm, "Tolerance", dimension::number);
  max_iterations = prm.get_integer("Maximum iterations");
  pressure_limit = get_optional_quantity(prm, "Maximum pressure change", dimension::pressure);
  show_iterations = prm.get_bool("Show iterations");
  prm.leave_subsection();
}


template <int dim>
MeshView<dim> CoupledSystem<dim>::mesh_view() const
{
  return {triangulation, dof_handler, mapping, increment_constraints, elements.has_pore_pressure};
}


template <int dim>
void CoupledSystem<dim>::setup_mesh(const double time)
{
  // Cells come along a space-filling curve, so the numbering is local as it is; and the components
  // of a node stay together, which the multigrid smoother wants.
  dof_handler.distribute_dofs(fe);
  std::vector<unsigned int> block_of_component(fe.n_components(), 0);
  if (elements.has_pore_pressure)
    block_of_component[dim] = 1;
  DoFRenumbering::component_wise(dof_handler, block_of_component);

  const auto dofs_per_block = DoFTools::count_dofs_per_fe_block(dof_handler, block_of_component);
  IndexSet all_relevant;
  DoFTools::extract_locally_relevant_dofs(dof_handler, all_relevant);
  owned = dof_handler.locally_owned_dofs().split_by_block(dofs_per_block);

  boundary_conditions.constrain(time, mapping, dof_handler, constraints, increment_constraints);
  constraints_time = time;
  model.setup(mesh_view(), communication);
  network.set_mesh(mesh_view(), scene, communication);

  // What the model couples across ranks it sees as well.
  std::vector<types::global_dof_index> coupled;
  if (const KeptTerms *kept = model.kept_terms())
    kept->add_couplings([&](const std::vector<types::global_dof_index> &dofs)
                        { coupled.insert(coupled.end(), dofs.begin(), dofs.end()); });
  std::sort(coupled.begin(), coupled.end());
  coupled.erase(std::unique(coupled.begin(), coupled.end()), coupled.end());
  IndexSet visible = all_relevant;
  visible.add_indices(coupled.begin(), coupled.end());
  relevant = visible.split_by_block(dofs_per_block);
  if (communication.max(coupled.empty() ? 0. : 1.) > 0.)
    make_visible(increment_constraints, dof_handler.locally_owned_dofs(), visible,
                 run.communicator);

  {
    BlockDynamicSparsityPattern pattern(relevant);
    DoFTools::make_sparsity_pattern(dof_handler, pattern, increment_constraints, false);
    if (const KeptTerms *kept = model.kept_terms())
      kept->add_couplings(
        [&](std::vector<types::global_dof_index> dofs)
        {
          // A bond may lead back to its own node, across a plane of symmetry.
          std::sort(dofs.begin(), dofs.end());
          dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
          increment_constraints.add_entries_local_to_global(dofs, pattern, false);
        });
    SparsityTools::distribute_sparsity_pattern(pattern, dof_handler.locally_owned_dofs(),
                                               run.communicator, visible);
    system.bulk.clear();
    system.bulk.reinit(owned, pattern, run.communicator);
    if (elements.has_pore_pressure)
      system.fixed_stress_mass.reinit(system.bulk.block(1, 1));
  }
  system.residual_bulk.reinit(owned, relevant, run.communicator, true);
  linear_residual_bulk.reinit(owned, run.communicator);
  ++stamps.mesh;
  matrix_is_current = false;

  bulk = std::make_unique<BulkAssembly<dim>>(scene.rock, boundary_conditions.loads(),
                                             elements.stabilisation, mesh_view(),
                                             [this](const auto &cell) { return model.role(cell); });
  if (!solver)
  {
    BulkStructure structure;
    structure.dim = dim;
    structure.has_pore_pressure = elements.has_pore_pressure;
    structure.n_dofs = dof_handler.n_dofs();
    const auto make = [this, structure]() -> std::unique_ptr<LinearSolver>
    {
      if (coupling_parameters.scheme == CouplingParameters::Scheme::monolithic)
        return make_linear_solver(solver_parameters, structure, run.communicator);
      return std::make_unique<SplitScheme>(
        coupling_parameters, solver_parameters, structure, run.communicator,
        [this](TrilinosWrappers::SparseMatrix &matrix) { bulk->undrained_term(matrix); });
    };
    solver = std::make_unique<TangentSolver>(make, run.communicator);
  }
  if (nonlinear)
    nonlinear->setup(mesh_view());
  has_rock_change = false;
  if (solver->wants_hierarchy(dof_handler.n_dofs()))
    system.displacement_hierarchy =
      make_displacement_hierarchy(mapping, dof_handler, increment_constraints);
}


template <int dim>
void CoupledSystem<dim>::renumber_extra(const std::vector<std::vector<double> *> &values)
{
  const ExtraNumbering old = numbering;
  adopt_extra(old, values);
}


template <int dim>
void CoupledSystem<dim>::adopt_extra(const ExtraNumbering &from,
                                     const std::vector<std::vector<double> *> &values)
{
  std::vector<ExtraUnknown> unknowns = model.extra_unknowns();
  n_model_extra = system.n_mechanical_extra = unknowns.size();
  network.set_segments(model.segments(), communication);
  network.set_offset(n_model_extra);
  const std::vector<ExtraUnknown> pressures = network.unknowns();
  unknowns.insert(unknowns.end(), pressures.begin(), pressures.end());

  ExtraNumbering now(std::move(unknowns));
  for (std::vector<double> *vector : values)
    if (vector->size() == from.size()) // a quasi-static run has no reference of acceleration
      *vector = now.transfer(from, *vector);
  numbering = std::move(now);
  bulk->forget_cuts();
  if (nonlinear)
    nonlinear->topology_changed();
  ++stamps.extra;
}


template <int dim>
TrilinosWrappers::MPI::BlockVector CoupledSystem<dim>::ghosted_vector() const
{
  TrilinosWrappers::MPI::BlockVector vector;
  vector.reinit(owned, relevant, run.communicator);
  return vector;
}


template <int dim>
TrilinosWrappers::MPI::BlockVector CoupledSystem<dim>::owned_vector() const
{
  TrilinosWrappers::MPI::BlockVector vector;
  vector.reinit(owned, run.communicator);
  return vector;
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
void CoupledSystem<dim>::assemble_bulk_matrix(const StepContext &context)
{
  const auto scope = run.timers.scope("assembly");
  const KeptTerms *const kept = model.kept_terms();
  const bool anew = !matrix_is_current || bulk_was_touched || kept_terms_changed();
  if (bulk->matrix(context, anew, system.bulk,
                   elements.has_pore_pressure ? &system.fixed_stress_mass : nullptr))
  {
    if (kept != nullptr)
    {
      const auto scope = run.timers.scope("fracture");
      SystemSink sink(increment_constraints, system, system.bulk, system.residual_bulk,
                      linear_residual_extra, linear_extra_extra);
      kept->assemble(context, sink);
      if (communication.max(sink.bulk_touched ? 1. : 0.) > 0.)
        system.bulk.compress(VectorOperation::add);
    }
    ++stamps.displacement_values;
  }
  kept_version = kept != nullptr ? kept->version() : 0;
  system.elastic = !elements.has_pore_pressure;
  system.definite_displacement = kept == nullptr || kept->is_symmetric();
  system.definite = system.elastic && system.definite_displacement;
  matrix_context = context;
  matrix_is_current = true;
  bulk_was_touched = false;
  ++stamps.bulk_values;
}


template <int dim>
void CoupledSystem<dim>::assemble_linear(const StepContext &context, const State &state)
{
  const bool coefficients_changed =
    context.acceleration != matrix_context.acceleration ||
    (elements.has_pore_pressure && (context.rate != matrix_context.rate ||
                                    context.pressure_rate != matrix_context.pressure_rate));
  if (!matrix_is_current || coefficients_changed || bulk_was_touched || kept_terms_changed())
    assemble_bulk_matrix(context);

  const auto scope = run.timers.scope("assembly");
  const auto role = [this](const auto &cell) { return model.role(cell); };
  bulk->residual(context, state, system.bulk, system.residual_bulk);

  system.bulk_extra.clear();
  system.extra_bulk.clear();
  linear_extra_extra.clear();
  linear_residual_extra.assign(numbering.size(), 0.);
  if (n_model_extra > 0)
  {
    SystemSink sink(increment_constraints, system, system.bulk, system.residual_bulk,
                    linear_residual_extra, linear_extra_extra);
    bulk->cut_cells(context, state, role, sink);
    system.residual_bulk.compress(VectorOperation::add);
    communication.sum(linear_residual_extra);
  }
  linear_residual_bulk = system.residual_bulk;
  n_linear_bulk_extra = system.bulk_extra.values.size();
  n_linear_extra_bulk = system.extra_bulk.values.size();
}


template <int dim>
void CoupledSystem<dim>::assemble_nonlinear(const StepContext &context, const State &state)
{
  if (bulk_was_touched)
    assemble_linear(context, state); // the kept matrix has terms of the last iteration in it

  const auto scope = run.timers.scope("fracture");
  truncate(system.bulk_extra, n_linear_bulk_extra);
  truncate(system.extra_bulk, n_linear_extra_bulk);
  system.extra_extra = linear_extra_extra;
  system.residual_bulk = 0.;
  system.residual_extra.assign(numbering.size(), 0.);

  SystemSink sink(increment_constraints, system, system.bulk, system.residual_bulk,
                  system.residual_extra, system.extra_extra);
  model.assemble(context, state, sink);
  network.assemble(context, state, communication, sink);
  if (nonlinear)
    assemble_rock(context, state);
  system.residual_bulk.compress(VectorOperation::add);
  if (numbering.size() > 0)
    communication.sum(system.residual_extra);

  const bool grown_border = system.bulk_extra.values.size() > n_linear_bulk_extra ||
                            system.extra_bulk.values.size() > n_linear_extra_bulk;
  const double touched = communication.max(sink.bulk_touched ? 2. : grown_border ? 1. : 0.);
  bulk_was_touched = touched == 2.;
  fracture_sees_bulk = touched > 0.;
  if (bulk_was_touched)
  {
    system.bulk.compress(VectorOperation::add);
    ++stamps.bulk_values;
    ++stamps.displacement_values;
  }
  for (unsigned int b = 0; b < owned.size(); ++b)
    system.residual_bulk.block(b) += linear_residual_bulk.block(b);
  for (unsigned int i = 0; i < numbering.size(); ++i)
    system.residual_extra[i] += linear_residual_extra[i];
  // The cubic law has no potential, so a flowing fracture makes the matrix unsymmetric.
  system.symmetric = model.requirements().symmetric && n_model_extra == numbering.size();
  ++stamps.extra_values;
}


template <int dim>
void CoupledSystem<dim>::assemble_rock(const StepContext &context, const State &state)
{
  const auto scope = run.timers.scope("rock");
  system.rock_change = nullptr;
  if (communication.max(nonlinear->find_active(state)) == 0.)
    return;
  if (!has_rock_change)
  {
    rock_change.reinit(system.bulk.n_block_rows(), system.bulk.n_block_cols());
    for (unsigned int i = 0; i < system.bulk.n_block_rows(); ++i)
      for (unsigned int j = 0; j < system.bulk.n_block_cols(); ++j)
        rock_change.block(i, j).reinit(system.bulk.block(i, j));
    rock_change.collect_sizes();
    has_rock_change = true;
  }
  rock_change = 0.;
  SystemSink sink(increment_constraints, system, rock_change, system.residual_bulk,
                  system.residual_extra, system.extra_extra);
  nonlinear->assemble(context, state, sink);
  rock_change.compress(VectorOperation::add);
  system.rock_change = &rock_change;
  system.rock_change_is_symmetric = communication.max(nonlinear->is_symmetric() ? 0. : 1.) == 0.;
}


template <int dim>
void CoupledSystem<dim>::update_linear_residual(const double step,
                                                const TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                                const std::vector<double> &dx_extra)
{
  auto product = owned_vector();
  system.bulk.vmult(product, dx_bulk);
  for (std::size_t k = 0; k < n_linear_bulk_extra; ++k)
    product(system.bulk_extra.rows[k]) +=
      system.bulk_extra.values[k] * dx_extra[system.bulk_extra.columns[k]];
  product.compress(VectorOperation::add);
  for (unsigned int b = 0; b < owned.size(); ++b)
    linear_residual_bulk.block(b).add(step, product.block(b));

  if (numbering.size() == 0)
    return;
  auto ghosted = ghosted_vector();
  ghosted = dx_bulk;
  std::vector<double> change(numbering.size(), 0.);
  for (std::size_t k = 0; k < n_linear_extra_bulk; ++k)
    change[system.extra_bulk.rows[k]] +=
      system.extra_bulk.values[k] * ghosted(system.extra_bulk.columns[k]);
  for (std::size_t k = 0; k < linear_extra_extra.values.size(); ++k)
    change[linear_extra_extra.rows[k]] +=
      linear_extra_extra.values[k] * dx_extra[linear_extra_extra.columns[k]];
  communication.sum(change);
  for (unsigned int i = 0; i < change.size(); ++i)
    linear_residual_extra[i] += step * change[i];
}


template <int dim>
typename CoupledSystem<dim>::PoreFluid CoupledSystem<dim>::pore_fluid(const StepContext &context,
                                                                      const State &state) const
{
  PoreFluid fluid;
  if (!elements.has_pore_pressure)
    return fluid;
  const auto role = [this](const auto &cell) { return model.role(cell); };
  fluid.stored = bulk->stored_fluid(context, state, role);
  fluid.volume = bulk->pore_volume(state.current, role);
  fluid.outflow = bulk->outflow(context, state);
  if (nonlinear)
  {
    fluid.stored += nonlinear->totals().content_change;
    fluid.volume += nonlinear->totals().content;
    fluid.outflow += nonlinear->totals().outflow;
  }
  fluid.stored = communication.sum(fluid.stored);
  fluid.volume = communication.sum(fluid.volume);
  fluid.outflow = communication.sum(fluid.outflow);
  return fluid;
}


template class CoupledSystem<2>;
template class CoupledSystem<3>;
} // namespace stockwork
