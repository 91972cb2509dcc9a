#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include "stockwork/mesh/nodal_fields.h"

#include <vector>

namespace stockwork
{
/// A quadratic energy 1/2 d.A d - b.d of a nodal field, with A positive definite, and its minimum
/// between bounds: of a damage field, for instance, which never heals and is 1 at most.
template <int dim>
class NodalEnergy
{
public:
  using Vector = typename NodalFields<dim>::Vector;

  /// Zero, on the mesh as the fields have it now; they outlive the energy.
  void reinit(const NodalFields<dim> &fields);

  /// Zero, on the same mesh.
  void clear();

  /// Add a cell's part of A and b.
  /// @param nodes of the cell, in the fields' numbers
  void add(const dealii::FullMatrix<double> &A,
           const dealii::Vector<double> &b,
           const std::vector<dealii::types::global_dof_index> &nodes);

  /// Collective. All parts have been added. The vectors are those of owned nodes, or of more.
  /// @param start where to begin: the nearer, the faster
  /// @throws SolveError if the nodes that are at a bound do not settle
  Vector minimum(const Vector &lower, double upper, const Vector &start);

private:
  const NodalFields<dim> *fields = nullptr;
  dealii::TrilinosWrappers::SparseMatrix matrix;
  Vector right_side;
};
} // namespace stockwork
