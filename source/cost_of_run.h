#pragma once

#include "case.h"
#include "cost_estimate.h"
#include "mesh_sizes.h"
#include "run_checkpoint.h"
#include "stockwork/base/error.h"

#include <utility>

namespace stockwork
{
/// The error of a mesh that takes so much memory, of so much [bytes].
template <int dim>
EntryError too_large(const Case<dim> &the_case,
                     const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                     double needed,
                     double available);

/// Before memory is taken for the unknowns of a mesh, but for what a fracture model takes in its
/// part of it. @throws EntryError if they would not fit into
/// the machines that the ranks run on. Collective.
template <int dim>
void refuse_too_large(const RunContext &run,
                      const Case<dim> &the_case,
                      const dealii::parallel::distributed::Triangulation<dim> &triangulation);

/// Of what is left of a run. Collective.
template <int dim>
std::pair<CostEstimate, ExpectedSteps> expected_cost(const RunContext &run,
                                                     const Case<dim> &the_case,
                                                     const MeshSizes<dim> &mesh,
                                                     const CoupledSystem<dim> &system,
                                                     Stepper<dim> &stepper,
                                                     const Clock &clock);
} // namespace stockwork
