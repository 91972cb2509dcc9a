// The return to the Mohr-Coulomb surface: tabled points, strengths, the search among all faces,
// edges and the apex at random, and the tangent against differences.
#include <doctest/doctest.h>

#include "reference_table.h"
#include "rock/mohr_coulomb/return_map.h"

#include <random>

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


/// The stress among all solutions of the return equations on one, two or three of the six planes,
/// unsorted: admissible, and with flow along each of them only forwards. None where psi = 0 and
/// the mean stress is beyond the apex.
std::vector<std::array<double, 3>> all_solutions(const std::array<double, 3> &trial,
                                                 const Strength &s)
{
  const double k = 2. * s.cohesion * std::cos(s.friction_angle);
  const double up = 1. + std::sin(s.friction_angle), down = 1. - std::sin(s.friction_angle);
  const double flow_up = 1. + std::sin(s.dilation_angle),
               flow_down = 1. - std::sin(s.dilation_angle);
  std::vector<std::array<double, 3>> normals, steps;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      if (i != j)
      {
        std::array<double, 3> a{}, g{};
        a[i] = up;
        a[j] = -down;
        g[i] = flow_up;
        g[j] = -flow_down;
        const double volume = lambda * (g[0] + g[1] + g[2]);
        normals.push_back(a);
        steps.push_back(
          {{volume + 2. * mu * g[0], volume + 2. * mu * g[1], volume + 2. * mu * g[2]}});
      }
  const auto dot = [](const auto &a, const auto &b)
  { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };

  std::vector<std::array<double, 3>> found;
  for (unsigned int set = 1; set < 64; ++set)
  {
    std::vector<unsigned int> active;
    for (unsigned int p = 0; p < 6; ++p)
      if (set & (1u << p))
        active.push_back(p);
    const unsigned int n = active.size();
    if (n > 3)
      continue;
    // Gauss's elimination of (a_i . D g_j) multiplier_j = a_i . trial - k
    double m[3][4];
    for (unsigned int i = 0; i < n; ++i)
    {
      for (unsigned int j = 0; j < n; ++j)
        m[i][j] = dot(normals[active[i]], steps[active[j]]);
      m[i][n] = dot(normals[active[i]], trial) - k;
    }
    bool singular = false;
    for (unsigned int c = 0; c < n && !singular; ++c)
    {
      unsigned int pivot = c;
      for (unsigned int r = c + 1; r < n; ++r)
        if (std::abs(m[r][c]) > std::abs(m[pivot][c]))
          pivot = r;
      singular = std::abs(m[pivot][c]) < 1e-9 * mu;
      if (singular)
        break;
      for (unsigned int col = 0; col <= n; ++col)
        std::swap(m[c][col], m[pivot][col]);
      for (unsigned int r = 0; r < n; ++r)
        if (r != c)
        {
          const double factor = m[r][c] / m[c][c];
          for (unsigned int col = c; col <= n; ++col)
            m[r][col] -= factor * m[c][col];
        }
    }
    if (singular)
      continue;
    std::array<double, 3> stress = trial;
    bool forwards = true;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double multiplier = m[i][n] / m[i][i];
      forwards = forwards && multiplier > -1e-12 * k / mu;
      for (unsigned int d = 0; d < 3; ++d)
        stress[d] -= multiplier * steps[active[i]][d];
    }
    bool admissible = forwards;
    for (const auto &normal : normals)
      admissible = admissible && dot(normal, stress) < k * (1. + 1e-9);
    if (admissible)
      found.push_back(stress);
  }
  return found;
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
      const auto solutions = all_solutions(s, rock);
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


TEST_CASE("the tangent is the derivative")
{
  std::mt19937 generator(12);
  std::uniform_real_distribution<double> wide(-5e7, 2e7), small(-1., 1.);
  std::map<Place, unsigned int> seen;
  for (unsigned int trial = 0; trial < 4000; ++trial)
  {
    const Strength rock = strength(27., trial % 2 == 0 ? 8. : 27.);
    Stress stress, direction;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
      {
        stress[i][j] = (i == j ? 1. : 0.2) * wide(generator);
        direction[i][j] = small(generator);
      }
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
       {Place::elastic, Place::face, Place::compression_edge, Place::extension_edge, Place::apex})
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
