#pragma once

#include <mpi.h>

#include <cstdint>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace stockwork
{
/// What summary.json says about a run. The keys of the file are the names of the members.
struct RunSummary
{
  /// Of one quantity against the reference solution of the case. Relative.
  struct Error
  {
    double final = 0;      ///< at the end time
    double mean = 0;       ///< over the run
    std::string reference; ///< which solution: "Cryer (1963)"
  };

  /// Volumes since the start [m^3; m^2 in plane strain, per metre of thickness].
  struct FluidBalance
  {
    double injected = 0;
    double in_fractures = 0;
    double leaked = 0;         ///< by a leak-off law, out of the model
    double stored = 0;         ///< in the pores
    double outflow = 0;        ///< through the boundary
    double relative_error = 0; ///< what is missing over what was injected
  };

  std::string case_name; ///< key "case"
  std::string fracture_model;
  std::string deck;                ///< its path
  std::string machine;             ///< machine()
  std::string date;                ///< of the end, utc_date()
  std::string status = "finished"; ///< or "failed"
  std::string reason;              ///< why it failed
  unsigned int ranks = 1;
  std::uint64_t cells = 0;
  std::uint64_t unknowns = 0;
  std::uint64_t steps = 0;
  std::uint64_t rejected_steps = 0;
  std::uint64_t nonlinear_iterations = 0;
  std::uint64_t linear_iterations = 0;
  std::map<std::string, double> wall_seconds; ///< PhaseTimers::seconds()
  double cpu_seconds = 0; ///< cpu_seconds(), since this run or its last restart began
  std::uint64_t peak_memory_bytes = 0;
  std::map<std::string, double> final_values; ///< key "final", StatisticsTable::final_values()
  std::map<std::string, Error> errors;
  std::map<double, std::map<std::string, Error>> errors_against; ///< by wrong factor
  FluidBalance fluid_balance;
  std::vector<std::string> warnings;

  /// What the deck said of entries that 'Physics = auto' has set: it is the problem that the run
  /// solves with less. The key is left out where there are none.
  std::map<std::string, std::string> before_physics;
};

/// Write the summary as JSON. Final values that are not finite are left out.
/// @throws OutputError if another number is not finite
void write_summary(std::ostream &out, const RunSummary &summary);

/// Write summary.json; the file appears complete or not at all. To be called on rank 0.
/// @throws OutputError
void write_summary(const std::string &file, const RunSummary &summary);

/// Time that processors have worked for this run, summed over the ranks [s]. Collective.
double cpu_seconds(MPI_Comm communicator);

/// Name, processor and number of processors of this computer.
std::string machine();

/// Now, as in 2024-02-29T12:34:56Z.
std::string utc_date();

/// The greatest resident memory so far, summed over the ranks [bytes]. Collective.
std::uint64_t peak_memory(MPI_Comm communicator);
} // namespace stockwork
