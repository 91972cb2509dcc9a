#include "solvers/krylov.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <memory>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Rounding makes the residual of the recurrence drift from the true one; then start afresh.
constexpr unsigned int max_cycles = 4;

/// All unknowns of this rank in one vector, for the library's Krylov methods: one sum over the
/// ranks per product. Extra unknowns, each with its owner, come last.
using KrylovVector = LinearAlgebra::distributed::Vector<double>;

/// Between the system's vectors and those of the Krylov methods.
class KrylovLayout
{
public:
  KrylovLayout(const SystemOperator &op, const MPI_Comm communicator)
    : extra(op.extra_layout())
  {
    const auto &bulk = op.scaling().bulk;
    types::global_dof_index n = extra.n_owned();
    for (unsigned int b = 0; b < bulk.n_blocks(); ++b)
      n += bulk.block(b).locally_owned_size();
    const auto parts = Utilities::MPI::create_ascending_partitioning(communicator, n);
    partitioner = std::make_shared<Utilities::MPI::Partitioner>(
      parts[Utilities::MPI::this_mpi_process(communicator)], communicator);
  }

  KrylovVector join(const SystemVector &from) const
  {
    KrylovVector to(partitioner);
    visit(from, [&to](const double value, const unsigned int i) { to.local_element(i) = value; });
    return to;
  }

  /// to = factor * from, unknown by unknown.
  void join(KrylovVector &to, const SystemVector &from, const KrylovVector &factor) const
  {
    visit(from, [&](const double value, const unsigned int i)
          { to.local_element(i) = factor.local_element(i) * value; });
  }

  /// to = factor * from, unknown by unknown.
  void split(SystemVector &to, const KrylovVector &from, const KrylovVector &factor) const
  {
    visit(to, [&](double &value, const unsigned int i)
          { value = factor.local_element(i) * from.local_element(i); });
    if (extra.size() > 0)
      extra.update(to.extra);
  }

private:
  /// Call `function(value, i)` for all unknowns of this rank.
  template <class Vector, class Function>
  void visit(Vector &vector, const Function &function) const
  {
    unsigned int i = 0;
    for (unsigned int b = 0; b < vector.bulk.n_blocks(); ++b)
    {
      auto *const values = vector.bulk.block(b).begin();
      const unsigned int n = vector.bulk.block(b).locally_owned_size();
      for (unsigned int k = 0; k < n; ++k, ++i)
        function(values[k], i);
    }
    for (unsigned int k = 0; k < extra.n_owned(); ++k, ++i)
      function(vector.extra[k], i);
  }

  const ExtraLayout &extra;
  std::shared_ptr<const Utilities::MPI::Partitioner> partitioner;
};

/// A linear action on all unknowns between diagonal scalings, so that the Krylov method sees the
/// norm of LinearReport.
class Scaled
{
public:
  /// dst = action of src, which it may use as working space.
  using Action = std::function<void(SystemVector &dst, SystemVector &src)>;

  Scaled(const SystemOperator &op,
         const KrylovLayout &layout,
         const KrylovVector &scaling,
         Action action)
    : layout(layout)
    , action(std::move(action))
    , scaling(scaling)
    , in(op.make_vector())
    , out(op.make_vector())
  {
  }

  void vmult(KrylovVector &dst, const KrylovVector &src) const
  {
    layout.split(in, src, scaling);
    action(out, in);
    layout.join(dst, out, scaling);
  }

private:
  const KrylovLayout &layout;
  const Action action;
  const KrylovVector &scaling;
  mutable SystemVector in, out;
};
} // namespace


void solve_by_krylov(const SystemOperator &op,
                     const MPI_Comm communicator,
                     const Preconditioner &preconditioner,
                     const KrylovLimits &limits,
                     SystemVector &dx,
                     LinearReport &report)
{
  const KrylovLayout layout(op, communicator);
  const KrylovVector scaling = layout.join(op.scaling());
  KrylovVector inverse_scaling(scaling);
  for (double &s : inverse_scaling)
    s = 1. / s;
  const Scaled matrix(op, layout, scaling,
                      [&](SystemVector &dst, SystemVector &src) { op.vmult(dst, src); });
  const Scaled scaled_preconditioner(op, layout, inverse_scaling, preconditioner);
  KrylovVector b = layout.join(op.load()), x, r;
  x.reinit(b);
  r.reinit(b);
  b.scale(scaling);
  b *= -1.;
  const double size = b.l2_norm();
  report.converged = size == 0.;
  unsigned int iterations = 0;
  for (unsigned int cycle = 0;
       cycle < max_cycles && !report.converged && iterations < limits.max_iterations; ++cycle)
  {
    SolverControl control(limits.max_iterations - iterations, limits.tolerance * size);
    try
    {
      if (limits.symmetric_definite)
        SolverCG<KrylovVector>(control).solve(matrix, x, b, scaled_preconditioner);
      else
        SolverFGMRES<KrylovVector>(control,
                                   SolverFGMRES<KrylovVector>::AdditionalData(limits.restart))
          .solve(matrix, x, b, scaled_preconditioner);
    }
    catch (const SolverControl::NoConvergence &)
    {
    }
    iterations += control.last_step();
    // Not what the recurrence believes, but what is.
    matrix.vmult(r, x);
    r -= b;
    report.relative_residual = r.l2_norm() / size;
    report.converged = report.relative_residual <= 1.01 * limits.tolerance;
  }
  report.iterations += iterations;
  layout.split(dx, x, scaling);
}
} // namespace stockwork
