// The law of the damage model: tangent, potential, energy, and the damage of a whole cell.
#include <doctest/doctest.h>

#include "fracture/damage/law.h"

#include <random>

namespace stockwork::damage_law_test
{
using namespace stockwork::damage;
using dealii::Tensor;

namespace
{
const SeamLaw law = SeamLaw::of_rock(1e6, 100., 0.01, 1. / 3.); // w_c = 200 um, w_0 = 2 um

template <int dim>
Tensor<1, dim> random_vector(std::mt19937 &random)
{
  std::normal_distribution<double> normal;
  Tensor<1, dim> v;
  for (unsigned int d = 0; d < dim; ++d)
    v[d] = normal(random);
  return v;
}


/// A jump with this opening and slip, the slip in a random direction.
template <int dim>
Tensor<1, dim>
jump_of(const Tensor<1, dim> &normal, const double opening, const double slip, std::mt19937 &random)
{
  Tensor<1, dim> along = random_vector<dim>(random);
  along -= (along * normal) * normal;
  return opening * normal + slip / along.norm() * along;
}


template <int dim>
void check_tangent()
{
  std::mt19937 random(7);
  // Opening, slip, and what has been reached before [um]: intact, softening, unloading and
  // reloading, broken, faces that touch, and all of these with slip.
  const double states[][3] = {{1., 0., 0.},   {0.8, 1.5, 0.},   {50., 0., 0.},    {50., 0., 20.},
                              {40., 90., 0.}, {30., 120., 60.}, {30., 0., 60.},   {20., 30., 100.},
                              {300., 0., 0.}, {10., 20., 200.}, {-5., 0., 0.},    {-5., 100., 0.},
                              {-5., 2., 0.},  {-5., 30., 80.},  {250., 100., 50.}};
  for (unsigned int repeat = 0; repeat < 5; ++repeat)
  {
    Tensor<1, dim> normal = random_vector<dim>(random);
    normal /= normal.norm();
    for (const auto &[opening, slip, greatest] : states)
    {
      CAPTURE(opening);
      CAPTURE(slip);
      CAPTURE(greatest);
      const Tensor<1, dim> jump = jump_of(normal, 1e-6 * opening, 1e-6 * slip, random);
      const auto response = law.evaluate(normal, jump, 1e-6 * greatest);
      const double step = 1e-10, stiffness = law.strength / law.start;
      for (unsigned int j = 0; j < dim; ++j)
      {
        Tensor<1, dim> less = jump, more = jump;
        less[j] -= step;
        more[j] += step;
        const auto difference = (law.evaluate(normal, more, 1e-6 * greatest).traction -
                                 law.evaluate(normal, less, 1e-6 * greatest).traction) /
                                (2. * step);
        for (unsigned int i = 0; i < dim; ++i)
          CHECK(std::abs(response.tangent[i][j] - difference[i]) < 1e-7 * stiffness);
      }
    }
  }
}


/// Work of the traction along straight pieces between these jumps, by the trapezoidal rule, and
/// what has been reached, which goes on from `greatest`.
template <int dim>
double work(const Tensor<1, dim> &normal, const std::vector<Tensor<1, dim>> &path, double &greatest)
{
  constexpr unsigned int n = 20000;
  double sum = 0.;
  for (unsigned int k = 0; k + 1 < path.size(); ++k)
  {
    const Tensor<1, dim> piece = (path[k + 1] - path[k]) / double(n);
    Tensor<1, dim> last = law.evaluate(normal, path[k], greatest).traction;
    for (unsigned int i = 1; i <= n; ++i)
    {
      const auto response = law.evaluate(normal, path[k] + double(i) * piece, greatest);
      sum += 0.5 * (last + response.traction) * piece;
      last = response.traction;
      greatest = response.greatest;
    }
  }
  return sum;
}


template <int dim>
void check_energy()
{
  std::mt19937 random(11);
  Tensor<1, dim> normal = random_vector<dim>(random);
  normal /= normal.norm();
  const auto at = [&](const double opening, const double slip)
  { return jump_of(normal, 1e-6 * opening, 1e-6 * slip, random); };
  const std::vector<std::vector<Tensor<1, dim>>> paths = {
    {at(0, 0), at(210, 0)},                                            // opening
    {at(0, 0), at(0, 400)},                                            // slip
    {at(0, 0), at(150, 150), at(250, 400)},                            // both
    {at(0, 0), at(30, 0), at(0, 0), at(90, 0), at(10, 0), at(210, 0)}, // unloaded
    {at(0, 0), at(0, 100), at(0, 0), at(80, 0), at(5, 60), at(-20, 90), at(210, 200), at(0, 0)}};
  for (const auto &path : paths)
  {
    double greatest = 0.;
    const double done = work(normal, path, greatest);
    CHECK(greatest >= law.critical);
    CHECK(done == doctest::Approx(100.).epsilon(1e-4));
    CHECK(law.dissipation(greatest) == doctest::Approx(100.).epsilon(1e-12));
  }
  // Half way: the work is what can be had back and what cannot.
  double greatest = 0.;
  const Tensor<1, dim> there = at(70, 50);
  const double done = work(normal, {at(0, 0), at(60, 0), at(10, 90), there}, greatest);
  const double held = 0.5 * (law.evaluate(normal, there, greatest).traction * there);
  CHECK(done == doctest::Approx(held + law.dissipation(greatest)).epsilon(1e-4));
  CHECK(held > 1.);
  CHECK(law.dissipation(greatest) > 10.);
  // A closed loop below what has been reached does no work, whatever way it takes.
  double same = 80e-6;
  std::vector<Tensor<1, dim>> loop = {at(10, 20), at(60, 0), at(40, 80), at(-10, 30)};
  loop.push_back(loop.front());
  CHECK(std::abs(work(normal, loop, same)) < 1e-4);
  CHECK(same == 80e-6);
}
} // namespace


TEST_CASE("the damage law: tangent against differences of the traction")
{
  check_tangent<2>();
  check_tangent<3>();
}


TEST_CASE("the damage law: peak, end, and a straight line between them")
{
  const Tensor<1, 2> normal({0.6, 0.8});
  const auto traction = [&](const double opening)
  { return law.evaluate(normal, opening * normal, 0.).traction * normal; };
  CHECK(law.critical == doctest::Approx(2e-4));
  CHECK(traction(law.start) == doctest::Approx(1e6));
  CHECK(traction(0.5 * law.start) == doctest::Approx(0.5e6));
  CHECK(traction(0.5 * (law.start + law.critical)) == doctest::Approx(0.5e6));
  CHECK(traction(law.critical) == 0.);
  CHECK(std::abs(traction(-1e-5)) < 1e-6); // faces that touch are another's business
  // In pure slip the energy is the same, so the strength is that of tension times sqrt(b).
  const Tensor<1, 2> along({-0.8, 0.6});
  const double slip = law.start / std::sqrt(law.shear_ratio);
  CHECK(law.evaluate(normal, slip * along, 0.).traction * along ==
        doctest::Approx(1e6 * std::sqrt(law.shear_ratio)));
}


TEST_CASE("the damage law: potential, and the fracture energy whatever the way")
{
  check_energy<2>();
  check_energy<3>();
}


TEST_CASE("damage of a cell: none before the peak, one when broken, and never less than before")
{
  for (const double rock : {1e9, 1e11, 1e14})
  {
    CHECK(law.damage(0., rock) == 0.);
    CHECK(law.damage(law.start, rock) == 0.);
    CHECK(law.damage(law.critical, rock) == 1.);
    CHECK(law.damage(10. * law.critical, rock) == 1.);
    double last = 0.;
    for (unsigned int i = 0; i <= 1000; ++i)
    {
      const double damage = law.damage(1.1e-3 * i * law.critical, rock);
      CHECK(damage >= last);
      CHECK(damage <= 1.);
      last = damage;
    }
  }
}
} // namespace stockwork::damage_law_test
