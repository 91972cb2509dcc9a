#include "solvers/bordered_solver.h"

#include "solvers/bulk_transfer.h"

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_gmres.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace stockwork
{
namespace
{
/// GMRES between few unknowns keeps all its basis vectors. It is given up when that has cost as
/// much as so many substitutions with all unknowns, or after so many iterations.
constexpr double most_substitutions = 20., most_local_iterations = 100.;
} // namespace

/// The linear system of rock that yields, seen from the few unknowns T that the change dA of the
/// rock's matrix or the border touches. With J the system of linear rock,
///
///   (J + dA) z = r,   z = J^-1 (r + y),   y + dA J^-1 y = -dA J^-1 r,
///
/// and y is zero outside of T. All between diagonal scalings.
class BorderedSolver::LocalTangent
{
public:
  using Vector = dealii::Vector<double>;

  LocalTangent(const BorderedSolver &solver,
               const SystemOperator &op,
               const SystemOperator::Border &border)
    : solver(solver)
    , border(border)
    , d(op.scaling().bulk.block(0).trilinos_vector()[0])
  {
    find_change(op.system().rock_change->block(0, 0).trilinos_matrix());
    inverse = solver.factor->local_inverse(unknowns);
    after_change.reinit(unknowns.size());
  }

  /// (J + dA)^-1 r: half = L^-1 of the load that gives it.
  unsigned int
  solve(std::vector<double> &half, const std::vector<double> &r_extra, const double allowed)
  {
    if (unknowns.empty())
      return 0; // the rock is on its surface, and has not moved on it
    Vector y(unknowns.size()), load(unknowns.size()), x(unknowns.size());
    inverse->backward_to_few(half, x);
    answer_of_extra(x, r_extra);
    multiply_by_change(load, x);
    load *= -1.;
    const unsigned int most = inverse->cost() * most_local_iterations > most_substitutions
                                ? most_substitutions / inverse->cost()
                                : most_local_iterations;
    dealii::SolverControl control(most, allowed);
    try
    {
      using Gmres = dealii::SolverGMRES<Vector>;
      Gmres(control, Gmres::AdditionalData(most + 2))
        .solve(*this, y, load, dealii::PreconditionIdentity());
    }
    catch (const dealii::SolverControl::NoConvergence &)
    {
    }
    inverse->add_forward(y, half);
    return control.last_step();
  }

  /// The extra unknowns z_extra, and half of what remains for the bulk.
  std::vector<double> eliminate_extra(std::vector<double> &half,
                                      const std::vector<double> &r_extra) const
  {
    std::vector<double> z(r_extra);
    if (border.n == 0)
      return z;
    Vector x(unknowns.size());
    inverse->backward_to_few(half, x);
    x = load_of_extra(x, z);
    inverse->add_forward(x, half);
    return z;
  }

  /// dst = (I + dA J^-1) src
  void vmult(Vector &dst, const Vector &src) const
  {
    inverse->vmult(dst, src);
    answer_of_extra(dst, {});
    multiply_by_change(after_change, dst);
    dst = src;
    dst += after_change;
  }

  const LocalInverse &local_inverse() const
  {
    return *inverse;
  }

private:
  int number(const dealii::types::global_dof_index unknown) const
  {
    return std::lower_bound(unknowns.begin(), unknowns.end(), static_cast<int>(unknown)) -
           unknowns.begin();
  }

  /// The rows of dA that are not zero, without the rest.
  void find_change(const Epetra_CrsMatrix &change)
  {
    const auto for_each_row = [&](const auto &use)
    {
      for (int i = 0; i < change.NumMyRows(); ++i)
      {
        int n_entries;
        double *values;
        int *indices;
        change.ExtractMyRowView(i, n_entries, values, indices);
        if (std::any_of(values, values + n_entries, [](const double v) { return v != 0.; }))
          use(i, n_entries, values, indices);
      }
    };
    for_each_row(
      [&](const int i, const int n_entries, const double *values, const int *indices)
      {
        rows.push_back(i);
        unknowns.push_back(i);
        for (int k = 0; k < n_entries; ++k)
          if (values[k] != 0.)
            entries.push_back({change.GCID(indices[k]), values[k]});
        ends.push_back(entries.size());
      });
    for (const auto &e : entries)
      unknowns.push_back(e.column);
    for (const auto &e : border.bulk_extra)
      unknowns.push_back(static_cast<int>(e.row));
    for (const auto &e : border.extra_bulk)
      unknowns.push_back(static_cast<int>(e.column));
    std::sort(unknowns.begin(), unknowns.end());
    unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
    std::size_t k = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      for (; k < ends[i]; ++k)
      {
        entries[k].value *= d[rows[i]] * d[entries[k].column];
        entries[k].column = number(entries[k].column);
      }
      rows[i] = number(rows[i]);
    }
    for (const auto &e : border.bulk_extra)
      columns_of_extra.push_back({number(e.row), e.column, e.value * d[e.row]});
    for (const auto &e : border.extra_bulk)
      rows_of_extra.push_back({number(e.column), e.row, e.value * d[e.column]});
  }

  void multiply_by_change(Vector &dst, const Vector &src) const
  {
    dst = 0.;
    std::size_t k = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      double sum = 0.;
      for (; k < ends[i]; ++k)
        sum += entries[k].value * src(entries[k].column);
      dst(rows[i]) = sum;
    }
  }

  /// z = S^-1 (r_extra - C x), x the answer of the bulk alone. Returns the load -B z.
  Vector load_of_extra(const Vector &x, std::vector<double> &z) const
  {
    z.resize(border.n, 0.);
    for (const auto &e : rows_of_extra)
      z[e.extra] -= e.value * x(e.few);
    solver.schur.solve(z);
    Vector load(x.size());
    for (const auto &e : columns_of_extra)
      load(e.few) -= e.value * z[e.extra];
    return load;
  }

  /// Make x, the answer of the bulk alone, that of the system.
  void answer_of_extra(Vector &x, std::vector<double> r_extra) const
  {
    if (border.n == 0)
      return;
    Vector more(x.size());
    inverse->vmult(more, load_of_extra(x, r_extra));
    x += more;
  }

  struct Entry
  {
    int column;
    double value;
  };
  struct BorderEntry
  {
    int few;
    unsigned int extra;
    double value;
  };

  const BorderedSolver &solver;
  const SystemOperator::Border &border;
  const double *const d;

  std::vector<int> unknowns; ///< T
  std::vector<int> rows;     ///< of dA, numbered in T
  std::vector<std::size_t> ends;
  std::vector<Entry> entries;
  std::vector<BorderEntry> columns_of_extra, rows_of_extra; ///< B and C
  std::unique_ptr<LocalInverse> inverse;
  mutable Vector after_change;
};


bool BorderedSolver::sees_rock_change(const LinearSystem &system, const SystemStamps &stamps) const
{
  return system.definite && has_factor(system, stamps) && factor->has_local_inverse();
}


unsigned int BorderedSolver::eliminate_tangent(const SystemOperator &op,
                                               const SystemOperator::Border &border,
                                               const SystemVector &r,
                                               const double allowed,
                                               SystemVector &dx)
{
  LocalTangent tangent(*this, op, border);
  const LocalInverse &inverse = tangent.local_inverse();
  const BulkTransfer transfer(op.system().residual_bulk, communicator);
  std::vector<double> x(factor->size());
  transfer.to_root(r.bulk, factor_scaling.bulk, x.data());
  std::vector<double> half = inverse.forward(x.data());
  const unsigned int iterations = tangent.solve(half, r.extra, allowed);
  const std::vector<double> z = tangent.eliminate_extra(half, r.extra);
  for (unsigned int i = 0; i < op.n_extra(); ++i)
    dx.extra[i] -= z[i];
  inverse.backward(std::move(half), x.data());
  SystemVector correction = op.make_vector();
  transfer.from_root(x.data(), factor_scaling.bulk, correction.bulk);
  dx.bulk -= correction.bulk;
  return iterations;
}
} // namespace stockwork
