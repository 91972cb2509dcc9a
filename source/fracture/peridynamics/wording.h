#pragma once

#include <deal.II/base/point.h>

#include <sstream>
#include <string>

namespace stockwork::peridynamics
{
/// A number in a sentence.
inline std::string text(const double number)
{
  std::ostringstream stream;
  stream.precision(3);
  stream << number;
  return stream.str();
}

/// @param stress [Pa]
inline std::string megapascals(const double stress)
{
  return text(1e-6 * stress) + " MPa";
}

/// A place in a sentence, "(x y) m".
template <int dim>
std::string in_metres(const dealii::Point<dim> &place)
{
  std::ostringstream stream;
  stream.precision(4);
  stream << "(" << place << ") m";
  return stream.str();
}
} // namespace stockwork::peridynamics
