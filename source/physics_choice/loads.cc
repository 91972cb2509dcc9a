#include "physics_choice/loads.h"

#include "scene_estimates.h"

#include <algorithm>
#include <cmath>

namespace stockwork
{
using namespace dealii;

template <int dim>
std::vector<double> loads_at(const Case<dim> &the_case, const double time)
{
  const Point<dim> lower = the_case.geometry.lower(), upper = the_case.geometry.upper();
  std::vector<double> values{the_case.boundary_conditions.maximum_displacement(time)};
  const auto add = [&](const PrescribedValue<dim> &load)
  {
    if (load.value)
      for (const Point<dim> &point : {lower, lower + 0.5 * (upper - lower), upper})
        values.push_back(load.value(point, time));
  };
  for (const auto &[side, load] : the_case.boundary_conditions.loads().normal_traction)
    add(load);
  for (const auto &[side, components] : the_case.boundary_conditions.loads().traction)
    for (const auto &load : components)
      add(load);
  return values;
}


template <int dim>
double greatest_change(const Case<dim> &the_case, const double within)
{
  // At the run's own steps: what a load does between two of them no run sees. Of a run of more
  // steps than `most`, a pulse shorter than that share of it may be missed.
  constexpr double fewest = 1e3, most = 2e5;
  const double start = the_case.control.start_time, duration = duration_of(the_case);
  const unsigned int n = static_cast<unsigned int>(
    std::clamp(std::ceil(duration / the_case.control.initial_step), fewest, most));
  std::vector<std::vector<double>> samples;
  for (unsigned int i = 0; i <= n; ++i)
    samples.push_back(loads_at(the_case, start + duration * i / n));

  double greatest = 0.;
  for (unsigned int k = 0; k < samples[0].size(); ++k)
  {
    double scale = 0.;
    for (const auto &sample : samples)
      scale = std::max(scale, std::abs(sample[k]));
    if (scale == 0.)
      continue;
    greatest = std::max(greatest, std::abs(samples[0][k]) / scale);
    for (unsigned int i = 0; i < n; ++i)
    {
      // Into the half where it changes more, until the rest is as short as the time.
      double from = start + duration * i / n, to = start + duration * (i + 1) / n;
      double before = samples[i][k], after = samples[i + 1][k];
      while (to - from > within && std::abs(after - before) > 1e-6 * scale)
      {
        const double middle = 0.5 * (from + to), value = loads_at(the_case, middle)[k];
        if (std::abs(value - before) > std::abs(after - value))
        {
          to = middle;
          after = value;
        }
        else
        {
          from = middle;
          before = value;
        }
      }
      const double intervals = std::max(1., within / (to - from));
      greatest = std::max(greatest, std::min(1., intervals * std::abs(after - before) / scale));
    }
  }
  return greatest;
}


template std::vector<double> loads_at<2>(const Case<2> &, double);
template std::vector<double> loads_at<3>(const Case<3> &, double);
template double greatest_change<2>(const Case<2> &, double);
template double greatest_change<3>(const Case<3> &, double);
} // namespace stockwork
