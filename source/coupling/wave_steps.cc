#include "coupling/wave_steps.h"

#include "rock/wave_speeds.h"

#include "stockwork/base/quantity.h"

#include <algorithm>
#include <cmath>

namespace stockwork
{
using namespace dealii;

namespace
{
/// A tip goes from segment to segment, so its speed is a mean over some of them.
constexpr unsigned int segments_of_a_speed = 5;
/// Over the time that the fastest wave takes through the cell where it is shortest.
constexpr double share_of_crossing = 0.5;
} // namespace


void WaveSteps::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Time");
  prm.declare_entry(
    "Waves resolved above", "0.1", Quantity(dimension::number, Range{0., INFINITY, true, false}),
    "A speed of tips over that of Rayleigh waves. With Newmark's scheme, while a tip runs faster "
    "(over four cells, in cracks with fluid), steps are at most half of the time that the fastest "
    "wave takes through a cell, the smallest; one that turns out too long is taken again. 'inf': "
    "steps do not mind waves.");
  prm.leave_subsection();
}


void WaveSteps::parse_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Time");
  threshold = get_quantity(prm, "Waves resolved above", dimension::number);
  prm.leave_subsection();
}


void WaveSteps::set_rock(const RockProperties &rock)
{
  rayleigh_speed = stockwork::rayleigh_speed(rock);
}


bool WaveSteps::are_wanted() const
{
  return std::isfinite(threshold);
}


template <int dim>
void WaveSteps::set_mesh(const parallel::distributed::Triangulation<dim> &triangulation,
                         const Rock &rock)
{
  double crossing = std::numeric_limits<double>::infinity(), size = crossing;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const double extent = cell->minimum_vertex_distance();
      size = std::min(size, extent);
      crossing = std::min(crossing, extent / fastest_wave_speed(rock(cell->material_id())));
    }
  cell_size = Utilities::MPI::min(size, triangulation.get_communicator());
  resolved = share_of_crossing * Utilities::MPI::min(crossing, triangulation.get_communicator());
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
  // From within the first of n segments to within the last of them is at least this far.
  return n < 2 ? 0. : (n - 1) * cell_size / time / rayleigh_speed;
}


void WaveSteps::accept(const double dt, const unsigned int advances)
{
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


template void WaveSteps::set_mesh<2>(const parallel::distributed::Triangulation<2> &, const Rock &);
template void WaveSteps::set_mesh<3>(const parallel::distributed::Triangulation<3> &, const Rock &);
} // namespace stockwork
