#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "mesh/spacing.h"
#include "stockwork/base/error.h"

namespace stockwork::spacing_test
{
namespace
{
double worst_ratio(const std::vector<double> &lines)
{
  double worst = 1.;
  for (std::size_t i = 2; i < lines.size(); ++i)
  {
    const double a = lines[i] - lines[i - 1], b = lines[i - 1] - lines[i - 2];
    worst = std::max({worst, a / b, b / a});
  }
  return worst;
}

/// The cell whose closure holds x: its lower line.
std::size_t cell_of(const std::vector<double> &lines, const double x)
{
  return std::upper_bound(lines.begin(), lines.end() - 1, x) - lines.begin() - 1;
}

void check_ends(const std::vector<double> &lines, const double lower, const double upper)
{
  CHECK(lines.front() == lower);
  CHECK(lines.back() == upper);
  CHECK(std::is_sorted(lines.begin(), lines.end(), std::less_equal<double>()));
}
} // namespace

TEST_CASE("equal cells")
{
  CHECK(parse_lines("4 cells", 0., 2.) == std::vector<double>{0., 0.5, 1., 1.5, 2.});
  CHECK(parse_lines("1 cell", -1., 2.) == std::vector<double>{-1., 2.});
  CHECK(parse_lines("50 cm", 0., 2.).size() == 5);
  CHECK(parse_lines("0.51", 0., 2.).size() == 5);
  CHECK(parse_lines("0.49", 0., 2.).size() == 6);
  CHECK(parse_equal_cells("0.1 m at 0 m", 0., 2.) == 0);
}

TEST_CASE("lines as given")
{
  CHECK(parse_lines("lines 0, 10 cm, 1, 3 m", 0., 3.) == std::vector<double>{0., 0.1, 1., 3.});
}

TEST_CASE("a line at a place, with cells of the asked size beside it")
{
  const auto lines = parse_lines("1 cm at 0 m, growth 1.2, largest 20 m", -400., 400.);
  check_ends(lines, -400., 400.);
  const auto zero = std::find(lines.begin(), lines.end(), 0.);
  REQUIRE(zero != lines.end());
  CHECK(zero[1] <= 0.01);
  CHECK(zero[1] > 0.0095);
  CHECK(worst_ratio(lines) < 1.2 + 1e-10);
  for (std::size_t i = 1; i < lines.size(); ++i)
    CHECK(lines[i] - lines[i - 1] < 20. * (1. + 1e-12));
  // 1 cm to 20 m takes ln(2000)/ln(1.2) = 41.7 cells over about 120 m, the rest 14 of 20 m.
  CHECK(lines.size() == doctest::Approx(2 * (42 + 14) + 1).epsilon(0.03));

  // Mirrored wishes, mirrored lines.
  for (std::size_t i = 0; i < lines.size(); ++i)
    CHECK(std::abs(lines[i] + lines[lines.size() - 1 - i]) < 1e-13 * (1. + std::abs(lines[i])));
}

TEST_CASE("the progression is geometric")
{
  const auto lines = parse_lines("1 at 0, growth 1.5", 0., 1. + 1.5 + 2.25 + 3.375);
  REQUIRE(lines.size() == 5);
  CHECK(lines[1] == doctest::Approx(1.).epsilon(1e-12));
  CHECK(lines[2] == doctest::Approx(2.5).epsilon(1e-12));
  CHECK(lines[3] == doctest::Approx(4.75).epsilon(1e-12));
}

TEST_CASE("a place in the middle of a cell")
{
  const auto lines = parse_lines("0.1 around 0.03, growth 1.2", -5., 7.);
  check_ends(lines, -5., 7.);
  const auto i = cell_of(lines, 0.03);
  CHECK(lines[i + 1] - lines[i] == doctest::Approx(0.1).epsilon(1e-12));
  CHECK(0.5 * (lines[i] + lines[i + 1]) == doctest::Approx(0.03).epsilon(1e-12));
  CHECK(worst_ratio(lines) < 1.25);

  SUBCASE("once cells have been halved")
  {
    auto halved = parse_lines("0.8 around 0 refined 3 times, largest 2", -10., 10.);
    for (unsigned int r = 0; r < 3; ++r)
    {
      std::vector<double> finer;
      for (std::size_t j = 0; j + 1 < halved.size(); ++j)
      {
        finer.push_back(halved[j]);
        finer.push_back(0.5 * (halved[j] + halved[j + 1]));
      }
      finer.push_back(halved.back());
      halved = finer;
    }
    const auto k = cell_of(halved, 0.);
    CHECK(halved[k + 1] - halved[k] == doctest::Approx(0.1).epsilon(1e-12));
    CHECK(std::abs(halved[k] + halved[k + 1]) < 1e-12);
  }
}

TEST_CASE("bands and several concentrations")
{
  const auto lines =
    parse_lines("0.1 from 0 to 2, 1 cm at 5, 0.5 at 9; growth 1.3; largest 1", -20., 20.);
  check_ends(lines, -20., 20.);
  CHECK(worst_ratio(lines) < 1.45);
  for (const double x : {0., 2., 5., 9.})
    CHECK(std::find(lines.begin(), lines.end(), x) != lines.end());
  for (unsigned int i = 0; i < 20; ++i)
  {
    const auto cell = cell_of(lines, 0.1 * i + 0.05);
    CHECK(lines[cell + 1] - lines[cell] == doctest::Approx(0.1).epsilon(1e-10));
  }
  const auto cell = cell_of(lines, 5. + 1e-6);
  CHECK(lines[cell + 1] - lines[cell] <= 0.01 + 1e-12);
  CHECK(lines[cell + 1] - lines[cell] > 0.009);
}

TEST_CASE("what cannot be understood is refused")
{
  for (const std::string text : {"",
                                 "fine",
                                 "0 cells",
                                 "-3 cells",
                                 "-1 m",
                                 "3 Pa",
                                 "2.5 cells",
                                 "lines 0, 2, 1, 4",
                                 "lines 1, 4",
                                 "lines 0, 3",
                                 "1 cm at 5",
                                 "1 cm at -1",
                                 "-1 cm at 1",
                                 "1 cm at 1, growth 0.5",
                                 "1 cm at 1, groth 1.5",
                                 "growth 1.2",
                                 "1 cm from 2 to 1",
                                 "1 cm from 0 to 2, 1 cm at 1",
                                 "1 cm around 0",
                                 "1e-9 m"})
  {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_lines(text, 0., 4.), InputError);
  }
}
} // namespace stockwork::spacing_test
