#include "output/bulk_fields.h"

#include <deal.II/fe/fe_values.h>

namespace stockwork
{
using namespace dealii;

template <int dim>
BulkFields<dim>::BulkFields(const Discretization<dim> &discretization,
                            const Scene<dim> &scene,
                            const FractureModel<dim> &model,
                            const State &state)
  : scene(scene)
  , model(model)
  , has_pore_pressure(discretization.has_pore_pressure)
{
  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const CutCell<dim> *cut = model.role(cell).cut)
      {
        FEValues<dim> fe_values(discretization.mapping, discretization.dof_handler.get_fe(),
                                Quadrature<dim>(cut->points), update_gradients);
        fe_values.reinit(cell);
        std::vector<SymmetricTensor<2, dim>> strain(cut->points.size());
        fe_values[FEValuesExtractors::Vector(0)].get_function_symmetric_gradients(
          state.current.bulk, strain);
        SymmetricTensor<2, dim> sum;
        double volume = 0.;
        for (unsigned int q = 0; q < cut->points.size(); ++q)
        {
          volume += cut->weights[q];
          sum += cut->weights[q] * strain[q];
          for (unsigned int c = 0; c < cut->n_columns(); ++c)
          {
            Tensor<2, dim> gradient;
            gradient[cut->component[c]] = cut->gradients[q * cut->n_columns() + c];
            sum += cut->weights[q] * state.current.extra[cut->extra[c]] * symmetrize(gradient);
          }
        }
        mean_strain[cell->active_cell_index()] = sum / volume;
      }
}

template <int dim>
void BulkFields<dim>::evaluate_vector_field(const DataPostprocessorInputs::Vector<dim> &inputs,
                                            std::vector<Vector<double>> &quantities) const
{
  const auto cell = inputs.template get_cell<dim>();
  const RockProperties &rock = scene.rock(cell->material_id());
  const auto identity = unit_symmetric_tensor<dim>();

  BulkCoefficients<dim> intact;
  intact.stiffness = rock.lame_lambda() * outer_product(identity, identity) +
                     2. * rock.shear_modulus() * identity_tensor<dim>();
  intact.biot = rock.biot_coefficient * identity;
  intact.storage = rock.inverse_biot_modulus;
  intact.mobility = rock.permeability / scene.rock.fluid().viscosity * identity;
  std::vector<BulkCoefficients<dim>> coefficients(inputs.evaluation_points.size(), intact);
  if (model.requirements().changes_bulk)
    model.bulk_coefficients(cell, inputs.evaluation_points, coefficients);
  const auto mean = mean_strain.find(cell->active_cell_index());

  for (unsigned int q = 0; q < inputs.evaluation_points.size(); ++q)
  {
    const Point<dim> &x = inputs.evaluation_points[q];
    unsigned int n = 0;
    const auto put = [&](const SymmetricTensor<2, dim> &t)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          quantities[q](n++) = t[i][j];
    };

    Tensor<2, dim> gradient;
    for (unsigned int d = 0; d < dim; ++d)
    {
      quantities[q](n++) = inputs.solution_values[q](d);
      gradient[d] = inputs.solution_gradients[q][d];
    }
    SymmetricTensor<2, dim> strain = symmetrize(gradient);
    if (mean != mean_strain.end())
      strain = mean->second;
    SymmetricTensor<2, dim> total = scene.in_situ_stress(x) + coefficients[q].stiffness * strain;
    if (!has_pore_pressure)
    {
      put(total);
      continue;
    }

    // The unknown is the pressure over in situ.
    const double excess = inputs.solution_values[q](dim);
    const double pressure = excess + scene.in_situ_pore_pressure(x);
    total -= excess * coefficients[q].biot;
    put(total);
    quantities[q](n++) = pressure;
    put(total + pressure * coefficients[q].biot);
    const Tensor<1, dim> flux = -(coefficients[q].mobility * inputs.solution_gradients[q][dim]);
    for (unsigned int d = 0; d < dim; ++d)
      quantities[q](n++) = flux[d];
  }
}

template <int dim>
std::vector<std::string> BulkFields<dim>::get_names() const
{
  std::vector<std::string> names(dim, "displacement");
  names.insert(names.end(), dim * dim, "total_stress");
  if (has_pore_pressure)
  {
    names.push_back("pore_pressure");
    names.insert(names.end(), dim * dim, "effective_stress");
    names.insert(names.end(), dim, "flux");
  }
  return names;
}

template <int dim>
std::vector<DataComponentInterpretation::DataComponentInterpretation>
BulkFields<dim>::get_data_component_interpretation() const
{
  using namespace DataComponentInterpretation;
  std::vector<DataComponentInterpretation::DataComponentInterpretation> kinds;
  for (const std::string &name : get_names())
    kinds.push_back(name == "pore_pressure"                    ? component_is_scalar
                    : name == "displacement" || name == "flux" ? component_is_part_of_vector
                                                               : component_is_part_of_tensor);
  return kinds;
}

template <int dim>
UpdateFlags BulkFields<dim>::get_needed_update_flags() const
{
  return update_values | update_gradients | update_quadrature_points;
}

template class BulkFields<2>;
template class BulkFields<3>;
} // namespace stockwork
