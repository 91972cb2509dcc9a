#include "discontinuity/stress_ahead.h"

#include "stockwork/rock/linear_stiffness.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

namespace stockwork
{
using dealii::SymmetricTensor;

template <int dim>
std::vector<RockAhead<dim>> average_ahead(const std::vector<HalfDisc<dim>> &discs,
                                          const MeshView<dim> &mesh_view,
                                          const std::function<bool(unsigned int)> &is_cracked,
                                          const Scene<dim> &scene,
                                          const State &state,
                                          const Collectives &collectives)
{
  constexpr unsigned int n_components = SymmetricTensor<2, dim>::n_independent_components;
  constexpr unsigned int stride = n_components + 2;

  const auto &fe = mesh_view.dof_handler.get_fe();
  const dealii::QGauss<dim> quadrature(3);
  dealii::FEValues<dim> fe_values(mesh_view.mapping, fe, quadrature,
                                  dealii::update_values | dealii::update_gradients |
                                    dealii::update_quadrature_points | dealii::update_JxW_values);
  const dealii::FEValuesExtractors::Vector displacement(0);
  const dealii::FEValuesExtractors::Scalar pore_pressure(dim);
  std::vector<SymmetricTensor<2, dim>> strains(quadrature.size());
  std::vector<double> pressures(quadrature.size(), 0.);

  // Weighted sums of stress and pore pressure, and sum of the weights, disc by disc.
  std::vector<double> sums(discs.size() * stride, 0.);
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned() || is_cracked(cell->active_cell_index()))
      continue;
    const auto &low = cell->vertex(0), &high = cell->vertex((1 << dim) - 1);
    const auto middle = low + 0.5 * (high - low);
    const double reach = 0.75 * low.distance(high);
    bool evaluated = false;
    for (unsigned int i = 0; i < discs.size(); ++i)
    {
      const HalfDisc<dim> &disc = discs[i];
      if (middle.distance(disc.centre) > disc.radius + reach)
        continue;
      if (!evaluated)
      {
        fe_values.reinit(cell);
        fe_values[displacement].get_function_symmetric_gradients(state.current.bulk, strains);
        if (mesh_view.has_pore_pressure)
          fe_values[pore_pressure].get_function_values(state.current.bulk, pressures);
        evaluated = true;
      }
      const RockProperties rock = scene.rock.at(cell->material_id(), cell->center());
      const LinearStiffness<dim> hooke(rock);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        const auto x = fe_values.quadrature_point(q);
        const auto r = x - disc.centre;
        const double distance = r.norm();
        if (distance > disc.radius || r * disc.direction <= 0.)
          continue;
        const double ratio = distance / disc.radius;
        const double weight = std::exp(-4. * ratio * ratio) * fe_values.JxW(q);
        SymmetricTensor<2, dim> stress = scene.in_situ_stress(x) + hooke.stress(strains[q]);
        for (unsigned int d = 0; d < dim; ++d)
          stress[d][d] -= rock.biot_coefficient * pressures[q];
        for (unsigned int k = 0; k < n_components; ++k)
          sums[i * stride + k] += weight * stress.access_raw_entry(k);
        sums[i * stride + n_components] += weight * (pressures[q] + scene.in_situ_pore_pressure(x));
        sums[i * stride + n_components + 1] += weight;
      }
    }
  }
  collectives.sum(sums);

  std::vector<RockAhead<dim>> averages(discs.size());
  for (unsigned int i = 0; i < discs.size(); ++i)
    if (const double weight = sums[i * stride + n_components + 1]; weight > 0.)
    {
      for (unsigned int k = 0; k < n_components; ++k)
        averages[i].stress.access_raw_entry(k) = sums[i * stride + k] / weight;
      averages[i].pore_pressure = sums[i * stride + n_components] / weight;
    }
    else // nothing but cut cells ahead
      averages[i] = {scene.in_situ_stress(discs[i].centre),
                     scene.in_situ_pore_pressure(discs[i].centre)};
  return averages;
}

template std::vector<RockAhead<2>> average_ahead(const std::vector<HalfDisc<2>> &,
                                                 const MeshView<2> &,
                                                 const std::function<bool(unsigned int)> &,
                                                 const Scene<2> &,
                                                 const State &,
                                                 const Collectives &);
template std::vector<RockAhead<3>> average_ahead(const std::vector<HalfDisc<3>> &,
                                                 const MeshView<3> &,
                                                 const std::function<bool(unsigned int)> &,
                                                 const Scene<3> &,
                                                 const State &,
                                                 const Collectives &);
} // namespace stockwork
