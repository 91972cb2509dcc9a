#pragma once

#include "verification/analytical/crack_shape.h"
#include "verification/analytical/dense_matrix.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace stockwork::analytical
{
/// Elasticity of a symmetric line crack |x| <= 1 in plane strain, or of a penny crack of radius 1
/// with x the distance from its axis, in an infinite body, on points that resolve every scale from
/// the inlet to the tip: x = exp(-exp(-v)) with equal steps of v, so that 1 - x falls to 1e-16 and
/// less. The unknown is m = -dp/dx. With E' = 1,
///   w(x) = k sqrt(1 - x^2) + int_0^1 m(s) H(x, s) ds,   k = lim w / sqrt(1 - x^2) at the tip,
/// where H is the opening by unit pressure on |x| < s less a uniform pressure that cancels its
/// stress intensity. For the line crack (Spence & Sharp 1985)
///   H = (4/pi) [(s - x) ln((a + b)^2 / |s^2 - x^2|) - 2 x ln((a s + b x) / (a + b))],
///   a = sqrt(1 - x^2), b = sqrt(1 - s^2);
/// for the penny crack (from Sneddon 1946) H is an elliptic integral.
class HalfCrackGrid
{
public:
  /// step is that of v; the points end where 1 - x is exp(-last).
  HalfCrackGrid(CrackShape shape, double step, double last);

  CrackShape shape() const
  {
    return crack;
  }

  std::size_t size() const
  {
    return position.size();
  }

  const std::vector<double> &x() const
  {
    return position;
  }

  /// 1 - x without cancellation.
  const std::vector<double> &distance_to_tip() const
  {
    return tip_distance;
  }

  /// -ln x of point i without cancellation.
  double minus_log(const std::size_t i) const
  {
    return std::exp(-(first + i * h));
  }

  /// sqrt(1 - x^2).
  const std::vector<double> &root() const
  {
    return chord;
  }

  /// w_i = k root_i + sum_j opening_matrix_ij m_j.
  const DenseMatrix &opening_matrix() const
  {
    return matrix;
  }

  /// x^n, n = 0 for the line and 1 for the penny crack: volumes are integrals of w x^n.
  double measure(const std::size_t i) const
  {
    return crack == CrackShape::penny ? position[i] : 1.;
  }

  /// result_i = int_{x_i}^1 f x^n dx, of eighth order in the step.
  void integrate_to_tip(const std::vector<double> &f, std::vector<double> &result) const;

  /// The transpose of integrate_to_tip: result_k = sum_i g_i d(int_{x_i}^1 f x^n dx)/df_k.
  void transpose_integrate(const double *g, std::vector<double> &result) const;

  /// Weight of point j in the integral of a function over (0, 1) that vanishes at the tip.
  double weight(const std::size_t j) const
  {
    return h * metric[j];
  }

  /// Pressure at the points, E' = 1.
  std::vector<double> pressure(double k, const std::vector<double> &m) const;

  /// The parameter v of a position in (0, 1), kept inside the range of the points.
  double parameter(double x) const;

  double first_parameter() const
  {
    return first;
  }

  double step() const
  {
    return h;
  }

private:
  void integrate(const std::vector<double> &f, std::vector<double> &result) const;

  CrackShape crack;
  double h;
  double first;
  std::vector<double> position;
  std::vector<double> tip_distance;
  std::vector<double> metric; // dx/dv
  std::vector<double> chord;
  DenseMatrix matrix;
};
} // namespace stockwork::analytical
