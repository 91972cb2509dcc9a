#pragma once

#include <deal.II/base/patterns.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

namespace stockwork
{
/// The dimension of a physical quantity: exponents of metre, kilogram, second and radian. They
/// may be halves (toughness, Pa m^1/2). Two dimensions are equal when the exponents are; name,
/// unit and example only serve messages and the manual.
struct Dimension
{
  double length = 0;
  double mass = 0;
  double time = 0;
  double angle = 0;
  const char *name = "";
  const char *unit = "";
  const char *example = "";
};

constexpr bool operator==(const Dimension &a, const Dimension &b)
{
  return a.length == b.length && a.mass == b.mass && a.time == b.time && a.angle == b.angle;
}

constexpr bool operator!=(const Dimension &a, const Dimension &b)
{
  return !(a == b);
}

namespace dimension
{
// clang-format off
constexpr Dimension number              {0, 0, 0, 0, "number", "", "0.25"};
constexpr Dimension angle               {0, 0, 0, 1, "angle", "rad", "30 deg"};
constexpr Dimension length              {1, 0, 0, 0, "length", "m", "5 mm"};
constexpr Dimension area                {2, 0, 0, 0, "area", "m^2", "2 m^2"};
constexpr Dimension volume              {3, 0, 0, 0, "volume", "m^3", "3 m^3"};
constexpr Dimension inverse_length      {-1, 0, 0, 0, "inverse length", "1/m", "2 1/m"};
constexpr Dimension time                {0, 0, 1, 0, "time", "s", "2 h"};
constexpr Dimension frequency           {0, 0, -1, 0, "frequency or strain rate", "1/s", "3 1/s"};
constexpr Dimension velocity            {1, 0, -1, 0, "velocity", "m/s", "3 m/s"};
constexpr Dimension acceleration        {1, 0, -2, 0, "acceleration", "m/s^2", "9.81 m/s^2"};
constexpr Dimension mass                {0, 1, 0, 0, "mass", "kg", "2 kg"};
constexpr Dimension density             {-3, 1, 0, 0, "density", "kg/m^3", "2650 kg/m^3"};
constexpr Dimension force               {1, 1, -2, 0, "force", "N", "3 kN"};
constexpr Dimension pressure            {-1, 1, -2, 0, "pressure", "Pa", "3 MPa"};
constexpr Dimension stress              {-1, 1, -2, 0, "stress", "Pa", "3 MPa"};
constexpr Dimension pressure_gradient   {-2, 1, -2, 0, "pressure gradient", "Pa/m", "10 kPa/m"};
constexpr Dimension compressibility     {1, -1, 2, 0, "compressibility", "1/Pa", "0.5 1/GPa"};
constexpr Dimension viscosity           {-1, 1, -1, 0, "viscosity", "Pa s", "1 cP"};
constexpr Dimension permeability        {2, 0, 0, 0, "permeability", "m^2", "1 md"};
constexpr Dimension conductivity        {3, 0, 0, 0, "conductivity", "m^3", "500 md m"};
constexpr Dimension mobility            {3, -1, 1, 0, "mobility", "m^2/(Pa s)", "1 md/cP"};
constexpr Dimension diffusivity         {2, 0, -1, 0, "diffusivity", "m^2/s", "1e-6 m^2/s"};
constexpr Dimension rate_per_thickness  {2, 0, -1, 0, "rate per thickness", "m^2/s", "1e-4 m^2/s"};
constexpr Dimension rate                {3, 0, -1, 0, "rate", "m^3/s", "20 bbl/min"};
constexpr Dimension mass_rate           {0, 1, -1, 0, "mass rate", "kg/s", "2 kg/s"};
constexpr Dimension carter              {1, 0, -0.5, 0, "Carter coefficient", "m/s^0.5",
                                         "1e-5 m/s^0.5"};
constexpr Dimension leakoff_per_pressure{2, -1, 1, 0, "leak-off per pressure", "m/(Pa s)",
                                         "1e-13 m/(Pa s)"};
constexpr Dimension energy              {2, 1, -2, 0, "energy", "J", "3 kJ"};
constexpr Dimension energy_release_rate {0, 1, -2, 0, "energy release rate", "J/m^2", "120 J/m^2"};
constexpr Dimension force_per_length    {0, 1, -2, 0, "force per length", "N/m", "3 kN/m"};
constexpr Dimension toughness           {-0.5, 1, -2, 0, "toughness", "Pa m^0.5", "1 MPa m^0.5"};
// clang-format on
} // namespace dimension

/// The value of @p text in SI units.
///
/// The text is an arithmetic expression of numbers and units: "15.96 GPa", "1/3", "2*3e9",
/// "1 MPa*m^0.5", "1 MPa sqrt(m)", "12 bbl/min", "1 m + 20 cm". A product may be written by a
/// blank. A text without any unit is in SI. "inf" and "-inf" are numbers.
/// @throws InputError with what was given and what is expected.
double parse_quantity(const std::string &text, const Dimension &dimension);

/// The same where nothing is infinite. @throws InputError
double parse_finite_quantity(const std::string &text, const Dimension &dimension);

/// "1.596e+10 Pa": a value with its SI unit, for messages.
std::string to_string(double value, const Dimension &dimension);

/// An interval of allowed values in SI units.
struct Range
{
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false; ///< min itself is not allowed
  bool max_open = false; ///< max itself is not allowed

  static Range any()
  {
    return {};
  }
  /// Finite values only.
  static Range finite()
  {
    return {any().min, any().max, true, true};
  }
  /// x > 0, finite.
  static Range positive()
  {
    return {0, any().max, true, true};
  }
  /// x >= 0, finite.
  static Range non_negative()
  {
    return {0, any().max, false, true};
  }
  static Range closed(const double min, const double max)
  {
    return {min, max, false, false};
  }
  static Range open(const double min, const double max)
  {
    return {min, max, true, true};
  }

  bool contains(const double x) const
  {
    return (min_open ? x > min : x >= min) && (max_open ? x < max : x <= max);
  }

  /// "> 0", "0 to 1", "between 0 and 0.5 (both excluded)"; empty if everything is allowed.
  std::string text(const Dimension &dimension) const;
};

/// Pattern of a deck entry that holds one physical quantity:
/// `prm.declare_entry("Young modulus", "20 GPa", Quantity(dimension::stress, Range::positive()))`.
class Quantity : public dealii::Patterns::PatternBase
{
public:
  explicit Quantity(const Dimension &dimension, const Range &range = Range::finite());

  /// Instead of a value the entry may also hold this word, "auto" or nothing at all ("").
  Quantity(const Dimension &dimension, const Range &range, const std::string &word);

  bool match(const std::string &text) const override;

  /// Machine style can be read back by create(); Text and LaTeX are sentences.
  std::string description(const OutputStyle style = Machine) const override;

  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;

  /// The pattern whose machine description this is, or null if it is another kind of pattern.
  static std::unique_ptr<Quantity> create(const std::string &description);

  /// The value in SI. @throws InputError for nonsense, a wrong dimension or a value out of range.
  double parse(const std::string &text) const;

  /// True for the word that may stand instead of a value.
  bool is_word(const std::string &text) const
  {
    return word.has_value() && text == *word;
  }

private:
  Dimension dimension;
  Range range;
  std::optional<std::string> word;

  /// Owns the texts of a dimension that create() has read.
  std::shared_ptr<const std::pair<std::string, std::string>> texts;
};

/// A list of physical quantities of one kind, separated by ',' or ';'. An empty text is the
/// empty list.
class Quantities : public dealii::Patterns::PatternBase
{
public:
  explicit Quantities(const Dimension &dimension,
                      const Range &range = Range::finite(),
                      const unsigned int min_size = 0,
                      const unsigned int max_size = std::numeric_limits<unsigned int>::max());

  bool match(const std::string &text) const override;
  std::string description(const OutputStyle style = Machine) const override;
  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;

  static std::unique_ptr<Quantities> create(const std::string &description);

  std::vector<double> parse(const std::string &text) const;

private:
  Quantity element;
  unsigned int min_size, max_size;
};

/// The SI value of an entry of the current subsection. @throws InputError
double get_quantity(const dealii::ParameterHandler &prm,
                    const std::string &entry,
                    const Dimension &dimension);

/// The same for an entry that may be empty or "auto": nothing then. @throws InputError
std::optional<double> get_optional_quantity(const dealii::ParameterHandler &prm,
                                            const std::string &entry,
                                            const Dimension &dimension);

/// The SI values of a list entry of the current subsection. @throws InputError
std::vector<double> get_quantities(const dealii::ParameterHandler &prm,
                                   const std::string &entry,
                                   const Dimension &dimension);

/// The parts of a list separated by ',' or ';', trimmed; separators inside parentheses or braces
/// do not count. An empty text gives no parts.
std::vector<std::string> split_list(const std::string &text);
} // namespace stockwork
