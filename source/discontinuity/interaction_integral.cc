#include "discontinuity/interaction_integral.h"

#include "discontinuity/near_tip_field.h"

#include "exchange/cell_evaluator.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace stockwork
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Gradient [i][j] = u_i,j of the field around the tip for a unit jump, in the frame of the tip.
Tensor<2, 2>
unit_gradient(const NearTipField &field, const unsigned int mode, const Tensor<1, 2> &x)
{
  const double r = x.norm(), theta = std::atan2(x[1], x[0]);
  const NearTipField::Angular f = field(mode, theta);
  Tensor<2, 2> gradient;
  for (unsigned int i = 0; i < 2; ++i)
  {
    gradient[i][0] = 0.5 * std::cos(theta) * f.value[i] - std::sin(theta) * f.derivative[i];
    gradient[i][1] = 0.5 * std::sin(theta) * f.value[i] + std::cos(theta) * f.derivative[i];
  }
  return gradient / std::sqrt(r);
}

/// Hooke's law in the frame of the tip.
struct TipStress
{
  const LinearStiffness<2> &rock;
  const Tensor<2, 2> &frame; ///< rows: the axes at the tip

  SymmetricTensor<2, 2> operator()(const Tensor<2, 2> &gradient) const
  {
    if (rock.is_isotropic())
      return rock.stress(symmetrize(gradient));
    const Tensor<2, 2> strain = transpose(frame) * symmetrize(gradient) * frame;
    return symmetrize(frame * Tensor<2, 2>(rock.stress(symmetrize(strain))) * transpose(frame));
  }
};

/// Falls smoothly from one to zero between inner and outer radius.
struct Weight
{
  double inner, outer;

  double value(const double r) const
  {
    const double s = std::min(std::max((r - inner) / (outer - inner), 0.), 1.);
    return 1. - s * s * (3. - 2. * s);
  }

  double slope(const double r) const
  {
    const double s = (r - inner) / (outer - inner);
    return s <= 0. || s >= 1. ? 0. : -6. * s * (1. - s) / (outer - inner);
  }
};

/// The tip, the axes there, and the fields around it that the integral pairs with those computed.
template <int dim>
struct Tip
{
  Point<dim> point;
  Tensor<1, dim> along, across;
  Tensor<2, dim> frame; ///< rows: the axes
  CrackEnd end;
  NearTipField field;

  Tip(const Point<dim> &point,
      const Tensor<1, dim> &along,
      const CrackEnd end,
      const LinearStiffness<dim> &rock)
    : point(point)
    , along(along)
    , end(end)
    , field(rock, along)
  {
    across[0] = -along[1];
    across[1] = along[0];
    for (unsigned int d = 0; d < dim; ++d)
    {
      frame[0][d] = along[d];
      frame[1][d] = across[d];
    }
  }

  /// In the frame of the tip. Where the crack runs beside its line, its side counts and not the
  /// place.
  /// @param piece that cuts the cell, or null
  /// @param unit_point in that cell
  Tensor<1, dim> place(const Point<dim> &x,
                       const CrackPiece<dim> *const piece,
                       const Point<dim> *const unit_point) const
  {
    Tensor<1, dim> place = frame * (x - point);
    if (piece != nullptr && place[0] < 0.)
    {
      const bool left = piece->plus_side(*unit_point) == (end == CrackEnd::last);
      place[1] = std::copysign(left == (place[1] > 0.) ? place[1] : 0., left ? 1. : -1.);
    }
    return place;
  }
};

/// What the points of a cell add to the integral, mode by mode.
/// @param piece that cuts the cell, or null
template <int dim>
void add_cell(const Tip<dim> &tip,
              const TipStress &stress_of,
              const Weight &weight,
              const CellEvaluator<dim> &cell,
              const CrackPiece<dim> *const piece,
              const State &state,
              std::vector<double> &sums)
{
  std::vector<Tensor<2, dim>> gradients;
  cell.displacement_gradient(state.current, gradients);
  for (unsigned int q = 0; q < gradients.size(); ++q)
  {
    const Tensor<1, dim> x = tip.place(cell.point(q), piece, &cell.unit_points()[q]);
    const double r = (tip.frame * (cell.point(q) - tip.point)).norm();
    if (weight.slope(r) == 0.)
      continue;
    const Tensor<2, dim> gradient = tip.frame * gradients[q] * transpose(tip.frame);
    const SymmetricTensor<2, dim> stress = stress_of(gradient);
    const Tensor<1, dim> dq = weight.slope(r) / r * x;
    for (unsigned int mode = 0; mode < 2; ++mode)
    {
      const Tensor<2, dim> unit = unit_gradient(tip.field, mode, x);
      const SymmetricTensor<2, dim> unit_stress = stress_of(unit);
      double integrand = -(stress * symmetrize(unit)) * dq[0];
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          integrand += (stress[i][j] * unit[i][0] + unit_stress[i][j] * gradient[i][0]) * dq[j];
      sums[mode] += integrand * cell.weight(q);
    }
  }
}

/// What the fluid's pressure on a piece of the crack adds, and the stress that it releases.
/// [[u^a]],1 = -1/(2 sqrt(r)); with r = s^2 it is smooth.
/// @param load on the face, along and across the crack at the tip [Pa]
template <int dim>
void add_face(const Tip<dim> &tip,
              const Weight &weight,
              const CrackPiece<dim> &piece,
              const Tensor<1, dim> &load,
              std::vector<double> &sums)
{
  const dealii::QGauss<1> line(4);
  const double from = piece.ends[0].distance(tip.point), to = piece.ends[1].distance(tip.point);
  if (std::min(from, to) >= weight.outer)
    return;
  const double a = std::sqrt(std::min(from, to)), b = std::sqrt(std::max(from, to));
  double integral = 0.;
  for (unsigned int q = 0; q < line.size(); ++q)
  {
    const double s = a + (b - a) * line.point(q)[0];
    integral -= weight.value(s * s) * (b - a) * line.weight(q);
  }
  sums[0] += load[1] * integral;
  sums[1] += load[0] * integral;
}
} // namespace

template <int dim>
StressIntensity stress_intensity(const unsigned int crack,
                                 const CrackEnd end,
                                 const double radius,
                                 const MeshView<dim> &mesh_view,
                                 const Discontinuity<dim> &discontinuity,
                                 const Scene<dim> &scene,
                                 const State &state,
                                 const Collectives &collectives)
{
  const CrackPath<dim> &path = discontinuity.paths()[crack];
  const CrackTip<dim> *exact = discontinuity.tip(crack, end);
  const LinearStiffness<dim> rock(scene.rock(path.piece_at(end).region));
  const Tip<dim> tip(exact != nullptr ? exact->point : path.tip(end),
                     exact != nullptr ? exact->along : path.direction(end), end, rock);
  const TipStress stress_of{rock, tip.frame};
  const Weight weight{0.25 * radius, radius};

  CellEvaluator<dim> evaluator(
    mesh_view.mapping, mesh_view.dof_handler.get_fe(), dealii::QGauss<dim>(4),
    dealii::update_gradients | dealii::update_quadrature_points | dealii::update_JxW_values);
  std::vector<double> sums(2, 0.);
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const auto &low = cell->vertex(0), &high = cell->vertex((1 << dim) - 1);
      if ((low + 0.5 * (high - low)).distance(tip.point) > radius + 0.75 * low.distance(high))
        continue;
      const CutCell<dim> *const cut = discontinuity.cut_cell(cell->active_cell_index());
      evaluator.reinit(cell, cut);
      add_cell(tip, stress_of, weight, evaluator,
               cut != nullptr ? discontinuity.piece_in(cell->id(), crack) : nullptr, state, sums);
    }
  collectives.sum(sums);

  for (unsigned int i = 0; i < path.pieces.size(); ++i)
  {
    const double pressure =
      state.segment_pressure ? state.segment_pressure(discontinuity.segment_key(crack, i)) : 0.;
    const Tensor<1, dim> released = scene.in_situ_stress(path.pieces[i].centre()) * tip.across;
    add_face(tip, weight, path.pieces[i], -1. * (tip.frame * (pressure * tip.across + released)),
             sums);
  }
  const double factor = std::sqrt(8. / dealii::numbers::PI);
  StressIntensity result{factor * sums[0], factor * sums[1]};
  Tensor<1, dim> k;
  k[0] = result.shear;
  k[1] = result.opening;
  result.energy_release_rate =
    0.5 * (k * (PlaneElasticity(rock.tensor(), tip.along).crack_compliance * k));
  return result;
}

template StressIntensity stress_intensity(const unsigned int,
                                          const CrackEnd,
                                          const double,
                                          const MeshView<2> &,
                                          const Discontinuity<2> &,
                                          const Scene<2> &,
                                          const State &,
                                          const Collectives &);
} // namespace stockwork
