#pragma once

#include <deal.II/dofs/dof_handler.h>

namespace stockwork
{
/// Number this rank's unknowns at vertices node by node along the first axis, rows of nodes by the
/// other axes; those elsewhere follow in the order that they had. For what sweeps the rows of a
/// lattice. (DoFRenumbering::downstream() knows one rank only.)
template <int dim>
void number_along_rows(dealii::DoFHandler<dim> &handler);
} // namespace stockwork
