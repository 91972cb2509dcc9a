#pragma once

#include <deal.II/lac/full_matrix.h>

#include "stockwork/biot/rock.h"
#include "stockwork/fracture/state.h"

#include "biot/cell_integrals.h"

namespace stockwork
{
/// Which stabilisation the pressure of an equal-order element gets.
enum class PressureStabilisation
{
  none,
  projection ///< polynomial pressure projection, on the increment (White & Borja 2008)
};

/// The matrices of one ordinary cell of homogeneous rock. They are those of the last cell where
/// that has the same shape, rock and time step.
template <int dim>
class CellMatrices
{
public:
  CellMatrices(const dealii::Mapping<dim> &mapping,
               const dealii::FiniteElement<dim> &fe,
               const Rock &rock,
               PressureStabilisation stabilisation);

  void reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
              const StepContext &context);

  const BulkLayout<dim> &layout() const
  {
    return integrals.layout;
  }

  const RockProperties &properties() const
  {
    return *rock_of_cell;
  }

  CellIntegrals<dim> integrals;

  /// Derivative of the residual of BulkAssembly, in the order of the cell's dofs.
  dealii::FullMatrix<double> whole;

  // Between pressure nodes, positive semi-definite.
  dealii::FullMatrix<double> storage;      ///< fluid per pressure, stabilisation included
  dealii::FullMatrix<double> diffusion;    ///< outflow per pressure
  dealii::FullMatrix<double> fixed_stress; ///< alpha^2 / (lambda + 2 G / dim) times the mass

private:
  void pressure_matrices();
  void whole_matrix(const StepContext &context);

  const Rock &rock;
  PressureStabilisation stabilisation;
  const RockProperties *rock_of_cell = nullptr;
  double rate = -1., pressure_rate = -1., acceleration = -1.; ///< of `whole`
};
} // namespace stockwork
