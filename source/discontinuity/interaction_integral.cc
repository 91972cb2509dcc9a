#include "discontinuity/interaction_integral.h"

#include "discontinuity/near_tip_field.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

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
  const Point<dim> tip = exact != nullptr ? exact->point : path.tip(end);
  const Tensor<1, dim> along = exact != nullptr ? exact->along : path.direction(end);
  Tensor<1, dim> across;
  across[0] = -along[1];
  across[1] = along[0];
  Tensor<2, dim> frame; // rows: the axes at the tip
  for (unsigned int d = 0; d < dim; ++d)
  {
    frame[0][d] = along[d];
    frame[1][d] = across[d];
  }
  const LinearStiffness<dim> rock(scene.rock.main());
  const TipStress stress_of{rock, frame};
  const NearTipField field(rock, along);
  const Weight weight{0.25 * radius, radius};

  const auto &fe = mesh_view.dof_handler.get_fe();
  const dealii::QGauss<dim> gauss(4);
  const dealii::FEValuesExtractors::Vector displacement(0);
  const auto flags =
    dealii::update_gradients | dealii::update_quadrature_points | dealii::update_JxW_values;
  dealii::FEValues<dim> plain_values(mesh_view.mapping, fe, gauss, flags);

  std::vector<double> sums(2, 0.);
  const auto add_points = [&](const dealii::FEValues<dim> &fe_values, const CutCell<dim> *cut,
                              const CrackPiece<dim> *piece)
  {
    std::vector<Tensor<2, dim>> gradients(fe_values.n_quadrature_points);
    fe_values[displacement].get_function_gradients(state.current.bulk, gradients);
    for (unsigned int q = 0; q < gradients.size(); ++q)
    {
      Tensor<1, dim> x = frame * (fe_values.quadrature_point(q) - tip);
      const double r = x.norm();
      // Where the crack runs beside its line, its side counts and not the place.
      if (piece != nullptr && x[0] < 0.)
      {
        const bool left = piece->plus_side(cut->points[q]) == (end == CrackEnd::last);
        x[1] = std::copysign(left == (x[1] > 0.) ? x[1] : 0., left ? 1. : -1.);
      }
      if (weight.slope(r) == 0.)
        continue;
      Tensor<2, dim> gradient = gradients[q];
      if (cut != nullptr)
        for (unsigned int c = 0; c < cut->n_columns(); ++c)
          gradient[cut->component[c]] +=
            state.current.extra[cut->extra[c]] * cut->gradients[q * cut->n_columns() + c];
      gradient = frame * gradient * transpose(frame);
      const SymmetricTensor<2, dim> stress = stress_of(gradient);
      const double dA = cut != nullptr ? cut->weights[q] : fe_values.JxW(q);
      const Tensor<1, dim> dq = weight.slope(r) / r * x;
      for (unsigned int mode = 0; mode < 2; ++mode)
      {
        const Tensor<2, dim> unit = unit_gradient(field, mode, x);
        const SymmetricTensor<2, dim> unit_stress = stress_of(unit);
        double integrand = -(stress * symmetrize(unit)) * dq[0];
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            integrand += (stress[i][j] * unit[i][0] + unit_stress[i][j] * gradient[i][0]) * dq[j];
        sums[mode] += integrand * dA;
      }
    }
  };

  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const auto &low = cell->vertex(0), &high = cell->vertex((1 << dim) - 1);
      if ((low + 0.5 * (high - low)).distance(tip) > radius + 0.75 * low.distance(high))
        continue;
      if (const CutCell<dim> *cut = discontinuity.cut_cell(cell->active_cell_index()))
      {
        dealii::FEValues<dim> cut_values(mesh_view.mapping, fe,
                                         dealii::Quadrature<dim>(cut->points), flags);
        cut_values.reinit(cell);
        add_points(cut_values, cut, discontinuity.piece_in(cell->id(), crack));
      }
      else
      {
        plain_values.reinit(cell);
        add_points(plain_values, nullptr, nullptr);
      }
    }
  collectives.sum(sums);

  // The loaded faces. [[u^a]],1 = -1/(2 sqrt(r)); with r = s^2 it is smooth.
  const dealii::QGauss<1> line(4);
  for (unsigned int i = 0; i < path.pieces.size(); ++i)
  {
    const CrackPiece<dim> &piece = path.pieces[i];
    const double from = piece.ends[0].distance(tip), to = piece.ends[1].distance(tip);
    if (std::min(from, to) >= radius)
      continue;
    const double pressure =
      state.segment_pressure ? state.segment_pressure(discontinuity.segment_key(crack, i)) : 0.;
    const Tensor<1, dim> load =
      -1. * (frame * (pressure * across + scene.in_situ_stress(piece.centre()) * across));
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
  const double factor = std::sqrt(8. / dealii::numbers::PI);
  StressIntensity result{factor * sums[0], factor * sums[1]};
  Tensor<1, dim> k;
  k[0] = result.shear;
  k[1] = result.opening;
  result.energy_release_rate =
    0.5 * (k * (PlaneElasticity(rock.tensor(), along).crack_compliance * k));
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
