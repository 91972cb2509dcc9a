#pragma once

#include <limits>
#include <ostream>
#include <string>

namespace stockwork
{
/// What the terminal shows of one accepted step. Members that are not finite are shown as '-'.
struct Progress
{
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  unsigned int step = 0;
  double time = 0; ///< [s]
  double start_time = 0;
  double end_time = unknown;
  double time_step = 0;
  unsigned int nonlinear_iterations = 0;
  unsigned long linear_iterations = 0;
  unsigned int rejected = 0;        ///< attempts before this one
  double fracture_length = unknown; ///< [m], in 3-D the area [m^2]
  double inlet_aperture = unknown;  ///< [m]
  double inlet_pressure = unknown;  ///< [Pa]
  double fluid_balance = unknown;   ///< relative error
  double wall_seconds = 0;          ///< since the start of this run
  double fraction_at_start = 0;     ///< of the time, where this run began (restart)
};

/// The two lines above the columns. In 3-D the "length" of a fracture is its area.
std::string progress_header(unsigned int dim);

/// One line, without end of line. The time left is estimated from the simulated time done since
/// the start of this run.
std::string progress_line(const Progress &progress);

/// "45 s", "12 min", "3.4 h", "2.1 d"
std::string duration_text(double seconds);
} // namespace stockwork
