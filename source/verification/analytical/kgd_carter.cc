#include "verification/analytical/kgd_carter.h"

#include "verification/analytical/kgd_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace stockwork::analytical
{
namespace
{
constexpr double grid_step = 0.3;
constexpr double time_step = 0.25;      // of ln t
constexpr double marched_span = 23.026; // ln 1e10

constexpr double least_toughness = 0.02;

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
} // namespace


struct KgdCarter::History
{
  History(const KgdCarterParameters &parameters, double last_time);

  // A quantity of the steps at time t.
  double value(const std::vector<double> &of_steps, double t) const;

  // A field of the steps at xi and time t.
  double value(const std::vector<std::vector<double>> &of_steps, double xi, double t) const;

  double half_length(double t) const;

  // Scales of the similarity solution.
  double length_scale(double t) const;
  double small_number(double t) const;

  double modulus, viscosity, rate, toughness;
  HalfCrackGrid grid;
  double first_log_time = 0.;
  std::vector<double> log_gamma, log_efficiency;    // per step
  std::vector<std::vector<double>> shape, pressure; // per step: ln(omega/sqrt(1 - xi^2)), Pi
};


KgdCarter::History::History(const KgdCarterParameters &parameters, const double last_time)
  : modulus(parameters.fracture.plane_strain_modulus())
  , viscosity(12. * parameters.fracture.viscosity)
  , rate(parameters.fracture.rate)
  , toughness(std::max(parameters.fracture.dimensionless_toughness(), least_toughness))
  , grid(grid_step, depth_of_grid(toughness))
{
  const std::size_t n = grid.size();
  const std::size_t n_steps = std::lround(marched_span / time_step);
  first_log_time = std::log(last_time) - n_steps * time_step;

  std::vector<double> log_time, log_length;
  std::vector<double> earlier[2]; // gamma omega, one and two steps ago
  double earlier_gamma[2] = {0., 0.};
  KgdFront front = estimate_front(grid, toughness);
  solve_front(grid, toughness, KgdMemory(), front);
  for (std::size_t step = 0; step <= n_steps; ++step)
  {
    const double tau = first_log_time + step * time_step;
    const double t = std::exp(tau);

    KgdMemory memory;
    memory.leak_off =
      2. * parameters.leak_off_coefficient * std::sqrt(t) / (small_number(t) * length_scale(t));
    memory.exposure = [&](const double gamma, std::vector<double> &exposure)
    {
      // ln t0 is linear in ln x between the steps, and follows t^(2/3) before the first.
      exposure.resize(n);
      const double log_tip = std::log(gamma * length_scale(t));
      std::size_t k = log_length.size();
      for (std::size_t j = n; j-- > 0;)
      {
        const double log_ratio = -grid.minus_log(j);
        const double log_x = log_tip + log_ratio;
        while (k > 0 && log_length[k - 1] > log_x)
          --k;
        double elapsed; // tau - ln t0
        if (k == log_length.size() && k > 0)
          elapsed = -log_ratio * (tau - log_time[k - 1]) / (log_tip - log_length[k - 1]);
        else if (k > 0)
          elapsed = tau - log_time[k] +
                    (log_length[k] - log_x) * (log_time[k] - log_time[k - 1]) /
                      (log_length[k] - log_length[k - 1]);
        else if (!log_length.empty())
          elapsed = tau - log_time[0] + 1.5 * (log_length[0] - log_x);
        else
          elapsed = -1.5 * log_ratio;
        exposure[j] = 1. / std::sqrt(-std::expm1(-elapsed));
      }
    };
    if (step > 0)
    {
      const bool second = step > 1;
      memory.rate = (second ? 1.5 : 1.) / time_step;
      const double c1 = (second ? -2. : -1.) / time_step, c2 = (second ? 0.5 : 0.) / time_step;
      memory.gamma_history = c1 * earlier_gamma[0] + c2 * earlier_gamma[1];
      memory.gamma_omega_history.resize(n);
      for (std::size_t j = 0; j < n; ++j)
        memory.gamma_omega_history[j] = c1 * earlier[0][j] + (second ? c2 * earlier[1][j] : 0.);
    }
    solve_front(grid, toughness, memory, front);

    std::swap(earlier[0], earlier[1]);
    earlier_gamma[1] = earlier_gamma[0];
    earlier_gamma[0] = front.gamma;
    earlier[0].resize(n);
    std::vector<double> shape_now(n);
    for (std::size_t j = 0; j < n; ++j)
    {
      earlier[0][j] = front.gamma * front.omega[j];
      shape_now[j] = std::log(front.omega[j] / grid.root()[j]);
    }
    log_time.push_back(tau);
    log_length.push_back(std::log(front.gamma * length_scale(t)));
    log_gamma.push_back(std::log(front.gamma));
    log_efficiency.push_back(std::log(front.efficiency(grid)));
    shape.push_back(shape_now);
    pressure.push_back(front.pressure(grid, toughness));
  }
}


double KgdCarter::History::length_scale(const double t) const
{
  return std::pow(modulus * std::pow(rate, 3) * std::pow(t, 4) / viscosity, 1. / 6.);
}


double KgdCarter::History::small_number(const double t) const
{
  return std::cbrt(viscosity / (modulus * t));
}


double KgdCarter::History::value(const std::vector<double> &of_steps, const double t) const
{
  const double position = (std::log(t) - first_log_time) / time_step;
  const std::size_t first = first_of(4, position, of_steps.size());
  const auto weights = lagrange_weights<4>(position - first);
  double sum = 0.;
  for (std::size_t k = 0; k < 4; ++k)
    sum += weights[k] * of_steps[first + k];
  return sum;
}


double KgdCarter::History::value(const std::vector<std::vector<double>> &of_steps,
                                 const double xi,
                                 const double t) const
{
  const double time = (std::log(t) - first_log_time) / time_step;
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


double KgdCarter::History::half_length(const double t) const
{
  return std::exp(value(log_gamma, t)) * length_scale(t);
}


KgdCarter::KgdCarter(const KgdCarterParameters &parameters, const double last_time)
  : history(std::make_unique<History>(parameters, last_time))
{
}


KgdCarter::~KgdCarter() = default;
KgdCarter::KgdCarter(KgdCarter &&) noexcept = default;
KgdCarter &KgdCarter::operator=(KgdCarter &&) noexcept = default;


double KgdCarter::half_length(const double t) const
{
  return history->half_length(t);
}


double KgdCarter::inlet_opening(const double t) const
{
  return opening(0., t);
}


double KgdCarter::inlet_pressure(const double t) const
{
  return pressure(0., t);
}


double KgdCarter::opening(const double x, const double t) const
{
  const double l = half_length(t), xi = std::abs(x) / l;
  if (xi >= 1.)
    return 0.;
  return history->small_number(t) * l * std::exp(history->value(history->shape, xi, t)) *
         std::sqrt((1. - xi) * (1. + xi));
}


double KgdCarter::pressure(const double x, const double t) const
{
  return history->small_number(t) * history->modulus *
         history->value(history->pressure, std::abs(x) / half_length(t), t);
}


double KgdCarter::injected_volume(const double t) const
{
  return history->rate * t;
}


double KgdCarter::fracture_volume(const double t) const
{
  return injected_volume(t) * std::exp(history->value(history->log_efficiency, t));
}


double KgdCarter::leaked_volume(const double t) const
{
  return injected_volume(t) - fracture_volume(t);
}
} // namespace stockwork::analytical
