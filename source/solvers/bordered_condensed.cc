#include "solvers/bordered_solver.h"

#include "stockwork/base/all_gather.h"

#include <deal.II/lac/full_matrix.h>

#include <cmath>
#include <numeric>

namespace stockwork
{
/// By the factor of the bulk and the products that ExtraSchur keeps: an iteration takes a dense
/// factorisation and no back-substitution.
class BorderedSolver::Condensed : public CondensedSystem
{
public:
  Condensed(BorderedSolver &solver, std::unique_ptr<SystemOperator> op)
    : solver(solver)
    , op(std::move(op))
  {
  }

  double solve(const LinearSystem &system,
               const double tolerance,
               std::vector<double> &dx_extra,
               std::vector<double> &reaction) override
  {
    gather_corner(system.extra_extra);
    solver.schur.factorise(corner);
    dx_extra.assign(op->n_extra(), 0.);
    reaction = dx_extra;
    std::vector<double> r = system.residual_extra;
    const double size = norm(r);
    double left = size > 0. ? 1. : 0.;
    for (unsigned int k = 0; k <= max_refinements && left > tolerance; ++k)
    {
      solver.schur.solve(r);
      for (unsigned int i = 0; i < r.size(); ++i)
        dx_extra[i] -= r[i];
      reaction = solver.schur.product(dx_extra);
      for (double &value : reaction)
        value = -value;
      for (unsigned int i = 0; i < r.size(); ++i)
        r[i] = system.residual_extra[i] + reaction[i] +
               std::inner_product(dx_extra.begin(), dx_extra.end(), &corner(i, 0), 0.);
      left = norm(r) / size;
    }
    return left;
  }

  void recover_bulk(const LinearSystem &system,
                    const std::vector<double> &dx_extra,
                    dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk) override
  {
    SystemVector load = op->make_vector();
    load.bulk = system.residual_bulk;
    for (const auto &e : op->bulk_extra())
    {
      const auto [block, local] = op->locate(e.row);
      SystemOperator::entry(load.bulk, block, local) += e.value * dx_extra[e.column];
    }
    SystemVector solution = op->make_vector();
    solver.solve_bulk(system, load.bulk, solution.bulk);
    solution.bulk *= -1.;
    dx_bulk = solution.bulk;
  }

private:
  static constexpr unsigned int max_refinements = 2;

  double norm(const std::vector<double> &r) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < r.size(); ++i)
      sum += (op->scaling().extra[i] * r[i]) * (op->scaling().extra[i] * r[i]);
    return std::sqrt(sum);
  }

  /// D of all ranks.
  void gather_corner(const Triplets &mine)
  {
    const auto rows = all_gather(solver.communicator, mine.rows),
               columns = all_gather(solver.communicator, mine.columns);
    const auto values = all_gather(solver.communicator, mine.values);
    corner.reinit(op->n_extra(), op->n_extra());
    for (std::size_t k = 0; k < values.size(); ++k)
      corner(rows[k], columns[k]) += values[k];
  }

  BorderedSolver &solver;
  std::unique_ptr<SystemOperator> op;
  dealii::FullMatrix<double> corner;
};


std::unique_ptr<CondensedSystem> BorderedSolver::condense(const LinearSystem &system,
                                                          const SystemStamps &stamps,
                                                          const double tolerance)
{
  if (!system.definite || !has_factor(system, stamps) || n_changes > 0 ||
      stamps.bulk_values != values_with_changes || system.residual_extra.empty())
    return nullptr;
  auto op = std::make_unique<SystemOperator>(system, communicator, &factor_scaling.bulk);
  SystemVector r = op->make_vector();
  r.bulk = system.residual_bulk;
  r.extra = system.residual_extra;
  if (!in_balance(*op, r, tolerance * op->scaled_norm(r)))
    return nullptr;
  schur.update_border(*op, op->border(), op->n_bulk(), true, &factor_scaling.bulk);
  return std::make_unique<Condensed>(*this, std::move(op));
}
} // namespace stockwork
