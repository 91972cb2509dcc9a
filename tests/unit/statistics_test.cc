// The statistics table: what the file holds during the run, and after a restart.
#include "stockwork/base/error.h"
#include "stockwork/base/statistics.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

namespace stockwork::statistics_test
{
namespace
{
struct File
{
  ~File()
  {
    std::filesystem::remove(name);
  }
  std::string content() const
  {
    std::ostringstream text;
    text << std::ifstream(name).rdbuf();
    return text.str();
  }
  const std::string name = (std::filesystem::temp_directory_path() /
                            ("stockwork_statistics_" + std::to_string(::getpid()) + ".csv"))
                             .string();
};

void step(StatisticsTable &table, const double time)
{
  table.set("time", time, "s");
  table.set("fracture_length", 2 * time, "m");
  table.end_row();
}
} // namespace

TEST_CASE("a fracture is a line in the plane, an area in space")
{
  CHECK(unit_of_column("fracture_length", 2) == "m");
  CHECK(unit_of_column("reference_fracture_length", 3) == "m^2");
  CHECK(unit_of_column("injected_volume", 2) == "m^2");
  CHECK(unit_of_column("well_1_perforation_2_rate", 3) == "m^3/s");
  CHECK(unit_of_column("peak_load", 2) == "N/m");
  CHECK(unit_of_column("error_inlet_pressure", 2).empty());
  CHECK(unit_of_column("energy_balance_error", 2).empty());
  CHECK(unit_of_column("branches", 2).empty());
}

TEST_CASE("each row is in the file at once")
{
  const File file;
  StatisticsTable table;
  table.open(file.name);
  step(table, 1);
  CHECK(file.content() == "# time [s], fracture_length [m]\ntime,fracture_length\n1,2\n");
  step(table, 0.1);
  CHECK(file.content() == "# time [s], fracture_length [m]\ntime,fracture_length\n1,2\n0.1,0.2\n");
  CHECK(table.final_values().at("fracture_length") == 0.2);
}

TEST_CASE("a column that comes later is empty before, one that is not set is empty")
{
  const File file;
  StatisticsTable table;
  table.open(file.name);
  step(table, 1);
  table.set("tips", 2);
  step(table, 2);
  step(table, 3);
  CHECK(file.content() ==
        "# time [s], fracture_length [m], tips\ntime,fracture_length,tips\n1,2,\n2,4,2\n3,6,\n");
  CHECK(table.final_values().count("tips") == 0);
}

TEST_CASE("a restart keeps the rows up to its time and goes on as if nothing had happened")
{
  const File file;
  std::string whole;
  StatisticsTable first;
  first.open(file.name);
  for (const double time : {1. / 3, 2. / 3, 1., 4. / 3})
    step(first, time);
  whole = file.content();
  std::ofstream(file.name, std::ios::app) << "5"; // a row that was cut off

  StatisticsTable second;
  second.continue_from(file.name, 2. / 3);
  CHECK(second.n_rows() == 2);
  CHECK(second.final_values().at("time") == 2. / 3);
  step(second, 1.);
  step(second, 4. / 3);
  CHECK(file.content() == whole);
}

TEST_CASE("a table that cannot be written says so")
{
  StatisticsTable table;
  CHECK_THROWS_AS(table.open("/no/such/directory/statistics.csv"), OutputError);
}

TEST_CASE("infinite and undefined values are left empty")
{
  const File file;
  StatisticsTable table;
  table.open(file.name);
  table.set("time", 1., "s");
  table.set("ratio", 0. / 0.);
  table.end_row();
  CHECK(file.content() == "# time [s], ratio\ntime,ratio\n1,\n");
}
} // namespace stockwork::statistics_test
