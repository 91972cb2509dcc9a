#pragma once

#include <deal.II/lac/trilinos_block_sparse_matrix.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include "solvers/displacement_hierarchy.h"
#include "solvers/row_changes.h"

#include <vector>

namespace stockwork
{
/// Entries of a sparse matrix as they come; repeated entries add up.
struct Triplets
{
  std::vector<dealii::types::global_dof_index> rows;
  std::vector<dealii::types::global_dof_index> columns;
  std::vector<double> values;

  void add(const dealii::types::global_dof_index row,
           const dealii::types::global_dof_index column,
           const double value)
  {
    rows.push_back(row);
    columns.push_back(column);
    values.push_back(value);
  }

  void clear()
  {
    rows.clear();
    columns.clear();
    values.clear();
  }

  /// Give back the room for more of them: as much again as they take.
  void shrink_to_fit()
  {
    rows.shrink_to_fit();
    columns.shrink_to_fit();
    values.shrink_to_fit();
  }
};

/// One linear system J dx = -R in the bulk unknowns (blocks: displacement and, if present, pore
/// pressure) and the extra unknowns of the fracture.
///
///   [ bulk         bulk_extra  ]
///   [ extra_bulk   extra_extra ]
///
/// Rows and columns of constrained bulk dofs have a diagonal entry and nothing else. The triplets
/// hold this rank's contributions only, in global bulk dof indices and extra indices; the system is
/// the sum over ranks. `residual_extra` is summed already and the same on all ranks.
struct LinearSystem
{
  dealii::TrilinosWrappers::BlockSparseMatrix bulk;
  RowChanges bulk_changes; ///< whoever changes a few rows says so here; else all count as changed

  /// What the tangent of rock beyond its linear range adds to `bulk`, with its pattern; null:
  /// nothing. TangentSolver sees to it; of the solvers only those do that say so
  /// (LinearSolver::sees_rock_change).
  const dealii::TrilinosWrappers::BlockSparseMatrix *rock_change = nullptr;
  bool rock_change_is_symmetric = true;

  Triplets bulk_extra;
  Triplets extra_bulk;
  Triplets extra_extra;

  dealii::TrilinosWrappers::MPI::BlockVector residual_bulk; ///< owned entries only
  std::vector<double> residual_extra;
  unsigned int n_mechanical_extra = 0; ///< the first extra unknowns move; the rest belong to fluid

  /// alpha^2 / (lambda + 2 G / dim) times the mass matrix of the pore pressure, positive, with the
  /// pattern of bulk(1,1), constrained rows zero. Wanted by the iterative solver and the
  /// fixed-stress split only; may be empty.
  dealii::TrilinosWrappers::SparseMatrix fixed_stress_mass;

  /// See make_displacement_hierarchy(). Wanted by the iterative solver only; may be empty.
  DisplacementHierarchy displacement_hierarchy;

  bool symmetric = true; ///< as assembled
  bool elastic = false;  ///< the bulk is displacement alone, so it has a factor without the rest
  bool definite = false; ///< the bulk alone is symmetric positive definite
  bool definite_displacement = false; ///< its displacement block is
};

/// What has changed since a solver last looked. A number grows when the thing it names changes.
struct SystemStamps
{
  unsigned int mesh = 0;                ///< size and sparsity of the bulk block
  unsigned int matrix = 0;              ///< values that have nothing to do with those before
  unsigned int bulk_values = 0;         ///< values of the bulk block
  unsigned int displacement_values = 0; ///< values of its displacement block
  unsigned int extra = 0;        ///< number or meaning of the extra unknowns, or their bulk columns
  unsigned int extra_values = 0; ///< values of extra_extra
};
} // namespace stockwork
