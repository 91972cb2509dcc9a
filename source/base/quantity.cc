#include "stockwork/base/quantity.h"

#include "base/unit_expression.h"
#include "stockwork/base/error.h"

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <regex>
#include <sstream>

namespace stockwork
{
namespace
{
std::string with_article(const std::string &noun)
{
  return (std::string("aeiou").find(noun[0]) == std::string::npos ? "a " : "an ") + noun;
}

std::string what_is_expected(const Dimension &expected)
{
  std::string text = with_article(expected.name) + " is expected";
  if (expected.example[0] != '\0')
    text += ", e.g. \"" + std::string(expected.example) + "\"";
  else if (expected.unit[0] != '\0')
    text += " (" + std::string(expected.unit) + ")";
  return text;
}

/// Shortest decimal text that is read back as the same number, at least for numbers that people
/// write into patterns.
std::string number_text(const double x)
{
  std::ostringstream out;
  out.precision(15);
  out << x;
  return out.str();
}
} // namespace

double parse_quantity(const std::string &text, const Dimension &expected)
{
  UnitValue result;
  try
  {
    result = evaluate_unit_expression(text);
  }
  catch (const InputError &error)
  {
    throw InputError(std::string(error.what()) + "; " + what_is_expected(expected));
  }

  if (std::isnan(result.value))
    throw InputError("\"" + text + "\" is not a number; " + what_is_expected(expected));
  if (result.has_unit && result.dimension != expected)
    throw InputError("\"" + text + "\" is " + with_article(dimension_name(result.dimension)) +
                     "; " + what_is_expected(expected));
  return result.value;
}

double parse_finite_quantity(const std::string &text, const Dimension &expected)
{
  const double value = parse_quantity(text, expected);
  if (!std::isfinite(value))
    throw InputError("\"" + text + "\" is not finite; " + what_is_expected(expected));
  return value;
}

std::string to_string(const double value, const Dimension &dimension)
{
  std::ostringstream out;
  out.precision(6);
  out << value;
  if (dimension.unit[0] != '\0')
    out << " " << dimension.unit;
  return out.str();
}

std::string Range::text(const Dimension &dimension) const
{
  const bool has_min = std::isfinite(min), has_max = std::isfinite(max);
  if (has_min && has_max)
  {
    std::string ends;
    if (min_open && max_open)
      ends = ", both excluded";
    else if (min_open || max_open)
      ends = ", " + to_string(min_open ? min : max, dimension) + " excluded";
    return "from " + to_string(min, dimension) + " to " + to_string(max, dimension) + ends;
  }
  if (has_min)
    return (min_open ? "> " : ">= ") + to_string(min, dimension);
  if (has_max)
    return (max_open ? "< " : "<= ") + to_string(max, dimension);
  return "";
}

Quantity::Quantity(const Dimension &dimension, const Range &range)
  : dimension(dimension)
  , range(range)
{
}

Quantity::Quantity(const Dimension &dimension, const Range &range, const std::string &word)
  : dimension(dimension)
  , range(range)
  , word(word)
{
}

double Quantity::parse(const std::string &text) const
{
  const double value = parse_quantity(text, dimension);
  if (!range.contains(value))
    throw InputError("\"" + text + "\" is out of range; allowed is " +
                     (std::isinf(value) && range.text(dimension).empty() ? "a finite value"
                                                                         : range.text(dimension)));
  return value;
}

bool Quantity::match(const std::string &text) const
{
  if (is_word(text))
    return true;
  try
  {
    parse(text);
    return true;
  }
  catch (const InputError &)
  {
    return false;
  }
}

std::string Quantity::description(const OutputStyle style) const
{
  if (style == Machine)
  {
    std::string text = "[Quantity " + std::string(dimension.name) + " in " +
                       (range.min_open ? "(" : "[") + number_text(range.min) + ", " +
                       number_text(range.max) + (range.max_open ? ")" : "]");
    if (dimension.unit[0] != '\0')
      text += std::string(" ") + dimension.unit;
    if (word)
      text += " or \"" + *word + "\"";
    return text + "]";
  }
  std::string text = with_article(dimension.name);
  const std::string ends = range.text(dimension);
  if (!ends.empty())
    text += " " + ends;
  else if (dimension.unit[0] != '\0')
    text += std::string(" (") + dimension.unit + ")";
  if (word)
    text += word->empty() ? ", or empty" : ", or '" + *word + "'";
  return text;
}

std::unique_ptr<dealii::Patterns::PatternBase> Quantity::clone() const
{
  return std::make_unique<Quantity>(*this);
}

std::unique_ptr<Quantity> Quantity::create(const std::string &description)
{
  static const std::regex form("\\[Quantity (.*) in ([(\\[])([^,]*), ([^)\\]]*)([)\\]])(?: (?!or "
                               "\")(.+?))?(?: or \"(.*)\")?\\]");
  std::smatch part;
  if (!std::regex_match(description, part, form))
    return nullptr;

  Dimension dimension;
  const auto texts = std::make_shared<const std::pair<std::string, std::string>>(part[1], part[6]);
  if (const Dimension *known = named_dimension(texts->first))
    dimension = *known;
  else
  {
    if (!texts->second.empty())
      dimension = evaluate_unit_expression(texts->second).dimension;
    dimension.name = texts->first.c_str();
    dimension.unit = texts->second.c_str();
  }
  const auto bound = [](const std::string &text) { return evaluate_unit_expression(text).value; };
  auto result = std::make_unique<Quantity>(
    dimension, Range{bound(part[3]), bound(part[4]), part[2] == "(", part[5] == ")"});
  if (part[7].matched)
    result->word = part[7];
  result->texts = texts;
  return result;
}

Quantities::Quantities(const Dimension &dimension,
                       const Range &range,
                       const unsigned int min_size,
                       const unsigned int max_size)
  : element(dimension, range)
  , min_size(min_size)
  , max_size(max_size)
{
}

std::vector<double> Quantities::parse(const std::string &text) const
{
  std::vector<double> values;
  for (const std::string &part : split_list(text))
    values.push_back(element.parse(part));
  if (values.size() < min_size || values.size() > max_size)
    throw InputError("\"" + text + "\" has " + std::to_string(values.size()) +
                     " values; allowed is " + description(Text));
  return values;
}

bool Quantities::match(const std::string &text) const
{
  try
  {
    parse(text);
    return true;
  }
  catch (const InputError &)
  {
    return false;
  }
}

std::string Quantities::description(const OutputStyle style) const
{
  const bool unlimited = max_size == std::numeric_limits<unsigned int>::max();
  const std::string count = min_size == max_size ? std::to_string(min_size)
                            : unlimited
                              ? std::to_string(min_size) + " or more"
                              : std::to_string(min_size) + " to " + std::to_string(max_size);
  if (style == Machine)
    return "[Quantities " + count + " of " + element.description(Machine) + "]";
  return "a list separated by commas" + (min_size == 0 && unlimited ? "" : " of " + count) +
         ", each " + element.description(style);
}

std::unique_ptr<dealii::Patterns::PatternBase> Quantities::clone() const
{
  return std::make_unique<Quantities>(*this);
}

std::unique_ptr<Quantities> Quantities::create(const std::string &description)
{
  const std::string begin = "[Quantities ";
  const auto of = description.find(" of ");
  if (description.compare(0, begin.size(), begin) != 0 || of == std::string::npos)
    return nullptr;
  const auto element = Quantity::create(description.substr(of + 4, description.size() - of - 5));
  if (!element)
    return nullptr;

  Quantities result(dimension::number);
  std::istringstream count(description.substr(begin.size(), of - begin.size()));
  std::string word;
  result.element = *element;
  count >> result.min_size;
  if (!(count >> word))
    result.max_size = result.min_size;
  else if (word == "to")
    count >> result.max_size;
  return std::make_unique<Quantities>(result);
}

double get_quantity(const dealii::ParameterHandler &prm,
                    const std::string &entry,
                    const Dimension &dimension)
{
  try
  {
    return parse_quantity(prm.get(entry), dimension);
  }
  catch (const InputError &error)
  {
    throw InputError("'" + entry + "': " + error.what());
  }
}

std::optional<double> get_optional_quantity(const dealii::ParameterHandler &prm,
                                            const std::string &entry,
                                            const Dimension &dimension)
{
  const std::string text = prm.get(entry);
  if (text.empty() || text == "auto")
    return std::nullopt;
  return get_quantity(prm, entry, dimension);
}

std::vector<double> get_quantities(const dealii::ParameterHandler &prm,
                                   const std::string &entry,
                                   const Dimension &dimension)
{
  try
  {
    return Quantities(dimension, Range::any()).parse(prm.get(entry));
  }
  catch (const InputError &error)
  {
    throw InputError("'" + entry + "': " + error.what());
  }
}

std::vector<std::string> split_list(const std::string &text)
{
  std::vector<std::string> parts;
  std::string part;
  const auto finish = [&]()
  {
    const auto first = part.find_first_not_of(" \t");
    const auto last = part.find_last_not_of(" \t");
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
    part.clear();
  };
  int depth = 0;
  for (const char c : text)
    if ((c == ',' || c == ';') && depth == 0)
      finish();
    else
    {
      depth += (c == '(' || c == '{') - (c == ')' || c == '}');
      part += c;
    }
  finish();
  if (parts.size() == 1 && parts[0].empty())
    parts.clear();
  return parts;
}
} // namespace stockwork
