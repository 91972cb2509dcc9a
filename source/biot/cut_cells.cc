#include "biot/bulk_assembly.h"

#include "stockwork/rock/linear_stiffness.h"

namespace stockwork
{
using namespace dealii;

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
        const LinearStiffness<dim> hooke(properties);
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
            stress[i] = hooke.stress(strain[i]);
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


template void
BulkAssembly<2>::cut_cells(const StepContext &, const State &, const Role &, Sink &) const;
template void
BulkAssembly<3>::cut_cells(const StepContext &, const State &, const Role &, Sink &) const;
} // namespace stockwork
