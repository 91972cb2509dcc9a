// The contract of a fracture model where matrices are too large to be looked at entry by entry, or
// in pieces: in three dimensions, and on several ranks.
//
//   contract_mpi_tests 2|3 DECK --set Fracture/Model=NAME
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "contract/directions.h"

#include "stockwork/base/command_line.h"
#include "stockwork/base/error.h"
#include "stockwork/base/lone_process.h"

#include <iostream>
#include <limits>

using namespace stockwork;

namespace
{
CommandLine command_line;
const char *const field_names[] = {"displacement", "pore pressure", "model", "flow"};

/// Numbers between -1 and 1 times a size for one of the fields; nothing elsewhere, and nothing
/// where there are constraints.
template <int dim>
Direction
noise(const ScenarioIn<dim> &scenario, const std::array<double, 4> &size, const unsigned int seed)
{
  const auto &system = scenario.system;
  Direction result{system.owned_vector(), std::vector<double>(scenario.current.extra.size())};
  std::uniform_real_distribution<double> uniform(-1., 1.);
  std::mt19937 local(seed + 1000 * (1 + system.collectives().rank())), shared(seed);
  for (const auto i : result.bulk.locally_owned_elements())
    result.bulk(i) = size[i < result.bulk.block(0).size() ? 0 : 1] * uniform(local);
  result.bulk.compress(dealii::VectorOperation::insert);
  system.mesh_view().constraints.set_zero(result.bulk);
  const unsigned int n_model = scenario.the_case->model->extra_unknowns().size();
  for (unsigned int i = 0; i < result.extra.size(); ++i)
    result.extra[i] = size[i < n_model ? 2 : 3] * uniform(shared);
  return result;
}


template <int dim>
void check_derivative()
{
  ScenarioIn<dim> scenario(command_line.deck, command_line.overrides);
  for (unsigned int step = 0; step < 3; ++step)
    scenario.advance();
  scenario.begin_step();
  const Unknowns accepted = scenario.current;
  Direction values{scenario.system.owned_vector(), accepted.extra};
  values.bulk = accepted.bulk;
  const std::array<double, 4> size = greatest(scenario, values);
  std::array<double, 4> away = size;
  for (double &value : away)
    value *= 0.1;
  const Direction change = noise(scenario, away, 1);
  residual(scenario, accepted, 1., change);
  const Unknowns state = scenario.current;

  constexpr double delta = 1e-7; // small, not to step over a kink
  std::array<std::array<double, 4>, 4> errors{}, entries{};
  for (unsigned int column = 0; column < 4; ++column)
  {
    if (size[column] == 0.)
      continue;
    std::array<double, 4> only{};
    only[column] = size[column];
    const Direction direction = noise(scenario, only, 2 + column);
    Direction difference = residual(scenario, state, delta, direction);
    const Direction below = residual(scenario, state, -delta, direction);
    difference.bulk -= below.bulk;
    difference.bulk *= 0.5 / delta;
    residual(scenario, state, 0., direction);
    const Direction exact = product(scenario, scenario.linearise(), direction);
    difference.bulk -= exact.bulk;
    for (unsigned int i = 0; i < exact.extra.size(); ++i)
      difference.extra[i] = (difference.extra[i] - below.extra[i]) * 0.5 / delta - exact.extra[i];
    errors[column] = greatest(scenario, difference);
    entries[column] = greatest(scenario, exact);
  }

  for (unsigned int row = 0; row < 4; ++row)
  {
    // The terms of a row are as large as what a whole step of any field does to it, and so is what
    // rounding leaves of their difference.
    double terms = 0.;
    for (unsigned int column = 0; column < 4; ++column)
      terms = std::max(terms, entries[column][row]);
    const double rounding = std::numeric_limits<double>::epsilon() / delta * terms;
    for (unsigned int column = 0; column < 4; ++column)
    {
      const double error = errors[column][row], entry = entries[column][row];
      if (entry + error == 0.)
        continue;
      if (scenario.system.collectives().rank() == 0)
        std::cout << field_names[row] << " along " << field_names[column] << ": up to " << entry
                  << ", error " << error << '\n';
      CHECK(error < 1e-6 * entry + rounding);
    }
  }
}


unsigned int space_dimension = 2;
} // namespace


TEST_CASE("derivative along directions")
{
  if (space_dimension == 2)
    check_derivative<2>();
  else
    check_derivative<3>();
}


int main(int argc, char **argv)
{
  stockwork::start_lone_process_quickly();
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  doctest::Context context;
  try
  {
    space_dimension = argc > 1 ? std::stoi(argv[1]) : 2;
    command_line = parse_command_line(argc - 1, argv + 1);
  }
  catch (const std::exception &error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return context.run();
}
