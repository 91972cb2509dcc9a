// What a run says about itself: JSON, summary, timers, warnings, progress, parameter manual.
#include "stockwork/base/deck.h"
#include "stockwork/base/error.h"
#include "stockwork/base/json.h"
#include "stockwork/base/parameters.h"
#include "stockwork/base/progress.h"
#include "stockwork/base/quantity.h"
#include "stockwork/base/run_context.h"
#include "stockwork/base/run_summary.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>
#include <doctest/doctest.h>

#include <cmath>
#include <sstream>
#include <thread>

namespace stockwork::run_output_mpi_test
{
namespace
{
boost::property_tree::ptree read_json(const std::string &text)
{
  std::istringstream in(text);
  boost::property_tree::ptree tree;
  boost::property_tree::read_json(in, tree);
  return tree;
}

void wait(const unsigned int milliseconds)
{
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}
} // namespace

TEST_CASE("JSON has true numbers and escaped text")
{
  std::ostringstream out;
  JsonWriter json(out);
  json.begin_object();
  json.member("third", 1. / 3);
  json.member("tenth", 0.1);
  json.member("count", 3u);
  json.member("text", "a \"b\" \\ \n c");
  json.member("yes", true);
  json.begin_array("none");
  json.end_array();
  json.begin_array("some");
  json.element("x");
  json.element(2.);
  json.end_array();
  json.end_object();
  CHECK(out.str() == "{\n"
                     "  \"third\": 0.3333333333333333,\n"
                     "  \"tenth\": 0.1,\n"
                     "  \"count\": 3,\n"
                     "  \"text\": \"a \\\"b\\\" \\\\ \\n c\",\n"
                     "  \"yes\": true,\n"
                     "  \"none\": [],\n"
                     "  \"some\": [\n"
                     "    \"x\",\n"
                     "    2\n"
                     "  ]\n"
                     "}\n");
  CHECK_THROWS_AS(json.member("bad", std::nan("")), OutputError);
  CHECK_THROWS_AS(json.member("bad", 1. / 0.), OutputError);
}

TEST_CASE("the summary has the promised keys")
{
  RunSummary summary;
  summary.case_name = "kgd/cohesive_xfem";
  summary.steps = 12;
  summary.wall_seconds = PhaseTimers().seconds(MPI_COMM_WORLD);
  summary.cpu_seconds = cpu_seconds(MPI_COMM_WORLD);
  summary.machine = machine();
  summary.date = utc_date();
  summary.peak_memory_bytes = peak_memory(MPI_COMM_WORLD);
  summary.final_values["inlet_pressure"] = 1e6;
  summary.final_values["undefined"] = std::nan("");
  summary.errors["pore_pressure"] = {0.01, 0.02, "Mandel (1953)"};
  summary.warnings = {"one"};
  summary.before_physics["Time/Inertia"] = "off";
  std::ostringstream out;
  write_summary(out, summary);
  const auto tree = read_json(out.str());
  for (const char *key : {"case",
                          "fracture_model",
                          "deck",
                          "date",
                          "machine",
                          "version",
                          "dealii_version",
                          "ranks",
                          "cells",
                          "unknowns",
                          "steps",
                          "rejected_steps",
                          "nonlinear_iterations",
                          "linear_iterations",
                          "wall_seconds.total",
                          "wall_seconds.assembly",
                          "wall_seconds.preconditioner",
                          "wall_seconds.solve",
                          "wall_seconds.fracture",
                          "wall_seconds.output",
                          "cpu_seconds",
                          "peak_memory_bytes",
                          "final.inlet_pressure",
                          "errors.pore_pressure.final",
                          "errors.pore_pressure.mean",
                          "errors.pore_pressure.reference",
                          "fluid_balance.injected",
                          "fluid_balance.in_fractures",
                          "fluid_balance.leaked",
                          "fluid_balance.stored",
                          "fluid_balance.outflow",
                          "fluid_balance.relative_error",
                          "before_physics.Time/Inertia",
                          "warnings"})
  {
    CAPTURE(key);
    CHECK(tree.get_child_optional(key).has_value());
  }
  CHECK_FALSE(tree.get_child_optional("final.undefined").has_value());
  CHECK(tree.get<double>("errors.pore_pressure.mean") == 0.02);
  CHECK(summary.cpu_seconds > 0.);
  CHECK(summary.machine.find(" processors") != std::string::npos);
  CHECK(summary.date.size() == 20);
  // A process with deal.II loaded takes more than a megabyte and less than this machine has.
  CHECK(summary.peak_memory_bytes > 1e6);
  CHECK(summary.peak_memory_bytes < 1e12);
  CHECK_THROWS_AS(write_summary(std::string("/no/such/directory/summary.json"), summary),
                  OutputError);
}

TEST_CASE("phases inside phases are counted once")
{
  PhaseTimers timers;
  {
    const auto solve = timers.scope("solve");
    wait(20);
    {
      const auto preconditioner = timers.scope("preconditioner");
      wait(40);
    }
    wait(20);
  }
  wait(20);
  // Of one rank: the greatest of all ranks, phase by phase, need not add up.
  const auto seconds = timers.seconds(MPI_COMM_SELF);
  CHECK(seconds.at("solve") >= 0.04);
  CHECK(seconds.at("preconditioner") >= 0.04);
  CHECK(seconds.at("assembly") == 0);
  CHECK(seconds.at("total") >= 0.1);
  CHECK(seconds.at("solve") + seconds.at("preconditioner") <= seconds.at("total") - 0.02 + 1e-9);

  std::ostringstream table;
  timers.print(table, MPI_COMM_WORLD, 2);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    CHECK(table.str().find("preconditioner") < table.str().find("everything else"));
  else
    CHECK(table.str().empty());
}

TEST_CASE("a warning is said once and kept")
{
  std::ostringstream out;
  RunContext context(MPI_COMM_WORLD, out);
  context.warn("the mesh is coarse");
  context.warn("the mesh is coarse");
  CHECK(out.str() == (context.rank == 0 ? "Warning: the mesh is coarse\n" : ""));
  CHECK(context.warnings.size() == 1);
}

TEST_CASE("the progress line stays in its columns")
{
  Progress progress;
  progress.step = 12;
  progress.time = 25;
  progress.end_time = 100;
  progress.time_step = 0.5;
  progress.nonlinear_iterations = 4;
  progress.linear_iterations = 61;
  progress.fracture_length = 12.5;
  progress.inlet_aperture = 1.234e-3;
  progress.inlet_pressure = 3.21e6;
  progress.fluid_balance = 1e-11;
  progress.wall_seconds = 10;
  const std::string header = progress_header(2);
  const std::string line = progress_line(progress);
  CHECK(line ==
        "    12        25   25.0       0.5       4/61    12.5     1.234      3.21   1.0e-11 "
        "     30 s");
  progress = Progress();
  CHECK(progress_line(progress).size() == line.size());
  CHECK(header.find('\n') == line.size());
  CHECK(header.find(" length ") != std::string::npos);
  CHECK(progress_header(3).find(" area ") != std::string::npos);
  CHECK(progress_header(3).size() == header.size());
  CHECK(duration_text(7200) == "2.0 h");
}

TEST_CASE("the parameter manual names unit, range and meaning")
{
  dealii::ParameterHandler prm;
  Deck::declare_parameters(prm);
  prm.enter_subsection("Rock");
  prm.declare_entry("Young modulus", "20 GPa", Quantity(dimension::stress, Range::positive()),
                    "stiffness of the drained rock | frame");
  prm.declare_entry("Corners", "1, 2", Quantities(dimension::length, Range::any(), 2, 3), "");
  prm.declare_entry("Weights", "1", dealii::Patterns::List(dealii::Patterns::Double(0)), "");
  prm.leave_subsection();
  for (const char *well : {"Well 1", "Well 2", "Well 3"})
  {
    prm.enter_subsection(well);
    prm.declare_entry("Rate", "0", Quantity(dimension::rate), "");
    prm.leave_subsection();
  }

  std::ostringstream markdown, text, json;
  print_parameters(prm, "markdown", markdown);
  const auto has = [&](const std::string &part)
  { return markdown.str().find(part) != std::string::npos; };
  CHECK(has("## Rock"));
  CHECK(has("## Well 1 to 3\n"));
  CHECK_FALSE(has("## Well 2"));
  CHECK(
    has("| Young modulus | `20 GPa` | a stress > 0 Pa | Stiffness of the drained rock \\| frame "
        "|"));
  CHECK(has("| Corners | `1, 2` | a list separated by commas of 2 to 3, each a length (m) |"));
  CHECK(has("a list separated by ',', each a number >= 0"));
  CHECK(has("one of 'auto', 'coarse', 'medium' or 'fine'"));

  // What is printed as a deck is a deck with the same values.
  print_parameters(prm, "prm", text);
  const std::uint64_t before = fingerprint(prm);
  prm.clear();
  print_parameters(prm, "json", json);
  CHECK(before != fingerprint(prm));
  CHECK(Deck::read_text(text.str()).peek("Rock/Young modulus").value() == "20 GPa");
  CHECK_THROWS_AS(print_parameters(prm, "xml", text), InputError);
}
} // namespace stockwork::run_output_mpi_test
