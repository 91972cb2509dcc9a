#include "cost_of_run.h"

#include "stockwork/base/error.h"

#include "scene_estimates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace stockwork
{
using namespace dealii;

namespace
{
template <int dim>
double unknowns_per_cell(const Case<dim> &the_case)
{
  const auto &d = the_case.elements;
  return dim * std::pow(d.displacement_degree, dim) + d.has_pore_pressure;
}

/// The error of a mesh that takes so much memory, of so much [bytes].
template <int dim>
EntryError too_large(const Case<dim> &the_case,
                     const parallel::distributed::Triangulation<dim> &triangulation,
                     const double needed,
                     const double available)
{
  return EntryError(
    "Mesh/Maximum number of cells", std::to_string(the_case.geometry.maximum_number_of_cells()),
    "a mesh that fits into memory: this one has " +
      std::to_string(triangulation.n_global_active_cells()) + " cells and would take about " +
      in_bytes(needed) + ", there are " + in_bytes(available));
}
} // namespace


template <int dim>
void refuse_too_large(const RunContext &run,
                      const Case<dim> &the_case,
                      const parallel::distributed::Triangulation<dim> &triangulation)
{
  const double n_cells = triangulation.n_global_active_cells();
  const double n_unknowns = n_cells * unknowns_per_cell(the_case);
  CostlyPhysics physics = costly_physics(the_case);
  double needed = explicit_cost({}, n_unknowns, physics.memory_per_unknown, run.n_ranks).memory;
  if (!the_case.scheme.is_explicit())
  {
    physics.memory_per_unknown = 0.; // which a model takes in its part of the mesh alone
    needed = estimate_cost(dim, n_unknowns, physics, run.n_ranks).memory;
  }
  const double available = physical_memory(run.communicator);
  if (needed > available)
    throw too_large(the_case, triangulation, needed, available);
}


template <int dim>
void compare_with_memory(RunContext &run,
                         const Case<dim> &the_case,
                         const parallel::distributed::Triangulation<dim> &triangulation,
                         const double estimate)
{
  constexpr double within = 3.; // CostEstimate
  const double available = physical_memory(run.communicator);
  if (estimate > within * available)
    throw too_large(the_case, triangulation, estimate, available);
  if (estimate > available)
    run.warn("The run may not fit into memory: it would take roughly " + in_bytes(estimate) +
             ", and there are " + in_bytes(available) + ".");
}


template <int dim>
std::pair<CostEstimate, ExpectedSteps> expected_cost(const RunContext &run,
                                                     const Case<dim> &the_case,
                                                     const MeshSizes<dim> &mesh,
                                                     const CoupledSystem<dim> &system,
                                                     Stepper<dim> &stepper,
                                                     const Clock &clock)
{
  const CostlyPhysics physics = costly_physics(the_case);
  const double duration = the_case.control.end_time - clock.time;
  if (ExplicitMarch<dim> *const march = stepper.explicit_march())
    return {explicit_cost(
              {static_cast<double>(march->n_parts(std::min(clock.dt, duration))), march->n_terms()},
              system.n_unknowns(), physics.memory_per_unknown, run.n_ranks),
            {std::ceil(duration / clock.dt), the_case.control.growth > 1.}};
  const bool cracked = is_cracked(the_case);
  const double at_end =
    unknowns_at_end(the_case, mesh, system.n_unknowns(), the_case.network.segments().size());
  const double cells =
    !cracked   ? 0.
    : dim == 3 ? std::numeric_limits<double>::quiet_NaN() // not all of a front comes on at once
               : (half_length_at_end(the_case) - half_length_at_start(the_case)) / mesh.smallest;
  return {estimate_cost(dim, at_end, physics, run.n_ranks),
          expected_steps(the_case.control, duration, clock.dt, cracked, cells)};
}


template void compare_with_memory<2>(RunContext &,
                                     const Case<2> &,
                                     const parallel::distributed::Triangulation<2> &,
                                     double);
template void refuse_too_large<2>(const RunContext &,
                                  const Case<2> &,
                                  const parallel::distributed::Triangulation<2> &);
template std::pair<CostEstimate, ExpectedSteps> expected_cost<2>(const RunContext &,
                                                                 const Case<2> &,
                                                                 const MeshSizes<2> &,
                                                                 const CoupledSystem<2> &,
                                                                 Stepper<2> &,
                                                                 const Clock &);
template void compare_with_memory<3>(RunContext &,
                                     const Case<3> &,
                                     const parallel::distributed::Triangulation<3> &,
                                     double);
template void refuse_too_large<3>(const RunContext &,
                                  const Case<3> &,
                                  const parallel::distributed::Triangulation<3> &);
template std::pair<CostEstimate, ExpectedSteps> expected_cost<3>(const RunContext &,
                                                                 const Case<3> &,
                                                                 const MeshSizes<3> &,
                                                                 const CoupledSystem<3> &,
                                                                 Stepper<3> &,
                                                                 const Clock &);
} // namespace stockwork
