#include "mesh/box_list.h"

#include <regex>
#include <sstream>

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork
{
template <int dim>
dealii::Point<dim> parse_point(const std::string &text)
{
  static const std::regex in_parentheses(R"(\s*\((.*)\)\s*)");
  std::smatch match;
  const std::vector<std::string> parts =
    split_list(std::regex_match(text, match, in_parentheses) ? match[1].str() : text);
  if (parts.size() != dim)
    throw InputError("\"" + text + "\" has " + std::to_string(parts.size()) +
                     " coordinates instead of " + std::to_string(dim));
  dealii::Point<dim> point;
  for (unsigned int d = 0; d < dim; ++d)
    point[d] = parse_finite_quantity(parts[d], dimension::length);
  return point;
}

template <int dim>
std::vector<LabelledBox<dim>> parse_boxes(const std::string &text)
{
  static const std::regex pattern(R"(\s*(?:([^:(]*\S)\s*:)?\s*(\(.*\))\s*to\s*(\(.*\))\s*)");
  std::vector<LabelledBox<dim>> boxes;
  std::string::size_type begin = 0;
  while (begin < text.size())
  {
    const auto end = std::min(text.find(';', begin), text.size());
    const std::string item = text.substr(begin, end - begin);
    begin = end + 1;
    if (item.find_first_not_of(" \t") == std::string::npos)
      continue;
    std::smatch match;
    if (!std::regex_match(item, match, pattern))
      throw InputError("\"" + item + "\" is not understood");
    const auto lower = parse_point<dim>(match[2]), upper = parse_point<dim>(match[3]);
    for (unsigned int d = 0; d < dim; ++d)
      if (!(lower[d] < upper[d]))
        throw InputError("\"" + item +
                         "\": the first corner must lie below the second in every "
                         "coordinate");
    boxes.push_back({match[1], dealii::BoundingBox<dim>({lower, upper})});
  }
  return boxes;
}

template <int dim>
std::string to_string(const dealii::BoundingBox<dim> &box)
{
  const auto corner = [](const dealii::Point<dim> &point)
  {
    std::ostringstream text;
    text.precision(5);
    for (unsigned int d = 0; d < dim; ++d)
      text << (d > 0 ? ", " : "(") << point[d] << " m";
    return text.str() + ")";
  };
  const auto &[lower, upper] = box.get_boundary_points();
  return corner(lower) + " to " + corner(upper);
}

template std::string to_string(const dealii::BoundingBox<2> &);
template std::string to_string(const dealii::BoundingBox<3> &);
template dealii::Point<2> parse_point<2>(const std::string &);
template dealii::Point<3> parse_point<3>(const std::string &);
template std::vector<LabelledBox<2>> parse_boxes<2>(const std::string &);
template std::vector<LabelledBox<3>> parse_boxes<3>(const std::string &);
} // namespace stockwork
