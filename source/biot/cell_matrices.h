#pragma once

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include "stockwork/fracture/cell_role.h"
#include "stockwork/fracture/state.h"
#include "stockwork/rock/linear_stiffness.h"

#include "biot/cell_integrals.h"

#include <functional>
#include <vector>

namespace stockwork
{
/// Which stabilisation the pressure of an equal-order element gets.
enum class PressureStabilisation
{
  none,
  projection ///< polynomial pressure projection, on the increment (White & Borja 2008)
};

/// What a fracture model does to the rock, see FractureModel; either may be empty.
template <int dim>
struct BulkChanges
{
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;

  std::function<void(const CellIterator &,
                     const std::vector<dealii::Point<dim>> &,
                     std::vector<BulkCoefficients<dim>> &)>
    coefficients;
  std::function<CellRole<dim>(const CellIterator &)>
    role; ///< cut cells are no business of this one
};

/// Rock that no fracture model changes.
template <int dim>
BulkCoefficients<dim> intact_rock(const RockProperties &rock, const Fluid &fluid);

/// The matrices of one cell. In homogeneous rock that no fracture model changes they are those of
/// the last cell where that has the same shape, rock and time step.
template <int dim>
class CellMatrices
{
public:
  CellMatrices(const dealii::Mapping<dim> &mapping,
               const dealii::FiniteElement<dim> &fe,
               const Rock &rock,
               PressureStabilisation stabilisation,
               const BulkChanges<dim> &changes = {});

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

  /// d(fluid in the pores of the cell)/d(unknowns), stabilisation aside.
  dealii::Vector<double> content;

private:
  void pressure_matrices();

  /// From coefficients at quadrature points, of any symmetry.
  void matrices_by_quadrature(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                              const StepContext &context);
  void whole_matrix(const StepContext &context);
  void skip_stiffness(const std::vector<bool> &vertices, const StepContext &context);
  void exclude_opening(const dealii::Tensor<1, dim> &normal);

  const Rock &rock;
  PressureStabilisation stabilisation;
  const BulkChanges<dim> changes;
  dealii::FEValues<dim> fe_values;                 ///< for changed or anisotropic cells
  std::vector<BulkCoefficients<dim>> coefficients; ///< at the quadrature points of such a cell
  const RockProperties *rock_of_cell = nullptr;
  bool is_special = false; ///< the cell has a role, so its matrices are no other's
  double rate = -1., pressure_rate = -1., acceleration = -1.; ///< of `whole`
};
} // namespace stockwork
