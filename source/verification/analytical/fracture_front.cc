#include "verification/analytical/fracture_front.h"

#include "stockwork/base/error.h"
#include "verification/analytical/constants.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace stockwork::analytical
{
namespace
{
constexpr double tolerance = 1e-8;
constexpr int max_iterations = 40;
constexpr double gamma_increment = 1e-6; // of the numerical derivative of the exposure

// The numbers in which plane strain and radial fractures differ.
struct Scaling
{
  explicit Scaling(const CrackShape shape)
    : n(shape == CrackShape::penny ? 1 : 0)
    , volume(shape == CrackShape::penny ? 2. * pi : 2.)
    , growth(4. / (6. + 3. * n))
  {
  }

  int n;
  double volume; // c
  double growth; // b
};


// The flux and its derivatives.
struct Flux
{
  std::vector<double> value; // times xi^n
  std::vector<double> by_gamma;
  double by_volume; // factor of int_xi^1 xi^n omega
  double by_omega;  // factor of xi^(n+1) omega
};


class FluxLaw
{
public:
  FluxLaw(const HalfCrackGrid &grid, const FrontMemory &memory)
    : grid(grid)
    , memory(memory)
    , history(grid.size(), 0.)
    , leak(grid.size(), 0.)
    , leak_by_gamma(grid.size(), 0.)
  {
    if (!memory.gamma_omega_history.empty())
      grid.integrate_to_tip(memory.gamma_omega_history, history);
  }

  void evaluate(const FractureFront &front, Flux &flux)
  {
    const std::size_t n = grid.size();
    const double gamma = front.gamma;
    if (memory.leak_off > 0.)
    {
      memory.exposure(gamma, exposure);
      grid.integrate_to_tip(exposure, leak);
      memory.exposure(gamma * (1. + gamma_increment), exposure);
      grid.integrate_to_tip(exposure, leak_by_gamma);
      for (std::size_t j = 0; j < n; ++j)
        leak_by_gamma[j] = (leak_by_gamma[j] - leak[j]) / (gamma * gamma_increment);
    }
    grid.integrate_to_tip(front.omega, volume);

    const Scaling scaling(grid.shape());
    const double a = scaling.growth + memory.rate + memory.gamma_history / gamma;
    const double a_by_gamma = -memory.gamma_history / (gamma * gamma);
    flux.by_volume = scaling.growth - 1. / 3. + memory.rate + (scaling.n + 1) * a;
    flux.by_omega = a;
    flux.value.resize(n);
    flux.by_gamma.resize(n);
    for (std::size_t j = 0; j < n; ++j)
    {
      const double passed = grid.x()[j] * grid.measure(j) * front.omega[j];
      const double carried = (history[j] + memory.leak_off * leak[j]) / gamma;
      flux.value[j] = flux.by_volume * volume[j] + a * passed + carried;
      flux.by_gamma[j] = a_by_gamma * ((scaling.n + 1) * volume[j] + passed) - carried / gamma +
                         memory.leak_off * leak_by_gamma[j] / gamma;
    }
  }

private:
  const HalfCrackGrid &grid;
  const FrontMemory &memory;
  std::vector<double> history, leak, leak_by_gamma, exposure, volume;
};
} // namespace


double FractureFront::tip_factor(const double toughness) const
{
  return toughness / std::sqrt(2. * gamma);
}


double FractureFront::efficiency(const HalfCrackGrid &grid) const
{
  std::vector<double> volume;
  grid.integrate_to_tip(omega, volume);
  const Scaling scaling(grid.shape());
  return scaling.volume * std::pow(gamma, scaling.n + 2) * volume[0];
}


std::vector<double> FractureFront::pressure(const HalfCrackGrid &grid, const double toughness) const
{
  return grid.pressure(tip_factor(toughness), gradient);
}


void FrontMemory::remember(std::initializer_list<std::pair<double, const FractureFront &>> fronts)
{
  for (const auto &[factor, front] : fronts)
  {
    rate -= factor;
    gamma_history += factor * front.gamma;
    gamma_omega_history.resize(front.omega.size(), 0.);
    for (std::size_t j = 0; j < front.omega.size(); ++j)
      gamma_omega_history[j] += factor * front.gamma * front.omega[j];
  }
}


FractureFront estimate_front(const HalfCrackGrid &grid, const double toughness)
{
  // At the toughness vertex omega = tip sqrt(1 - xi^2) and c gamma^(n+2) int xi^n omega = 1.
  const Scaling scaling(grid.shape());
  const double integral = scaling.n == 0 ? pi / 4. : 1. / 3.; // of xi^n sqrt(1 - xi^2)
  const double exponent = 1. / (2. * (scaling.n + 2));
  const double tip =
    std::pow(toughness / std::sqrt(2.) * std::pow(scaling.volume * integral, exponent),
             1. / (1. - exponent));
  const double viscous = scaling.n == 0 ? 1.83 : 1.71;
  FractureFront front;
  for (const double root : grid.root())
    front.omega.push_back(
      std::cbrt(std::pow(viscous, 3) * std::pow(root, 4) + std::pow(tip * root, 3)));
  std::vector<double> volume;
  grid.integrate_to_tip(front.omega, volume);
  front.gamma = std::pow(scaling.volume * volume[0], -2. * exponent);
  return front;
}


void solve_front(const HalfCrackGrid &grid,
                 const double toughness,
                 const FrontMemory &memory,
                 FractureFront &front)
{
  const std::size_t n = grid.size();
  const DenseMatrix &H = grid.opening_matrix();
  std::vector<double> &omega = front.omega, &gradient = front.gradient;
  gradient.resize(n);

  FluxLaw law(grid, memory);
  Flux flux;
  const Scaling scaling(grid.shape());
  std::vector<double> lost(n);   // pressure by friction
  std::vector<double> passed(n); // xi^(n+1)
  for (std::size_t j = 0; j < n; ++j)
    passed[j] = grid.x()[j] * grid.measure(j);
  DenseMatrix wall_gradient(memory.walls ? n : 0), wall_opening(memory.walls ? n : 0);
  std::vector<double> row(n), by_volume, first(n, 0.), correction(n + 1);
  first[0] = 1.;
  for (int iteration = 0; iteration < max_iterations; ++iteration)
  {
    law.evaluate(front, flux);
    const double tip = front.tip_factor(toughness);
    for (std::size_t j = 0; j < n; ++j)
      gradient[j] = lost[j] = flux.value[j] / (grid.measure(j) * std::pow(omega[j], 3));
    if (memory.walls)
    {
      memory.walls(front.gamma, wall_gradient);
      multiply(H, wall_gradient, wall_opening);
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = 0; k < n; ++k)
          gradient[j] += wall_gradient[j][k] * omega[k];
    }

    DenseMatrix jacobian(n + 1);
    for (std::size_t i = 0; i < n; ++i) // elasticity
    {
      const double root = grid.root()[i];
      double residual = omega[i] - tip * root;
      double residual_by_gamma = 0.5 * tip * root / front.gamma;
      for (std::size_t j = 0; j < n; ++j)
      {
        row[j] = H[i][j] / (grid.measure(j) * std::pow(omega[j], 3));
        residual -= H[i][j] * gradient[j];
        residual_by_gamma -= row[j] * flux.by_gamma[j];
      }
      grid.transpose_integrate(row.data(), by_volume);
      for (std::size_t j = 0; j < n; ++j)
        jacobian[i][j] = (3. * H[i][j] * lost[j] - flux.by_omega * passed[j] * row[j] * omega[j] -
                          flux.by_volume * by_volume[j] * omega[j]) /
                         omega[i];
      if (memory.walls)
        for (std::size_t j = 0; j < n; ++j)
          jacobian[i][j] -= wall_opening[i][j] * omega[j] / omega[i];
      jacobian[i][i] += 1.;
      jacobian[i][n] = residual_by_gamma * front.gamma / omega[i];
      correction[i] = -residual / omega[i];
    }

    // What enters is the injected rate.
    const double factor = scaling.volume * std::pow(front.gamma, scaling.n + 2);
    grid.transpose_integrate(first.data(), by_volume);
    for (std::size_t j = 0; j < n; ++j)
      jacobian[n][j] = factor * flux.by_volume * by_volume[j] * omega[j];
    jacobian[n][0] += factor * flux.by_omega * passed[0] * omega[0];
    jacobian[n][n] = factor * ((scaling.n + 2) * flux.value[0] + front.gamma * flux.by_gamma[0]);
    correction[n] = 1. - factor * flux.value[0];

    solve_in_place(jacobian, correction);

    double largest = 0.;
    for (const double c : correction)
      largest = std::max(largest, std::abs(c));
    const double damping = largest > 1. ? 1. / largest : 1.;
    for (std::size_t i = 0; i < n; ++i)
      omega[i] *= std::exp(damping * correction[i]);
    front.gamma *= std::exp(damping * correction[n]);
    if (largest < tolerance)
      return;
  }
  throw SolveError("The reference solution of the hydraulic fracture did not converge for K_m = " +
                   std::to_string(toughness) + ".");
}
} // namespace stockwork::analytical
