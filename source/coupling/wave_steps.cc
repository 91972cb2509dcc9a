#include "coupling/wave_steps.h"

#include "rock/wave_speeds.h"

#include "stockwork/base/quantity.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace stockwork
{
using namespace dealii;

namespace
{
/// A tip goes from segment to segment, so its speed is a mean over some of them.
constexpr unsigned int segments_of_a_speed = 5;
/// Over the time that the fastest wave takes through a segment.
constexpr double share_of_crossing = 0.5;
} // namespace


void WaveSteps::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Time");
  prm.declare_entry(
    "Waves resolved above", "inf", Quantity(dimension::number, Range{0., INFINITY, true, false}),
    "A speed of tips over that of Rayleigh waves, such as 0.1, below which inertia hardly matters. "
    "With Newmark's scheme, while a tip runs faster, in the mean over five segments of the "
    "fracture, steps are at most half of the time that the fastest wave takes through a segment; "
    "one that turns out too long (by a half) is taken again. The fluid shall be compressible, or "
    "its pressure swings in steps that short. 'inf': steps are as long as the front lets them be, "
    "and filter the waves; if a tip then runs at more than 0.1, the run says so.");
  prm.leave_subsection();
}


void WaveSteps::parse_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Time");
  threshold = get_quantity(prm, "Waves resolved above", dimension::number);
  prm.leave_subsection();
}


bool WaveSteps::are_wanted() const
{
  return std::isfinite(threshold);
}


template <int dim>
void WaveSteps::set_segments(const std::vector<NetworkSegment<dim>> &segments, const Rock &rock)
{
  double sum = 0., fastest = 0.;
  std::set<std::pair<types::material_id, bool>> seen;
  rayleigh_speed = std::numeric_limits<double>::infinity();
  for (const NetworkSegment<dim> &segment : segments)
  {
    sum += segment.size();
    if (!seen.insert({segment.region, segment.rock_has_pore_pressure}).second)
      continue;
    const RockProperties &there = rock(segment.region);
    rayleigh_speed = std::min(rayleigh_speed, stockwork::rayleigh_speed(there));
    fastest = std::max(fastest, fastest_wave_speed(there, segment.rock_has_pore_pressure));
  }
  segment_size = segments.empty() ? 0. : sum / segments.size();
  resolved = segments.empty() ? std::numeric_limits<double>::infinity()
                              : share_of_crossing * segment_size / fastest;
}


double WaveSteps::tip_speed(const double dt, const unsigned int advances) const
{
  double time = dt;
  unsigned int n = advances;
  for (auto step = steps.rbegin(); step != steps.rend() && n < segments_of_a_speed; ++step)
  {
    time += step->dt;
    n += step->advances;
  }
  // From somewhere in the first of n segments to somewhere in the last of them.
  return n < 2 ? 0. : (n - 1) * segment_size / time / rayleigh_speed;
}


void WaveSteps::accept(const double dt, const unsigned int advances)
{
  if (advances == 0 && !steps.empty())
  {
    steps.back().dt += dt;
    return;
  }
  steps.push_back({dt, advances});
  unsigned int n = 0;
  for (const Step &step : steps)
    n += step.advances;
  while (n >= segments_of_a_speed + steps.front().advances)
  {
    n -= steps.front().advances;
    steps.erase(steps.begin());
  }
}


template void WaveSteps::set_segments<2>(const std::vector<NetworkSegment<2>> &, const Rock &);
template void WaveSteps::set_segments<3>(const std::vector<NetworkSegment<3>> &, const Rock &);
} // namespace stockwork
