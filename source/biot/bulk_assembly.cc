#include "biot/bulk_assembly.h"

#include "biot/cell_integrals.h"

#include <deal.II/base/quadrature_lib.h>

namespace stockwork
{
using namespace dealii;

namespace
{
/// The cell's matrix from its integrals, in the order of the cell's dofs.
template <int dim>
void cell_matrix(const CellIntegrals<dim> &integrals,
                 const RockProperties &rock,
                 const double mobility,
                 const StepContext &context,
                 const PressureStabilisation stabilisation,
                 FullMatrix<double> &matrix)
{
  const auto &layout = integrals.layout;
  const unsigned int n_u = layout.n_u, n_p = layout.n_p;
  const double lambda = rock.lame_lambda(), mu = rock.shear_modulus();

  for (unsigned int a = 0; a < n_u; ++a)
    for (unsigned int b = 0; b < n_u; ++b)
    {
      double diagonal = 0.;
      for (unsigned int i = 0; i < dim; ++i)
        diagonal += integrals.gradients[((i * dim + i) * n_u + a) * n_u + b];
      diagonal *= mu;
      if (context.acceleration > 0.)
        diagonal += context.acceleration * rock.density * integrals.masses[a * n_u + b];
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          matrix(layout.u[a * dim + i], layout.u[b * dim + j]) =
            lambda * integrals.gradients[((i * dim + j) * n_u + a) * n_u + b] +
            mu * integrals.gradients[((j * dim + i) * n_u + a) * n_u + b] +
            (i == j ? diagonal : 0.);
    }
  if (n_p == 0)
    return;

  for (unsigned int a = 0; a < n_p; ++a)
    for (unsigned int b = 0; b < n_u; ++b)
      for (unsigned int i = 0; i < dim; ++i)
      {
        const double coupling =
          -rock.biot_coefficient * integrals.divergences[(i * n_p + a) * n_u + b];
        matrix(layout.p[a], layout.u[b * dim + i]) = coupling;
        matrix(layout.u[b * dim + i], layout.p[a]) = coupling;
      }

  // White & Borja 2008: what the projection onto cell-wise constants leaves of the pressure, times
  // 1/(2G), added to the storage. It acts on the increment, so it vanishes in the steady state.
  const double stabilising = stabilisation == PressureStabilisation::projection
                               ? rock.biot_coefficient * rock.biot_coefficient / (2. * mu)
                               : 0.;
  const double ratio = context.pressure_rate / context.rate;
  for (unsigned int a = 0; a < n_p; ++a)
    for (unsigned int b = 0; b < n_p; ++b)
    {
      const double mass = integrals.pressure_masses[a * n_p + b];
      const double rest =
        mass - integrals.pressure_means[a] * integrals.pressure_means[b] / integrals.volume;
      matrix(layout.p[a], layout.p[b]) =
        -ratio * (rock.inverse_biot_modulus * mass + stabilising * rest) -
        context.effective_dt() * mobility * integrals.pressure_gradients[a * n_p + b];
    }
}


/// What the rate references contribute to the residual: it is matrix * x - history.
template <int dim>
void subtract_history(const CellIntegrals<dim> &integrals,
                      const RockProperties &rock,
                      const StepContext &context,
                      const PressureStabilisation stabilisation,
                      const Vector<double> &rate_reference,
                      const Vector<double> &acceleration_reference,
                      Vector<double> &residual)
{
  const auto &layout = integrals.layout;
  const unsigned int n_u = layout.n_u, n_p = layout.n_p;
  if (context.acceleration > 0.)
    for (unsigned int a = 0; a < n_u; ++a)
      for (unsigned int b = 0; b < n_u; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          residual(layout.u[a * dim + i]) -= context.acceleration * rock.density *
                                             integrals.masses[a * n_u + b] *
                                             acceleration_reference(layout.u[b * dim + i]);
  const double stabilising =
    stabilisation == PressureStabilisation::projection
      ? rock.biot_coefficient * rock.biot_coefficient / (2. * rock.shear_modulus())
      : 0.;
  const double ratio = n_p > 0 ? context.pressure_rate / context.rate : 0.;
  for (unsigned int a = 0; a < n_p; ++a)
  {
    double content = 0.;
    for (unsigned int b = 0; b < n_u; ++b)
      for (unsigned int i = 0; i < dim; ++i)
        content += rock.biot_coefficient * integrals.divergences[(i * n_p + a) * n_u + b] *
                   rate_reference(layout.u[b * dim + i]);
    for (unsigned int b = 0; b < n_p; ++b)
    {
      const double mass = integrals.pressure_masses[a * n_p + b];
      const double rest =
        mass - integrals.pressure_means[a] * integrals.pressure_means[b] / integrals.volume;
      content += ratio * (rock.inverse_biot_modulus * mass + stabilising * rest) *
                 rate_reference(layout.p[b]);
    }
    residual(layout.p[a]) += content;
  }
}


/// Work of the boundary loads on one cell.
template <int dim>
void subtract_loads(const Loads<dim> &loads,
                    const typename DoFHandler<dim>::active_cell_iterator &cell,
                    const StepContext &context,
                    FEFaceValues<dim> &fe_values,
                    const BulkLayout<dim> &layout,
                    Vector<double> &residual)
{
  for (const unsigned int f : cell->face_indices())
    if (cell->face(f)->at_boundary())
    {
      const auto id = cell->face(f)->boundary_id();
      const auto traction = loads.traction.find(id);
      const auto normal = loads.normal_traction.find(id);
      const auto flux = loads.flux.find(id);
      if (traction == loads.traction.end() && normal == loads.normal_traction.end() &&
          (flux == loads.flux.end() || layout.n_p == 0))
        continue;
      fe_values.reinit(cell, f);
      for (const unsigned int q : fe_values.quadrature_point_indices())
      {
        const Point<dim> &x = fe_values.quadrature_point(q);
        Tensor<1, dim> t;
        if (traction != loads.traction.end())
          for (unsigned int d = 0; d < dim; ++d)
            t[d] += traction->second[d].value(x, context.time);
        if (normal != loads.normal_traction.end())
          t += normal->second.value(x, context.time) * fe_values.normal_vector(q);
        for (unsigned int a = 0; a < layout.n_u; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            residual(layout.u[a * dim + d]) -=
              t[d] * fe_values.shape_value(layout.u[a * dim + d], q) * fe_values.JxW(q);
        if (layout.n_p > 0 && flux != loads.flux.end())
        {
          const double volume =
            context.effective_dt() * flux->second.value(x, context.time) * fe_values.JxW(q);
          for (unsigned int a = 0; a < layout.n_p; ++a)
            residual(layout.p[a]) += volume * fe_values.shape_value(layout.p[a], q);
        }
      }
    }
}
} // namespace


template <int dim>
BulkAssembly<dim>::BulkAssembly(const Rock &rock,
                                const Loads<dim> &loads,
                                const PressureStabilisation stabilisation,
                                const Discretization<dim> discretization)
  : rock(rock)
  , loads(loads)
  , stabilisation(stabilisation)
  , discretization(discretization)
{
}


template <int dim>
void BulkAssembly<dim>::matrix(const StepContext &context,
                               const Role &,
                               TrilinosWrappers::BlockSparseMatrix &matrix,
                               TrilinosWrappers::SparseMatrix *fixed_stress_mass) const
{
  const auto &fe = discretization.dof_handler.get_fe();
  CellIntegrals<dim> integrals(discretization.mapping, fe, context.acceleration > 0.);
  FullMatrix<double> local(fe.n_dofs_per_cell());
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  const unsigned int n_p = integrals.layout.n_p;
  FullMatrix<double> local_mass(n_p);
  std::vector<types::global_dof_index> pressure_dofs(n_p);
  const bool with_mass = fixed_stress_mass != nullptr && n_p > 0;
  const auto first_pressure = with_mass ? matrix.block(0, 0).m() : 0;
  // The fixed-stress mass lives on the pressure block alone, so its constraints are resolved here
  // by dropping constrained rows (they carry a unit diagonal in the block itself).

  const RockProperties *properties_of_local = nullptr;
  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const RockProperties &properties = rock(cell->material_id());
      if (integrals.reinit(cell) || &properties != properties_of_local)
        cell_matrix(integrals, properties, properties.permeability / rock.fluid().viscosity,
                    context, stabilisation, local);
      properties_of_local = &properties;
      cell->get_dof_indices(dofs);
      discretization.constraints.distribute_local_to_global(local, dofs, matrix);
      if (with_mass)
      {
        const double compliance =
          properties.biot_coefficient * properties.biot_coefficient /
          (properties.lame_lambda() + 2. * properties.shear_modulus() / dim);
        for (unsigned int a = 0; a < n_p; ++a)
        {
          pressure_dofs[a] = dofs[integrals.layout.p[a]];
          for (unsigned int b = 0; b < n_p; ++b)
            local_mass(a, b) = compliance * integrals.pressure_masses[a * n_p + b];
        }
        for (unsigned int a = 0; a < n_p; ++a)
          for (unsigned int b = 0; b < n_p; ++b)
            if (!discretization.constraints.is_constrained(pressure_dofs[a]) &&
                !discretization.constraints.is_constrained(pressure_dofs[b]))
              fixed_stress_mass->add(pressure_dofs[a] - first_pressure,
                                     pressure_dofs[b] - first_pressure, local_mass(a, b));
      }
    }
  matrix.compress(VectorOperation::add);
  if (with_mass)
    fixed_stress_mass->compress(VectorOperation::add);
}


template <int dim>
void BulkAssembly<dim>::undrained_term(TrilinosWrappers::SparseMatrix &matrix) const
{
  const auto &fe = discretization.dof_handler.get_fe();
  CellIntegrals<dim> integrals(discretization.mapping, fe, false);
  const auto &layout = integrals.layout;
  const unsigned int n_u = layout.n_u, n = n_u * dim;
  FullMatrix<double> local(n);
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell()), displacement_dofs(n);
  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const RockProperties &properties = rock(cell->material_id());
      const double stiffening =
        properties.biot_coefficient * properties.biot_coefficient / properties.inverse_biot_modulus;
      integrals.reinit(cell);
      cell->get_dof_indices(dofs);
      for (unsigned int k = 0; k < n; ++k)
        displacement_dofs[k] = dofs[layout.u[k]];
      for (unsigned int a = 0; a < n_u; ++a)
        for (unsigned int b = 0; b < n_u; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              local(a * dim + i, b * dim + j) =
                stiffening * integrals.gradients[((i * dim + j) * n_u + a) * n_u + b];
      discretization.constraints.distribute_local_to_global(local, displacement_dofs, matrix);
    }
  matrix.compress(VectorOperation::add);
}


template <int dim>
template <class Function>
void BulkAssembly<dim>::for_each_residual(const StepContext &context,
                                          const State &state,
                                          const Function &use) const
{
  const auto &fe = discretization.dof_handler.get_fe();
  const unsigned int n = fe.n_dofs_per_cell();
  CellIntegrals<dim> integrals(discretization.mapping, fe, context.acceleration > 0.);
  FullMatrix<double> local(n);
  Vector<double> local_residual(n), x(n), rate_reference(n), acceleration_reference(n);
  std::vector<types::global_dof_index> dofs(n);
  FEFaceValues<dim> face_values(
    discretization.mapping, fe, QGauss<dim - 1>(fe.base_element(0).degree + 1),
    update_values | update_quadrature_points | update_normal_vectors | update_JxW_values);

  const RockProperties *properties_of_local = nullptr;
  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const RockProperties &properties = rock(cell->material_id());
      if (integrals.reinit(cell) || &properties != properties_of_local)
        cell_matrix(integrals, properties, properties.permeability / rock.fluid().viscosity,
                    context, stabilisation, local);
      properties_of_local = &properties;
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < n; ++i)
      {
        x(i) = state.current.bulk(dofs[i]);
        if (integrals.layout.n_p > 0)
          rate_reference(i) = state.rate_reference.bulk(dofs[i]);
        if (context.acceleration > 0.)
          acceleration_reference(i) = state.acceleration_reference.bulk(dofs[i]);
      }
      local.vmult(local_residual, x);
      subtract_history(integrals, properties, context, stabilisation, rate_reference,
                       acceleration_reference, local_residual);
      if (!loads.empty() && cell->at_boundary())
        subtract_loads(loads, cell, context, face_values, integrals.layout, local_residual);
      use(integrals.layout, dofs, local_residual);
    }
}


template <int dim>
void BulkAssembly<dim>::residual(const StepContext &context,
                                 const State &state,
                                 const Role &,
                                 TrilinosWrappers::MPI::BlockVector &residual) const
{
  for_each_residual(context, state,
                    [&](const auto &, const auto &dofs, const Vector<double> &local) {
                      discretization.constraints.distribute_local_to_global(local, dofs, residual);
                    });
  residual.compress(VectorOperation::add);
}


template <int dim>
void BulkAssembly<dim>::cut_cells(const StepContext &context,
                                  const State &state,
                                  const Role &role,
                                  Sink &sink) const
{
  const auto &fe = discretization.dof_handler.get_fe();
  const BulkLayout<dim> layout(fe);
  const unsigned int n_bulk = fe.n_dofs_per_cell();
  const FEValuesExtractors::Vector displacement(0);

  LocalSystem local;
  local.bulk.resize(n_bulk);
  std::vector<SymmetricTensor<2, dim>> strain, stress;
  std::vector<double> divergence;
  Vector<double> x, reference, acceleration_reference;

  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const CutCell<dim> *cut = role(cell).cut)
      {
        const unsigned int n_extra = cut->n_columns(), n = n_bulk + n_extra;
        local.extra = cut->extra;
        cell->get_dof_indices(local.bulk);
        local.reinit();

        const RockProperties &properties = rock(cell->material_id());
        const double lambda = properties.lame_lambda(), mu = properties.shear_modulus();
        const double alpha = layout.n_p > 0 ? properties.biot_coefficient : 0.;
        const double inertia = context.acceleration * properties.density;

        FEValues<dim> fe_values(discretization.mapping, fe, Quadrature<dim>(cut->points),
                                update_values | update_gradients);
        fe_values.reinit(cell);

        strain.assign(n, SymmetricTensor<2, dim>());
        stress.assign(n, SymmetricTensor<2, dim>());
        divergence.assign(n, 0.);
        for (unsigned int q = 0; q < cut->points.size(); ++q)
        {
          const double w = cut->weights[q];
          for (unsigned int k = 0; k < layout.n_u * dim; ++k)
          {
            const unsigned int i = layout.u[k];
            strain[i] = fe_values[displacement].symmetric_gradient(i, q);
          }
          for (unsigned int c = 0; c < n_extra; ++c)
          {
            const Tensor<1, dim> &gradient = cut->gradients[q * n_extra + c];
            const unsigned int d = cut->component[c];
            SymmetricTensor<2, dim> e;
            for (unsigned int j = 0; j < dim; ++j)
              e[d][j] += (j == d ? 1. : 0.5) * gradient[j];
            strain[n_bulk + c] = e;
          }
          for (unsigned int i = 0; i < n; ++i)
          {
            divergence[i] = trace(strain[i]);
            stress[i] = 2. * mu * strain[i];
            for (unsigned int d = 0; d < dim; ++d)
              stress[i][d][d] += lambda * divergence[i];
          }
          for (unsigned int c = 0; c < n_extra; ++c)
          {
            const unsigned int row = n_bulk + c;
            for (unsigned int k = 0; k < layout.n_u * dim; ++k)
            {
              const unsigned int i = layout.u[k];
              double coupling = (stress[i] * strain[row]) * w;
              if (inertia > 0. && k % dim == cut->component[c])
                coupling +=
                  inertia * cut->values[q * n_extra + c] * fe_values.shape_value(i, q) * w;
              local.matrix(row, i) += coupling;
              local.matrix(i, row) += coupling;
            }
            for (unsigned int e = 0; e < n_extra; ++e)
            {
              double coupling = (stress[n_bulk + e] * strain[row]) * w;
              if (inertia > 0. && cut->component[c] == cut->component[e])
                coupling +=
                  inertia * cut->values[q * n_extra + c] * cut->values[q * n_extra + e] * w;
              local.matrix(row, n_bulk + e) += coupling;
            }
            for (unsigned int a = 0; a < layout.n_p; ++a)
            {
              const unsigned int i = layout.p[a];
              const double coupling = -alpha * divergence[row] * fe_values.shape_value(i, q) * w;
              local.matrix(row, i) += coupling;
              local.matrix(i, row) += coupling;
            }
          }
        }

        // The residual: matrix times the unknowns, with the rate references in the mass rows.
        x.reinit(n);
        reference.reinit(n);
        for (unsigned int i = 0; i < n; ++i)
        {
          x(i) = i < n_bulk ? state.current.bulk(local.bulk[i])
                            : state.current.extra[local.extra[i - n_bulk]];
          if (layout.n_p > 0)
            reference(i) = i < n_bulk ? state.rate_reference.bulk(local.bulk[i])
                                      : state.rate_reference.extra[local.extra[i - n_bulk]];
        }
        local.matrix.vmult(local.residual, x);
        for (unsigned int a = 0; a < layout.n_p; ++a)
          for (unsigned int e = 0; e < n_extra; ++e)
            local.residual(layout.p[a]) -=
              local.matrix(layout.p[a], n_bulk + e) * reference(n_bulk + e);
        if (inertia > 0.)
        {
          // Inertia has its own reference: subtract its part of the rows again.
          for (unsigned int q = 0; q < cut->points.size(); ++q)
            for (unsigned int c = 0; c < n_extra; ++c)
            {
              double bulk_value = 0.;
              for (unsigned int b = 0; b < layout.n_u; ++b)
              {
                const unsigned int i = layout.u[b * dim + cut->component[c]];
                bulk_value +=
                  fe_values.shape_value(i, q) * state.acceleration_reference.bulk(local.bulk[i]);
              }
              double extra_value = 0.;
              for (unsigned int e = 0; e < n_extra; ++e)
                if (cut->component[e] == cut->component[c])
                  extra_value += cut->values[q * n_extra + e] *
                                 state.acceleration_reference.extra[local.extra[e]];
              const double w = inertia * cut->weights[q];
              local.residual(n_bulk + c) -=
                w * cut->values[q * n_extra + c] * (bulk_value + extra_value);
              for (unsigned int b = 0; b < layout.n_u; ++b)
              {
                const unsigned int i = layout.u[b * dim + cut->component[c]];
                local.residual(i) -= w * fe_values.shape_value(i, q) *
                                     cut->values[q * n_extra + c] *
                                     state.acceleration_reference.extra[local.extra[c]];
              }
            }
        }
        sink.add(local);
      }
}


template <int dim>
double BulkAssembly<dim>::stored_fluid(const StepContext &context,
                                       const State &state,
                                       const Role &role) const
{
  const auto &fe = discretization.dof_handler.get_fe();
  CellIntegrals<dim> integrals(discretization.mapping, fe, false);
  const auto &layout = integrals.layout;
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  const double ratio = context.pressure_rate / context.rate;
  double stored = 0.;
  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const RockProperties &properties = rock(cell->material_id());
      integrals.reinit(cell);
      cell->get_dof_indices(dofs);
      const auto change = [&](const unsigned int i)
      { return state.current.bulk(dofs[i]) - state.rate_reference.bulk(dofs[i]); };
      for (unsigned int a = 0; a < layout.n_p; ++a)
      {
        stored += ratio * properties.inverse_biot_modulus * integrals.pressure_means[a] *
                  change(layout.p[a]);
        for (unsigned int b = 0; b < layout.n_u; ++b)
          for (unsigned int i = 0; i < dim; ++i)
            stored += properties.biot_coefficient *
                      integrals.divergences[(i * layout.n_p + a) * layout.n_u + b] *
                      change(layout.u[b * dim + i]);
      }
      if (const CutCell<dim> *cut = role(cell).cut)
        for (unsigned int q = 0; q < cut->points.size(); ++q)
          for (unsigned int c = 0; c < cut->n_columns(); ++c)
          {
            const unsigned int k = cut->extra[c];
            stored += properties.biot_coefficient * cut->weights[q] *
                      cut->gradients[q * cut->n_columns() + c][cut->component[c]] *
                      (state.current.extra[k] - state.rate_reference.extra[k]);
          }
    }
  return stored;
}


template <int dim>
double BulkAssembly<dim>::outflow(const StepContext &context, const State &state) const
{
  const auto &constraints = discretization.constraints;
  double volume = 0.;
  for_each_residual(context, state,
                    [&](const BulkLayout<dim> &layout,
                        const std::vector<types::global_dof_index> &dofs,
                        const Vector<double> &residual)
                    {
                      for (const unsigned int i : layout.p)
                        if (constraints.is_constrained(dofs[i]))
                        {
                          const auto *masters = constraints.get_constraint_entries(dofs[i]);
                          if (masters == nullptr || masters->empty())
                            volume += residual(i);
                        }
                    });
  if (!loads.flux.empty())
  {
    const auto &fe = discretization.dof_handler.get_fe();
    FEFaceValues<dim> face_values(discretization.mapping, fe,
                                  QGauss<dim - 1>(fe.base_element(0).degree + 1),
                                  update_quadrature_points | update_JxW_values);
    for (const auto &cell : discretization.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
          {
            const auto flux = loads.flux.find(cell->face(f)->boundary_id());
            if (flux == loads.flux.end())
              continue;
            face_values.reinit(cell, f);
            for (const unsigned int q : face_values.quadrature_point_indices())
              volume -= context.effective_dt() * face_values.JxW(q) *
                        flux->second.value(face_values.quadrature_point(q), context.time);
          }
  }
  return volume;
}


template class BulkAssembly<2>;
template class BulkAssembly<3>;
} // namespace stockwork
