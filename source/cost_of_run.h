#pragma once

#include "case.h"
#include "clock.h"
#include "cost_estimate.h"
#include "mesh_sizes.h"

#include <utility>

namespace stockwork
{
/// Before memory is taken for the unknowns of a mesh; what a fracture model takes in its part of it
/// is not known yet. @throws EntryError if they would not fit into the machines that the ranks run
/// on. Collective.
template <int dim>
void refuse_too_large(const RunContext &run,
                      const Case<dim> &the_case,
                      const dealii::parallel::distributed::Triangulation<dim> &triangulation);

/// When all is known: a warning if the estimate [bytes] is more than there is. It is right to
/// within a factor of three. @throws EntryError beyond that. Collective.
template <int dim>
void compare_with_memory(RunContext &run,
                         const Case<dim> &the_case,
                         const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                         double estimate);

/// Of what is left of a run. Collective.
template <int dim>
std::pair<CostEstimate, ExpectedSteps> expected_cost(const RunContext &run,
                                                     const Case<dim> &the_case,
                                                     const MeshSizes<dim> &mesh,
                                                     const CoupledSystem<dim> &system,
                                                     Stepper<dim> &stepper,
                                                     const Clock &clock);
} // namespace stockwork
