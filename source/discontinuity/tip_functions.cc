#include "discontinuity/tip_functions.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria_accessor.h>

#include <algorithm>
#include <cmath>

namespace stockwork
{
using dealii::Point;
using dealii::Tensor;

namespace
{
/// Falls from one to zero between a tenth of the radius and the radius, with two continuous
/// derivatives.
struct CutOff
{
  static constexpr double inner = 0.1;
  double value = 1., slope = 0.; ///< by r/R

  explicit CutOff(const double s)
  {
    if (s <= inner)
      return;
    const double width = 1. - inner, t = std::min((s - inner) / width, 1.);
    value = 1. - t * t * t * (10. - 15. * t + 6. * t * t);
    slope = -30. * t * t * (1. - t) * (1. - t) / width;
  }
};

double distance_to_edge(const Point<2> &p, const Point<2> &a, const Point<2> &b)
{
  const Tensor<1, 2> edge = b - a;
  const double share = std::clamp(((p - a) * edge) / edge.norm_square(), 0., 1.);
  return p.distance(a + share * edge);
}
} // namespace

template <int dim>
Tensor<1, dim> CrackTip<dim>::across() const
{
  Tensor<1, dim> left;
  left[0] = -along[1];
  left[1] = along[0];
  return left;
}

template <int dim>
typename CrackTip<dim>::Value
CrackTip<dim>::evaluate(const unsigned int mode, const Point<dim> &x, const Side side) const
{
  Value result;
  const Tensor<1, dim> across = this->across();
  const double x1 = (x - point) * along;
  double x2 = (x - point) * across;
  const double r = std::hypot(x1, x2);
  if (r >= radius)
    return result;
  if (x1 < 0.)
  {
    // Seen from the first end the crack's left is to the right.
    const bool on_line = std::abs(x2) < 1e-9 * radius;
    const bool plus = side == Side::plus || (side == Side::by_place && on_line);
    const bool minus = side == Side::minus;
    if (plus || minus)
      x2 = plus == (end == CrackEnd::last) ? std::max(x2, 0.) : std::min(x2, -0.);
    if (x2 == 0.)
      x2 = std::copysign(0., plus == (end == CrackEnd::last) ? 1. : -1.);
  }
  const double theta = std::atan2(x2, x1);
  const NearTipField::Angular angular = (*field)(mode, theta);
  const CutOff chi(r / radius);
  const double root = std::sqrt(r / radius);
  Tensor<2, dim> gradient; // in the frame of the tip
  for (unsigned int i = 0; i < dim; ++i)
  {
    result.value += chi.value * root * angular.value[i] * (i == 0 ? along : across);
    if (r == 0.)
      continue;
    const double by_r = root * angular.value[i] * (0.5 * chi.value / r + chi.slope / radius);
    const double by_theta = chi.value * root * angular.derivative[i] / r;
    gradient[i][0] = std::cos(theta) * by_r - std::sin(theta) * by_theta;
    gradient[i][1] = std::sin(theta) * by_r + std::cos(theta) * by_theta;
  }
  Tensor<2, dim> frame; // rows: the axes at the tip
  for (unsigned int d = 0; d < dim; ++d)
  {
    frame[0][d] = along[d];
    frame[1][d] = across[d];
  }
  result.gradient = transpose(frame) * gradient * frame;
  return result;
}

template <int dim>
Tensor<1, dim> CrackTip<dim>::mean_jump(const unsigned int mode, const CrackPiece<dim> &piece) const
{
  const double from = (point - piece.ends[0]) * along, to = (point - piece.ends[1]) * along;
  const double near = std::max(std::min(from, to), 0.), far = std::min(std::max(from, to), radius);
  if (far <= near)
    return {};
  // With r = s^2 the integrand is smooth.
  const dealii::QGauss<1> line(8);
  const double a = std::sqrt(near), b = std::sqrt(far);
  double integral = 0.;
  for (unsigned int q = 0; q < line.size(); ++q)
  {
    const double s = a + (b - a) * line.point(q)[0];
    integral +=
      CutOff(s * s / radius).value * s / std::sqrt(radius) * 2. * s * (b - a) * line.weight(q);
  }
  const double sign = end == CrackEnd::last ? 1. : -1.;
  return sign * integral / std::abs(to - from) * (mode == 0 ? across() : along);
}

template <int dim>
std::vector<typename CrackTip<dim>::Value>
shifted_tip_functions(const CrackTip<dim> &tip,
                      const dealii::Mapping<dim> &mapping,
                      const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
                      const std::vector<Point<dim>> &unit_points,
                      const unsigned int degree,
                      const CrackPiece<dim> *piece)
{
  using Side = typename CrackTip<dim>::Side;
  const dealii::FE_Q<dim> fe(degree);
  dealii::FEValues<dim> fe_values(mapping, fe, dealii::Quadrature<dim>(unit_points),
                                  dealii::update_values | dealii::update_gradients |
                                    dealii::update_quadrature_points);
  fe_values.reinit(cell);

  std::vector<typename CrackTip<dim>::Value> result(2 * unit_points.size());
  for (unsigned int mode = 0; mode < 2; ++mode)
  {
    std::vector<Tensor<1, dim>> nodal;
    for (const Point<dim> &node : fe.get_unit_support_points())
      nodal.push_back(
        tip.evaluate(mode, mapping.transform_unit_to_real_cell(cell, node), Side::by_place).value);
    for (unsigned int q = 0; q < unit_points.size(); ++q)
    {
      const Side side = piece == nullptr                   ? Side::by_place
                        : piece->plus_side(unit_points[q]) ? Side::plus
                                                           : Side::minus;
      auto &sum = result[2 * q + mode];
      sum = tip.evaluate(mode, fe_values.quadrature_point(q), side);
      for (unsigned int i = 0; i < nodal.size(); ++i)
      {
        sum.value -= fe_values.shape_value(i, q) * nodal[i];
        sum.gradient -= outer_product(nodal[i], fe_values.shape_grad(i, q));
      }
    }
  }
  return result;
}

template <int dim>
double maximum_tip_radius(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                          const std::vector<Point<dim>> &polyline,
                          const CrackEnd end,
                          const Collectives &collectives)
{
  const bool first = end == CrackEnd::first;
  const Point<dim> &tip = first ? polyline.front() : polyline.back();
  const Point<dim> &before = first ? polyline[1] : polyline[polyline.size() - 2];
  double radius = 0.5 * tip.distance(before);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f) || cell->neighbor_is_coarser(f))
          radius = std::min(
            radius, distance_to_edge(tip, cell->face(f)->vertex(0), cell->face(f)->vertex(1)));
  return collectives.min(radius);
}

template struct CrackTip<2>;
template std::vector<typename CrackTip<2>::Value>
shifted_tip_functions(const CrackTip<2> &,
                      const dealii::Mapping<2> &,
                      const dealii::Triangulation<2>::active_cell_iterator &,
                      const std::vector<Point<2>> &,
                      const unsigned int,
                      const CrackPiece<2> *);
template double maximum_tip_radius(const dealii::parallel::distributed::Triangulation<2> &,
                                   const std::vector<Point<2>> &,
                                   const CrackEnd,
                                   const Collectives &);
} // namespace stockwork
