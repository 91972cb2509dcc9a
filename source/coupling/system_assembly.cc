#include "coupling/system_assembly.h"

#include "stockwork/base/all_gather.h"

#include "coupling/system_sink.h"

#include <algorithm>
#include <cmath>

namespace stockwork
{
using namespace dealii;

namespace
{
void truncate(Triplets &triplets, const std::size_t size)
{
  triplets.rows.resize(size);
  triplets.columns.resize(size);
  triplets.values.resize(size);
}
} // namespace


template <int dim>
SystemAssembly<dim>::SystemAssembly(RunContext &run,
                                    const UnknownNumbering<dim> &unknowns,
                                    const Scene<dim> &scene,
                                    const RockLaws &laws,
                                    const Loads<dim> &loads,
                                    const FractureModel<dim> &model,
                                    const Network<dim> &network)
  : run(run)
  , unknowns(unknowns)
  , scene(scene)
  , loads(loads)
  , model(model)
  , network(network)
  , kept(model.kept_terms())
{
  if (const RockLaw *of_model = model.requirements().law; of_model != nullptr || !laws.are_linear())
    nonlinear = std::make_unique<NonlinearRock<dim>>(
      laws, scene, [this](const auto &cell) { return this->model.role(cell); }, of_model);
}


template <int dim>
void SystemAssembly<dim>::mesh_changed()
{
  const auto &owned = unknowns.owned();
  system.bulk.clear();
  has_bulk_matrix = false;
  system.residual_bulk.reinit(owned, unknowns.relevant(), run.communicator, true);
  linear_residual_bulk.reinit(owned, run.communicator);
  ++changes.mesh;
  matrix_is_current = false;

  bulk = std::make_unique<BulkAssembly<dim>>(scene.rock, loads, unknowns.elements.stabilisation,
                                             unknowns.mesh_view(),
                                             [this](const auto &cell) { return model.role(cell); });
  if (const auto &load = unknowns.controlled_load())
    control = std::make_unique<OpeningControl<dim>>(*load, scene.rock.main().young_modulus,
                                                    unknowns.mesh_view(), unknowns.communication);
  if (nonlinear)
    nonlinear->setup(unknowns.mesh_view());
  has_rock_change = false;
}


template <int dim>
void SystemAssembly<dim>::topology_changed()
{
  system.n_mechanical_extra = unknowns.n_mechanical_extra();
  bulk->forget_cuts();
  if (nonlinear)
    nonlinear->topology_changed();
  ++changes.extra;
}


template <int dim>
void SystemAssembly<dim>::begin_step(const StepContext &context)
{
  coefficients_are_current =
    context.acceleration == matrix_context.acceleration &&
    (!has_pores() || (context.rate == matrix_context.rate &&
                      context.pressure_rate == matrix_context.pressure_rate));
}


template <int dim>
std::optional<IndexSet> SystemAssembly<dim>::changed_rows(const StepContext &context) const
{
  if (!matrix_is_current || bulk_was_touched || !kept_terms_changed() ||
      context.acceleration != matrix_context.acceleration)
    return {};
  const auto mine = kept->changed_rows(kept_version);
  if (!mine)
    return {};
  std::vector<types::global_dof_index> all = all_gather(run.communicator, *mine);
  std::sort(all.begin(), all.end());
  IndexSet rows(unknowns.n_bulk());
  rows.add_indices(all.begin(), all.end());
  rows.compress();
  return rows;
}


template <int dim>
void SystemAssembly<dim>::make_bulk_matrix()
{
  BlockDynamicSparsityPattern pattern(unknowns.relevant());
  unknowns.couple(pattern);
  system.bulk.reinit(unknowns.owned(), pattern, run.communicator);
  if (has_pores())
    system.fixed_stress_mass.reinit(system.bulk.block(1, 1));
  has_bulk_matrix = true;
}


template <int dim>
void SystemAssembly<dim>::assemble_bulk_matrix(const StepContext &context)
{
  const auto scope = run.timers.scope("assembly");
  if (!has_bulk_matrix)
    make_bulk_matrix();
  std::optional<IndexSet> rows = changed_rows(context);
  if (rows && !bulk->rows(context, *rows, system.bulk))
    rows.reset();
  const bool anew = !matrix_is_current || bulk_was_touched || (kept_terms_changed() && !rows);
  const bool visited =
    bulk->matrix(context, anew, system.bulk, has_pores() ? &system.fixed_stress_mass : nullptr);
  ++changes.bulk_values;
  if (rows && coefficients_are_current)
    system.bulk_changes.in(*rows, changes.bulk_values);
  else
    system.bulk_changes.anywhere(changes.bulk_values);
  if (visited || rows)
    ++changes.displacement_values;

  if (kept != nullptr && (visited || rows))
  {
    const auto scope = run.timers.scope("fracture");
    SystemSink sink(unknowns.increment_constraints(), system, system.bulk, system.residual_bulk,
                    linear_residual_extra, linear_extra_extra);
    sink.rows = rows ? &*rows : nullptr;
    kept->assemble(context, rows ? *rows : complete_index_set(unknowns.n_bulk()), sink);
    if (unknowns.communication.max(sink.bulk_touched ? 1. : 0.) > 0.)
      system.bulk.compress(VectorOperation::add);
  }
  kept_version = kept != nullptr ? kept->version() : 0;
  system.elastic = !has_pores();
  system.definite_displacement = kept == nullptr || kept->is_symmetric();
  system.definite = system.elastic && system.definite_displacement;
  matrix_context = context;
  matrix_is_current = coefficients_are_current = true;
  bulk_was_touched = false;
}


template <int dim>
void SystemAssembly<dim>::assemble_linear(const StepContext &context, const State &state)
{
  if (!matrix_is_current || !coefficients_are_current || bulk_was_touched || kept_terms_changed())
    assemble_bulk_matrix(context);

  const auto scope = run.timers.scope("assembly");
  bulk->residual(context, state, &system.bulk, system.residual_bulk);

  system.bulk_extra.clear();
  system.extra_bulk.clear();
  linear_extra_extra.clear();
  linear_residual_extra.assign(unknowns.n_extra(), 0.);
  if (unknowns.n_mechanical_extra() > 0)
  {
    SystemSink sink(unknowns.increment_constraints(), system, system.bulk, system.residual_bulk,
                    linear_residual_extra, linear_extra_extra);
    bulk->cut_cells(
      context, state, [this](const auto &cell) { return model.role(cell); }, sink);
    if (control)
      control->assemble(context, state, index_of_control(), sink);
    system.residual_bulk.compress(VectorOperation::add);
    unknowns.communication.sum(linear_residual_extra);
  }
  all_linear_extra_extra.reset();
  linear_residual_bulk = system.residual_bulk;
  system.bulk_extra.shrink_to_fit();
  system.extra_bulk.shrink_to_fit();
  n_linear_bulk_extra = system.bulk_extra.values.size();
  n_linear_extra_bulk = system.extra_bulk.values.size();
}


template <int dim>
const typename SystemAssembly<dim>::BlockVector &
SystemAssembly<dim>::residual_at_rest(const StepContext &context, const State &state)
{
  const auto scope = run.timers.scope("assembly");
  bulk->residual(context, state, nullptr, system.residual_bulk);
  return system.residual_bulk;
}


template <int dim>
void SystemAssembly<dim>::assemble_nonlinear(const StepContext &context, const State &state)
{
  if (bulk_was_touched)
    assemble_linear(context, state); // the kept matrix has terms of the last iteration in it

  const auto scope = run.timers.scope("fracture");
  const unsigned int n_extra = unknowns.n_extra();
  truncate(system.bulk_extra, n_linear_bulk_extra);
  truncate(system.extra_bulk, n_linear_extra_bulk);
  system.extra_extra = linear_extra_extra;
  system.residual_bulk = 0.;
  system.residual_extra.assign(n_extra, 0.);

  SystemSink sink(unknowns.increment_constraints(), system, system.bulk, system.residual_bulk,
                  system.residual_extra, system.extra_extra);
  model.assemble(context, state, sink);
  network.assemble(context, state, unknowns.communication, sink);
  if (nonlinear)
    assemble_rock(context, state);

  // One sum over the ranks for the residual and for what has been touched.
  const bool grown_border = system.bulk_extra.values.size() > n_linear_bulk_extra ||
                            system.extra_bulk.values.size() > n_linear_extra_bulk;
  std::vector<double> &sums = system.residual_extra;
  for (const bool here : {sink.bulk_touched, grown_border, sink.residual_touched})
    sums.push_back(here ? 1. : 0.);
  unknowns.communication.sum(sums);
  bulk_was_touched = sums[n_extra] > 0.;
  sees_bulk = bulk_was_touched || sums[n_extra + 1] > 0.;
  // In most iterations nobody adds to the bulk's residual.
  if (sums[n_extra + 2] > 0. || system.rock_change != nullptr)
    system.residual_bulk.compress(VectorOperation::add);
  sums.resize(n_extra);
  if (bulk_was_touched)
  {
    system.bulk.compress(VectorOperation::add);
    ++changes.bulk_values;
    ++changes.displacement_values;
    system.bulk_changes.anywhere(changes.bulk_values);
  }
  for (unsigned int b = 0; b < linear_residual_bulk.n_blocks(); ++b)
    system.residual_bulk.block(b) += linear_residual_bulk.block(b);
  for (unsigned int i = 0; i < n_extra; ++i)
    system.residual_extra[i] += linear_residual_extra[i];
  // The cubic law has no potential, so a flowing fracture makes the matrix unsymmetric.
  system.symmetric =
    model.requirements().symmetric && !control && unknowns.n_mechanical_extra() == n_extra;
  ++changes.extra_values;
}


template <int dim>
void SystemAssembly<dim>::assemble_rock(const StepContext &context, const State &state)
{
  const auto scope = run.timers.scope("rock");
  system.rock_change = nullptr;
  if (unknowns.communication.max(nonlinear->find_active(state)) == 0.)
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
  SystemSink sink(unknowns.increment_constraints(), system, rock_change, system.residual_bulk,
                  system.residual_extra, system.extra_extra);
  nonlinear->assemble(context, state, sink);
  rock_change.compress(VectorOperation::add);
  system.rock_change = &rock_change;
  system.rock_change_is_symmetric =
    unknowns.communication.max(nonlinear->is_symmetric() ? 0. : 1.) == 0.;
}


template <int dim>
void SystemAssembly<dim>::update_linear(const double step,
                                        const BlockVector &dx_bulk,
                                        const std::vector<double> &dx_extra)
{
  auto product = unknowns.owned_vector();
  system.bulk.vmult(product, dx_bulk);
  for (std::size_t k = 0; k < n_linear_bulk_extra; ++k)
    product(system.bulk_extra.rows[k]) +=
      system.bulk_extra.values[k] * dx_extra[system.bulk_extra.columns[k]];
  product.compress(VectorOperation::add);
  for (unsigned int b = 0; b < product.n_blocks(); ++b)
    linear_residual_bulk.block(b).add(step, product.block(b));

  if (unknowns.n_extra() == 0)
    return;
  auto ghosted = unknowns.ghosted_vector();
  unknowns.update_ghosted(ghosted, dx_bulk);
  std::vector<double> change(unknowns.n_extra(), 0.);
  for (std::size_t k = 0; k < n_linear_extra_bulk; ++k)
    change[system.extra_bulk.rows[k]] +=
      system.extra_bulk.values[k] * ghosted(system.extra_bulk.columns[k]);
  for (std::size_t k = 0; k < linear_extra_extra.values.size(); ++k)
    change[linear_extra_extra.rows[k]] +=
      linear_extra_extra.values[k] * dx_extra[linear_extra_extra.columns[k]];
  unknowns.communication.sum(change);
  for (unsigned int i = 0; i < change.size(); ++i)
    linear_residual_extra[i] += step * change[i];
}


template <int dim>
std::vector<double> SystemAssembly<dim>::linear_change_by_extra(const std::vector<double> &dx_extra)
{
  if (!all_linear_extra_extra)
    all_linear_extra_extra = Triplets{all_gather(run.communicator, linear_extra_extra.rows),
                                      all_gather(run.communicator, linear_extra_extra.columns),
                                      all_gather(run.communicator, linear_extra_extra.values)};
  std::vector<double> change(dx_extra.size(), 0.);
  const Triplets &all = *all_linear_extra_extra;
  for (std::size_t k = 0; k < all.values.size(); ++k)
    change[all.rows[k]] += all.values[k] * dx_extra[all.columns[k]];
  return change;
}


template <int dim>
ResidualNorms SystemAssembly<dim>::residual_norms() const
{
  ResidualNorms norms;
  norms.momentum = system.residual_bulk.block(0).l2_norm();
  if (has_pores())
    norms.mass = system.residual_bulk.block(1).l1_norm();
  for (unsigned int i = 0; i < unknowns.n_extra(); ++i)
    if (i < unknowns.n_mechanical_extra())
      norms.extra += system.residual_extra[i] * system.residual_extra[i];
    else
      norms.fracture_fluid += std::abs(system.residual_extra[i]);
  norms.extra = std::sqrt(norms.extra);
  return norms;
}


template <int dim>
ResidualNorms SystemAssembly<dim>::rounding_errors(const BlockVector &values,
                                                   const StepContext &context,
                                                   const State &state)
{
  if (stamp_of_norms != changes.bulk_values)
  {
    matrix_norms.reinit(system.bulk.n_block_rows(), system.bulk.n_block_cols());
    for (unsigned int i = 0; i < matrix_norms.m(); ++i)
      for (unsigned int j = 0; j < matrix_norms.n(); ++j)
        matrix_norms(i, j) = system.bulk.block(i, j).l1_norm();
    stamp_of_norms = changes.bulk_values;
  }
  constexpr double epsilon = 1e-14;
  ResidualNorms norms;
  const auto in_fractures = network.rounding(context, state, unknowns.communication);
  norms.momentum = epsilon * matrix_norms(0, 0) * values.block(0).l2_norm() + in_fractures.force;
  if (has_pores())
    norms.mass = epsilon * (matrix_norms(1, 0) * values.block(0).l1_norm() +
                            matrix_norms(1, 1) * values.block(1).l1_norm());
  norms.fracture_fluid = in_fractures.fluid;
  return norms;
}


template <int dim>
typename SystemAssembly<dim>::PoreFluid SystemAssembly<dim>::pore_fluid(const StepContext &context,
                                                                        const State &state) const
{
  PoreFluid fluid;
  if (!has_pores())
    return fluid;
  const auto role = [this](const auto &cell) { return model.role(cell); };
  fluid.stored = bulk->stored_fluid(context, state, role);
  fluid.volume = bulk->pore_volume(state.current, role);
  for (const Segment<dim> &segment : model.segments())
  {
    if (segment.taken_from_pores == 0.)
      continue;
    const double taken = segment.taken_from_pores * segment.area;
    const double now = value(segment.opening, state.current);
    fluid.stored -= taken * (now - value(segment.opening, state.rate_reference));
    fluid.volume -= taken * now;
  }
  const auto at_boundary = bulk->outflow(context, state);
  fluid.outflow = at_boundary.out;
  fluid.through = unknowns.communication.sum(at_boundary.through);
  if (nonlinear)
  {
    fluid.stored += nonlinear->totals().content_change;
    fluid.volume += nonlinear->totals().content;
    fluid.outflow += nonlinear->totals().outflow;
  }
  fluid.stored = unknowns.communication.sum(fluid.stored);
  fluid.volume = unknowns.communication.sum(fluid.volume);
  fluid.outflow = unknowns.communication.sum(fluid.outflow);
  return fluid;
}


template class SystemAssembly<2>;
template class SystemAssembly<3>;
} // namespace stockwork
