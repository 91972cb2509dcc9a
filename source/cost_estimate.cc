#include "cost_estimate.h"

#include "solvers/linear_solver.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

namespace stockwork
{
namespace
{
constexpr double program_memory = 1.9e8; // deal.II, Trilinos and MPI, before any cell is made
constexpr double start_up = 0.5;         // loading libraries, making the mesh [s]
} // namespace

CostEstimate estimate_cost(const unsigned int dim,
                           const double n_unknowns,
                           const CostlyPhysics &physics,
                           const unsigned int n_ranks)
{
  const double n = std::max(n_unknowns, 2.);
  const double program =
    program_memory * n_ranks + (physics.fracture ? physics.memory_per_unknown * n : 0.);
  const double looking = physics.yields ? 1.7 : 1.;
  const double beside_fracture = physics.fracture ? physics.time_of_step : 1.;
  const bool lasting = !physics.pore_pressure && !physics.inertia && !physics.yields;
  if (dim == 3 && lasting && n <= largest_lasting_factor)
    return {program + 6e3 * n + 230. * std::pow(n, 4. / 3.), start_up + 1e-9 * n * n,
            physics.fracture ? 2e-7 * std::pow(n, 4. / 3.) * beside_fracture : 1e-6 * n};
  if (dim == 3)
    return {program + 1e4 * std::min(n, 3e4) + 6e3 * std::max(n - 3e4, 0.), start_up,
            4e-5 * n * (physics.fracture ? 4. : 1.) * looking};
  const double factor = 60. * n * std::log2(n);
  const double first_factor =
    3e-5 * n + 2e-8 * std::pow(n, 1.5); // with the analysis of its pattern
  const double new_factor = 1.5e-5 * n + 2.6e-8 * std::pow(n, 1.5), iteration = 1e-6 * n;
  const bool changes_with_step = physics.fracture && (physics.pore_pressure || physics.inertia);
  const double factors_per_step = changes_with_step                     ? 1.
                                  : physics.yields && !physics.fracture ? 3.
                                                                        : 0.;
  return {program + 2e3 * n + factor, start_up + first_factor,
          factors_per_step * new_factor +
            iteration * (physics.fracture ? 4. * beside_fracture : 1.) * looking};
}


CostEstimate explicit_cost(const ExplicitWork &work,
                           const double n_unknowns,
                           const double memory_per_unknown,
                           const unsigned int n_ranks)
{
  constexpr double time_of_term = 1e-9, time_of_unknown = 1e-8; // in each part [s]
  constexpr double beside_parts = 2e-6; // the fracture and the report, per unknown [s]
  return {program_memory * n_ranks + memory_per_unknown * n_unknowns, start_up,
          work.parts * (time_of_term * work.terms + time_of_unknown * n_unknowns) +
            beside_parts * n_unknowns};
}


double physical_memory(MPI_Comm communicator)
{
  // Ranks of one machine share its memory; limits count for each of them.
  MPI_Comm machine;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const bool first = dealii::Utilities::MPI::this_mpi_process(machine) == 0;
  MPI_Comm_free(&machine);
  const double installed = first ? double(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE) : 0.;
  rlimit limit;
  const double allowed = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
                           ? static_cast<double>(limit.rlim_cur)
                           : INFINITY;
  return std::min(dealii::Utilities::MPI::sum(installed, communicator),
                  dealii::Utilities::MPI::sum(allowed, communicator));
}


double resident_memory()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024. * usage.ru_maxrss;
}


namespace
{
std::string two_digits(const double value, const char *unit)
{
  std::ostringstream out;
  const double step =
    std::pow(10., std::max(std::floor(std::log10(std::max(value, 0.1))) - 1, -1.));
  out << step * std::round(value / step) << ' ' << unit;
  return out.str();
}
} // namespace


std::string in_bytes(const double bytes)
{
  return bytes < 1e9 ? two_digits(bytes / 1e6, "MB") : two_digits(bytes / 1e9, "GB");
}


std::string in_time(const double seconds)
{
  return seconds < 1.        ? two_digits(1000. * seconds, "ms")
         : seconds < 120.    ? two_digits(seconds, "s")
         : seconds < 7200.   ? two_digits(seconds / 60., "min")
         : seconds < 172800. ? two_digits(seconds / 3600., "h")
                             : two_digits(seconds / 86400., "days");
}


ExpectedSteps expected_steps(const StepControl &control,
                             const double duration,
                             const double dt,
                             const bool has_fracture,
                             const double cells)
{
  const double equal = std::ceil(duration / dt);
  if (equal <= 1. || control.growth == 1. || (control.growth < 0. && !has_fracture))
    return {equal, false};
  double number = 0.;
  if (std::isfinite(control.error_tolerance))
    // What diffuses changes with the logarithm of time. The error of a step of BDF2 is then as
    // (dt/t)^3, which the tolerance sets; the factor is that of mandel, column, cryer and drawdown.
    number = 0.55 * std::log(std::max(duration / dt, 2.)) / std::cbrt(control.error_tolerance);
  else if (!std::isnan(cells))
  {
    number = std::max({2. * cells, duration / control.maximum_step, 1.}); // step_limit()
    const double growth = control.growth < 0. ? growth_beside_fractures : control.growth;
    number += std::max(std::log(duration / number / dt) / std::log(growth), 0.);
  }
  else
    return {equal, true};
  return {std::min(std::ceil(number), equal), false};
}


std::string
in_words(const CostEstimate &cost, const ExpectedSteps &steps, const unsigned int n_ranks)
{
  std::ostringstream text;
  text << "roughly " << in_bytes(cost.memory) << " of memory"
       << (n_ranks > 1 ? " on " + std::to_string(n_ranks) + " ranks" : "") << ", "
       << in_time(cost.step) << " per step; " << (steps.at_most ? "at most " : "about ")
       << steps.number << " steps would take " << in_time(cost.start + steps.number * cost.step)
       << " on one core";
  if (steps.at_most)
    text << " if none were longer than the first";
  return text.str();
}
} // namespace stockwork
