#include "stockwork/base/run_summary.h"

#include "stockwork/base/error.h"
#include "stockwork/base/json.h"
#include "stockwork/base/version.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <thread>

namespace stockwork
{
void write_summary(std::ostream &out, const RunSummary &summary)
{
  JsonWriter json(out);
  json.begin_object();
  json.member("case", summary.case_name);
  json.member("fracture_model", summary.fracture_model);
  json.member("deck", summary.deck);
  json.member("date", summary.date);
  json.member("machine", summary.machine);
  json.member("status", summary.status);
  if (!summary.reason.empty())
    json.member("reason", summary.reason);
  json.member("version", version());
  json.member("dealii_version", dealii_version());
  json.member("ranks", summary.ranks);
  json.member("cells", summary.cells);
  json.member("unknowns", summary.unknowns);
  json.member("steps", summary.steps);
  json.member("rejected_steps", summary.rejected_steps);
  json.member("nonlinear_iterations", summary.nonlinear_iterations);
  json.member("linear_iterations", summary.linear_iterations);

  json.begin_object("wall_seconds");
  for (const auto &[phase, seconds] : summary.wall_seconds)
    json.member(phase, seconds);
  json.end_object();

  json.member("cpu_seconds", summary.cpu_seconds);
  json.member("peak_memory_bytes", summary.peak_memory_bytes);
  if (!summary.before_physics.empty())
  {
    json.begin_object("before_physics");
    for (const auto &[entry, value] : summary.before_physics)
      json.member(entry, value);
    json.end_object();
  }

  json.begin_object("final");
  for (const auto &[column, value] : summary.final_values)
    if (std::isfinite(value))
      json.member(column, value);
  json.end_object();

  const auto write_errors = [&](const std::map<std::string, RunSummary::Error> &errors)
  {
    for (const auto &[quantity, error] : errors)
    {
      json.begin_object(quantity);
      json.member("final", error.final);
      json.member("mean", error.mean);
      json.member("reference", error.reference);
      json.end_object();
    }
  };
  json.begin_object("errors");
  write_errors(summary.errors);
  json.end_object();
  if (!summary.errors_against.empty())
  {
    json.begin_object("errors_against");
    for (const auto &[factor, errors] : summary.errors_against)
    {
      std::ostringstream name;
      name << std::setprecision(17) << factor;
      json.begin_object(name.str());
      write_errors(errors);
      json.end_object();
    }
    json.end_object();
  }

  const auto &balance = summary.fluid_balance;
  json.begin_object("fluid_balance");
  json.member("injected", balance.injected);
  json.member("in_fractures", balance.in_fractures);
  json.member("leaked", balance.leaked);
  json.member("stored", balance.stored);
  json.member("outflow", balance.outflow);
  json.member("relative_error", balance.relative_error);
  json.end_object();

  json.begin_array("warnings");
  for (const std::string &warning : summary.warnings)
    json.element(warning);
  json.end_array();
  json.end_object();
}

void write_summary(const std::string &file, const RunSummary &summary)
{
  const std::string unfinished = file + ".new";
  std::ofstream out(unfinished);
  write_summary(out, summary);
  out.close();
  if (!out)
    throw OutputError("cannot write '" + unfinished + "': " + std::strerror(errno));
  std::error_code error;
  std::filesystem::rename(unfinished, file, error);
  if (error)
    throw OutputError("cannot write '" + file + "': " + error.message());
}

double cpu_seconds(const MPI_Comm communicator)
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval &t) { return t.tv_sec + 1e-6 * t.tv_usec; };
  double mine = seconds(usage.ru_utime) + seconds(usage.ru_stime), sum = 0.;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, communicator);
  return sum;
}

std::string machine()
{
  char name[256] = "";
  gethostname(name, sizeof(name) - 1);
  std::string result = name;
  std::ifstream processors("/proc/cpuinfo");
  for (std::string line; std::getline(processors, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
    {
      result += ", " + line.substr(line.find(": ") + 2);
      break;
    }
  return result + ", " + std::to_string(std::thread::hardware_concurrency()) + " processors";
}

std::string utc_date()
{
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

std::uint64_t peak_memory(const MPI_Comm communicator)
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  const std::uint64_t unit = 1;
#else
  const std::uint64_t unit = 1024;
#endif
  const std::uint64_t mine = unit * static_cast<std::uint64_t>(usage.ru_maxrss);
  std::uint64_t sum = 0;
  MPI_Allreduce(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, communicator);
  return sum;
}
} // namespace stockwork
