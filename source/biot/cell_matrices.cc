#include "biot/cell_matrices.h"

namespace stockwork
{
using namespace dealii;

template <int dim>
CellMatrices<dim>::CellMatrices(const Mapping<dim> &mapping,
                                const FiniteElement<dim> &fe,
                                const Rock &rock,
                                const PressureStabilisation stabilisation)
  : integrals(mapping, fe)
  , whole(fe.n_dofs_per_cell())
  , storage(integrals.layout.n_p)
  , diffusion(integrals.layout.n_p)
  , fixed_stress(integrals.layout.n_p)
  , rock(rock)
  , stabilisation(stabilisation)
{
}


template <int dim>
void CellMatrices<dim>::reinit(const typename DoFHandler<dim>::active_cell_iterator &cell,
                               const StepContext &context)
{
  const RockProperties *const before = rock_of_cell;
  rock_of_cell = &rock(cell->material_id());
  const bool new_cell = integrals.reinit(cell) || rock_of_cell != before;
  if (new_cell)
    pressure_matrices();
  if (new_cell || rate != context.rate || pressure_rate != context.pressure_rate ||
      acceleration != context.acceleration)
    whole_matrix(context);
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
        diagonal += inertia * integrals.masses[a * n_u + b];
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


template class CellMatrices<2>;
template class CellMatrices<3>;
} // namespace stockwork
