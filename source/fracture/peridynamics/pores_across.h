#pragma once

#include "fracture/peridynamics/zone.h"
#include "stockwork/exchange/segment.h"

namespace stockwork::peridynamics
{
/// The pressure of the pores on the faces of a piece of a path. Elements spread the jump across it
/// over the cells that it crosses, and their pressure acts on that, not the one on the line. In two
/// dimensions.
template <int dim>
LinearFunctional pores_across(const Zone<dim> &zone, const Segment<dim> &piece);
} // namespace stockwork::peridynamics
