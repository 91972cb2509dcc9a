#include "biot/cell_matrices.h"

#include <deal.II/base/quadrature_lib.h>

#include <numeric>

namespace stockwork
{
using namespace dealii;

template <int dim>
BulkCoefficients<dim>::BulkCoefficients(const RockProperties &rock, const Fluid &fluid)
  : stiffness(LinearStiffness<dim>(rock).tensor())
  , biot(rock.biot_coefficient * unit_symmetric_tensor<dim>())
  , storage(rock.inverse_biot_modulus)
  , mobility(rock.permeability_tensor<dim>() / fluid.viscosity)
{
}


template <int dim>
CellMatrices<dim>::CellMatrices(const Mapping<dim> &mapping,
                                const FiniteElement<dim> &fe,
                                const Rock &rock,
                                const PressureStabilisation stabilisation,
                                const Role &role)
  : integrals(mapping, fe)
  , whole(fe.n_dofs_per_cell())
  , storage(integrals.layout.n_p)
  , diffusion(integrals.layout.n_p)
  , fixed_stress(integrals.layout.n_p)
  , content(fe.n_dofs_per_cell())
  , rock(rock)
  , stabilisation(stabilisation)
  , role_of(role)
  , fe_values(mapping,
              fe,
              QGauss<dim>(fe.base_element(0).degree + 1),
              update_values | update_gradients | update_quadrature_points | update_JxW_values)
{
}


template <int dim>
bool CellMatrices<dim>::find_rock(const typename DoFHandler<dim>::active_cell_iterator &cell)
{
  const RockProperties *const before = rock_of_cell;
  rock_of_cell = &rock(cell->material_id());
  if (!rock_of_cell->is_random() || !rock_of_cell->random->varies_in_bulk())
    return rock_of_cell != before;
  rock_of_place = rock.at(cell->material_id(), cell->center());
  rock_of_cell = &rock_of_place;
  return true;
}


template <int dim>
void CellMatrices<dim>::reinit(const typename DoFHandler<dim>::active_cell_iterator &cell,
                               const StepContext &context)
{
  const bool new_rock = find_rock(cell);
  const bool new_cell = integrals.reinit(cell) || new_rock || is_special || has_passed_over;
  has_passed_over = false;
  const CellRole<dim> role = role_of ? role_of(cell) : CellRole<dim>();
  is_special = role.skip_stiffness != nullptr || role.fracture_normal != nullptr || role.lumps_mass;
  lumps_mass = role.lumps_mass;
  const bool new_whole = new_cell || rate != context.rate ||
                         pressure_rate != context.pressure_rate ||
                         acceleration != context.acceleration;
  if (rock_of_cell->stiffness || !rock_of_cell->has_isotropic_permeability())
  {
    if (new_whole)
      matrices_by_quadrature(cell, context);
  }
  else
  {
    if (new_cell)
      pressure_matrices();
    if (new_whole)
      whole_matrix(context);
  }
  if (role.fracture_normal != nullptr)
    exclude_opening(*role.fracture_normal);
  if (role.skip_stiffness != nullptr)
    skip_stiffness(*role.skip_stiffness, context);
}


template <int dim>
double CellMatrices<dim>::mass(const unsigned int a, const unsigned int b) const
{
  const double *const row = integrals.masses.data() + a * layout().n_u;
  if (!lumps_mass)
    return row[b];
  return a == b ? std::accumulate(row, row + layout().n_u, 0.) : 0.;
}


template <int dim>
void CellMatrices<dim>::skip_stiffness(const std::vector<bool> &vertices,
                                       const StepContext &context)
{
  // Vertices are a cell's first nodes.
  const double inertia = context.acceleration * rock_of_cell->density;
  for (unsigned int a = 0; a < vertices.size(); ++a)
    if (vertices[a])
      for (unsigned int b = 0; b < layout().n_u; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            whole(layout().u[a * dim + i], layout().u[b * dim + j]) =
              i == j ? inertia * mass(a, b) : 0.;
}


template <int dim>
void CellMatrices<dim>::exclude_opening(const Tensor<1, dim> &normal)
{
  const unsigned int n_u = layout().n_u, n_p = layout().n_p;
  for (unsigned int a = 0; a < n_p; ++a)
    for (unsigned int b = 0; b < n_u; ++b)
    {
      double along = 0.; // int P_a n.grad N_b
      for (unsigned int j = 0; j < dim; ++j)
        along += normal[j] * integrals.divergences[(j * n_p + a) * n_u + b];
      for (unsigned int i = 0; i < dim; ++i)
      {
        const unsigned int u = layout().u[b * dim + i], p = layout().p[a];
        const double opening = rock_of_cell->biot_coefficient * normal[i] * along;
        whole(p, u) += opening;
        whole(u, p) += opening;
        content(u) -= opening;
      }
    }
}


template <int dim>
void CellMatrices<dim>::pressure_matrices()
{
  const unsigned int n_p = layout().n_p;
  const RockProperties &properties = *rock_of_cell;
  const double alpha_squared = properties.biot_coefficient * properties.biot_coefficient;
  const double mobility = properties.permeability / rock.fluid().viscosity;
  const double compliance =
    alpha_squared / (properties.lame_lambda() + 2. * properties.shear_modulus() / dim);
  // White & Borja 2008: what the projection onto cell-wise constants leaves of the pressure, times
  // 1/(2G), added to the storage. It acts on the increment, so it vanishes in the steady state.
  const double stabilising = stabilisation == PressureStabilisation::projection
                               ? alpha_squared / (2. * properties.shear_modulus())
                               : 0.;
  for (unsigned int a = 0; a < n_p; ++a)
    for (unsigned int b = 0; b < n_p; ++b)
    {
      const double mass = integrals.pressure_masses[a * n_p + b];
      const double rest =
        mass - integrals.pressure_means[a] * integrals.pressure_means[b] / integrals.volume;
      storage(a, b) = properties.inverse_biot_modulus * mass + stabilising * rest;
      diffusion(a, b) = mobility * integrals.pressure_gradients[a * n_p + b];
      fixed_stress(a, b) = compliance * mass;
    }
  const unsigned int n_u = layout().n_u;
  content = 0.;
  for (unsigned int a = 0; a < n_p; ++a)
  {
    content(layout().p[a]) = properties.inverse_biot_modulus * integrals.pressure_means[a];
    for (unsigned int b = 0; b < n_u; ++b)
      for (unsigned int i = 0; i < dim; ++i)
        content(layout().u[b * dim + i]) +=
          properties.biot_coefficient * integrals.divergences[(i * n_p + a) * n_u + b];
  }
}


template <int dim>
void CellMatrices<dim>::whole_matrix(const StepContext &context)
{
  const auto &layout = integrals.layout;
  const unsigned int n_u = layout.n_u, n_p = layout.n_p;
  const double lambda = rock_of_cell->lame_lambda(), mu = rock_of_cell->shear_modulus();
  const double inertia = context.acceleration * rock_of_cell->density;

  for (unsigned int a = 0; a < n_u; ++a)
    for (unsigned int b = 0; b < n_u; ++b)
    {
      double diagonal = 0.;
      for (unsigned int i = 0; i < dim; ++i)
        diagonal += integrals.gradients[((i * dim + i) * n_u + a) * n_u + b];
      diagonal *= mu;
      if (inertia > 0.)
        diagonal += inertia * mass(a, b);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          whole(layout.u[a * dim + i], layout.u[b * dim + j]) =
            lambda * integrals.gradients[((i * dim + j) * n_u + a) * n_u + b] +
            mu * integrals.gradients[((j * dim + i) * n_u + a) * n_u + b] +
            (i == j ? diagonal : 0.);
    }
  for (unsigned int a = 0; a < n_p; ++a)
  {
    for (unsigned int b = 0; b < n_u; ++b)
      for (unsigned int i = 0; i < dim; ++i)
      {
        const double coupling =
          -rock_of_cell->biot_coefficient * integrals.divergences[(i * n_p + a) * n_u + b];
        whole(layout.p[a], layout.u[b * dim + i]) = coupling;
        whole(layout.u[b * dim + i], layout.p[a]) = coupling;
      }
    for (unsigned int b = 0; b < n_p; ++b)
      whole(layout.p[a], layout.p[b]) = -context.pressure_rate / context.rate * storage(a, b) -
                                        context.effective_dt() * diffusion(a, b);
  }
  rate = context.rate;
  pressure_rate = context.pressure_rate;
  acceleration = context.acceleration;
}


template <int dim>
void CellMatrices<dim>::matrices_by_quadrature(
  const typename DoFHandler<dim>::active_cell_iterator &cell, const StepContext &context)
{
  const FEValuesExtractors::Vector displacement(0);
  const auto &layout = integrals.layout;
  const unsigned int n_p = layout.n_p;
  const double inertia = context.acceleration * rock_of_cell->density;

  fe_values.reinit(cell);
  const BulkCoefficients<dim> c(*rock_of_cell, rock.fluid());

  for (FullMatrix<double> *matrix : {&whole, &storage, &diffusion, &fixed_stress})
    *matrix = 0.;
  content = 0.;
  for (const unsigned int q : fe_values.quadrature_point_indices())
  {
    const double w = fe_values.JxW(q);
    for (const unsigned int j : layout.u)
    {
      const auto strain = fe_values[displacement].symmetric_gradient(j, q);
      const auto stress = c.stiffness * strain;
      const double content_here = c.biot * strain * w;
      for (const unsigned int i : layout.u)
        whole(i, j) += fe_values[displacement].symmetric_gradient(i, q) * stress * w;
      for (const unsigned int i : layout.p)
      {
        whole(i, j) -= fe_values.shape_value(i, q) * content_here;
        whole(j, i) -= fe_values.shape_value(i, q) * content_here;
      }
      content(j) += content_here;
    }
    // As in isotropic rock: alpha, G and the bulk modulus are means of the tensors.
    const double alpha = trace(c.biot) / dim;
    const double stabilising =
      stabilisation == PressureStabilisation::projection
        ? alpha * alpha / (2. * LinearStiffness<dim>::mean_shear_modulus(c.stiffness))
        : 0.;
    const double bulk_modulus = LinearStiffness<dim>::mean_bulk_modulus(c.stiffness);
    for (unsigned int a = 0; a < n_p; ++a)
    {
      const double value = fe_values.shape_value(layout.p[a], q),
                   mean = integrals.pressure_means[a] / integrals.volume;
      const Tensor<1, dim> flux = c.mobility * fe_values.shape_grad(layout.p[a], q) * w;
      content(layout.p[a]) += c.storage * value * w;
      for (unsigned int b = 0; b < n_p; ++b)
      {
        const double other = fe_values.shape_value(layout.p[b], q),
                     other_mean = integrals.pressure_means[b] / integrals.volume;
        storage(a, b) +=
          (c.storage * value * other + stabilising * (value - mean) * (other - other_mean)) * w;
        diffusion(a, b) += flux * fe_values.shape_grad(layout.p[b], q);
        fixed_stress(a, b) += alpha * alpha / bulk_modulus * value * other * w;
      }
    }
  }
  if (inertia > 0.)
    for (unsigned int a = 0; a < layout.n_u; ++a)
      for (unsigned int b = 0; b < layout.n_u; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          whole(layout.u[a * dim + i], layout.u[b * dim + i]) += inertia * mass(a, b);
  for (unsigned int a = 0; a < n_p; ++a)
    for (unsigned int b = 0; b < n_p; ++b)
      whole(layout.p[a], layout.p[b]) = -context.pressure_rate / context.rate * storage(a, b) -
                                        context.effective_dt() * diffusion(a, b);
  rate = context.rate;
  pressure_rate = context.pressure_rate;
  acceleration = context.acceleration;
}


template struct BulkCoefficients<2>;
template struct BulkCoefficients<3>;
template class CellMatrices<2>;
template class CellMatrices<3>;
} // namespace stockwork
