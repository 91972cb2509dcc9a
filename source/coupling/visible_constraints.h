#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

namespace stockwork
{
/// Let a rank know which of the visible dofs are held, those too that are far from its cells. None
/// of these hangs, for bonds end in uniform cells. (deal.II does this from 9.5 on.) Collective.
/// @param constraints of the rank's relevant dofs, homogeneous
/// @param visible these dofs and what else the rank couples to
void make_visible(dealii::AffineConstraints<double> &constraints,
                  const dealii::IndexSet &owned,
                  const dealii::IndexSet &visible,
                  MPI_Comm communicator);
} // namespace stockwork
