// What every fracture model must fulfil as part of the coupled system, whatever its physics:
//
//   contract_tests TEST DECK --set Fracture/Model=NAME
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "scenario.h"

#include "stockwork/base/command_line.h"
#include "stockwork/base/error.h"
#include "stockwork/base/lone_process.h"

#include <iostream>

using namespace stockwork;
using dealii::Vector;

namespace
{
CommandLine command_line;

std::vector<std::string> with(std::vector<std::string> settings)
{
  settings.insert(settings.begin(), command_line.overrides.begin(), command_line.overrides.end());
  return settings;
}

/// Reproducible numbers between -1 and 1.
class Noise
{
public:
  double operator()()
  {
    return -1. + 2. * engine() / (engine.max() + 1.);
  }

private:
  std::mt19937 engine{20161};
};

/// Bulk unknowns that move the body without straining it.
Vector<double> rigid_motion(const Scenario &scenario,
                            const dealii::Tensor<1, 2> &translation,
                            const double rotation)
{
  Vector<double> values(scenario.n_unknowns());
  const auto &fe = scenario.system.bulk_dofs().get_fe();
  std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
  for (const auto &cell : scenario.system.bulk_dofs().active_cell_iterators())
  {
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      const unsigned int component = fe.system_to_component_index(i).first;
      if (component == 2)
        continue;
      const auto x =
        scenario.mapping->transform_unit_to_real_cell(cell, fe.get_unit_support_points()[i]);
      values(dofs[i]) = translation[component] + rotation * (component == 0 ? -x[1] : x[0]);
    }
  }
  return values;
}

/// Of a bulk unknown or, behind these, an extra one.
double value(const Unknowns &unknowns, const unsigned int i)
{
  const unsigned int n_bulk = unknowns.bulk.size();
  return i < n_bulk ? double(unknowns.bulk(i)) : unknowns.extra[i - n_bulk];
}

const char *const field_names[] = {"displacement", "pore pressure", "model", "flow"};
} // namespace


TEST_CASE("rigid motion")
{
  // Nothing holds the body, nothing loads it.
  Scenario scenario(command_line.deck,
                    with({"Boundary conditions/Roller=", "Boundary conditions/Normal traction=",
                          "Wells/Well 1/Rate=0", "Verification/Reference=none"}));
  scenario.begin_step();
  const Unknowns rest = scenario.current;
  const unsigned int n = scenario.n_unknowns();

  // Once from rest, and once with all unknowns of the fracture moved, so that it is open.
  for (const bool open : {false, true})
  {
    Vector<double> start(n);
    Noise noise;
    for (unsigned int i = scenario.n_bulk(); open && i < n; ++i)
      start(i) = scenario.field(i) == 2 ? 1e-4 * noise() : 1e6 * noise();
    scenario.move(rest, start);
    const Vector<double> before = scenario.residual();
    const auto apertures =
      scenario.network().apertures(scenario.current, scenario.system.collectives());
    if (!open)
      CHECK(before.linfty_norm() == 0.);

    dealii::Tensor<1, 2> x, y;
    x[0] = y[1] = 1e-3;
    for (const Vector<double> &motion :
         {rigid_motion(scenario, x, 0.), rigid_motion(scenario, y, 0.),
          rigid_motion(scenario, dealii::Tensor<1, 2>(), 1e-4)})
    {
      Vector<double> moved = start;
      moved += motion;
      scenario.move(rest, moved);
      Vector<double> difference = scenario.residual();
      difference -= before;
      // Against the forces that would arise if the motion did not cancel.
      const double forces =
        scenario.linearise().bulk.block(0, 0).linfty_norm() * motion.linfty_norm();
      double greatest[4] = {0., 0., 0., 0.};
      for (unsigned int i = 0; i < n; ++i)
        greatest[scenario.field(i)] =
          std::max(greatest[scenario.field(i)], std::abs(difference(i)));
      std::cout << (open ? "open: " : "at rest: ");
      for (unsigned int f = 0; f < 4; ++f)
        std::cout << field_names[f] << ' ' << greatest[f] << (f < 3 ? ", " : "");
      std::cout << "; forces " << forces << '\n';
      const double volumes = motion.linfty_norm() * scenario.the_case->scene.domain_size;
      CHECK(greatest[0] < 1e-13 * forces);
      CHECK(greatest[1] < 1e-13 * volumes);
      CHECK(greatest[2] < 1e-13 * forces);
      CHECK(greatest[3] < 1e-13 * volumes);

      const auto now =
        scenario.network().apertures(scenario.current, scenario.system.collectives());
      for (unsigned int s = 0; s < now.size(); ++s)
        CHECK(std::abs(now[s] - apertures[s]) < 1e-13 * motion.linfty_norm());
    }
  }
}


TEST_CASE("derivative")
{
  Scenario scenario(command_line.deck, with({}));
  for (unsigned int step = 0; step < 8; ++step)
    scenario.advance();
  scenario.begin_step();
  const unsigned int n = scenario.n_unknowns(), n_bulk = scenario.n_bulk();

  // Typical sizes; then away from the accepted state, where laws have their kinks: it is where
  // unloading begins.
  double size[4] = {0., 0., 0., 0.};
  const Unknowns accepted = scenario.current;
  for (unsigned int i = 0; i < n; ++i)
    size[scenario.field(i)] = std::max(size[scenario.field(i)], std::abs(value(accepted, i)));
  Vector<double> change(n);
  Noise noise;
  for (unsigned int i = 0; i < n; ++i)
    change(i) = 0.1 * size[scenario.field(i)] * noise();
  scenario.move(accepted, change);
  const Unknowns state = scenario.current;

  // The state is one where everything happens at once.
  const FractureSummary summary =
    scenario.model().summary(scenario.state(), scenario.system.collectives());
  const auto apertures = scenario.network().apertures(state, scenario.system.collectives());
  const auto pressures = scenario.network().pressures(state);
  if (!apertures.empty())
  {
    const auto minmax = std::minmax_element(pressures.begin(), pressures.end());
    std::cout << apertures.size() << " segments, greatest aperture "
              << *std::max_element(apertures.begin(), apertures.end()) << " m, pressure "
              << *minmax.first << " to " << *minmax.second << " Pa; broken "
              << summary.broken_length << " of " << summary.length << " m\n";
    CHECK(*std::max_element(apertures.begin(), apertures.end()) > 0.);
    CHECK(*minmax.second > *minmax.first);
    if (summary.dissipated_energy > 0.)
      CHECK(summary.broken_length < summary.length);
  }

  const dealii::FullMatrix<double> matrix = scenario.matrix();
  if (scenario.system.nonlinear_rock() != nullptr)
    CHECK(scenario.linearise().rock_change != nullptr); // or nothing of it would be tested
  const auto &constraints = scenario.system.mesh_view().constraints;
  double error[4][4] = {}, greatest[4][4] = {};
  for (unsigned int j = 0; j < n; ++j)
  {
    if (j < n_bulk && constraints.is_constrained(j))
      continue;
    const unsigned int column = scenario.field(j);
    const double delta = 1e-6 * size[column]; // small, not to step over a kink
    Vector<double> direction(n);
    direction(j) = delta;
    scenario.move(state, direction);
    Vector<double> difference = scenario.residual();
    direction(j) = -delta;
    scenario.move(state, direction);
    difference -= scenario.residual();
    difference *= 0.5 / delta;
    for (unsigned int i = 0; i < n; ++i)
      if (i >= n_bulk || !constraints.is_constrained(i))
      {
        const unsigned int row = scenario.field(i);
        error[row][column] = std::max(error[row][column], std::abs(difference(i) - matrix(i, j)));
        greatest[row][column] = std::max(greatest[row][column], std::abs(matrix(i, j)));
      }
  }
  for (unsigned int row = 0; row < 4; ++row)
  {
    double terms = 0.; // of the residual, which are rounded even where they cancel
    for (unsigned int column = 0; column < 4; ++column)
      terms = std::max(terms, greatest[row][column] * size[column]);
    for (unsigned int column = 0; column < 4; ++column)
    {
      if (greatest[row][column] + error[row][column] == 0.)
        continue;
      std::cout << field_names[row] << " by " << field_names[column] << ": entries up to "
                << greatest[row][column] << ", error " << error[row][column] << '\n';
      CHECK(error[row][column] < 1e-6 * greatest[row][column] + 1e-9 * terms / size[column]);
    }
  }
}


TEST_CASE("rejected step")
{
  // A step that is thrown away and taken again with half its length, and one that has this length
  // at once, after growth and changes of the mesh.
  Scenario rejected(command_line.deck, with({"Time/Reject first attempt of step=7"})),
    straight(command_line.deck, with({}));
  for (Scenario *scenario : {&rejected, &straight})
    for (unsigned int step = 1; step < 7; ++step)
      scenario->advance();
  REQUIRE(rejected.time == straight.time);
  const double length = rejected.dt;
  straight.dt = 0.5 * length;
  for (Scenario *scenario : {&rejected, &straight})
  {
    scenario->advance();
    scenario->dt = length;
    scenario->advance();
  }
  CHECK(rejected.log.str().find("rejected as the deck demands") != std::string::npos);
  CHECK(rejected.time == straight.time);
  std::cout << "t = " << rejected.time << " s, " << rejected.n_unknowns() << " unknowns\n";

  REQUIRE(rejected.n_unknowns() == straight.n_unknowns());
  REQUIRE(rejected.system.extra_numbering().same_keys(straight.system.extra_numbering()));
  rejected.begin_step();
  straight.begin_step();
  double greatest[4] = {}, difference[4] = {};
  for (unsigned int i = 0; i < rejected.n_unknowns(); ++i)
  {
    const unsigned int field = rejected.field(i);
    const double a = value(rejected.current, i), b = value(straight.current, i);
    greatest[field] = std::max(greatest[field], std::abs(b));
    difference[field] = std::max(difference[field], std::abs(a - b));
  }
  for (unsigned int f = 0; f < 4; ++f)
  {
    std::cout << field_names[f] << ": up to " << greatest[f] << ", difference " << difference[f]
              << '\n';
    CHECK(difference[f] <= 1e-10 * greatest[f]);
  }
}


TEST_CASE("messages")
{
  // A fracture that reaches the end of a short domain in a step of 8 s, but not in one of 4 s.
  const auto messages = [](const std::string &step, const std::string &rejected)
  {
    Scenario scenario(command_line.deck,
                      with({"Mesh/Box/Upper corner=6 m, 8 m", "Time/Initial step=" + step,
                            "Time/Reject first attempt of step=" + rejected}));
    scenario.advance();
    return scenario.model().take_messages();
  };
  CHECK(messages("8 s", "0").size() == messages("4 s", "0").size() + 1);
  CHECK(messages("8 s", "1") == messages("4 s", "0"));
}


int main(int argc, char **argv)
{
  stockwork::start_lone_process_quickly();
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  doctest::Context context;
  context.setOption("test-case", argc > 1 ? argv[1] : "");
  try
  {
    command_line = parse_command_line(argc - 1, argv + 1);
  }
  catch (const InputError &error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return context.run();
}
