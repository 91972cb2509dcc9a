#include "solvers/bordered_solver.h"

#include "stockwork/base/all_gather.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_templates.h>

#include <cmath>

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
    , of_bulk(solver.schur.product())
  {
  }

  double solve(const LinearSystem &system,
               const double tolerance,
               std::vector<double> &dx_extra,
               std::vector<double> &reaction) override
  {
    gather_corner(system.extra_extra);
    dealii::FullMatrix<double> s(op->n_extra(), op->n_extra());
    // In the order of ExtraSchur::update(), to the last digit, by which DenseSolver sees what
    // stays.
    for (const Entry &e : corner)
      s(e.row, e.column) += e.value;
    s.add(-1., of_bulk);
    solver.schur.factorise(std::move(s));
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
      react(dx_extra, reaction);
      for (unsigned int i = 0; i < r.size(); ++i)
        r[i] = system.residual_extra[i] + reaction[i];
      for (const Entry &e : corner)
        r[e.row] += e.value * dx_extra[e.column];
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

  /// reaction = -C A^-1 B dx, by BLAS: deal.II's product takes five times as long.
  void react(const std::vector<double> &dx, std::vector<double> &reaction) const
  {
    const char by_row = 'T';
    const int n = static_cast<int>(dx.size()), step = 1;
    const double minus_one = -1., zero = 0.;
    if (n > 0)
      dealii::gemv(&by_row, &n, &n, &minus_one, &of_bulk(0, 0), &n, dx.data(), &step, &zero,
                   reaction.data(), &step);
  }

  struct Entry
  {
    unsigned int row, column;
    double value;
  };

  /// D of all ranks.
  void gather_corner(const Triplets &mine)
  {
    corner.clear();
    for (std::size_t k = 0; k < mine.values.size(); ++k)
      corner.push_back({static_cast<unsigned int>(mine.rows[k]),
                        static_cast<unsigned int>(mine.columns[k]), mine.values[k]});
    corner = all_gather(solver.communicator, corner);
  }

  BorderedSolver &solver;
  std::unique_ptr<SystemOperator> op;
  const dealii::FullMatrix<double> of_bulk; ///< C A^-1 B
  std::vector<Entry> corner;                ///< D; repeated entries add up
};


std::unique_ptr<CondensedSystem> BorderedSolver::condense(const LinearSystem &system,
                                                          const SystemStamps &stamps,
                                                          const double tolerance)
{
  if (!system.definite || !has_factor(system, stamps) || n_changes > 0 ||
      stamps.bulk_values != values_with_changes || system.residual_extra.empty())
    return nullptr;
  auto op = std::make_unique<SystemOperator>(system, communicator, &factor_scaling.bulk);
  const SystemVector r = op->load();
  if (!in_balance(*op, r, tolerance * op->scaled_norm(r)))
    return nullptr;
  schur.update_border(*op, op->border(), op->n_bulk(), true, &factor_scaling.bulk);
  return std::make_unique<Condensed>(*this, std::move(op));
}
} // namespace stockwork
