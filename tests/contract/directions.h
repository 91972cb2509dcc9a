#pragma once

#include "scenario.h"

#include <random>

namespace stockwork
{
/// A change of all unknowns, for tests on any number of ranks: the owned ones of the bulk, and the
/// extra ones, which every rank has.
struct Direction
{
  dealii::TrilinosWrappers::MPI::BlockVector bulk;
  std::vector<double> extra;
};


/// The matrix of a linear system times a direction; what constrained rows say is left out.
template <int dim>
Direction product(ScenarioIn<dim> &scenario, const LinearSystem &linear, const Direction &x)
{
  Direction result{scenario.system.owned_vector(), std::vector<double>(x.extra.size(), 0.)};
  linear.bulk.vmult(result.bulk, x.bulk);
  if (linear.rock_change != nullptr)
  {
    auto more = scenario.system.owned_vector();
    linear.rock_change->vmult(more, x.bulk);
    result.bulk += more;
  }
  for (std::size_t k = 0; k < linear.bulk_extra.values.size(); ++k)
    result.bulk(linear.bulk_extra.rows[k]) +=
      linear.bulk_extra.values[k] * x.extra[linear.bulk_extra.columns[k]];
  result.bulk.compress(dealii::VectorOperation::add);
  scenario.system.mesh_view().constraints.set_zero(result.bulk);

  auto ghosted = scenario.system.ghosted_vector();
  ghosted = x.bulk;
  const auto add = [&](const Triplets &triplets, const auto &value)
  {
    for (std::size_t k = 0; k < triplets.values.size(); ++k)
      result.extra[triplets.rows[k]] += triplets.values[k] * value(triplets.columns[k]);
  };
  add(linear.extra_bulk, [&](const auto j) { return double(ghosted(j)); });
  add(linear.extra_extra, [&](const auto j) { return x.extra[j]; });
  scenario.system.collectives().sum(result.extra);
  return result;
}


/// The residual at a state moved by a multiple of a direction; constrained rows left out.
template <int dim>
Direction residual(ScenarioIn<dim> &scenario,
                   const Unknowns &from,
                   const double step,
                   const Direction &direction)
{
  auto bulk = scenario.system.owned_vector(), change = scenario.system.owned_vector();
  bulk = from.bulk;
  change = direction.bulk;
  scenario.system.mesh_view().constraints.distribute(change);
  bulk.add(step, change);
  scenario.current.bulk = bulk;
  for (unsigned int i = 0; i < direction.extra.size(); ++i)
    scenario.current.extra[i] = from.extra[i] + step * direction.extra[i];
  const LinearSystem &linear = scenario.linearise();
  Direction result{scenario.system.owned_vector(), linear.residual_extra};
  result.bulk = linear.residual_bulk;
  scenario.system.mesh_view().constraints.set_zero(result.bulk);
  return result;
}


/// Greatest entries, by what they belong to: displacement, pore pressure, the model, the flow.
template <int dim>
std::array<double, 4> greatest(const ScenarioIn<dim> &scenario, const Direction &x)
{
  std::array<double, 4> result{};
  for (unsigned int b = 0; b < x.bulk.n_blocks(); ++b)
    result[b] = x.bulk.block(b).linfty_norm();
  const unsigned int n_model = scenario.the_case->model->extra_unknowns().size();
  for (unsigned int i = 0; i < x.extra.size(); ++i)
  {
    double &field = result[i < n_model ? 2 : 3];
    field = std::max(field, std::abs(x.extra[i]));
  }
  return result;
}
} // namespace stockwork
