#include "stockwork/base/progress.h"

#include <cmath>
#include <cstdio>

namespace stockwork
{
namespace
{
/// The number in a column of this width, '-' if it is not known.
std::string column(const char *format, const int width, const double value)
{
  char text[64];
  if (std::isfinite(value))
    std::snprintf(text, sizeof(text), format, value);
  else
    std::snprintf(text, sizeof(text), "-");
  char padded[64];
  std::snprintf(padded, sizeof(padded), "%*s", width, text);
  return padded;
}

std::string column(const int width, const std::string &text)
{
  return text.size() >= static_cast<std::size_t>(width)
           ? text
           : std::string(width - text.size(), ' ') + text;
}
} // namespace

std::string duration_text(const double seconds)
{
  char text[32];
  if (!std::isfinite(seconds))
    return "-";
  if (seconds < 100)
    std::snprintf(text, sizeof(text), "%.0f s", seconds);
  else if (seconds < 100 * 60)
    std::snprintf(text, sizeof(text), "%.0f min", seconds / 60);
  else if (seconds < 48 * 3600)
    std::snprintf(text, sizeof(text), "%.1f h", seconds / 3600);
  else
    std::snprintf(text, sizeof(text), "%.1f d", seconds / 86400);
  return text;
}

std::string progress_header(const unsigned int dim)
{
  return std::string("  step     time       %        dt   nonl/lin  ") +
         (dim == 2 ? "length" : "  area") +
         "  aperture  pressure   balance      left\n"
         "              s                 s                " +
         (dim == 2 ? "  m" : "m^2") + "        mm       MPa         -";
}

std::string progress_line(const Progress &p)
{
  const double fraction = (p.time - p.start_time) / (p.end_time - p.start_time);
  const double left = p.wall_seconds * (1 - fraction) / (fraction - p.fraction_at_start);
  std::string line =
    column("%.0f", 6, p.step) + column("%.4g", 10, p.time) + column("%.1f", 7, 100 * fraction) +
    column("%.3g", 10, p.time_step) +
    column(11, std::to_string(p.nonlinear_iterations) + "/" + std::to_string(p.linear_iterations)) +
    column("%.4g", 8, p.fracture_length) + column("%.4g", 10, 1e3 * p.inlet_aperture) +
    column("%.4g", 10, 1e-6 * p.inlet_pressure) + column("%.1e", 10, p.fluid_balance) +
    column(10, duration_text(left));
  if (p.rejected > 0)
    line += "  (" + std::to_string(p.rejected) + " rejected)";
  return line;
}
} // namespace stockwork
