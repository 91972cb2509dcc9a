#pragma once

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/trilinos_block_sparse_matrix.h>

#include "stockwork/biot/rock.h"
#include "stockwork/fracture/cell_role.h"
#include "stockwork/fracture/sink.h"
#include "stockwork/fracture/state.h"
#include "stockwork/mesh/discretization.h"

#include "biot/boundary_conditions.h"

#include <functional>

namespace stockwork
{
/// Which stabilisation the pressure of an equal-order element gets.
enum class PressureStabilisation
{
  none,
  projection ///< polynomial pressure projection, on the increment (White & Borja 2008)
};

/// Assembles Biot's equations for isotropic rock:
///
///   R_u(v) = int (C : eps(u) - alpha p I) : eps(v) + rho u'' . v - loads
///   R_p(q) = -dt_eff int [ q (alpha div u' + p'/M - s) + (k/mu) grad q . grad p ]
///
/// where p is the pore pressure over its in-situ value, u is measured from the in-situ state and
/// the signs are those of Sink. The rock is linear, so the matrix depends on the time scheme's
/// coefficients and the mesh only.
template <int dim>
class BulkAssembly
{
public:
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;
  using Role = std::function<CellRole<dim>(const CellIterator &)>;

  BulkAssembly(const Rock &rock,
               const Loads<dim> &loads,
               PressureStabilisation stabilisation,
               const Discretization<dim> discretization);

  /// Add the matrix of the bulk; `fixed_stress_mass` may be null.
  void matrix(const StepContext &context,
              const Role &role,
              dealii::TrilinosWrappers::BlockSparseMatrix &matrix,
              dealii::TrilinosWrappers::SparseMatrix *fixed_stress_mass) const;

  /// Add int alpha^2 M div u div v, which turns the drained stiffness into the undrained one, to a
  /// matrix of the displacement block.
  void undrained_term(dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /// Add the residual of the bulk.
  void residual(const StepContext &context,
                const State &state,
                const Role &role,
                dealii::TrilinosWrappers::MPI::BlockVector &residual) const;

  /// Add what cut cells have beyond an ordinary cell: matrix and residual of the extra columns.
  void
  cut_cells(const StepContext &context, const State &state, const Role &role, Sink &sink) const;

  /// Fluid that the pores of the owned cells have gained since the rate references [m^3 (/m)].
  double stored_fluid(const StepContext &context, const State &state, const Role &role) const;

  /// Fluid that has left the owned cells through the boundary in the step [m^3 (/m)]: the reactions
  /// to prescribed pore pressures, less the prescribed flux.
  double outflow(const StepContext &context, const State &state) const;

private:
  /// Call use(layout, dofs, residual) with the unconstrained residual of every owned cell.
  template <class Function>
  void for_each_residual(const StepContext &context, const State &state, const Function &use) const;

  const Rock &rock;
  const Loads<dim> &loads;
  PressureStabilisation stabilisation;
  const Discretization<dim> discretization;
};
} // namespace stockwork
