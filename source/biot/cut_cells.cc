#include "biot/bulk_assembly.h"

#include "stockwork/rock/linear_stiffness.h"

#include <functional>
#include <string_view>

namespace stockwork
{
using namespace dealii;

namespace
{
template <class Number>
void mix(std::size_t &fingerprint, const std::vector<Number> &numbers)
{
  const std::string_view bytes(reinterpret_cast<const char *>(numbers.data()),
                               numbers.size() * sizeof(Number));
  fingerprint = 31 * fingerprint + std::hash<std::string_view>()(bytes);
}


/// A number that is the same where the same functions jump, whatever the indices of their unknowns.
template <int dim>
std::size_t fingerprint_of(const CutCell<dim> &cut)
{
  std::size_t fingerprint = 1;
  mix(fingerprint, cut.component);
  mix(fingerprint, cut.values);
  mix(fingerprint, cut.gradients);
  mix(fingerprint, cut.points);
  mix(fingerprint, cut.weights);
  return fingerprint;
}


/// Index in a local system of a function of the displacement.
template <int dim>
unsigned int place(const CellEvaluator<dim> &cell, const unsigned int function)
{
  const auto &u = cell.layout.u;
  return function < u.size() ? u[function] : cell.dofs().size() + function - u.size();
}


/// Columns and rows of the extra functions; what ordinary ones do to one another is not here.
template <int dim>
void add_matrix(const CellEvaluator<dim> &cell,
                const RockProperties &rock,
                const double inertia,
                FullMatrix<double> &matrix)
{
  const LinearStiffness<dim> hooke(rock);
  const unsigned int n_ordinary = cell.layout.u.size(), n = cell.n_functions();
  std::vector<SymmetricTensor<2, dim>> strain(n), stress(n);
  for (unsigned int q = 0; q < cell.n_points(); ++q)
  {
    const double w = cell.weight(q);
    for (unsigned int i = 0; i < n; ++i)
    {
      strain[i] = cell.strain_of(i, q);
      stress[i] = w * hooke.stress(strain[i]);
    }
    for (unsigned int r = n_ordinary; r < n; ++r)
    {
      const unsigned int row = place(cell, r);
      for (unsigned int i = 0; i < n; ++i)
      {
        double coupling = stress[i] * strain[r];
        if (inertia > 0. && cell.component(i) == cell.component(r))
          coupling += inertia * cell.value(i, q) * cell.value(r, q) * w;
        matrix(row, place(cell, i)) += coupling;
        if (i < n_ordinary)
          matrix(place(cell, i), row) += coupling;
      }
      for (unsigned int a = 0; a < cell.layout.n_p; ++a)
      {
        const double coupling =
          -rock.biot_coefficient * trace(strain[r]) * cell.pressure_value(a, q) * w;
        matrix(row, cell.layout.p[a]) += coupling;
        matrix(cell.layout.p[a], row) += coupling;
      }
    }
  }
}


/// Matrix times unknowns, with the rate references in the mass rows.
template <int dim>
void add_residual(const BulkLayout<dim> &layout, const State &state, LocalSystem &local)
{
  const unsigned int n_bulk = local.bulk.size(), n_extra = local.extra.size();
  Vector<double> x(n_bulk + n_extra);
  for (unsigned int i = 0; i < n_bulk; ++i)
    x(i) = state.current.bulk(local.bulk[i]);
  for (unsigned int e = 0; e < n_extra; ++e)
    x(n_bulk + e) = state.current.extra[local.extra[e]];
  local.matrix.vmult(local.residual, x);
  for (const unsigned int row : layout.p)
    for (unsigned int e = 0; e < n_extra; ++e)
      local.residual(row) -=
        local.matrix(row, n_bulk + e) * state.rate_reference.extra[local.extra[e]];
}


/// Inertia has its own reference: its part of the rows is taken away again.
template <int dim>
void subtract_inertia_of_reference(const CellEvaluator<dim> &cell,
                                   const State &state,
                                   const double inertia,
                                   LocalSystem &local)
{
  const Unknowns &reference = state.acceleration_reference;
  const unsigned int n_ordinary = cell.layout.u.size(), n = cell.n_functions();
  const auto value = [&](const unsigned int function)
  {
    return function < n_ordinary ? double(reference.bulk(local.bulk[cell.layout.u[function]]))
                                 : reference.extra[local.extra[function - n_ordinary]];
  };
  for (unsigned int q = 0; q < cell.n_points(); ++q)
    for (unsigned int r = n_ordinary; r < n; ++r)
      for (unsigned int i = 0; i < n; ++i)
      {
        if (cell.component(i) != cell.component(r))
          continue;
        const double mass = inertia * cell.weight(q) * cell.value(i, q) * cell.value(r, q);
        local.residual(place(cell, r)) -= mass * value(i);
        if (i < n_ordinary)
          local.residual(place(cell, i)) -= mass * value(r);
      }
}
} // namespace


template <int dim>
void BulkAssembly<dim>::cut_cells(const StepContext &context,
                                  const State &state,
                                  const Role &role,
                                  Sink &sink) const
{
  LocalSystem local;
  local.bulk.resize(mesh_view.dof_handler.get_fe().n_dofs_per_cell());
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const CutCell<dim> *cut = role(cell).cut)
      {
        cell->get_dof_indices(local.bulk);
        local.extra = cut->extra;
        local.reinit();
        const RockProperties properties = rock.at(cell->material_id(), cell->center());
        const double inertia = context.acceleration * properties.density;
        CutMatrix &kept = cut_matrices[cell->active_cell_index()];
        const std::size_t fingerprint = fingerprint_of(*cut);
        const bool is_known =
          !kept.matrix.empty() && kept.inertia == inertia && kept.fingerprint == fingerprint;
        if (!is_known || inertia > 0.)
          cut_evaluator.reinit(cell, cut);
        if (!is_known)
        {
          add_matrix(cut_evaluator, properties, inertia, local.matrix);
          kept = {fingerprint, inertia, local.matrix};
        }
        local.matrix = kept.matrix;
        add_residual(cut_evaluator.layout, state, local);
        if (inertia > 0.)
          subtract_inertia_of_reference(cut_evaluator, state, inertia, local);
        else
          cut_evaluator.forget_cuts(); // not asked for again, and large
        sink.add(local);
      }
}


template void
BulkAssembly<2>::cut_cells(const StepContext &, const State &, const Role &, Sink &) const;
template void
BulkAssembly<3>::cut_cells(const StepContext &, const State &, const Role &, Sink &) const;
} // namespace stockwork
