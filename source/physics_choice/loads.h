#pragma once

#include "case.h"

#include <vector>

namespace stockwork
{
/// All loads on the boundary and the greatest displacement given there, at a time; of what varies
/// along the boundary, at the corners and the middle of the domain.
template <int dim>
std::vector<double> loads_at(const Case<dim> &the_case, double time);

/// By how much loads change at most within a time, over their greatest value. Before the run there
/// are none.
template <int dim>
double greatest_change(const Case<dim> &the_case, double within);
} // namespace stockwork
