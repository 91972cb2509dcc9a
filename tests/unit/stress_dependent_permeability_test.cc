// Permeability that falls with the effective stress: derivatives of the law, and steady flow
// through a column against its closed form.
#include <doctest/doctest.h>

#include "scenario.h"

#include "rock/mohr_coulomb/law.h"
#include "rock/stress_dependent_permeability.h"
#include "stockwork/rock/linear_law.h"

#include <deal.II/base/function_lib.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <random>
#include <sstream>

namespace stockwork::stress_dependent_permeability_test
{
using namespace dealii;

namespace
{
RockProperties properties()
{
  RockProperties rock;
  rock.young_modulus = 1e10;
  rock.poisson_ratio = 0.25;
  rock.biot_coefficient = 0.7;
  rock.inverse_biot_modulus = 1. / 12e9;
  rock.permeability = 3e-15;
  rock.permeability_across = 1e-15;
  rock.layer_normal[1] = 1.;
  rock.permeability_decay_stress = 7e6;
  return rock;
}


RockResponse ask(const RockLaw &law, const RockState &state)
{
  RockResponse response;
  std::vector<double> history(law.n_history() + 1);
  response.history = history.data();
  law.evaluate(ArrayView<const RockState>(&state, 1), ArrayView<RockResponse>(&response, 1));
  response.history = nullptr;
  return response;
}
} // namespace


TEST_CASE(
  "stress-dependent permeability: derivatives, in rock that is linear and in rock that yields")
{
  const RockProperties rock = properties();
  const mohr_coulomb::Strength strength{1e6, 0.5, 0.1};
  const StressDependentPermeability linear(std::make_unique<LinearRockLaw>(rock), rock),
    yielding(std::make_unique<mohr_coulomb::MohrCoulomb>(rock, strength), rock);
  std::mt19937 generator(4711);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const auto random = [&](const double size)
  {
    SymmetricTensor<2, 3> result;
    for (unsigned int i = 0; i < 6; ++i)
      result.access_raw_entry(i) = size * uniform(generator);
    return result;
  };
  for (const RockLaw *law : std::initializer_list<const RockLaw *>{&linear, &yielding})
    for (unsigned int i = 0; i < 200; ++i)
    {
      RockState state;
      state.in_situ_stress = -10e6 * unit_symmetric_tensor<3>() + random(1e6);
      state.in_situ_pressure = 2e6;
      state.strain = random(5e-4);
      state.pressure = 3e6 * uniform(generator);
      const RockResponse here = ask(*law, state);
      const SymmetricTensor<2, 3> direction = random(1.);
      const double step = 1e-9, pressure_step = 10.;
      RockState up = state, down = state;
      up.strain += step * direction;
      down.strain -= step * direction;
      const auto by_strain =
        (ask(*law, up).permeability - ask(*law, down).permeability) / (2. * step);
      const double size = (here.permeability_by_strain * direction).norm();
      CHECK((by_strain - here.permeability_by_strain * direction).norm() < 1e-5 * size);
      up = down = state;
      up.pressure += pressure_step;
      down.pressure -= pressure_step;
      const auto by_pressure =
        (ask(*law, up).permeability - ask(*law, down).permeability) / (2. * pressure_step);
      CHECK((by_pressure - here.permeability_by_pressure).norm() <
            1e-6 * here.permeability.norm() / 7e6);
    }
}


TEST_CASE("stress-dependent permeability: in tension it ends at a million times, and says so")
{
  const RockProperties rock = properties();
  const StressDependentPermeability law(std::make_unique<LinearRockLaw>(rock), rock);
  RockState state;
  const double full = std::log(1e6) * rock.permeability_decay_stress;
  const auto share = [&](const double tension)
  {
    state.in_situ_stress = tension * unit_symmetric_tensor<3>();
    return ask(law, state).permeability[0][0] / rock.permeability;
  };
  CHECK(share(0.5 * full) == doctest::Approx(1e3));
  CHECK(ask(law, state).remark == nullptr);
  for (const double tension : {1.01 * full, 1e4 * full}) // the exponential would not be a number
  {
    CHECK(share(tension) == doctest::Approx(1e6));
    const RockResponse response = ask(law, state);
    CHECK(response.permeability_by_strain.norm() == 0.);
    CHECK(response.permeability_by_pressure.norm() == 0.);
    CHECK(response.remark != nullptr);
  }
}


TEST_CASE("stress-dependent permeability: its value, in layered rock")
{
  const RockProperties rock = properties();
  const StressDependentPermeability law(std::make_unique<LinearRockLaw>(rock), rock);
  RockState state;
  state.in_situ_stress = -10e6 * unit_symmetric_tensor<3>();
  state.in_situ_pressure = 2e6;
  state.pressure = 1e6;
  // The pressure since in situ acts by alpha twice: the stress has changed by -alpha p as well.
  const double effective = 10e6 + 0.7 * 1e6 - 0.7 * (2e6 + 1e6);
  const SymmetricTensor<2, 3> k = ask(law, state).permeability;
  CHECK(k[0][0] == doctest::Approx(3e-15 * std::exp(-effective / 7e6)).epsilon(1e-12));
  CHECK(k[1][1] == doctest::Approx(1e-15 * std::exp(-effective / 7e6)).epsilon(1e-12));
  CHECK(k[0][1] == 0.);
}


namespace
{
// With the total stress -S along the column and no strain across it, the mean effective stress is
// (S - alpha p) m with m = (1 + nu) / (3 (1 - nu)). So k is k_1 exp(a p) with a = alpha m / s, and
// exp(a p) is linear along the column (Kirchhoff's transformation).
constexpr double load = 10e6, alpha = 0.8, nu = 0.25, decay = 4e6, inlet = 5e6, length = 10.;
constexpr double a = alpha * (1. + nu) / (3. * (1. - nu)) / decay;

/// The greatest error of the steady pressure over that at the inlet.
double error_of_column(std::vector<std::string> settings)
{
  settings.push_back("Nonlinear solver/Tolerance=1e-9"); // the elements' error is looked at
  Scenario scenario(STOCKWORK_SOURCE "/tests/rock/permeability.prm", settings);
  for (unsigned int step = 0; step < 10; ++step)
    scenario.advance();
  double worst = 0.;
  for (double y = 0.; y <= length; y += length / 8.)
  {
    Vector<double> values(3);
    VectorTools::point_value(*scenario.mapping, scenario.system.bulk_dofs(),
                             scenario.stepper.committed.bulk, Point<2>(0.5, y), values);
    const double exact = std::log(std::exp(a * inlet) * (1. - y / length) + y / length) / a;
    worst = std::max(worst, std::abs(values(2) - exact) / inlet);
  }
  const auto &context = scenario.stepper.last_context();
  const double flux =
    1e-12 / 1e-3 * std::exp(-load * a / alpha) * (std::exp(a * inlet) - 1.) / (a * length);
  const double left = scenario.system.pore_fluid(context, scenario.stepper.last_state()).outflow;
  CHECK(std::abs(left) < 1e-6 * flux * context.dt); // below in, above out
  return worst;
}
} // namespace


TEST_CASE("stress-dependent permeability: steady flow through a column")
{
  const double coarse = error_of_column({}),
               fine = error_of_column({"Mesh/Box/Y spacing=16 cells"});
  // A pressure that is linear in each cell has the exact mean of exp(a p) there, so the nodes are
  // exact, but for the quadrature.
  CHECK(coarse < 1e-12);
  CHECK(fine < 1e-12);

  // The flux that goes with it, k_1 (exp(a p) - 1) / (a mu L), in place of the pressure below.
  std::ostringstream flux;
  flux.precision(16);
  flux << 1e-12 / 1e-3 * std::exp(-load * a / alpha) * (std::exp(a * inlet) - 1.) / (a * length);
  const double driven = error_of_column(
    {"Boundary conditions/Pore pressure=", "Boundary conditions/Flux=bottom: " + flux.str()});
  CHECK(driven < 1e-9);
}


TEST_CASE("stress-dependent permeability: a damaged cell in the column")
{
  // A crack across the column that stays shut: k_n is the rock's present permeability, so that
  // nothing changes.
  const double error =
    error_of_column({"Fracture/Model=damage", "Fracture/damage/Fluid=permeability tensor",
                     "Fracture flow/Leak-off=resolved", "Fracture flow/Minimum aperture=10 nm",
                     "Rock/Fracture toughness=1 MPa m^0.5", "Cracks/Open=0, 4.4 -> 1, 4.4",
                     "Mesh/Box/X spacing=1 m"});
  CHECK(error < 1e-9);
}
} // namespace stockwork::stress_dependent_permeability_test
