// Quantities with units. Conversion factors are the definitions: NIST SP 811 (2008), appendix B;
// 1 darcy = 9.869233e-13 m^2.
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <deal.II/base/parameter_handler.h>

#include <doctest/doctest.h>

#include <cmath>

namespace stockwork::quantity_test
{
namespace dim = stockwork::dimension;

namespace
{
std::string message(const std::string &text, const Dimension &dimension)
{
  try
  {
    parse_quantity(text, dimension);
    return "";
  }
  catch (const InputError &error)
  {
    return error.what();
  }
}

void check(const std::string &text, const Dimension &dimension, const double expected)
{
  CAPTURE(text);
  CHECK(parse_quantity(text, dimension) == doctest::Approx(expected).epsilon(1e-13));
}
} // namespace

TEST_CASE("units people write")
{
  check("15.96 GPa", dim::stress, 15.96e9);
  check("15.96GPa", dim::stress, 15.96e9);
  check("1 md", dim::permeability, 9.869233e-16);
  check("1 mD", dim::permeability, 9.869233e-16);
  check("2 darcy", dim::permeability, 2 * 9.869233e-13);
  check("1 cP", dim::viscosity, 1e-3);
  check("1 mPa s", dim::viscosity, 1e-3);
  check("1 MPa*m^0.5", dim::toughness, 1e6);
  check("1 MPa m^(1/2)", dim::toughness, 1e6);
  check("1.5 MPa sqrt(m)", dim::toughness, 1.5e6);
  check("1e-4 m^2/s", dim::rate_per_thickness, 1e-4);
  check("1 m2/s", dim::rate_per_thickness, 1e-4 * 1e4);
  check("20 bbl/min", dim::rate, 20 * 42 * 231 * std::pow(0.0254, 3) / 60);
  check("30 deg", dim::angle, std::acos(-1.) / 6);
  check("30 °", dim::angle, std::acos(-1.) / 6);
  check("2 h", dim::time, 7200);
  check("3 min", dim::time, 180);
  check("1 day", dim::time, 86400);
  check("1 year", dim::time, 31557600);
  check("5 mm", dim::length, 5e-3);
  check("5 µm", dim::length, 5e-6);
  check("10 ft", dim::length, 3.048);
  check("1 psi", dim::pressure, 6894.757293168361);
  check("3 bar", dim::pressure, 3e5);
  check("120 J/m^2", dim::energy_release_rate, 120);
  check("120 N/m", dim::energy_release_rate, 120);
  check("0.12 kPa m", dim::energy_release_rate, 120);
  check("2.65 g/cm^3", dim::density, 2650);
  check("10 kPa/m", dim::pressure_gradient, 1e4);
  check("1e-5 m/s^0.5", dim::carter, 1e-5);
  check("1e-3 ft/min^0.5", dim::carter, 1e-3 * 0.3048 / std::sqrt(60.));
  check("1e-13 m/(Pa s)", dim::leakoff_per_pressure, 1e-13);
  check("1e-13 m/Pa/s", dim::leakoff_per_pressure, 1e-13);
  check("0.5 1/GPa", dim::compressibility, 5e-10);
  check("0.5/GPa", dim::compressibility, 5e-10);
  check("12 %", dim::number, 0.12);
}

TEST_CASE("a bare number is SI, and arithmetic is allowed")
{
  check("3e9", dim::stress, 3e9);
  check("1/3", dim::number, 1. / 3);
  check("2*3e9", dim::stress, 6e9);
  check("-1.5e-3", dim::length, -1.5e-3);
  check("-(2 + 3) MPa", dim::stress, -5e6);
  check("1/3 MPa", dim::stress, 1e6 / 3);
  check("1 m + 20 cm", dim::length, 1.2);
  check("2^3", dim::number, 8);
  check(".5", dim::number, 0.5);
  CHECK(parse_quantity("inf", dim::length) == std::numeric_limits<double>::infinity());
  CHECK(parse_quantity("-inf", dim::length) == -std::numeric_limits<double>::infinity());
}

TEST_CASE("a wrong dimension is refused, and the message says what is expected")
{
  CHECK(message("3 m", dim::pressure) ==
        "\"3 m\" is a length; a pressure is expected, e.g. \"3 MPa\"");
  CHECK(message("3 MPa", dim::angle) ==
        "\"3 MPa\" is a pressure; an angle is expected, e.g. \"30 deg\"");
  CHECK(message("3 deg", dim::number).find("is an angle; a number is expected") !=
        std::string::npos);
  CHECK(message("3 m^7", dim::pressure).find("quantity in m^7") != std::string::npos);
  CHECK(message("5 %", dim::length).find("is a number; a length") != std::string::npos);
  CHECK(message("1 m + 1 s", dim::length).find("cannot be added") != std::string::npos);
}

TEST_CASE("nonsense is refused")
{
  CHECK(message("3 Gpa", dim::pressure).find("did you mean 'GPa'") != std::string::npos);
  CHECK(message("3 apples", dim::pressure).find("\"apples\" is not a unit") != std::string::npos);
  CHECK(message("", dim::pressure).find("empty; a pressure is expected") != std::string::npos);
  CHECK(message("1 m/Pa s", dim::leakoff_per_pressure).find("m/(Pa s)") != std::string::npos);
  for (const char *text :
       {"3 4", "3,4", "3 *", "(3", "3)", "1e", "sqrt 4", "m^", "nan", "0/0", "$"})
  {
    CAPTURE(text);
    CHECK_FALSE(message(text, dim::length).empty());
  }
}

TEST_CASE("the pattern checks range and dimension")
{
  const Quantity ratio(dim::number, {-1, 0.5, true, false});
  CHECK(ratio.match("0.5"));
  CHECK(ratio.match("1/4"));
  CHECK_FALSE(ratio.match("-1"));
  CHECK_FALSE(ratio.match("0.51"));
  CHECK(ratio.description(Quantity::Text) == "a number from -1 to 0.5, -1 excluded");

  const Quantity modulus(dim::stress, Range::positive());
  CHECK(modulus.match("1 kPa"));
  CHECK_FALSE(modulus.match("0"));
  CHECK_FALSE(modulus.match("inf"));
  CHECK_FALSE(modulus.match("1 m"));
  CHECK(modulus.description(Quantity::Text) == "a stress > 0 Pa");
  CHECK_THROWS_WITH_AS(modulus.parse("-3 MPa"), "\"-3 MPa\" is out of range; allowed is > 0 Pa",
                       InputError);

  CHECK_FALSE(Quantity(dim::time).match("inf"));
  CHECK(Quantity(dim::time, {0, std::numeric_limits<double>::infinity()}).match("inf"));
}

TEST_CASE("patterns can be read back from their machine style description")
{
  const Quantity modulus(dim::stress, {1e3, 3e11, true, false});
  const auto copy = Quantity::create(modulus.description());
  REQUIRE(copy);
  CHECK(copy->description() == modulus.description());
  CHECK(copy->match("300 GPa"));
  CHECK_FALSE(copy->match("1 kPa"));
  CHECK(Quantity::create("[Double 0...1 (inclusive)]") == nullptr);

  const Quantities range(dim::length, Range::positive(), 2, 3);
  const auto list = Quantities::create(range.description());
  REQUIRE(list);
  CHECK(list->description() == range.description());
  CHECK(list->match("1 m, 2 m"));
  CHECK_FALSE(list->match("1 m"));
}

TEST_CASE("a word instead of a value")
{
  const Quantity modulus(dim::stress, Range::positive(), "auto");
  CHECK(modulus.match("auto"));
  CHECK(modulus.match("3 GPa"));
  CHECK_FALSE(modulus.match("automatic"));
  CHECK_FALSE(modulus.match(""));
  CHECK(modulus.description(Quantity::Text) == "a stress > 0 Pa, or 'auto'");
  const auto copy = Quantity::create(modulus.description());
  REQUIRE(copy);
  CHECK(copy->match("auto"));
  CHECK(copy->description() == modulus.description());
  CHECK(Quantity(dim::stress, Range::any(), "").match(""));

  // A number has no unit between the range and the word.
  const Quantity ratio(dim::number, Range::closed(0, 1), "");
  const auto copied_ratio = Quantity::create(ratio.description());
  REQUIRE(copied_ratio);
  CHECK(copied_ratio->match(""));
  CHECK(copied_ratio->description(Quantity::Text) == "a number from 0 to 1, or empty");

  dealii::ParameterHandler prm;
  prm.declare_entry("Strength", "", Quantity(dim::stress, Range::positive(), ""), "");
  CHECK_FALSE(get_optional_quantity(prm, "Strength", dim::stress).has_value());
  prm.set("Strength", std::string("3 MPa"));
  CHECK(get_optional_quantity(prm, "Strength", dim::stress).value() == 3e6);
}

TEST_CASE("a dimension of one's own")
{
  constexpr Dimension friction{-5, 1, 0, 0, "perforation friction", "Pa/(m^3/s)^2"};
  static_assert(friction != dim::pressure, "");
  const auto pattern = Quantity::create(Quantity(friction, Range::positive()).description());
  REQUIRE(pattern);
  CHECK(pattern->parse("2 kPa s^2/m^6") == doctest::Approx(2e3));
  CHECK(message("3 m", friction) ==
        "\"3 m\" is a length; a perforation friction is expected (Pa/(m^3/s)^2)");
}

TEST_CASE("lists")
{
  const Quantities values(dim::length);
  CHECK(values.parse("").empty());
  CHECK(values.parse("1 m, 20 cm; 3") == std::vector<double>{1, 0.2, 3});
  CHECK_FALSE(values.match("1 m, 2 s"));
  CHECK_FALSE(values.match("1 m,, 2 m"));
  CHECK(split_list("max(a, b), c") == std::vector<std::string>{"max(a, b)", "c"});
}

TEST_CASE("entries of a ParameterHandler")
{
  dealii::ParameterHandler prm;
  prm.declare_entry("Modulus", "20 GPa", Quantity(dim::stress, Range::positive()), "");
  prm.declare_entry("Depths", "1 m, 2 ft", Quantities(dim::length), "");
  CHECK(get_quantity(prm, "Modulus", dim::stress) == 2e10);
  CHECK(get_quantities(prm, "Depths", dim::length) == std::vector<double>{1, 0.6096});
  prm.set("Modulus", std::string("3 bar"));
  CHECK(get_quantity(prm, "Modulus", dim::stress) == 3e5);
  CHECK_THROWS(prm.set("Modulus", std::string("3 m")));
}
} // namespace stockwork::quantity_test
