#pragma once

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include "solvers/displacement_hierarchy.h"

#include <memory>

class Epetra_CrsMatrix;

namespace stockwork
{
/// One multigrid cycle for the stiffness matrix. Quadratic elements: Chebyshev smoothing on all
/// nodes and a correction from the linear elements on the same mesh (Galerkin), which smoothed
/// aggregation with the rigid body modes solves. Linear elements, and numberings that tear nodes
/// apart: smoothed aggregation at once.
class DisplacementMultigrid
{
public:
  DisplacementMultigrid();
  ~DisplacementMultigrid();

  /// Keeps references to the matrix and the hierarchy.
  void build(const dealii::TrilinosWrappers::SparseMatrix &matrix, const DisplacementHierarchy &);

  /// dst ~ A^-1 src, symmetric and positive definite where A is.
  void vmult(dealii::TrilinosWrappers::MPI::Vector &dst,
             const dealii::TrilinosWrappers::MPI::Vector &src) const;

private:
  struct Smoother;
  template <int dim>
  struct SmootherOf;

  std::unique_ptr<Smoother> smoother; ///< of the quadratic level; may be null
  const DisplacementHierarchy *hierarchy = nullptr;
  std::unique_ptr<Epetra_CrsMatrix> linear_matrix;
  dealii::TrilinosWrappers::PreconditionAMG aggregation;
  std::vector<double> modes; ///< ML keeps a pointer into it

  mutable dealii::TrilinosWrappers::MPI::Vector defect, correction, coarse_defect,
    coarse_correction;
};
} // namespace stockwork
