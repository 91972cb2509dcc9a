#include "base/unit_expression.h"

#include "stockwork/base/error.h"
#include "stockwork/base/nearest.h"

#include <cctype>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace stockwork
{
namespace
{
struct Unit
{
  double factor;
  Dimension dimension;
};

using UnitTable = std::map<std::string, Unit>;

constexpr double minute = 60, hour = 3600, day = 24 * hour, year = 365.25 * day;
constexpr double foot = 0.3048, inch = 0.0254;
constexpr double pound = 0.45359237, pound_force = pound * 9.80665;
constexpr double darcy = 9.869233e-13;
constexpr double barrel = 0.158987294928; // 42 US gallons
constexpr double degree = 3.14159265358979323846 / 180;

/// Units that take the prefixes below.
const UnitTable &prefixed_units()
{
  static const UnitTable table = {
    {"m", {1, dimension::length}},      {"g", {1e-3, dimension::mass}},
    {"s", {1, dimension::time}},        {"Hz", {1, dimension::frequency}},
    {"N", {1, dimension::force}},       {"Pa", {1, dimension::pressure}},
    {"J", {1, dimension::energy}},      {"bar", {1e5, dimension::pressure}},
    {"P", {0.1, dimension::viscosity}}, {"D", {darcy, dimension::permeability}},
    {"l", {1e-3, dimension::volume}},   {"L", {1e-3, dimension::volume}},
    {"rad", {1, dimension::angle}},     {"psi", {pound_force / inch / inch, dimension::pressure}}};
  return table;
}

const UnitTable &plain_units()
{
  static const UnitTable table = {{"%", {0.01, dimension::number}},
                                  {"deg", {degree, dimension::angle}},
                                  {"min", {minute, dimension::time}},
                                  {"h", {hour, dimension::time}},
                                  {"hour", {hour, dimension::time}},
                                  {"hours", {hour, dimension::time}},
                                  {"d", {day, dimension::time}},
                                  {"day", {day, dimension::time}},
                                  {"days", {day, dimension::time}},
                                  {"year", {year, dimension::time}},
                                  {"years", {year, dimension::time}},
                                  {"ft", {foot, dimension::length}},
                                  {"in", {inch, dimension::length}},
                                  {"t", {1000, dimension::mass}},
                                  {"lb", {pound, dimension::mass}},
                                  {"lbf", {pound_force, dimension::force}},
                                  {"atm", {101325, dimension::pressure}},
                                  {"md", {1e-3 * darcy, dimension::permeability}},
                                  {"darcy", {darcy, dimension::permeability}},
                                  {"millidarcy", {1e-3 * darcy, dimension::permeability}},
                                  {"cp", {1e-3, dimension::viscosity}},
                                  {"bbl", {barrel, dimension::volume}},
                                  {"gal", {barrel / 42, dimension::volume}}};
  return table;
}

/// The prefixes that rocks and fluids need; without "d", "h" and "da", which nobody writes here.
const std::map<std::string, double> &prefixes()
{
  static const std::map<std::string, double> table = {
    {"n", 1e-9}, {"u", 1e-6}, {"m", 1e-3}, {"c", 1e-2}, {"k", 1e3}, {"M", 1e6}, {"G", 1e9}};
  return table;
}

std::vector<std::string> all_unit_names()
{
  std::vector<std::string> names;
  for (const auto &[unit, value] : plain_units())
    names.push_back(unit);
  for (const auto &[unit, value] : prefixed_units())
  {
    names.push_back(unit);
    for (const auto &[prefix, factor] : prefixes())
      names.push_back(prefix + unit);
  }
  return names;
}

Unit find_unit(const std::string &name)
{
  if (const auto plain = plain_units().find(name); plain != plain_units().end())
    return plain->second;
  if (const auto unit = prefixed_units().find(name); unit != prefixed_units().end())
    return unit->second;
  const auto prefix = prefixes().find(name.substr(0, 1));
  const auto unit = prefixed_units().find(name.substr(1));
  if (prefix != prefixes().end() && unit != prefixed_units().end())
    return {prefix->second * unit->second.factor, unit->second.dimension};

  const std::string hint = did_you_mean(name, all_unit_names());
  throw InputError("\"" + name + "\" is not a unit" + (hint.empty() ? "" : " (" + hint + ")"));
}

Dimension scaled_sum(const Dimension &a, const double s, const Dimension &b)
{
  return {a.length + s * b.length, a.mass + s * b.mass, a.time + s * b.time, a.angle + s * b.angle};
}

/// Symbols that people type, in ASCII.
std::string plain_ascii(std::string text)
{
  static const std::vector<std::pair<std::string, std::string>> symbols = {
    {"\u00b5", "u"},  {"\u03bc", "u"},  {"\u00b7", "*"}, {"\u00b0", " deg"},
    {"\u00b2", "^2"}, {"\u00b3", "^3"}, {"\u00d7", "*"}, {"\u2212", "-"}};
  for (const auto &[symbol, ascii] : symbols)
    for (auto at = text.find(symbol); at != std::string::npos; at = text.find(symbol, at))
      text.replace(at, symbol.size(), ascii);
  return text;
}

/// Recursive descent: sum of products of powers of numbers, units and parentheses.
class UnitExpression
{
public:
  explicit UnitExpression(const std::string &given)
    : given(given)
    , text(plain_ascii(given))
  {
  }

  UnitValue evaluate()
  {
    if (peek() == '\0')
      throw InputError("the value is empty");
    const UnitValue result = sum();
    if (peek() != '\0')
      fail("nothing is expected from \"" + text.substr(position) + "\" on");
    return result;
  }

private:
  [[noreturn]] void fail(const std::string &reason) const
  {
    throw InputError("\"" + (given.size() > 200 ? given.substr(0, 200) + "..." : given) +
                     "\" is not understood: " + reason);
  }

  /// The next character that is not blank.
  char peek()
  {
    while (position < text.size() && std::isspace(static_cast<unsigned char>(text[position])))
      ++position;
    return position < text.size() ? text[position] : '\0';
  }

  bool accept(const char c)
  {
    if (peek() != c)
      return false;
    ++position;
    return true;
  }

  bool at_number()
  {
    return std::isdigit(static_cast<unsigned char>(peek())) || peek() == '.';
  }

  bool at_word()
  {
    return std::isalpha(static_cast<unsigned char>(peek())) || peek() == '%';
  }

  /// "0.5 1/GPa": a reciprocal unit after a number.
  bool at_reciprocal()
  {
    if (peek() != '1')
      return false;
    const auto next = text.find_first_not_of(" \t", position + 1);
    return next != std::string::npos && text[next] == '/';
  }

  UnitValue sum()
  {
    UnitValue result = product();
    while (peek() == '+' || peek() == '-')
    {
      const double sign = accept('+') ? 1 : (accept('-'), -1);
      const UnitValue term = product();
      if (term.has_unit != result.has_unit || term.dimension != result.dimension)
        fail("a " + dimension_name(result.dimension) + " and a " + dimension_name(term.dimension) +
             " cannot be added");
      result.value += sign * term.value;
    }
    return result;
  }

  UnitValue product()
  {
    UnitValue result = power();
    bool divided_by_units = false;
    while (true)
    {
      double exponent = 1;
      if (accept('*'))
        divided_by_units = false;
      else if (accept('/'))
        exponent = -1;
      else if (at_word() || peek() == '(' || at_reciprocal())
      {
        // Some read "m/Pa s" as m/(Pa s), some as (m/Pa) s.
        if (divided_by_units)
          fail("a unit after a quotient needs parentheses or a '*', as in \"m/(Pa s)\"");
      }
      else if (at_number())
        fail("an operator is missing before \"" + text.substr(position) + "\"");
      else
        return result;

      const UnitValue factor = power();
      if (exponent < 0)
        divided_by_units = factor.has_unit;
      result.value = exponent < 0 ? result.value / factor.value : result.value * factor.value;
      result.dimension = scaled_sum(result.dimension, exponent, factor.dimension);
      result.has_unit = result.has_unit || factor.has_unit;
    }
  }

  UnitValue power()
  {
    // Each level of parentheses, signs and powers passes here; none needs many.
    if (++depth > 200)
      fail("it is nested too deeply");
    const UnitValue result = signed_power();
    --depth;
    return result;
  }

  UnitValue signed_power()
  {
    if (accept('-'))
    {
      UnitValue result = power();
      result.value = -result.value;
      return result;
    }
    if (accept('+'))
      return power();

    const UnitValue base = primary();
    if (!accept('^'))
      return base;
    const UnitValue exponent = power();
    if (exponent.has_unit)
      fail("an exponent has no unit");
    return raise(base, exponent.value);
  }

  static UnitValue raise(const UnitValue &base, const double exponent)
  {
    return {std::pow(base.value, exponent), scaled_sum(dimension::number, exponent, base.dimension),
            base.has_unit};
  }

  UnitValue primary()
  {
    if (accept('('))
    {
      const UnitValue result = sum();
      if (!accept(')'))
        fail("a ')' is missing");
      return result;
    }
    if (at_number())
      return {number(), dimension::number, false};
    if (!at_word())
      fail(peek() == '\0' ? "it ends too early"
                          : "a number or a unit is expected at \"" + text.substr(position) + "\"");

    const std::string name = word();
    if (name == "sqrt")
    {
      if (peek() != '(')
        fail("sqrt needs parentheses");
      return raise(primary(), 0.5);
    }
    if (name == "inf" || name == "infinity")
      return {std::numeric_limits<double>::infinity(), dimension::number, false};
    if (name == "nan")
      fail("nan is not a value");

    Unit unit;
    try
    {
      unit = find_unit(name);
    }
    catch (const InputError &error)
    {
      fail(error.what());
    }
    UnitValue result{unit.factor, unit.dimension, true};
    // "m2", "ft3": a digit right after the unit is its power.
    if (position < text.size() && std::isdigit(static_cast<unsigned char>(text[position])))
      result = raise(result, number());
    return result;
  }

  std::string word()
  {
    if (accept('%'))
      return "%";
    const std::size_t begin = position;
    while (position < text.size() && std::isalpha(static_cast<unsigned char>(text[position])))
      ++position;
    return text.substr(begin, position - begin);
  }

  double number()
  {
    const std::size_t begin = position;
    const auto digits = [&]()
    {
      while (position < text.size() && std::isdigit(static_cast<unsigned char>(text[position])))
        ++position;
    };
    digits();
    if (position < text.size() && text[position] == '.')
    {
      ++position;
      digits();
    }
    if (position < text.size() && (text[position] == 'e' || text[position] == 'E'))
    {
      // Only with digits is it an exponent; otherwise the letter begins a unit.
      const std::size_t before = position++;
      if (position < text.size() && (text[position] == '+' || text[position] == '-'))
        ++position;
      const std::size_t first_digit = position;
      digits();
      if (position == first_digit)
        position = before;
    }
    const std::string literal = text.substr(begin, position - begin);
    try
    {
      return std::stod(literal);
    }
    catch (const std::exception &)
    {
      fail("\"" + literal + "\" is not a number");
    }
  }

  const std::string given, text;
  std::size_t position = 0;
  unsigned int depth = 0;
};

const std::vector<Dimension> &named_dimensions()
{
  using namespace dimension;
  static const std::vector<Dimension> list = {number,
                                              dimension::angle,
                                              dimension::length,
                                              area,
                                              volume,
                                              inverse_length,
                                              dimension::time,
                                              frequency,
                                              velocity,
                                              acceleration,
                                              dimension::mass,
                                              density,
                                              force,
                                              pressure,
                                              stress,
                                              pressure_gradient,
                                              compressibility,
                                              viscosity,
                                              permeability,
                                              mobility,
                                              diffusivity,
                                              rate_per_thickness,
                                              rate,
                                              mass_rate,
                                              carter,
                                              leakoff_per_pressure,
                                              energy,
                                              energy_release_rate,
                                              force_per_length,
                                              toughness};
  return list;
}
} // namespace

UnitValue evaluate_unit_expression(const std::string &text)
{
  return UnitExpression(text).evaluate();
}

std::string dimension_name(const Dimension &dimension)
{
  for (const Dimension &named : named_dimensions())
    if (named == dimension)
      return named.name;
  std::ostringstream out;
  out << "quantity in";
  const auto base = [&](const char *unit, const double exponent)
  {
    if (exponent == 1)
      out << " " << unit;
    else if (exponent != 0)
      out << " " << unit << "^" << exponent;
  };
  base("m", dimension.length);
  base("kg", dimension.mass);
  base("s", dimension.time);
  base("rad", dimension.angle);
  return out.str();
}

const Dimension *named_dimension(const std::string &name)
{
  for (const Dimension &dimension : named_dimensions())
    if (dimension.name == name)
      return &dimension;
  return nullptr;
}
} // namespace stockwork
