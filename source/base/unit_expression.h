#pragma once

#include "stockwork/base/quantity.h"

#include <string>

namespace stockwork
{
/// A number with its dimension; has_unit tells "1" from "1 m/m".
struct UnitValue
{
  double value = 0;
  Dimension dimension;
  bool has_unit = false;
};

/// Evaluate an arithmetic expression of numbers and units with + - * / ^ ( ) and sqrt; a blank
/// multiplies. @throws InputError that says where it is not understood.
UnitValue evaluate_unit_expression(const std::string &text);

/// "pressure", or a product of base units when the dimension has no name.
std::string dimension_name(const Dimension &dimension);

/// The dimension of this name in namespace dimension, or null.
const Dimension *named_dimension(const std::string &name);
} // namespace stockwork
