// Mohr-Coulomb rock whose cohesion changes with the plastic strain: the return at random against a
// search over all planes, tangents, the limit of softening, and stress-strain curves in closed
// form.
#include <doctest/doctest.h>

#include "mohr_coulomb_search.h"
#include "rock/mohr_coulomb/hardening.h"
#include "rock/mohr_coulomb/law.h"

#include <map>
#include <random>

namespace stockwork::mohr_coulomb_hardening_test
{
using namespace dealii;
using namespace mohr_coulomb;

namespace
{
using Stress = SymmetricTensor<2, 3>;

constexpr double degree = 3.14159265358979323846 / 180.;
constexpr double young = 1e10, poisson = 0.25;
constexpr double lambda = young * poisson / ((1. + poisson) * (1. - 2. * poisson)),
                 mu = young / (2. * (1. + poisson));
constexpr double infinity = std::numeric_limits<double>::infinity();

Strength strength(const double psi,
                  const double cut_off,
                  const double modulus,
                  const double final_cohesion,
                  const double phi = 27.)
{
  return {3e6, phi * degree, psi * degree, cut_off, modulus, final_cohesion};
}

double limit(const Strength &rock, const int sense)
{
  return hardening_limit(principal_stiffness(lambda, mu), rock, sense);
}

struct Found
{
  double greatest = 0.; ///< difference from a solution of the search, over the cohesion
  unsigned int plastic = 0, without_solution = 0;
};

Found compare(const Strength &rock,
              const unsigned int n_trials,
              std::map<Place, unsigned int> &seen)
{
  std::mt19937 generator(4711);
  std::uniform_real_distribution<double> wide(-6e7, 2.5e7), strain(0., 2e-3);
  const test::MohrCoulombSearch search(rock, lambda, mu);
  Found found;
  for (unsigned int trial = 0; trial < n_trials; ++trial)
  {
    const std::array<double, 3> s{{wide(generator), wide(generator), wide(generator)}};
    const double before = trial % 2 == 0 ? 0. : strain(generator);
    Stress stress;
    for (unsigned int d = 0; d < 3; ++d)
      stress[d][d] = s[d];
    const Return back = return_to_surface(stress, lambda, mu, rock, before);
    ++seen[back.place];
    if (back.place == Place::elastic)
      continue;
    ++found.plastic;
    const auto solutions = search(s, before);
    found.without_solution += solutions.empty();
    for (const auto &solution : solutions)
      for (unsigned int d = 0; d < 3; ++d)
        found.greatest =
          std::max(found.greatest, std::abs(back.stress[d][d] - solution[d]) / rock.cohesion);
  }
  return found;
}
} // namespace


TEST_CASE(
  "hardening and softening: random trial stresses return where a search over all planes ends")
{
  const double soft = -0.9 * limit(strength(8., 1e6, 0., infinity), -1);
  std::map<Place, unsigned int> seen;
  for (const Strength &rock :
       {strength(27., infinity, 2e9, infinity), strength(8., infinity, 5e9, 6e6),
        strength(8., infinity, -1e9, 1e6), strength(8., 1e6, 3e9, infinity),
        strength(8., 1e6, soft, 0.5e6), strength(27., 1e6, -5e8, 0.), strength(8., 0., 3e9, 5e6),
        strength(0., 1e6, -1e9, 1e6), strength(0., 2e6, 1e9, infinity, 0.),
        strength(0., 2e6, -1e9, 1e6, 0.), strength(8., infinity, 1e11, infinity)})
  {
    const int sense = rock.hardening_modulus > 0. ? 1 : -1;
    INFO("psi ", rock.dilation_angle / degree, ", T ", rock.tension_cut_off, ", H ",
         rock.hardening_modulus, ", limit ", limit(rock, sense));
    REQUIRE(std::abs(rock.hardening_modulus) < limit(rock, sense));
    const Found found = compare(rock, 10000, seen);
    CHECK(found.plastic > 4000);
    CHECK(found.greatest < 1e-10);
    CHECK(found.without_solution == 0);
  }
  for (const Place place :
       {Place::elastic, Place::face, Place::compression_edge, Place::extension_edge, Place::apex,
        Place::cut_off, Place::cut_off_face, Place::cut_off_edge, Place::cut_off_extension,
        Place::cut_off_compression, Place::cut_off_corner})
    CHECK(seen[place] > 20);
}


namespace
{
/// Of how many trial stresses near the surface there is more than one state, that of rock which
/// does not yield counted.
unsigned int n_ambiguous(const Strength &rock)
{
  std::mt19937 generator(4711);
  std::uniform_real_distribution<double> near(-1.5e7, 8e6);
  const test::MohrCoulombSearch search(rock, lambda, mu);
  unsigned int n = 0;
  for (unsigned int trial = 0; trial < 10000; ++trial)
  {
    const PrincipalVector s({near(generator), near(generator), near(generator)});
    std::vector<std::array<double, 3>> states = search({{s[0], s[1], s[2]}});
    if (excess(s, rock, rock.cohesion) < -1e-6 * rock.cohesion)
      states.push_back({{s[0], s[1], s[2]}});
    bool several = false;
    for (const auto &state : states)
      for (unsigned int d = 0; d < 3; ++d)
        several = several || std::abs(state[d] - states[0][d]) > 1e-6 * rock.cohesion;
    n += several;
  }
  return n;
}
} // namespace


TEST_CASE("the limit of softening: below it there is one state, beyond it are several")
{
  for (const double cut_off : {infinity, 1e6})
  {
    Strength rock = strength(8., cut_off, 0., 1e6);
    const double most = limit(rock, -1);
    rock.hardening_modulus = -0.999 * most;
    CHECK(n_ambiguous(rock) == 0);
    rock.hardening_modulus = -1.2 * most;
    CHECK(n_ambiguous(rock) > 0);
  }
  // Without friction the yield stress 2 c of triaxial compression may fall by less than 3 G.
  CHECK(limit(strength(0., infinity, 0., 1e6, 0.), -1) == doctest::Approx(1.5 * mu));
  CHECK(limit(strength(8., 1e6, 0., infinity), 1) == infinity);
}


TEST_CASE("hardening and softening: the tangent is the derivative")
{
  std::mt19937 generator(12);
  std::uniform_real_distribution<double> wide(-5e7, 2e7), small(-1., 1.);
  const std::vector<Strength> rocks{strength(8., infinity, 2e9, infinity),
                                    strength(27., 1e6, 2e9, 5e6), strength(8., infinity, -1e9, 1e6),
                                    strength(8., 2e6, -1e9, 1e6)};
  std::map<Place, unsigned int> seen;
  double greatest = 0.;
  for (unsigned int trial = 0; trial < 40000; ++trial)
  {
    const Strength &rock = rocks[trial % rocks.size()];
    Stress stress, direction;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
      {
        stress[i][j] = (i == j ? 1. : 0.2) * wide(generator);
        direction[i][j] = small(generator);
      }
    stress += trial % 5 / 4 * 4e7 * unit_symmetric_tensor<3>(); // some in tension
    const double step = 1e-8;
    const auto at = [&](const double sign)
    {
      const Stress more =
        lambda * trace(direction) * unit_symmetric_tensor<3>() + 2. * mu * direction;
      return return_to_surface(stress + sign * step * more, lambda, mu, rock, 1e-4);
    };
    const Return middle = at(0.), ahead = at(1.), behind = at(-1.);
    if (ahead.place != behind.place)
      continue;
    const Stress difference = (ahead.stress - behind.stress) / (2. * step);
    const double error = (middle.tangent * direction - difference).norm() / (2. * mu);
    // A few come to the final cohesion in between.
    if (error < 1e-4)
      ++seen[middle.place];
    else
      greatest = std::max(greatest, double(++seen[Place(100)]));
  }
  CHECK(greatest < 40.);
  for (const Place place :
       {Place::elastic, Place::face, Place::compression_edge, Place::extension_edge, Place::apex,
        Place::cut_off, Place::cut_off_face, Place::cut_off_edge, Place::cut_off_extension,
        Place::cut_off_compression, Place::cut_off_corner})
  {
    INFO("place ", int(place));
    CHECK(seen[place] > 20);
  }
}


namespace
{
/// A cylinder under a confinement, strained along its axis step by step; the strain across follows
/// from the stress there by Newton's method.
class TriaxialTest
{
public:
  TriaxialTest(const Strength &strength, const double confinement)
    : law(rock(), strength)
    , history(law.n_history(), 0.)
  {
    state.in_situ_stress = -confinement * unit_symmetric_tensor<3>();
  }

  /// Axial stress [Pa]
  double strain_to(const double axial)
  {
    state.strain[2][2] = axial;
    RockResponse response;
    std::vector<double> next(history.size());
    for (unsigned int i = 0; i < 20; ++i)
    {
      response = RockResponse();
      state.history = history.data();
      response.history = next.data();
      law.evaluate(ArrayView<const RockState>(&state, 1), ArrayView<RockResponse>(&response, 1));
      residuals.push_back(std::abs(response.stress[0][0]));
      if (residuals.back() < 1e-6)
        break;
      const double slope =
        response.stress_by_strain[0][0][0][0] + response.stress_by_strain[0][0][1][1];
      state.strain[0][0] -= response.stress[0][0] / slope;
      state.strain[1][1] = state.strain[0][0];
    }
    history = next;
    most_iterations = std::max<unsigned int>(most_iterations, residuals.size());
    residuals.clear();
    return response.stress[2][2] + state.in_situ_stress[2][2];
  }

  double equivalent_strain() const
  {
    return history[6];
  }

  unsigned int most_iterations = 0;

private:
  static RockProperties rock()
  {
    RockProperties properties;
    properties.young_modulus = young;
    properties.poisson_ratio = poisson;
    return properties;
  }

  MohrCoulomb law;
  RockState state;
  std::vector<double> history, residuals;
};
} // namespace


// Compression: s = -p - (q_0 + 2 cos(phi) H k)/(1 - sin(phi)), with the plastic strain along
// (1 + sin psi, 1 + sin psi, -2 (1 - sin psi)). Tension: along the axis.
TEST_CASE("hardening and softening: stress and strain in triaxial compression and uniaxial tension")
{
  for (const double modulus : {1e9, -1e9, 0.})
  {
    const double p = 5e6, end = modulus > 0. ? 4e6 : 2e6;
    const Strength rock = strength(8., 1e6, modulus, modulus == 0. ? infinity : end);
    const double sine = std::sin(rock.friction_angle), cosine = std::cos(rock.friction_angle),
                 flow = std::sin(rock.dilation_angle);
    INFO("H ", modulus);
    TriaxialTest compression(rock, p), tension(rock, 0.);
    for (unsigned int i = 1; i <= 40; ++i)
    {
      // Axial stress and strain for a plastic strain; the root by halving.
      const auto axial_strain = [&](const double k)
      {
        const double c = rock.cohesion_after(k);
        const double stress = -(p * (1. + sine) + 2. * c * cosine) / (1. - sine);
        const double size =
          std::sqrt(2. / 3. * (2. * (1. + flow) * (1. + flow) + 4. * (1. - flow) * (1. - flow)));
        return std::make_pair(stress, (stress + p) / young - 2. * (1. - flow) * k / size);
      };
      const double strain = -1e-4 * i;
      const double stress = compression.strain_to(strain);
      const auto [expected, strain_there] = axial_strain(compression.equivalent_strain());
      if (compression.equivalent_strain() > 0.)
      {
        CHECK(stress == doctest::Approx(expected).epsilon(1e-10));
        CHECK(strain == doctest::Approx(strain_there).epsilon(1e-10));
      }
      else
        CHECK(stress == doctest::Approx(-p + young * strain).epsilon(1e-10));

      const double pulled = 2e-5 * i, pull = tension.strain_to(pulled);
      const double k = tension.equivalent_strain();
      CHECK(pulled == doctest::Approx(pull / young + std::sqrt(1.5) * k).epsilon(1e-10));
      if (k > 0.)
        CHECK(pull == doctest::Approx(1e6 * rock.cohesion_after(k) / rock.cohesion).epsilon(1e-10));
      if (modulus == 0. && pulled > 1e6 / young)
        CHECK(pull == doctest::Approx(1e6).epsilon(1e-12)); // stops at T
    }
    CHECK(compression.equivalent_strain() > 1e-3); // where it ends
    CHECK(compression.most_iterations <= 6);
    CHECK(tension.most_iterations <= 6);
  }
}
} // namespace stockwork::mohr_coulomb_hardening_test
