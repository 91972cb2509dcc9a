#pragma once

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/trilinos_block_sparse_matrix.h>

#include "stockwork/exchange/cell_role.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"
#include "stockwork/mesh/mesh_view.h"
#include "stockwork/rock/rock.h"

#include "biot/boundary_conditions.h"
#include "biot/cell_matrices.h"
#include "exchange/cell_evaluator.h"

#include <functional>
#include <map>
#include <vector>

namespace stockwork
{
/// Assembles Biot's equations for isotropic rock:
///
///   R_u(v) = int (C : eps(u) - alpha p I) : eps(v) + rho u'' . v - loads
///   R_p(q) = -dt_eff int [ q (alpha div u' + p'/M - s) + (k/mu) grad q . grad p ]
///
/// where p is the pore pressure over its in-situ value, u is measured from the in-situ state and
/// the signs are those of Sink. The rock is linear, so the matrix depends on the time scheme's
/// coefficients, the mesh and what a fracture model does to the rock, and most of the residual is
/// a product with it.
///
/// Valid for one mesh.
template <int dim>
class BulkAssembly
{
public:
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;
  using Role = std::function<CellRole<dim>(const CellIterator &)>;

  BulkAssembly(const Rock &rock,
               const Loads<dim> &loads,
               PressureStabilisation stabilisation,
               const MeshView<dim> mesh_view,
               const Role &role = {});

  /// Fill the matrix of the bulk and, unless null, the fixed-stress mass. Cells are visited when
  /// `anew` or where inertia has changed; otherwise the step's length alone has, and with it the
  /// pressure block, a linear combination of two matrices. Returns whether the displacement's rows
  /// have changed.
  bool matrix(const StepContext &context,
              bool anew,
              dealii::TrilinosWrappers::BlockSparseMatrix &matrix,
              dealii::TrilinosWrappers::SparseMatrix *fixed_stress_mass);

  /// Fill rows of the matrix anew, and what the fluid content takes of their unknowns; between
  /// pressures nothing changes. What is there afterwards is what matrix() would have put there.
  /// @param rows of all ranks
  /// @return false where hanging nodes meet the rows: then nothing has been done. Collective.
  bool rows(const StepContext &context,
            const dealii::IndexSet &rows,
            dealii::TrilinosWrappers::BlockSparseMatrix &matrix);

  /// Add int alpha^2 M div u div v, which turns the drained stiffness into the undrained one, to a
  /// matrix of the displacement block.
  void undrained_term(dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /// The residual of the bulk.
  /// @param matrix of this step; null: in a state in which no free unknown has moved
  void residual(const StepContext &context,
                const State &state,
                const dealii::TrilinosWrappers::BlockSparseMatrix *matrix,
                dealii::TrilinosWrappers::MPI::BlockVector &residual) const;

  /// Add what cut cells have beyond an ordinary cell: matrix and residual of the extra columns.
  void
  cut_cells(const StepContext &context, const State &state, const Role &role, Sink &sink) const;

  /// The cuts of cells may have changed.
  void forget_cuts()
  {
    cut_evaluator.forget_cuts();
  }

  /// Fluid that the pores of the owned cells have gained since the rate references [m^3 (/m)].
  double stored_fluid(const StepContext &context, const State &state, const Role &role) const;

  /// Fluid that the pores of the owned cells hold over what they held in situ [m^3 (/m)].
  double pore_volume(const Unknowns &unknowns, const Role &role) const;

  /// Fluid that has passed the boundary of the owned cells in a step [m^3 (/m)].
  struct BoundaryFlow
  {
    double out = 0.;     ///< less what has come in
    double through = 0.; ///< out and in
  };

  /// The reactions to prescribed pore pressures, and the prescribed flux.
  BoundaryFlow outflow(const StepContext &context, const State &state) const;

private:
  /// What matrix() does where cells are visited, but for the pressure block.
  void visit_cells(const StepContext &context,
                   dealii::TrilinosWrappers::BlockSparseMatrix &matrix,
                   dealii::TrilinosWrappers::SparseMatrix *fixed_stress_mass);

  /// Add what a cell without hanging nodes does to these rows.
  void add_rows(const std::vector<dealii::types::global_dof_index> &dofs,
                const dealii::IndexSet &rows,
                dealii::TrilinosWrappers::BlockSparseMatrix &matrix);

  using LocalVector = dealii::Vector<double>;

  /// Numbers of the pressure dofs and of the cells that need more than a product.
  void set_up();

  /// What the rate references contribute to the residual of a cell.
  void subtract_history(const StepContext &context,
                        const LocalVector &rate_reference,
                        LocalVector &residual) const;

  /// The fluid in the pores per these values of the unknowns; the owned ones of the bulk.
  double fluid_content(const dealii::TrilinosWrappers::MPI::BlockVector &bulk,
                       const std::vector<double> &extra,
                       const Role &role) const;

  /// Work and volume of the boundary loads on a cell.
  void
  subtract_loads(const StepContext &context, const CellIterator &cell, LocalVector &residual) const;

  /// Inertia of the reference state.
  void add_inertia(const StepContext &context,
                   const State &state,
                   dealii::TrilinosWrappers::MPI::BlockVector &residual) const;

  const Rock &rock;
  const Loads<dim> &loads;
  const MeshView<dim> mesh_view;

  std::vector<dealii::IndexSet> owned, relevant; ///< by block
  std::vector<std::vector<int>> constrained;     ///< among the owned ones, by block
  /// Of the pressures, numbered from zero.
  dealii::AffineConstraints<double> pressure_constraints;
  std::vector<CellIterator> edge_cells; ///< with loads or constrained dofs
  std::vector<CellIterator>
    drained_cells; ///< with prescribed pressures, or hanging nodes beside them

  // Of the pressure block, both positive semi-definite.
  dealii::TrilinosWrappers::SparseMatrix storage, diffusion;
  double acceleration = 0.; ///< with which the matrix was assembled

  /// d(fluid in the pores)/d(unknowns), the pressures' part at the rate of the displacement's.
  dealii::TrilinosWrappers::MPI::BlockVector content;

  /// The matrix of a cut cell, and what it was made for.
  struct CutMatrix
  {
    std::size_t fingerprint = 0; ///< of the functions that jump and their points
    double inertia = 0.;
    dealii::FullMatrix<double> matrix;
  };

  mutable CellMatrices<dim> matrices;
  mutable CellEvaluator<dim> cut_evaluator;
  /// By active cell index. A crack that grows leaves most cells as they are.
  mutable std::map<unsigned int, CutMatrix> cut_matrices;
  mutable dealii::FEFaceValues<dim> face_values;
};
} // namespace stockwork
