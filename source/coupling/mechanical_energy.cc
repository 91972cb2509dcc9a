#include "coupling/mechanical_energy.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace stockwork
{
using namespace dealii;

template <int dim>
MechanicalEnergy mechanical_energy(
  const Discretization<dim> &discretization,
  const Rock &rock,
  const std::function<CellRole<dim>(const typename DoFHandler<dim>::active_cell_iterator &)> &role,
  const State &state,
  const Collectives &collectives)
{
  const auto &fe = discretization.dof_handler.get_fe();
  const auto &constraints = discretization.constraints;
  const QGauss<dim> gauss(fe.degree + 1);
  const FEValuesExtractors::Vector displacement(0);
  FEValues<dim> ordinary(discretization.mapping, fe, gauss, update_gradients | update_JxW_values);
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  std::vector<unsigned int> held; // local indices of prescribed displacements

  double stored = 0., work = 0., force = 0., greatest = 0.;
  const auto add_cell =
    [&](const FEValues<dim> &values, const CutCell<dim> *cut, const RockProperties &properties)
  {
    std::vector<SymmetricTensor<2, dim>> now(values.n_quadrature_points), before(now.size());
    values[displacement].get_function_symmetric_gradients(state.current.bulk, now);
    if (!held.empty())
      values[displacement].get_function_symmetric_gradients(state.committed.bulk, before);
    for (unsigned int q = 0; q < now.size(); ++q)
    {
      if (cut != nullptr)
        for (unsigned int c = 0; c < cut->n_columns(); ++c)
        {
          Tensor<2, dim> gradient;
          gradient[cut->component[c]] = cut->gradients[q * cut->n_columns() + c];
          now[q] += state.current.extra[cut->extra[c]] * symmetrize(gradient);
          before[q] += state.committed.extra[cut->extra[c]] * symmetrize(gradient);
        }
      const double weight = cut != nullptr ? cut->weights[q] : values.JxW(q);
      const auto stress = [&](const SymmetricTensor<2, dim> &strain)
      {
        return properties.lame_lambda() * trace(strain) * unit_symmetric_tensor<dim>() +
               2. * properties.shear_modulus() * strain;
      };
      const SymmetricTensor<2, dim> stress_now = stress(now[q]);
      stored += 0.5 * weight * (stress_now * now[q]);
      if (held.empty())
        continue;
      const SymmetricTensor<2, dim> mean = 0.5 * (stress_now + stress(before[q]));
      for (const unsigned int i : held)
      {
        const SymmetricTensor<2, dim> strain = values[displacement].symmetric_gradient(i, q);
        const double u = state.current.bulk(dofs[i]);
        work += weight * (mean * strain) * (u - state.committed.bulk(dofs[i]));
        force += weight * (stress_now * strain) * u;
        greatest = std::max(greatest, std::abs(u));
      }
    }
  };

  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(dofs);
      held.clear();
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (fe.system_to_component_index(i).first < dim && constraints.is_constrained(dofs[i]))
        {
          const auto *masters = constraints.get_constraint_entries(dofs[i]);
          if (masters == nullptr || masters->empty())
            held.push_back(i);
        }
      const RockProperties &properties = rock(cell->material_id());
      if (const CutCell<dim> *cut = role(cell).cut)
      {
        FEValues<dim> values(discretization.mapping, fe, Quadrature<dim>(cut->points),
                             update_gradients);
        values.reinit(cell);
        add_cell(values, cut, properties);
      }
      else
      {
        ordinary.reinit(cell);
        add_cell(ordinary, nullptr, properties);
      }
    }
  greatest = collectives.max(greatest);
  std::vector<double> sums{stored, work, force};
  collectives.sum(sums);
  return {sums[0], sums[1], greatest > 0. ? sums[2] / greatest : 0.};
}


template MechanicalEnergy
mechanical_energy(const Discretization<2> &,
                  const Rock &,
                  const std::function<CellRole<2>(const DoFHandler<2>::active_cell_iterator &)> &,
                  const State &,
                  const Collectives &);
template MechanicalEnergy
mechanical_energy(const Discretization<3> &,
                  const Rock &,
                  const std::function<CellRole<3>(const DoFHandler<3>::active_cell_iterator &)> &,
                  const State &,
                  const Collectives &);
} // namespace stockwork
