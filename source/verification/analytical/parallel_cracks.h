#pragma once

#include "verification/analytical/line_crack.h"

#include <vector>

namespace stockwork::analytical
{
/// Equal parallel cracks |x| <= a at equal distances, aligned, each under the same net pressure,
/// in an infinite plane-strain body.
struct ParallelCracksParameters
{
  double youngs_modulus; ///< Pa
  double poisson_ratio;
  double half_length;  ///< a, m
  double distance;     ///< between neighbours, m
  double net_pressure; ///< Pa
  unsigned int n_cracks;
};

/// Solved once, by continuous dislocations (Hirth & Lothe 1982, section 3; Erdogan & Gupta 1972);
/// accurate to 1e-9 for distances above a tenth of the half length. Cracks are counted from the
/// lowest; there is no contact condition.
class ParallelCracks
{
public:
  explicit ParallelCracks(const ParallelCracksParameters &);

  /// Full opening at the distance x from the centre, m.
  double opening(unsigned int crack, double x) const;

  /// m^2 per unit thickness.
  double volume(unsigned int crack) const;

  /// At the tip x = +a, Pa sqrt(m); at x = -a mode II has the other sign.
  StressIntensity stress_intensity(unsigned int crack) const;

private:
  ParallelCracksParameters parameters;
  unsigned int n_points;
  double modulus;             // E', Pa
  std::vector<double> slopes; // per crack: opening, then slip, n_points each
};
} // namespace stockwork::analytical
