#pragma once

#include "case.h"

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace stockwork
{
/// A warning for each reason why entries that the deck gives are without effect in this case. Not
/// with 'Physics = auto', which says itself what it leaves out.
template <int dim>
std::vector<std::string> idle_entries(dealii::ParameterHandler &prm, const Case<dim> &the_case);
} // namespace stockwork
