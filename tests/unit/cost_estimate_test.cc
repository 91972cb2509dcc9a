// The number of steps that --check announces, beside those that runs of the shipped cases took
// (doc/cases: kgd, mandel, column, cryer, drawdown).
#include <doctest/doctest.h>

#include <limits>
#include <tuple>

#include "cost_estimate.h"

namespace stockwork::cost_estimate_test
{
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

StepControl control(const double maximum_step, const double growth, const double tolerance)
{
  StepControl c{};
  c.maximum_step = maximum_step;
  c.growth = growth;
  c.error_tolerance = tolerance;
  return c;
}

void check_within_half(const ExpectedSteps &expected, const double taken)
{
  CHECK_FALSE(expected.at_most);
  CHECK(expected.number > taken / 1.5);
  CHECK(expected.number < taken * 1.5);
}

void check_within(const double factor, const double expected, const double seen)
{
  CHECK(expected > seen / factor);
  CHECK(expected < factor * seen);
}

TEST_CASE("a tip crosses a cell in every other step")
{
  const StepControl c = control(2., -1., infinite);
  check_within_half(expected_steps(c, 100., 0.02, true, 39.),
                    107.); // kgd/toughness, half-length 20.1 m
  check_within_half(expected_steps(c, 100., 0.02, true, 78.), 181.);
  check_within_half(expected_steps(c, 100., 0.02, true, 157.), 335.);
  CHECK(expected_steps(c, 100., 0.02, true, 0.).number >= 50.); // the maximum step
  CHECK(expected_steps(c, 1., 0.5, true, 157.).number == 2.);   // no more than equal steps
}

TEST_CASE("steps chosen by their error follow the logarithm of time")
{
  check_within_half(expected_steps(control(infinite, 2., 1e-4), 21493., 2., false, 0.), 106.);
  check_within_half(expected_steps(control(infinite, 2., 2e-6), 21493., 2., false, 0.), 369.);
  check_within_half(expected_steps(control(infinite, 2., 1.5e-5), 600., 0.02, false, 0.), 238.);
  check_within_half(expected_steps(control(infinite, 2., 2e-4), 2., 0.001, false, 0.), 71.);
  check_within_half(expected_steps(control(infinite, 2., 1e-3), 86400., 60., false, 0.), 56.);
}

TEST_CASE("what lasts no longer than a step is dear beside a fracture")
{
  // Seen with 8000 unknowns: 5.3 to 7.1 times with inertia, 4.2 to 7.6 with pores, 1.5 to 2.6 where
  // rock may yield (doc/deck.md).
  const auto times = [](const CostlyPhysics &with, const CostlyPhysics &without)
  { return estimate_cost(2, 8e3, with).step / estimate_cost(2, 8e3, without).step; };
  CHECK(times({true, false, true, false}, {true, false, false, false}) ==
        doctest::Approx(5.3).epsilon(0.3));
  CHECK(times({true, true, false, false}, {true, false, false, false}) ==
        doctest::Approx(6.).epsilon(0.3));
  CHECK(times({true, false, false, true}, {true, false, false, false}) ==
        doctest::Approx(2.).epsilon(0.3));
  CHECK(times({false, true, true, false}, {}) == doctest::Approx(1.));
}

TEST_CASE("equal steps are counted; where nothing tells how they grow, that is said")
{
  CHECK(expected_steps(control(infinite, -1., infinite), 1., 0.1, false, 0.).number == 10.);
  CHECK_FALSE(expected_steps(control(infinite, -1., infinite), 1., 0.1, false, 0.).at_most);
  const ExpectedSteps steps =
    expected_steps(control(infinite, -1., infinite), 1., 0.1, true, unknown);
  CHECK(steps.at_most);
  CHECK(steps.number == 10.);
  CHECK(
    in_words({2e8, 0.5, 0.014}, steps) ==
    "roughly 200 MB of memory, 14 ms per step; at most 10 steps would take 640 ms on one core if "
    "none were longer than the first");
}

TEST_CASE("memory of factors that last")
{
  CostlyPhysics crack;
  crack.fracture = true;
  // radial/small/damage, coarse, medium, and on cells of 4 cm: peak_memory_bytes of summary.json.
  for (const auto &[unknowns, bytes] :
       {std::pair(29052., 425013248.), {48126., 635916288.}, {88212., 1207078912.}})
  {
    const double expected = estimate_cost(3, unknowns, crack).memory;
    CHECK(expected > bytes);
    CHECK(expected < 1.5 * bytes);
  }
}

TEST_CASE("a step with a factor that lasts, in three dimensions")
{
  CostlyPhysics crack;
  crack.fracture = true;
  // cpu_seconds / steps of radial/small, carter and toughness with damage, coarse and medium, and
  // the unknowns at their ends.
  for (const auto &[unknowns, seconds] : {std::pair(29432., 0.156),
                                          {48810., 0.267},
                                          {41216., 0.241},
                                          {82246., 0.675},
                                          {42799., 0.340},
                                          {97301., 1.90}})
  {
    const double expected = estimate_cost(3, unknowns, crack).step;
    check_within(2.5, expected, seconds);
  }
}

TEST_CASE("the first factor is what a static run in two dimensions takes")
{
  CostlyPhysics crack;
  crack.fracture = true;
  // unknowns, cpu_seconds of sneddon and inclined/* with cohesive_xfem, damage and prescribed, one
  // step.
  for (const auto &[unknowns, seconds] : {std::pair(425950., 34.8),
                                          {425678., 19.4},
                                          {131514., 6.0},
                                          {107174., 6.4},
                                          {72226., 3.6},
                                          {44618., 2.2},
                                          {10470., 0.7}})
  {
    const CostEstimate expected = estimate_cost(2, unknowns, crack);
    check_within(2., expected.start + expected.step, seconds);
  }
}

TEST_CASE("a step of bonds")
{
  CostlyPhysics bonds;
  bonds.fracture = true;
  bonds.time_of_step = 7.5; // Peridynamics<2>::requirements()
  // kgd/sun and kgd/toughness, coarse to fine: cpu_seconds / steps, unknowns at the end.
  for (const auto &[unknowns, seconds] : {std::pair(3413., 0.144),
                                          {6689., 0.234},
                                          {11844., 0.547},
                                          {8027., 0.163},
                                          {11491., 0.292},
                                          {18642., 0.708}})
  {
    const double expected = estimate_cost(2, unknowns, bonds).step;
    check_within(2., expected, seconds);
  }
}

TEST_CASE("rock that is loaded until it yields has new factors")
{
  CostlyPhysics rock;
  rock.yields = true;
  // footing/bearing and borehole/expansion, coarse: unknowns, steps, cpu_seconds.
  for (const auto &[unknowns, steps, seconds] : {std::tuple(3566., 50., 12.2), {1750., 20., 1.25}})
  {
    const CostEstimate expected = estimate_cost(2, unknowns, rock);
    check_within(3., expected.start + steps * expected.step, seconds);
  }
}

TEST_CASE("every rank loads the program, and a model keeps what it keeps")
{
  CostlyPhysics bonds;
  bonds.fracture = true;
  const double one = estimate_cost(2, 1e4, bonds).memory;
  CHECK(estimate_cost(2, 1e4, bonds, 2).memory - one > 1e8);
  bonds.memory_per_unknown = 12e3;
  CHECK(estimate_cost(2, 1e4, bonds).memory - one == doctest::Approx(12e3 * 1e4));
}
} // namespace stockwork::cost_estimate_test
