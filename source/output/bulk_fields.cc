#include "output/bulk_fields.h"

#include "stockwork/rock/linear_law.h"

#include "biot/cell_matrices.h"
#include "biot/plane_tensors.h"
#include "exchange/cell_evaluator.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace stockwork
{
using namespace dealii;

template <int dim>
BulkFields<dim>::BulkFields(const MeshView<dim> &mesh_view,
                            const Scene<dim> &scene,
                            const FractureModel<dim> &model,
                            const State &state,
                            const NonlinearRock<dim> *nonlinear)
  : scene(scene)
  , model(model)
  , has_pore_pressure(mesh_view.has_pore_pressure)
  , nonlinear(nonlinear)
  , mapping(mesh_view.mapping)
  , state(state)
{
  if (nonlinear != nullptr)
    for (const RockLaw *law : nonlinear->all_laws())
    {
      permeability_changes |= law->changes_permeability();
      for (const HistoryField &field : law->history())
        if (std::none_of(remembered.begin(), remembered.end(),
                         [&](const HistoryField &known) { return known.name == field.name; }))
          remembered.push_back(field);
    }
  CellEvaluator<dim> evaluator(mesh_view.mapping, mesh_view.dof_handler.get_fe(), QMidpoint<dim>());
  std::vector<SymmetricTensor<2, dim>> strain;
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const CutCell<dim> *cut = model.role(cell).cut)
      {
        evaluator.reinit(cell, cut);
        evaluator.strain(state.current, strain);
        SymmetricTensor<2, dim> sum;
        double volume = 0.;
        for (unsigned int q = 0; q < strain.size(); ++q)
        {
          volume += evaluator.weight(q);
          sum += evaluator.weight(q) * strain[q];
        }
        mean_strain[cell->active_cell_index()] = sum / volume;
      }
}

template <int dim>
void BulkFields<dim>::evaluate_vector_field(const DataPostprocessorInputs::Vector<dim> &inputs,
                                            std::vector<Vector<double>> &quantities) const
{
  const auto cell = inputs.template get_cell<dim>();
  const RockProperties rock = scene.rock.at(cell->material_id(), cell->center());
  const BulkCoefficients<dim> linear(rock, scene.rock.fluid());
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
    // The unknown is the pressure over in situ.
    const double excess = has_pore_pressure ? inputs.solution_values[q](dim) : 0.;
    SymmetricTensor<2, dim> total =
      scene.in_situ_stress(x) + linear.stiffness * strain - excess * linear.biot;
    typename NonlinearRock<dim>::Answer answer;
    const bool asks_law = nonlinear != nullptr && nonlinear->answers(cell);
    if (asks_law)
    {
      answer =
        nonlinear->at(cell, mapping.transform_real_to_unit_cell(cell, x), x, strain, excess, state);
      total = scene.in_situ_stress(x) + in_plane<dim>(answer.stress);
    }
    put(total);
    if (has_pore_pressure)
    {
      const double pressure = excess + scene.in_situ_pore_pressure(x);
      quantities[q](n++) = pressure;
      put(total + pressure * linear.biot);
      SymmetricTensor<2, dim> mobility = linear.mobility;
      if (answer.permeability)
        mobility = in_plane<dim>(*answer.permeability) / scene.rock.fluid().viscosity;
      const Tensor<1, dim> flux = -(mobility * inputs.solution_gradients[q][dim]);
      for (unsigned int d = 0; d < dim; ++d)
        quantities[q](n++) = flux[d];
      if (permeability_changes)
        put(mobility * scene.rock.fluid().viscosity);
    }
    if (remembered.empty())
      continue;
    if (dim == 2)
      quantities[q](n++) = asks_law ? scene.in_situ_tensor(x, rock)[2][2] + answer.stress[2][2]
                                    : linear_stress_zz(x, rock, strain, excess);
    quantities[q](n++) = answer.dissipated_energy;
    put_memory(cell, answer.history, quantities[q], n);
  }
}

template <int dim>
double BulkFields<dim>::linear_stress_zz(const Point<dim> &x,
                                         const RockProperties &rock,
                                         const SymmetricTensor<2, dim> &strain,
                                         const double excess) const
{
  RockState linear;
  linear.pressure = excess;
  linear.strain = in_space(strain);
  return scene.in_situ_tensor(x, rock)[2][2] + linear_response(rock, linear).stress[2][2];
}

template <int dim>
void BulkFields<dim>::put_memory(const typename DoFHandler<dim>::active_cell_iterator &cell,
                                 const std::vector<double> &history,
                                 Vector<double> &quantities,
                                 unsigned int &n) const
{
  const std::vector<HistoryField> own =
    history.empty() ? std::vector<HistoryField>() : nonlinear->law(cell).history();
  for (const HistoryField &field : remembered)
  {
    SymmetricTensor<2, 3> tensor;
    double number = 0.;
    unsigned int at = 0;
    for (const HistoryField &mine : own)
    {
      if (mine.name == field.name && field.is_tensor)
        for (unsigned int i = 0; i < 6; ++i)
          tensor.access_raw_entry(i) = history[at + i];
      else if (mine.name == field.name)
        number = history[at];
      at += mine.is_tensor ? 6 : 1;
    }
    if (!field.is_tensor)
      quantities(n++) = number;
    else
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          quantities(n++) = tensor[i][j];
      if (dim == 2)
        quantities(n++) = tensor[2][2];
    }
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
    if (permeability_changes)
      names.insert(names.end(), dim * dim, "permeability");
  }
  if (remembered.empty())
    return names;
  if (dim == 2)
    names.push_back("total_stress_zz");
  names.push_back("dissipated_energy");
  for (const HistoryField &field : remembered)
  {
    names.insert(names.end(), field.is_tensor ? dim * dim : 1, field.name);
    if (field.is_tensor && dim == 2)
      names.push_back(field.name + "_zz");
  }
  return names;
}

template <int dim>
std::vector<DataComponentInterpretation::DataComponentInterpretation>
BulkFields<dim>::get_data_component_interpretation() const
{
  using namespace DataComponentInterpretation;
  std::vector<DataComponentInterpretation::DataComponentInterpretation> kinds;
  // A name that comes once is a scalar's, dim times a vector's, else a tensor's.
  const std::vector<std::string> names = get_names();
  for (const std::string &name : names)
  {
    const auto n = std::count(names.begin(), names.end(), name);
    kinds.push_back(n == 1     ? component_is_scalar
                    : n == dim ? component_is_part_of_vector
                               : component_is_part_of_tensor);
  }
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
