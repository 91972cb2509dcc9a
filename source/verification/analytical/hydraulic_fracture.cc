#include "verification/analytical/hydraulic_fracture.h"

#include "stockwork/base/error.h"
#include "verification/analytical/constants.h"
#include "verification/analytical/fracture_front.h"
#include "verification/analytical/roller_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace stockwork::analytical
{
namespace
{
constexpr double grid_step = 0.3;
constexpr double minimum_toughness = 0.02;

// Leak-off changes as t^(1/6), so long steps do, but its beginning lies many decades back; walls
// change with the length, and a fracture that is short against them is similar.
constexpr double long_step = 0.25, long_span = 23.; // of ln t
constexpr double short_step = 0.1, short_span = 14.;

// Half length over half width below which walls do nothing: their share grows as its square.
constexpr double no_walls = 1e-3;

// That above which it is too near to them, and steps that interpolation takes.
constexpr double near_walls = 0.8;
constexpr std::size_t least_steps = 4;

// Weights of equally spaced values in the polynomial through them, at `position` in steps from
// the first.
template <std::size_t n>
std::array<double, n> lagrange_weights(const double position)
{
  std::array<double, n> weights;
  for (std::size_t i = 0; i < n; ++i)
  {
    weights[i] = 1.;
    for (std::size_t j = 0; j < n; ++j)
      if (j != i)
        weights[i] *= (position - j) / (static_cast<double>(i) - j);
  }
  return weights;
}


// The first of n neighbouring values around a position among `size` of them.
std::size_t first_of(const std::size_t n, const double position, const std::size_t size)
{
  const double first = std::floor(position) - (n / 2 - 1.);
  return static_cast<std::size_t>(std::clamp(first, 0., static_cast<double>(size - n)));
}


// The tip layer in which toughness governs, 1 - xi < O(K_m^6), must be resolved.
double depth_of_grid(const double toughness)
{
  return toughness < 0.3 ? 50. : 36.;
}


// The front of the next step, by those of the last two, in the logarithms.
FractureFront extrapolated(const FractureFront &last, const FractureFront &before)
{
  FractureFront next = last;
  next.gamma *= last.gamma / before.gamma;
  for (std::size_t j = 0; j < next.omega.size(); ++j)
    next.omega[j] *= last.omega[j] / before.omega[j];
  return next;
}


// When the tip passed each place.
struct TipPath
{
  double first_exponent; // ln t0 over ln x before the first step
  std::vector<double> log_time, log_length;

  // 1/sqrt(1 - t0/t) at the points if the tip now, at ln t = tau, stands at exp(log_tip). ln t0
  // is linear in ln x between the steps.
  void exposure(const HalfCrackGrid &grid,
                const double tau,
                const double log_tip,
                std::vector<double> &result) const
  {
    result.resize(grid.size());
    std::size_t k = log_length.size();
    for (std::size_t j = grid.size(); j-- > 0;)
    {
      const double behind = grid.minus_log(j); // ln(l/x)
      const double log_x = log_tip - behind;
      while (k > 0 && log_length[k - 1] > log_x)
        --k;
      double elapsed; // tau - ln t0
      if (log_length.empty())
        elapsed = first_exponent * behind;
      else if (k == log_length.size())
        elapsed = behind * (tau - log_time[k - 1]) / (log_tip - log_length[k - 1]);
      else if (k > 0)
        elapsed = tau - log_time[k] +
                  (log_length[k] - log_x) * (log_time[k] - log_time[k - 1]) /
                    (log_length[k] - log_length[k - 1]);
      else
        elapsed = tau - log_time[0] + first_exponent * (log_length[0] - log_x);
      result[j] = 1. / std::sqrt(-std::expm1(-elapsed));
    }
  }
};
} // namespace


struct HydraulicFracture::Steps
{
  Steps(const HydraulicFractureParameters &parameters, double last_time);

  // A quantity of the steps at time t.
  double value(const std::vector<double> &of_steps, double t) const;

  // A field of the steps at xi and time t.
  double value(const std::vector<std::vector<double>> &of_steps, double xi, double t) const;

  double half_length(double t) const;

  // Counted from the first, not beyond the ends.
  double step_at(double t) const;

  // Scales of the similarity solution.
  double length_scale(double t) const;
  double small_number(double t) const;
  double toughness(double t) const;

  CrackShape shape_of_crack;
  double modulus, viscosity, rate, fracture_toughness;
  HalfCrackGrid grid;
  double time_step, first_log_time;                 // of ln t
  std::vector<double> log_gamma, log_efficiency;    // per step
  std::vector<std::vector<double>> shape, pressure; // per step: ln(omega/sqrt(1 - xi^2)), Pi
};


HydraulicFracture::Steps::Steps(const HydraulicFractureParameters &parameters,
                                const double last_time)
  : shape_of_crack(parameters.shape)
  , modulus(parameters.fracture.plane_strain_modulus())
  , viscosity(12. * parameters.fracture.viscosity)
  , rate(parameters.fracture.rate)
  , fracture_toughness(parameters.fracture.toughness)
  , grid(shape_of_crack, grid_step, depth_of_grid(toughness(last_time * std::exp(-long_span))))
{
  const bool walled = std::isfinite(parameters.half_width);
  const bool slow = parameters.leak_off_coefficient > 0. || shape_of_crack == CrackShape::penny;
  const RollerWalls walls(parameters.half_width, parameters.half_height,
                          parameters.fracture.poisson_ratio);
  time_step = walled ? short_step : long_step;
  const std::size_t n_steps = std::lround((slow ? long_span : short_span) / time_step);
  first_log_time = std::log(last_time) - n_steps * time_step;

  TipPath path{shape_of_crack == CrackShape::penny ? 9. / 4. : 3. / 2., {}, {}};
  FractureFront front = estimate_front(grid, toughness(std::exp(first_log_time)));
  solve_front(grid, toughness(std::exp(first_log_time)), FrontMemory(), front);
  FractureFront earlier, two_earlier;
  for (std::size_t step = 0; step <= n_steps; ++step)
  {
    const double tau = first_log_time + step * time_step;
    const double t = std::exp(tau), scale = length_scale(t);

    FrontMemory memory;
    memory.leak_off =
      2. * parameters.leak_off_coefficient * std::sqrt(t) / (small_number(t) * scale);
    memory.exposure = [&](const double gamma, std::vector<double> &result)
    { path.exposure(grid, tau, std::log(gamma * scale), result); };
    const bool confined = walled && front.gamma * scale > no_walls * parameters.half_width;
    if (confined)
      memory.walls = [&](const double gamma, DenseMatrix &matrix)
      { walls.gradient_matrix(grid, gamma * scale, matrix); };
    if (step == 1)
      memory.remember({{-1. / time_step, earlier}});
    else if (step > 1)
      memory.remember({{-2. / time_step, earlier}, {0.5 / time_step, two_earlier}});
    if (step > 1)
      front = extrapolated(earlier, two_earlier);
    try
    {
      solve_front(grid, toughness(t), memory, front);
    }
    catch (const SolveError &)
    {
      if (step < least_steps)
        throw;
      return;
    }
    if (step >= least_steps && !(front.gamma * scale <= near_walls * parameters.half_width))
      return;

    path.log_time.push_back(tau);
    path.log_length.push_back(std::log(front.gamma * scale));
    log_gamma.push_back(std::log(front.gamma));
    log_efficiency.push_back(std::log(front.efficiency(grid)));
    shape.emplace_back(grid.size());
    for (std::size_t j = 0; j < grid.size(); ++j)
      shape.back()[j] = std::log(front.omega[j] / grid.root()[j]);
    pressure.push_back(front.pressure(grid, toughness(t)));
    if (confined)
    {
      const auto added = walls.pressure(grid, front.gamma * scale, front.omega);
      for (std::size_t j = 0; j < grid.size(); ++j)
        pressure.back()[j] += added[j];
    }
    two_earlier = std::move(earlier);
    earlier = front;
  }
}


double HydraulicFracture::Steps::length_scale(const double t) const
{
  return std::pow(modulus * std::pow(rate, 3) * std::pow(t, 4) / viscosity,
                  shape_of_crack == CrackShape::penny ? 1. / 9. : 1. / 6.);
}


double HydraulicFracture::Steps::small_number(const double t) const
{
  return std::cbrt(viscosity / (modulus * t));
}


double HydraulicFracture::Steps::toughness(const double t) const
{
  const double K = 4. * std::sqrt(2. / pi) * fracture_toughness /
                   (modulus * small_number(t) * std::sqrt(length_scale(t)));
  return std::max(K, minimum_toughness);
}


double HydraulicFracture::Steps::step_at(const double t) const
{
  return std::clamp((std::log(t) - first_log_time) / time_step, 0., log_gamma.size() - 1.);
}


double HydraulicFracture::Steps::value(const std::vector<double> &of_steps, const double t) const
{
  const double position = step_at(t);
  const std::size_t first = first_of(4, position, of_steps.size());
  const auto weights = lagrange_weights<4>(position - first);
  double sum = 0.;
  for (std::size_t k = 0; k < 4; ++k)
    sum += weights[k] * of_steps[first + k];
  return sum;
}


double HydraulicFracture::Steps::value(const std::vector<std::vector<double>> &of_steps,
                                       const double xi,
                                       const double t) const
{
  const double time = step_at(t);
  const double place = (grid.parameter(xi) - grid.first_parameter()) / grid.step();
  const std::size_t first_step = first_of(4, time, of_steps.size());
  const std::size_t first_point = first_of(6, place, grid.size());
  const auto in_time = lagrange_weights<4>(time - first_step);
  const auto in_place = lagrange_weights<6>(place - first_point);
  double sum = 0.;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 6; ++j)
      sum += in_time[k] * in_place[j] * of_steps[first_step + k][first_point + j];
  return sum;
}


double HydraulicFracture::Steps::half_length(const double t) const
{
  return std::exp(value(log_gamma, t)) * length_scale(t);
}


HydraulicFracture::HydraulicFracture(const HydraulicFractureParameters &parameters,
                                     const double last_time)
  : parameters(parameters)
  , last_time(last_time)
{
}


HydraulicFracture::~HydraulicFracture() = default;
HydraulicFracture::HydraulicFracture(HydraulicFracture &&) noexcept = default;
HydraulicFracture &HydraulicFracture::operator=(HydraulicFracture &&) noexcept = default;


const HydraulicFracture::Steps &HydraulicFracture::steps() const
{
  if (!marched)
    marched = std::make_unique<Steps>(parameters, last_time);
  return *marched;
}


double HydraulicFracture::valid_until() const
{
  const Steps &all = steps();
  const double taken = all.log_gamma.size() - 1.;
  return std::min(last_time, std::exp(all.first_log_time + taken * all.time_step));
}


double HydraulicFracture::half_length(const double t) const
{
  return steps().half_length(t);
}


double HydraulicFracture::inlet_opening(const double t) const
{
  return opening(0., t);
}


double HydraulicFracture::inlet_pressure(const double t) const
{
  return pressure(0., t);
}


double HydraulicFracture::opening(const double x, const double t) const
{
  const double l = half_length(t), xi = std::abs(x) / l;
  if (xi >= 1.)
    return 0.;
  return steps().small_number(t) * l * std::exp(steps().value(steps().shape, xi, t)) *
         std::sqrt((1. - xi) * (1. + xi));
}


double HydraulicFracture::pressure(const double x, const double t) const
{
  return steps().small_number(t) * steps().modulus *
         steps().value(steps().pressure, std::abs(x) / half_length(t), t);
}


double HydraulicFracture::injected_volume(const double t) const
{
  return parameters.fracture.rate * t;
}


double HydraulicFracture::fracture_volume(const double t) const
{
  return injected_volume(t) * std::exp(steps().value(steps().log_efficiency, t));
}


double HydraulicFracture::leaked_volume(const double t) const
{
  return injected_volume(t) - fracture_volume(t);
}
} // namespace stockwork::analytical
