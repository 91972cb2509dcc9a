#pragma once

#include <algorithm>

namespace stockwork
{
/// How exactly an iteration of Newton's method solves its linear system: to which share of the
/// residual. Choice 2 of Eisenstat & Walker (1996, SIAM J. Sci. Comput. 17),
///
///   eta_k = gamma (|F_k| / |F_{k-1}|)^2 ,
///
/// which keeps the quadratic convergence. Their safeguard, eta_k >= gamma eta_{k-1}^2 where that is
/// above 0.1, never acts with a gamma this small. Nothing is solved further than the end of the
/// iterations asks for. Near a limit load, where a small residual is no small error, loose
/// solutions cost iterations and whole steps: once an iteration has gained too little or was
/// shortened, the rest of the solve is done exactly.
class ForcingTerm
{
public:
  /// Of the linear system where nothing is gained by less.
  static constexpr double exact = 1e-6;

  /// @param residual size of the residual; its unit is the same in all calls
  /// @param excess the greatest ratio of a residual to what counts as none
  /// @param shortened whether an increment of this solve has had to be shortened
  double next(const double residual, const double excess, const bool shortened)
  {
    double eta = first;
    if (before > 0.)
    {
      const double ratio = residual / before;
      eta = gamma * ratio * ratio;
      is_exact = is_exact || shortened || ratio > little_gain;
    }
    before = residual;
    if (is_exact)
      eta = exact;
    // An evaluation of the rock costs two back-substitutions or more, so the last iterations
    // should not miss their end.
    if (excess > 0.)
      eta = std::max(eta, end / excess);
    return std::clamp(eta, exact, loosest);
  }

private:
  static constexpr double first = 1e-3, loosest = 0.1, gamma = 0.1, little_gain = 0.5, end = 0.3;

  double before = 0.;
  bool is_exact = false;
};
} // namespace stockwork
