#pragma once

#include "stockwork/base/run_context.h"

#include "case.h"
#include "mesh_sizes.h"

namespace stockwork
{
/// Print the numbers with what is left out and why that is safe. Where a number says that the
/// answer cannot be trusted, that is a warning of the run.
/// @param n_unknowns of the whole system
template <int dim>
void print_scene_audit(RunContext &run,
                       const Case<dim> &the_case,
                       const MeshSizes<dim> &mesh,
                       double n_unknowns);
} // namespace stockwork
