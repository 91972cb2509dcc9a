#pragma once

#include "verification/analytical/half_crack_grid.h"

#include <functional>
#include <initializer_list>
#include <utility>
#include <vector>

namespace stockwork::analytical
{
/// The scaled equations of a hydraulic fracture driven at a constant rate, in plane strain (n = 0,
/// c = 2) or radial (n = 1, c = 2 pi), with
///   l = gamma L,  w = eps L gamma omega(xi),  p = eps E' Pi(xi),  xi = x/l,
///   L = (E' Q0^3 t^4 / mu')^(1/(6 + 3 n)),  eps = (mu' / (E' t))^(1/3),  tau = ln t:
/// omega^3 Pi' = -q with the flux
///   xi^n q = int_xi^1 xi^n ((b - 1/3) omega + (gamma omega)_tau / gamma
///                           + chi / (gamma sqrt(1 - t0/t))) dxi
///            + a (xi^(n+1) omega + (n + 1) int_xi^1 xi^n omega dxi),
///   b = 4/(6 + 3 n),  a = b + gamma_tau / gamma,
/// c gamma^(n+2) (xi^n q)(0) = 1, omega -> K gamma^(-1/2) sqrt(1 - xi) at the tip, and Pi from
/// omega by elasticity. K is the toughness in the same scaling, constant in time for n = 0 and
/// growing as t^(1/9) for n = 1. chi = 2 C_L sqrt(t) / (eps L) is the leak-off coefficient, t0(x)
/// the time at which the tip passed x. Without leak-off the plane-strain front does not depend on
/// tau. (Detournay 2004; Savitski & Detournay 2002; Adachi & Detournay 2008.)
struct FractureFront
{
  double gamma = 0.;
  std::vector<double> omega;    // at the points of the grid
  std::vector<double> gradient; // -dPi/dxi; with walls, of the pressure less what they add

  /// lim omega / sqrt(1 - xi^2) at the tip.
  double tip_factor(double toughness) const;

  /// Volume of the fracture over the injected volume.
  double efficiency(const HalfCrackGrid &grid) const;

  /// Of a crack in an infinite plane.
  std::vector<double> pressure(const HalfCrackGrid &grid, double toughness) const;
};


/// What the solution at one time must know of earlier times and of its surroundings. d/dtau is
/// approximated by rate times the new value plus a sum over earlier ones. Empty for the similarity
/// solution.
struct FrontMemory
{
  /// Sets the rate and the histories from earlier solutions with their factors in the formula,
  /// whose factors sum to zero with the new one.
  void remember(std::initializer_list<std::pair<double, const FractureFront &>> fronts);

  double rate = 0.;
  double gamma_history = 0.;               // of gamma
  std::vector<double> gamma_omega_history; // of gamma omega
  double leak_off = 0.;                    // chi

  /// Fills 1/sqrt(1 - t0/t) at the points for a given gamma.
  std::function<void(double gamma, std::vector<double> &)> exposure;

  /// Fills the matrix by which walls add to dPi/dxi for a given omega; empty without walls.
  std::function<void(double gamma, DenseMatrix &)> walls;
};


/// A front between the viscosity and the toughness vertex to start Newton's method from.
FractureFront estimate_front(const HalfCrackGrid &grid, double toughness);

/// Newton's method for ln(omega) and ln(gamma), starting from `front`; throws SolveError if it
/// does not converge.
void solve_front(const HalfCrackGrid &grid,
                 double toughness,
                 const FrontMemory &memory,
                 FractureFront &front);
} // namespace stockwork::analytical
