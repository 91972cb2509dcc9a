// The return to the Mohr-Coulomb surface: tabled points, strengths, the search among all faces,
// edges and the apex at random, and the tangent against differences.
#include <doctest/doctest.h>

#include "mohr_coulomb_search.h"
#include "reference_table.h"
#include "rock/mohr_coulomb/return_map.h"

#include <random>
#include <tuple>

namespace stockwork::mohr_coulomb_test
{
using namespace dealii;
using namespace mohr_coulomb;

namespace
{
using Stress = SymmetricTensor<2, 3>;

constexpr double pi = 3.14159265358979323846, degree = pi / 180.;
constexpr double young = 1e10, poisson = 0.25;
constexpr double lambda = young * poisson / ((1. + poisson) * (1. - 2. * poisson)),
                 mu = young / (2. * (1. + poisson));

Strength strength(const double phi, const double psi)
{
  return {3e6, phi * degree, psi * degree};
}

Stress elastic_stress(const Stress &strain)
{
  return lambda * trace(strain) * unit_symmetric_tensor<3>() + 2. * mu * strain;
}

Stress tensor(const test::ReferenceTable &table,
              const std::size_t row,
              const std::string &name,
              const std::string &unit)
{
  const std::array<std::string, 3> axis{{"x", "y", "z"}};
  Stress result;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = i; j < 3; ++j)
      result[i][j] = table(row, name + '_' + axis[i] + axis[j] + unit);
  return result;
}

const std::map<std::string, Place> places{{"elastic", Place::elastic},
                                          {"face", Place::face},
                                          {"13+23", Place::compression_edge},
                                          {"13+12", Place::extension_edge},
                                          {"apex", Place::apex}};

/// The greatest difference of the tabled stresses and plastic strains, over the yield stress and
/// the strain that belongs to it.
double difference_from_table(const double factor)
{
  const test::ReferenceTable table("mc_return_points");
  REQUIRE(table.rows() == 71);
  const double k = 5346039.1;
  double greatest = 0.;
  for (std::size_t row = 0; row < table.rows(); ++row)
  {
    const Stress trial =
      tensor(table, row, "sigma0", "_Pa") + elastic_stress(tensor(table, row, "deps", ""));
    const Return back = return_to_surface(trial, lambda, mu, strength(27., table(row, "psi_deg")));
    INFO("row ", row + 1);
    CHECK(back.place == places.at(table.text(row, "active_set")));
    greatest =
      std::max(greatest, (back.stress - factor * tensor(table, row, "sigma", "_Pa")).norm() / k);
    // C : strain = trial - stress
    const Stress plastic = elastic_stress(tensor(table, row, "dep_plastic", ""));
    greatest = std::max(greatest, (trial - back.stress - factor * plastic).norm() / k);
  }
  return greatest;
}
} // namespace

// A step of the stress, of every kind, by hand: tests/data/reference/mc_return_points.csv says how
// the values were found.
TEST_CASE("stresses and plastic strains of the table")
{
  CHECK(difference_from_table(1.) < 1e-10);
  CHECK(difference_from_table(1. + 1e-9) > 1e-10); // so the comparison can fail
}


TEST_CASE("strengths in triaxial and plane-strain tests lie on the surface")
{
  const test::ReferenceTable table("mc_strength");
  for (std::size_t row = 0; row < table.rows(); ++row)
  {
    const std::string kind = table.text(row, "test");
    const double confinement = table(row, "confinement_Pa"),
                 axial = table(row, "sigma_axial_failure_Pa");
    Stress stress;
    stress[0][0] = axial;
    stress[1][1] = -confinement;
    stress[2][2] =
      kind == "plane_strain_compression" ? table(row, "sigma_second_lateral_Pa") : -confinement;
    const Strength rock = strength(table(row, "phi_deg"), table(row, "psi_deg"));
    CHECK(std::abs(distance_to_yield(stress, rock)) < 1e-7); // eight digits in the table
    stress[0][0] *= 1.001;
    CHECK(std::abs(distance_to_yield(stress, rock)) > 1e-5);
  }
}


TEST_CASE("random trial stresses return where a search over all faces, edges and the apex ends")
{
  std::mt19937 generator(4711);
  std::uniform_real_distribution<double> wide(-6e7, 2.5e7);
  for (const double psi : {27., 8., 0.})
  {
    const Strength rock = strength(27., psi);
    const double k = 2. * rock.cohesion * std::cos(rock.friction_angle);
    const double apex = rock.cohesion / std::tan(rock.friction_angle);
    const test::MohrCoulombSearch search(rock, lambda, mu);
    unsigned int plastic = 0, decreed = 0, without_solution = 0;
    double greatest = 0.;
    for (unsigned int trial = 0; trial < 34000; ++trial)
    {
      const std::array<double, 3> s{{wide(generator), wide(generator), wide(generator)}};
      Stress stress;
      for (unsigned int d = 0; d < 3; ++d)
        stress[d][d] = s[d];
      const Return back = return_to_surface(stress, lambda, mu, rock);
      if (back.place == Place::elastic)
        continue;
      ++plastic;
      const auto solutions = search(s);
      decreed += back.by_decree;
      without_solution += solutions.empty();
      if (solutions.empty())
        for (unsigned int d = 0; d < 3; ++d)
          greatest = std::max(greatest, std::abs(back.stress[d][d] - apex) / k);
      for (const auto &solution : solutions)
        for (unsigned int d = 0; d < 3; ++d)
          greatest = std::max(greatest, std::abs(back.stress[d][d] - solution[d]) / k);
    }
    INFO("psi ", psi);
    CHECK(plastic > 20000);
    CHECK(greatest < 1e-10);
    CHECK(decreed == without_solution);
    CHECK((decreed > 0) == (psi == 0.));
  }
}


// With T = 0, T next to the apex, no dilation, and no friction, where there is no apex.
TEST_CASE("random trial stresses return where that search ends, with a tension cut-off")
{
  std::mt19937 generator(815);
  std::uniform_real_distribution<double> wide(-6e7, 2.5e7);
  std::map<Place, unsigned int> seen;
  for (const auto &[phi, psi, cut_off] :
       std::vector<std::tuple<double, double, double>>{{27., 27., 1e6},
                                                       {27., 8., 0.},
                                                       {27., 8., 5.8e6}, // apex: 5.888 MPa
                                                       {27., 0., 3e6},
                                                       {0., 0., 2e6}})
  {
    Strength rock = strength(phi, psi);
    rock.tension_cut_off = cut_off;
    const test::MohrCoulombSearch search(rock, lambda, mu);
    double greatest = 0.;
    unsigned int without_solution = 0, decreed = 0;
    for (unsigned int trial = 0; trial < 20000; ++trial)
    {
      const std::array<double, 3> s{{wide(generator), wide(generator), wide(generator)}};
      Stress stress;
      for (unsigned int d = 0; d < 3; ++d)
        stress[d][d] = s[d];
      const Return back = return_to_surface(stress, lambda, mu, rock);
      ++seen[back.place];
      if (back.place == Place::elastic)
        continue;
      const auto solutions = search(s);
      without_solution += solutions.empty();
      decreed += back.by_decree;
      for (const auto &solution : solutions)
        for (unsigned int d = 0; d < 3; ++d)
          greatest = std::max(greatest, std::abs(back.stress[d][d] - solution[d]) / rock.cohesion);
    }
    INFO("phi ", phi, ", psi ", psi, ", T ", cut_off);
    CHECK(greatest < 1e-10);
    CHECK(without_solution == 0);
    CHECK(decreed == 0);
  }
  for (const Place place :
       {Place::elastic, Place::face, Place::compression_edge, Place::extension_edge, Place::cut_off,
        Place::cut_off_face, Place::cut_off_edge, Place::cut_off_extension,
        Place::cut_off_compression, Place::cut_off_corner})
    CHECK(seen[place] > 20);
  CHECK(seen[Place::apex] == 0);
}


TEST_CASE("the share of the strength is 1 where the cut-off is reached, and the margin 0")
{
  Strength rock = strength(27., 8.);
  rock.tension_cut_off = 1e6;
  Stress stress;
  stress[0][0] = 1e6;
  stress[1][1] = -4e6;
  stress[2][2] = -2e6;
  CHECK(share_of_strength(stress, rock) == doctest::Approx(1.));
  CHECK(margin_to_yield(stress, rock) == doctest::Approx(0.));
  CHECK(distance_to_yield(stress, rock) < -0.1); // far from shear
  stress[0][0] = 0.4e6;
  CHECK(share_of_strength(stress, rock) < 1.);
  CHECK(margin_to_yield(stress, rock) == doctest::Approx(0.6e6));
  CHECK(share_of_strength(3e6 * unit_symmetric_tensor<3>(), rock) > 1.); // in all directions
  rock.tension_cut_off = 0.;
  CHECK(share_of_strength(Stress(), rock) == 1.);
}


TEST_CASE("the tangent is the derivative")
{
  std::mt19937 generator(12);
  std::uniform_real_distribution<double> wide(-5e7, 2e7), small(-1., 1.);
  std::map<Place, unsigned int> seen;
  for (unsigned int trial = 0; trial < 40000; ++trial)
  {
    Strength rock = strength(27., trial % 2 == 0 ? 8. : 27.);
    if (trial % 3 > 0)
      rock.tension_cut_off = trial % 3 * 1e6;
    Stress stress, direction;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
      {
        stress[i][j] = (i == j ? 1. : 0.2) * wide(generator);
        direction[i][j] = small(generator);
      }
    stress += trial % 5 / 4 * 4e7 * unit_symmetric_tensor<3>(); // some in tension
    const double step = 1e-9;
    const auto at = [&](const double sign) {
      return return_to_surface(stress + sign * step * elastic_stress(direction), lambda, mu, rock);
    };
    const Return middle = at(0.), ahead = at(1.), behind = at(-1.);
    if (ahead.place != behind.place)
      continue;
    ++seen[middle.place];
    const Stress difference = (ahead.stress - behind.stress) / (2. * step);
    CHECK((middle.tangent * direction - difference).norm() < 1e-5 * 2. * mu);
  }
  for (const Place place :
       {Place::elastic, Place::face, Place::compression_edge, Place::extension_edge, Place::apex,
        Place::cut_off, Place::cut_off_face, Place::cut_off_edge, Place::cut_off_extension,
        Place::cut_off_compression, Place::cut_off_corner})
    CHECK(seen[place] > 20);
}


TEST_CASE("with equal principal stresses the tangent is that of stresses which hardly differ")
{
  const Strength rock = strength(27., 8.);
  Stress equal, differ;
  equal[0][0] = equal[1][1] = -2e6;
  equal[2][2] = -4e7;
  differ = equal;
  differ[0][0] += 1.;
  differ[0][1] = 0.5;
  const Return a = return_to_surface(equal, lambda, mu, rock),
               b = return_to_surface(differ, lambda, mu, rock);
  CHECK(a.place == Place::compression_edge);
  CHECK((a.tangent - b.tangent).norm() < 1e-6 * a.tangent.norm());
}
} // namespace stockwork::mohr_coulomb_test
