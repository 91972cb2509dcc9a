#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "stockwork/base/error.h"
#include "stockwork/rock/rock.h"

namespace stockwork::random_field_test
{
using dealii::Point;
using Entries = std::map<std::string, std::string>;

RandomField field(const Entries &entries)
{
  dealii::ParameterHandler prm;
  RandomField::declare_parameters(prm, false);
  prm.enter_subsection("Random field");
  prm.set("Properties", "Young modulus, tensile strength");
  prm.set("Weibull modulus", "10");
  prm.set("Lattice spacing", "2 m");
  for (const auto &[name, value] : entries)
    prm.set(name, value);
  prm.leave_subsection();
  RandomField result;
  result.parse_parameters(prm, "Rock", RandomField());
  return result;
}

/// The factors of a property on a square of cells of the lattice, n by n.
std::vector<double> square(const RandomField &random,
                           const int n,
                           const RandomField::Property property = RandomField::young_modulus)
{
  std::vector<double> values;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      values.push_back(random.factors(Point<2>(2. * i + 1. - n, 2. * j + 1. - n))[property]);
  return values;
}

double mean(const std::vector<double> &values)
{
  return std::accumulate(values.begin(), values.end(), 0.) / values.size();
}

/// Of paired numbers.
double correlation(const std::vector<double> &a, const std::vector<double> &b)
{
  const double mean_a = mean(a), mean_b = mean(b);
  double ab = 0., aa = 0., bb = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
  {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

/// The normal deviate of the same probability as a factor.
double deviate(const double factor, const double m)
{
  const double exceedance = std::exp(-std::pow(factor, m));
  double low = -9., high = 9.;
  for (unsigned int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.)) > exceedance ? low : high) = middle;
  }
  return low;
}

/// The greatest distance between the distribution of sorted values and Weibull's, times sqrt(n).
double kolmogorov(std::vector<double> values, const double m)
{
  std::sort(values.begin(), values.end());
  const double n = values.size();
  double greatest = 0.;
  for (unsigned int i = 0; i < values.size(); ++i)
  {
    const double probability = 1. - std::exp(-std::pow(values[i], m));
    greatest = std::max({greatest, probability - i / n, (i + 1) / n - probability});
  }
  return greatest * std::sqrt(n);
}

TEST_CASE("factors have Weibull's distribution")
{
  for (const double m : {1.5, 10.})
  {
    const RandomField random = field({{"Weibull modulus", std::to_string(m)}});
    const std::vector<double> values = square(random, 317); // 1e5 of them
    const double expected = std::tgamma(1. + 1. / m),
                 variance = std::tgamma(1. + 2. / m) - expected * expected;
    CHECK(random.mean_factor() == doctest::Approx(expected));
    CHECK(random.deviation() == doctest::Approx(std::sqrt(variance)));
    // Four deviations of the mean, and of the variance (of a kurtosis below 5).
    const double n = values.size();
    CHECK(std::abs(mean(values) - expected) < 4. * std::sqrt(variance / n));
    double squares = 0.;
    for (const double value : values)
      squares += (value - expected) * (value - expected);
    CHECK(std::abs(squares / n - variance) < 4. * variance * std::sqrt(4. / n));
    CHECK(kolmogorov(values, m) < 1.63); // one in a hundred is above
  }
  CHECK(field({}).mean_factor() == doctest::Approx(0.951).epsilon(5e-4));
}

TEST_CASE("neighbours, seeds and independent properties have nothing to do with one another")
{
  constexpr int n = 317;
  const std::vector<double> values = square(field({}), n);
  std::vector<double> left, right, below, above;
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i)
    {
      left.push_back(values[j * n + i]);
      right.push_back(values[j * n + i + 1]);
      above.push_back(values[(j + 1) * n + i]);
    }
  constexpr double noise = 4. / n; // four deviations of a correlation that is none
  CHECK(std::abs(correlation(left, right)) < noise);
  CHECK(std::abs(correlation(left, above)) < noise);
  CHECK(std::abs(correlation(right, above)) < noise);
  CHECK(std::abs(correlation(values, square(field({{"Seed", "2"}}), n))) < noise);
  CHECK(square(field({}), n, RandomField::tensile_strength) == values);
  const RandomField independent = field({{"Independent properties", "true"}});
  CHECK(std::abs(correlation(square(independent, n),
                             square(independent, n, RandomField::tensile_strength))) < noise);
  // What does not vary.
  CHECK(square(field({}), 2, RandomField::permeability) == std::vector<double>(4, 1.));
}

TEST_CASE("a correlated field has the same distribution, and the correlation that is asked for")
{
  constexpr int n = 600;
  constexpr double m = 3., length = 6., spacing = 2.;
  const RandomField random = field({{"Correlation length", "6 m"}, {"Weibull modulus", "3"}});
  const std::vector<double> values = square(random, n);
  std::vector<double> deviates;
  for (const double value : values)
    deviates.push_back(deviate(value, m));
  // Of one cell in eight each way, which are independent.
  std::vector<double> sparse;
  for (int j = 0; j < n; j += 8)
    for (int i = 0; i < n; i += 8)
      sparse.push_back(values[j * n + i]);
  CHECK(kolmogorov(sparse, m) < 1.63);
  for (const auto &[i_step, j_step] :
       {std::pair(1, 0), std::pair(0, 2), std::pair(2, 2), std::pair(3, 0), std::pair(0, 9)})
  {
    std::vector<double> here, there;
    for (int j = 0; j + j_step < n; ++j)
      for (int i = 0; i + i_step < n; ++i)
      {
        here.push_back(deviates[j * n + i]);
        there.push_back(deviates[(j + j_step) * n + i + i_step]);
      }
    const double r = spacing * std::hypot(i_step, j_step);
    CAPTURE(r);
    // About (n spacing / length)^2 / pi independent patches.
    CHECK(std::abs(correlation(here, there) - std::exp(-r * r / (length * length))) < 0.03);
  }
  // In three dimensions as well.
  double squares = 0.;
  constexpr int few = 20;
  for (int k = 0; k < few; ++k)
    for (int j = 0; j < few; ++j)
      for (int i = 0; i < few; ++i)
        squares += std::pow(deviate(random.factors(Point<3>(24. * i, 24. * j, 24. * k))[0], m), 2);
  CHECK(squares / (few * few * few) == doctest::Approx(1.).epsilon(4. * std::sqrt(2. / 8000.)));
}

TEST_CASE("a place has its factor whatever the cell of the mesh, round-off and all")
{
  const RandomField random = field({});
  const auto at = [&](const double x, const double y)
  { return random.factors(Point<2>(x, y))[RandomField::young_modulus]; };
  CHECK(at(1., 1.) == at(0.3, 1.9));
  CHECK(at(1., 1.) != at(2.1, 1.));
  CHECK(at(-1., 1.) != at(1., 1.));
  for (int i = -1000; i < 1000; ++i) // the corners of the lattice
    CHECK(at(2. * i, 0.) == at(2. * i * (1. + 1e-14) - 1e-14, -1e-14));
}

TEST_CASE("great moduli are uniform rock, to the last bit")
{
  const std::vector<double> values = square(field({{"Weibull modulus", "1e300"}}), 100);
  CHECK(std::all_of(values.begin(), values.end(), [](const double value) { return value == 1.; }));
}

/// Rock with these entries, written "Section/Entry" below Rock.
Rock rock_with(const Entries &entries)
{
  dealii::ParameterHandler prm;
  Rock::declare_parameters(prm);
  prm.enter_subsection("Rock");
  prm.set("Young modulus", "10 GPa");
  prm.set("Tensile strength", "2 MPa");
  prm.set("Critical energy release rate", "50 J/m^2");
  for (const auto &[path, value] : entries)
  {
    std::string name = path;
    unsigned int depth = 0;
    for (std::size_t slash; (slash = name.find('/')) != std::string::npos; ++depth)
    {
      prm.enter_subsection(name.substr(0, slash));
      name.erase(0, slash + 1);
    }
    prm.set(name, value);
    for (; depth > 0; --depth)
      prm.leave_subsection();
  }
  prm.leave_subsection();
  Rock rock;
  rock.parse_parameters(prm);
  return rock;
}

TEST_CASE("regions inherit the field, and have their own")
{
  const Rock rock =
    rock_with({{"Random field/Properties", "Young modulus, tensile strength"},
               {"Random field/Weibull modulus", "5"},
               {"Random field/Lattice spacing", "1 m"},
               {"Region 1/Young modulus", "20 GPa"},
               {"Region 2/Random field/Weibull modulus", "20"},
               {"Region 3/Random field/Seed", "7"},
               {"Region 4/Random field/Properties", "none"},
               {"Region 5/Random field/Properties", "critical energy release rate"}});
  CHECK(rock.is_random());
  CHECK(rock.varies(RandomField::energy_release_rate));
  CHECK(!rock.varies(RandomField::permeability));
  const Point<2> place(3.5, 0.5);
  const RockProperties here = rock.at(0, place);
  const double factor = here.young_modulus / 10e9;
  CHECK(factor != 1.);
  CHECK(here.tensile_strength == doctest::Approx(2e6 * factor));
  CHECK(here.energy_release_rate == 50.);
  CHECK(!here.is_random());
  CHECK(rock.at(1, place).young_modulus == doctest::Approx(20e9 * factor));
  // The same probability: factor^5 = factor_2^20.
  CHECK(rock.at(2, place).young_modulus == doctest::Approx(10e9 * std::pow(factor, 0.25)));
  CHECK(rock.at(3, place).young_modulus != here.young_modulus);
  CHECK(rock.at(4, place).young_modulus == 10e9);
  CHECK(rock.at(5, place).young_modulus == 10e9);
  CHECK(rock.at(5, place).energy_release_rate == doctest::Approx(50. * factor));
  CHECK(rock.at(5, place).shear_energy_release_rate == doctest::Approx(50. * factor));
  // A region alone, with what the rock at large says.
  const Rock one = rock_with({{"Random field/Weibull modulus", "5"},
                              {"Random field/Lattice spacing", "1 m"},
                              {"Region 1/Random field/Properties", "Young modulus"}});
  CHECK(one.at(0, place).young_modulus == 10e9);
  CHECK(one.at(1, place).young_modulus == doctest::Approx(10e9 * factor));
  CHECK(!rock_with({}).is_random());
}

TEST_CASE("what makes no sense is refused")
{
  const Entries sound = {{"Random field/Properties", "Young modulus"},
                         {"Random field/Weibull modulus", "5"},
                         {"Random field/Lattice spacing", "1 m"}};
  CHECK_NOTHROW(rock_with(sound));
  const std::vector<std::pair<std::string, std::string>> wrong = {
    {"Random field/Weibull modulus", ""},
    {"Random field/Lattice spacing", ""},
    {"Random field/Seed", "1.5"},
    {"Random field/Seed", "-1"},
    {"Random field/Correlation length", "1 m"},
    {"Random field/Correlation length", "6 m"},
    {"Random field/Properties", "none, Young modulus"},
    {"Random field/Properties", ""},
    {"Random field/Properties", "permeability"},
    {"Region 1/Random field/Properties", "permeability"}};
  for (const auto &[name, value] : wrong)
  {
    const std::string entry = name + " = " + value;
    CAPTURE(entry);
    Entries entries = sound;
    entries[name] = value;
    CHECK_THROWS_AS(rock_with(entries), EntryError);
  }
}
} // namespace stockwork::random_field_test
