#pragma once

#include "verification/analytical/half_crack_grid.h"

#include <vector>

namespace stockwork::analytical
{
/// What the walls of the rectangle |x| <= W, |y| <= H add to the pressure that opens a crack
/// |x| <= l, y = 0, if they are rollers: no normal displacement, no shear. By mirroring, the
/// pressure is a Fourier series of the opening with the stiffness of a layer; it is split into an
/// infinite plane, the row of mirrored collinear cracks (closed form), the layer's excess over a
/// half space (falls exponentially) and the mean.
class RollerWalls
{
public:
  RollerWalls(double half_width, double half_height, double poisson_ratio);

  /// Stiffness of a layer over that of a half space, minus one, for one wave number times height.
  static double layer_excess(double h);

  /// (lambda + 2 G)/E': the mean opening compresses the layer without letting it widen.
  static double uniaxial_ratio(double poisson_ratio);

  /// For a crack of half length l whose opening is l omega(xi) on the points of the grid (E' = 1):
  /// matrix with d(added pressure)/dxi = matrix omega.
  void gradient_matrix(const HalfCrackGrid &grid, double l, DenseMatrix &matrix) const;

  /// The added pressure itself.
  std::vector<double>
  pressure(const HalfCrackGrid &grid, double l, const std::vector<double> &omega) const;

private:
  unsigned int n_waves() const;

  double half_width;
  double half_height;
  double poisson_ratio;
};
} // namespace stockwork::analytical
