#pragma once

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <stdexcept>

namespace phase_field
{
using Vector = dealii::TrilinosWrappers::MPI::Vector;
using Matrix = dealii::TrilinosWrappers::SparseMatrix;

/// The matrix among nodes whose mark is one.
struct FreePart
{
  const Matrix &matrix;
  const Vector &is_free;
  mutable Vector copy;

  void vmult(Vector &result, const Vector &x) const
  {
    copy = x;
    copy.scale(is_free);
    matrix.vmult(result, copy);
    result.scale(is_free);
  }
};


/// Of 1/2 d.A d - b.d between bounds, the upper of which is 1, by the primal-dual active set of
/// Hintermueller, Ito and Kunisch (2003): nodes on a bound that are pushed outwards stay there, the
/// others solve the linear system.
/// @param d where to begin, and the minimum; of owned nodes, as all vectors
inline void minimise(const Matrix &A,
                     const Vector &b,
                     const Vector &lower,
                     const dealii::AffineConstraints<double> &hanging,
                     Vector &d)
{
  constexpr unsigned int max_sets = 200;
  // Where there is no load, the bounds alone drive d.
  const double accuracy = 1e-10 * std::max(b.l2_norm(), A.frobenius_norm());
  dealii::TrilinosWrappers::PreconditionJacobi jacobi;
  jacobi.initialize(A);
  Vector is_free = d, before = d, residual = d, change = d;
  before = -1.;
  for (unsigned int set = 0; set < max_sets; ++set)
  {
    A.residual(residual, d, b);
    for (const auto i : d.locally_owned_elements())
      is_free(i) = hanging.is_constrained(i) || (d(i) <= lower(i) && residual(i) <= 0.) ||
                       (d(i) >= 1. && residual(i) >= 0.)
                     ? 0.
                     : 1.;
    is_free.compress(dealii::VectorOperation::insert);
    residual.scale(is_free);
    before -= is_free;
    if (before.linfty_norm() == 0. && residual.l2_norm() <= 10. * accuracy)
    {
      hanging.distribute(d);
      return;
    }
    before = is_free;
    change = 0.;
    if (residual.l2_norm() > accuracy)
    {
      dealii::SolverControl control(10000, accuracy);
      dealii::SolverCG<Vector>(control).solve(FreePart{A, is_free, d}, change, residual, jacobi);
    }
    d += change;
    for (const auto i : d.locally_owned_elements())
      d(i) = std::clamp<double>(d(i), lower(i), 1.);
    d.compress(dealii::VectorOperation::insert);
  }
  throw std::runtime_error("phase_field: the active set of nodes does not settle");
}
} // namespace phase_field
