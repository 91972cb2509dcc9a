#pragma once

#include <deal.II/base/numbers.h>

namespace stockwork::analytical
{
constexpr double pi = dealii::numbers::PI;
} // namespace stockwork::analytical
