// The law that surrounds the return to the Mohr-Coulomb surface: committed and asked again it
// answers the same, its derivatives, what it stores and dissipates, fluid content included.
#include <doctest/doctest.h>

#include "rock/mohr_coulomb/law.h"

#include <cmath>
#include <random>

namespace stockwork::mohr_coulomb_law_test
{
using namespace dealii;
using namespace mohr_coulomb;

namespace
{
using Tensor2 = SymmetricTensor<2, 3>;

constexpr double degree = 3.14159265358979323846 / 180.;

MohrCoulomb make_law(const Strength &strength)
{
  RockProperties rock;
  rock.young_modulus = 1e10;
  rock.poisson_ratio = 0.25;
  rock.biot_coefficient = 0.7;
  rock.inverse_biot_modulus = 1. / 12e9;
  return MohrCoulomb(rock, strength);
}


/// Perfectly plastic; cut off; hardening; softening and cut off.
std::vector<Strength> strengths(const double psi)
{
  const Strength plain{3e6, 27. * degree, psi * degree};
  Strength cut = plain, hardens = plain, softens = plain;
  cut.tension_cut_off = softens.tension_cut_off = 1e6;
  hardens.hardening_modulus = 2e9;
  softens.hardening_modulus = -1e9;
  softens.final_cohesion = 1e6;
  return {plain, cut, hardens, softens};
}


struct Answer
{
  RockResponse response;
  std::vector<double> history = std::vector<double>(7, 0.);
};


Answer ask(const RockLaw &law, const RockState &state)
{
  Answer answer;
  answer.response.history = answer.history.data();
  law.evaluate(ArrayView<const RockState>(&state, 1), ArrayView<RockResponse>(&answer.response, 1));
  return answer;
}


class Random
{
public:
  double number()
  {
    return uniform(generator);
  }

  Tensor2 tensor(const double size)
  {
    Tensor2 result;
    for (unsigned int i = 0; i < 6; ++i)
      result.access_raw_entry(i) = size * number();
    return result;
  }

private:
  std::mt19937 generator{4711};
  std::uniform_real_distribution<double> uniform{-1., 1.};
};


/// Two steps in a row of random strain and pressure from a random in-situ state within strength.
RockState random_state(Random &random)
{
  RockState state;
  state.in_situ_stress = -10e6 * unit_symmetric_tensor<3>() + random.tensor(1e6);
  state.in_situ_pressure = 2e6;
  state.strain = random.tensor(2e-3);
  state.pressure = 3e6 * random.number();
  return state;
}
} // namespace


TEST_CASE("Mohr-Coulomb law: committed and asked again, the answer is the same")
{
  Random random;
  for (const double psi : {0., 8., 27.})
    for (const Strength &strength : strengths(psi))
    {
      const MohrCoulomb law = make_law(strength);
      double worst = 0.;
      for (unsigned int i = 0; i < 10000; ++i)
      {
        RockState state = random_state(random);
        const Answer first = ask(law, state);
        state.history = first.history.data();
        const Answer again = ask(law, state);
        worst = std::max({worst, (again.response.stress - first.response.stress).norm() / 1e7,
                          std::abs(again.response.content - first.response.content) / 1e-3});
      }
      CHECK(worst < 1e-10);
    }
}


TEST_CASE("Mohr-Coulomb law: derivatives by strain and pressure, fluid content included")
{
  Random random;
  for (const double psi : {0., 8., 27.})
    for (const Strength &strength : strengths(psi))
    {
      const MohrCoulomb law = make_law(strength);
      unsigned int n_plastic = 0;
      std::vector<double> errors;
      for (unsigned int i = 0; i < 300; ++i)
      {
        RockState state = random_state(random);
        const Answer committed = ask(law, state);
        state.history = committed.history.data();
        state.strain += random.tensor(1e-3);
        state.pressure += 1e6 * random.number();
        const Answer here = ask(law, state);
        n_plastic += here.history[6] > committed.history[6];
        const Tensor2 direction = random.tensor(1.);
        const double step = 1e-9, pressure_step = 10.;
        RockState up = state, down = state;
        up.strain += step * direction;
        down.strain -= step * direction;
        const auto stress_difference =
          (ask(law, up).response.stress - ask(law, down).response.stress) / (2. * step);
        const double content_difference =
          (ask(law, up).response.content - ask(law, down).response.content) / (2. * step);
        double error =
          (stress_difference - here.response.stress_by_strain * direction).norm() / 1e10;
        error = std::max(
          error, std::abs(content_difference - here.response.content_by_strain * direction));
        up = down = state;
        up.pressure += pressure_step;
        down.pressure -= pressure_step;
        const auto by_pressure =
          (ask(law, up).response.stress - ask(law, down).response.stress) / (2. * pressure_step);
        const double content_by_pressure =
          (ask(law, up).response.content - ask(law, down).response.content) / (2. * pressure_step);
        error = std::max(error, (by_pressure - here.response.stress_by_pressure).norm());
        error =
          std::max(error, 1e10 * std::abs(content_by_pressure - here.response.content_by_pressure));
        errors.push_back(error);
      }
      // A few steps straddle two parts of the surface.
      std::sort(errors.begin(), errors.end());
      CHECK(n_plastic > 100);
      CHECK(errors[295] < 1e-4);
      CHECK(law.is_symmetric() == (psi == 27. && strength.hardening_modulus == 0.));
    }
}


TEST_CASE("Mohr-Coulomb law: work is stored or dissipated, and dissipation is not negative")
{
  Random random;
  for (const double psi : {8., 27.})
    for (const Strength &strength : strengths(psi))
    {
      const MohrCoulomb law = make_law(strength);
      double worst = 0.;
      for (unsigned int i = 0; i < 2000; ++i)
      {
        // Along a straight path in fine steps.
        RockState state;
        state.in_situ_stress = -10e6 * unit_symmetric_tensor<3>() + random.tensor(1e6);
        state.in_situ_pressure = 2e6;
        const Tensor2 strain = random.tensor(1e-3);
        const double pressure = 3e6 * random.number();
        Answer before = ask(law, state);
        RockState old = state;
        double work = 0.;
        std::vector<double> history = before.history;
        constexpr unsigned int n = 20;
        for (unsigned int k = 1; k <= n; ++k)
        {
          state.strain = double(k) / n * strain;
          state.pressure = double(k) / n * pressure;
          state.history = history.data();
          const Answer now = ask(law, state);
          work += (state.in_situ_stress + 0.5 * (before.response.stress + now.response.stress)) *
                    (state.strain - old.strain) +
                  (state.in_situ_pressure + 0.5 * (old.pressure + state.pressure)) *
                    (now.response.content - before.response.content);
          old = state;
          before = now;
          history = now.history;
        }
        worst = std::min(worst, (work - before.response.energy) / 1e3);
      }
      CHECK(worst > -1e-9);
    }
}
} // namespace stockwork::mohr_coulomb_law_test
