#pragma once

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include "stockwork/exchange/cell_role.h"
#include "stockwork/exchange/state.h"
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

/// Coefficients of linear rock, of any symmetry.
template <int dim>
struct BulkCoefficients
{
  BulkCoefficients(const RockProperties &rock, const Fluid &fluid);

  dealii::SymmetricTensor<4, dim> stiffness;
  dealii::SymmetricTensor<2, dim> biot;
  double storage;                           ///< 1/M [1/Pa]
  dealii::SymmetricTensor<2, dim> mobility; ///< k/mu [m^2/(Pa s)]
};

/// The matrices of one cell of linear rock. They are those of the last cell where that has the same
/// shape, rock and time step, and neither has a role. Where the rock varies from place to place,
/// the integrals at least are the last cell's.
template <int dim>
class CellMatrices
{
public:
  using Role =
    std::function<CellRole<dim>(const typename dealii::DoFHandler<dim>::active_cell_iterator &)>;

  /// @param role what a fracture model does to cells; cut ones are no business of this class. May
  /// be empty.
  CellMatrices(const dealii::Mapping<dim> &mapping,
               const dealii::FiniteElement<dim> &fe,
               const Rock &rock,
               PressureStabilisation stabilisation,
               const Role &role = {});

  void reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
              const StepContext &context);

  /// As reinit() where the matrices of the cell are not wanted: those of later cells are the same,
  /// to the last digit, as if they had been.
  void pass_over(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell)
  {
    has_passed_over = integrals.reinit(cell) || has_passed_over;
  }

  const BulkLayout<dim> &layout() const
  {
    return integrals.layout;
  }

  const RockProperties &properties() const
  {
    return *rock_of_cell;
  }

  CellIntegrals<dim> integrals;

  /// Of the displacement's nodes, over the density; lumped where the cell's role says so.
  double mass(unsigned int a, unsigned int b) const;

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

  /// Find the rock of a cell. Returns whether it is another than that of the last cell.
  bool find_rock(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell);

  /// Of anisotropic rock.
  void matrices_by_quadrature(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                              const StepContext &context);
  void whole_matrix(const StepContext &context);
  void skip_stiffness(const std::vector<bool> &vertices, const StepContext &context);
  void exclude_opening(const dealii::Tensor<1, dim> &normal);

  const Rock &rock;
  PressureStabilisation stabilisation;
  const Role role_of;
  dealii::FEValues<dim> fe_values; ///< for anisotropic rock
  const RockProperties *rock_of_cell = nullptr;
  RockProperties rock_of_place; ///< of a cell whose rock is no other's
  bool is_special = false;      ///< the cell has a role, so its matrices are no other's
  bool lumps_mass = false;      ///< by its role
  bool has_passed_over = false; ///< a cell that has changed the integrals
  double rate = -1., pressure_rate = -1., acceleration = -1.; ///< of `whole`
};
} // namespace stockwork
