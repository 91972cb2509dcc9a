#include "stockwork/mesh/nodal_energy.h"

#include "stockwork/base/error.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <algorithm>
#include <string>

namespace stockwork
{
using namespace dealii;

template <int dim>
void NodalEnergy<dim>::reinit(const NodalFields<dim> &new_fields)
{
  fields = &new_fields;
  const DoFHandler<dim> &handler = fields->dof_handler();
  IndexSet relevant;
  DoFTools::extract_locally_relevant_dofs(handler, relevant);
  DynamicSparsityPattern pattern(relevant);
  DoFTools::make_sparsity_pattern(handler, pattern, fields->constraints(), false);
  const IndexSet &owned = handler.locally_owned_dofs();
  SparsityTools::distribute_sparsity_pattern(pattern, owned, handler.get_communicator(), relevant);
  matrix.reinit(owned, owned, pattern, handler.get_communicator());
  right_side = fields->owned_vector();
}


template <int dim>
void NodalEnergy<dim>::clear()
{
  matrix = 0.;
  right_side = 0.;
}


template <int dim>
void NodalEnergy<dim>::add(const FullMatrix<double> &A,
                           const dealii::Vector<double> &b,
                           const std::vector<types::global_dof_index> &nodes)
{
  fields->constraints().distribute_local_to_global(A, b, nodes, matrix, right_side);
}


namespace
{
/// The matrix among nodes whose mark is one.
struct FreePart
{
  using Vector = TrilinosWrappers::MPI::Vector;

  const TrilinosWrappers::SparseMatrix &matrix;
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
} // namespace


/// The primal-dual active set of Hintermueller, Ito and Kunisch (2003): nodes on a bound that are
/// pushed outwards stay there, the others solve the linear system.
template <int dim>
typename NodalEnergy<dim>::Vector
NodalEnergy<dim>::minimum(const Vector &lower, const double upper, const Vector &start)
{
  constexpr unsigned int max_sets = 200;
  matrix.compress(VectorOperation::add);
  right_side.compress(VectorOperation::add);
  // Where there is no load, the bounds alone drive the field.
  const double accuracy = 1e-10 * std::max(right_side.l2_norm(), matrix.frobenius_norm());
  TrilinosWrappers::PreconditionJacobi jacobi;
  jacobi.initialize(matrix);
  Vector d = fields->owned_vector();
  d = start;
  Vector is_free = d, before = d, residual = d, change = d;
  before = -1.;
  for (unsigned int set = 0; set < max_sets; ++set)
  {
    matrix.residual(residual, d, right_side);
    for (const auto i : d.locally_owned_elements())
      is_free(i) = fields->constraints().is_constrained(i) ||
                       (d(i) <= lower(i) && residual(i) <= 0.) ||
                       (d(i) >= upper && residual(i) >= 0.)
                     ? 0.
                     : 1.;
    is_free.compress(VectorOperation::insert);
    residual.scale(is_free);
    before -= is_free;
    if (before.linfty_norm() == 0. && residual.l2_norm() <= 10. * accuracy)
    {
      fields->constraints().distribute(d);
      return d;
    }
    before = is_free;
    change = 0.;
    if (residual.l2_norm() > accuracy)
    {
      SolverControl control(10000, accuracy);
      SolverCG<Vector>(control).solve(FreePart{matrix, is_free, d}, change, residual, jacobi);
    }
    d += change;
    for (const auto i : d.locally_owned_elements())
      d(i) = std::clamp<double>(d(i), lower(i), upper);
    d.compress(VectorOperation::insert);
  }
  throw SolveError("The nodes at which the field '" + fields->names.front() +
                   "' is at a bound do not settle in " + std::to_string(max_sets) + " passes.");
}


template class NodalEnergy<2>;
template class NodalEnergy<3>;
} // namespace stockwork
