#include "solvers/krylov.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Rounding makes the residual of the recurrence drift from the true one; then start afresh.
constexpr unsigned int max_cycles = 4;

using BlockVector = TrilinosWrappers::MPI::BlockVector;

/// All unknowns as one block vector, for the library's Krylov methods. The extra ones, if any, are
/// its last block, each with its owner.
class Joined
{
public:
  Joined(const SystemOperator &op, const MPI_Comm communicator)
    : extra(op.extra_layout())
  {
    const auto &bulk = op.scaling().bulk;
    const unsigned int n_bulk = bulk.n_blocks();
    zero.reinit(n_bulk + (extra.size() > 0 ? 1 : 0));
    for (unsigned int b = 0; b < n_bulk; ++b)
      zero.block(b).reinit(bulk.block(b).locally_owned_elements(), communicator);
    if (extra.size() > 0)
      zero.block(n_bulk).reinit(extra.owned(), communicator);
    zero.collect_sizes();
  }

  BlockVector join(const SystemVector &from) const
  {
    BlockVector to(zero);
    join(to, from);
    return to;
  }

  void join(BlockVector &to, const SystemVector &from) const
  {
    for (unsigned int b = 0; b < from.bulk.n_blocks(); ++b)
      to.block(b) = from.bulk.block(b);
    if (extra.size() > 0)
      std::copy_n(from.extra.begin(), extra.n_owned(),
                  to.block(to.n_blocks() - 1).trilinos_vector()[0]);
  }

  void split(SystemVector &to, const BlockVector &from) const
  {
    for (unsigned int b = 0; b < to.bulk.n_blocks(); ++b)
      to.bulk.block(b) = from.block(b);
    if (extra.size() == 0)
      return;
    std::copy_n(from.block(from.n_blocks() - 1).trilinos_vector()[0], extra.n_owned(),
                to.extra.begin());
    extra.update(to.extra);
  }

private:
  const ExtraLayout &extra;
  BlockVector zero;
};

/// A linear action on all unknowns between diagonal scalings, so that the Krylov method sees the
/// norm of LinearReport.
class Scaled
{
public:
  /// dst = action of src, which it may use as working space.
  using Action = std::function<void(SystemVector &dst, SystemVector &src)>;

  Scaled(const SystemOperator &op, const Joined &joined, const BlockVector &scaling, Action action)
    : joined(joined)
    , action(std::move(action))
    , scaling(scaling)
    , unscaled(scaling)
    , in(op.make_vector())
    , out(op.make_vector())
  {
  }

  void vmult(BlockVector &dst, const BlockVector &src) const
  {
    unscaled = src;
    unscaled.scale(scaling);
    joined.split(in, unscaled);
    action(out, in);
    joined.join(dst, out);
    dst.scale(scaling);
  }

private:
  const Joined &joined;
  const Action action;
  const BlockVector scaling;
  mutable BlockVector unscaled;
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
  const Joined joined(op, communicator);
  const BlockVector scaling = joined.join(op.scaling());
  BlockVector inverse_scaling(scaling);
  for (unsigned int b = 0; b < inverse_scaling.n_blocks(); ++b)
  {
    auto &v = inverse_scaling.block(b).trilinos_vector();
    v.Reciprocal(v);
  }
  const Scaled matrix(op, joined, scaling,
                      [&](SystemVector &dst, SystemVector &src) { op.vmult(dst, src); });
  const Scaled scaled_preconditioner(op, joined, inverse_scaling, preconditioner);
  BlockVector b = joined.join(op.load()), x(scaling), r(scaling);
  b.scale(scaling);
  b *= -1.;
  x = 0.;
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
        SolverCG<BlockVector>(control).solve(matrix, x, b, scaled_preconditioner);
      else
        SolverFGMRES<BlockVector>(control,
                                  SolverFGMRES<BlockVector>::AdditionalData(limits.restart))
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
  x.scale(scaling);
  joined.split(dx, x);
}
} // namespace stockwork
