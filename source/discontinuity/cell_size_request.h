#pragma once

#include <deal.II/distributed/tria.h>

#include "discontinuity/discontinuity.h"

#include <vector>

namespace stockwork
{
/// Ask that the cells beside a crack, and some rings of them around the way ahead of each tip, be
/// split as often as those it cuts.
/// @param sizes by active cell index [m], lowered where need be
template <int dim>
void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                       const Discontinuity<dim> &discontinuity,
                       const unsigned int rings_ahead,
                       std::vector<float> &sizes);
} // namespace stockwork
