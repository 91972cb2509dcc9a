#include "solvers/bordered_solver.h"

#include "solvers/bulk_transfer.h"
#include "stockwork/base/all_gather.h"
#include "stockwork/base/error.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace stockwork
{
namespace
{
constexpr unsigned int no_place = -1;
constexpr unsigned int max_refinements = 4;
/// Right-hand sides solved for at once: a dense solution each on rank 0.
constexpr unsigned int batch = 32;

[[noreturn]] void throw_singular()
{
  throw SolveError("The linear system of the fracture is singular. Usual causes: a fracture that "
                   "cuts a piece off, a fracture pressure without storage, flow or well.");
}
} // namespace

BorderedSolver::BorderedSolver(const MPI_Comm communicator)
  : communicator(communicator)
  , is_root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  , direct(communicator)
{
}

void BorderedSolver::factorise(const SystemOperator &op, const SystemStamps &stamps)
{
  // The products belong to the old factor, whatever happens below.
  known.clear();
  products.clear();
  has_schur = false;
  if (!factor || stamps.mesh != factor_stamps.mesh ||
      static_cast<unsigned int>(factor->size()) != op.n_bulk())
  {
    factor = std::make_unique<Mumps>(communicator, Mumps::Kind::definite);
    std::vector<int> rows, columns;
    append_bulk_indices(op, true, rows, columns);
    factor->analyse(static_cast<int>(op.n_bulk()), std::move(rows), std::move(columns));
  }
  std::vector<double> values;
  append_bulk_values(op, true, values);
  factor->factorise(values);
  factor_scaling = op.scaling();
  factor_stamps = stamps;
}

std::vector<BorderedSolver::Border> BorderedSolver::gather_borders(const SystemOperator &op) const
{
  // Pack what this rank holds as (extra, bulk, value), columns and rows apart.
  std::vector<double> mine[2];
  const auto scaling = [&](const auto i)
  {
    const auto [block, local] = op.locate(i);
    return SystemOperator::entry(factor_scaling.bulk, block, local);
  };
  for (const auto &e : op.bulk_extra())
    mine[0].insert(mine[0].end(), {double(e.column), double(e.row), scaling(e.row) * e.value});
  for (const auto &e : op.extra_bulk())
    mine[1].insert(mine[1].end(), {double(e.row), double(e.column), scaling(e.column) * e.value});

  std::vector<Border> borders(op.n_extra());
  for (const bool rows : {false, true})
  {
    const std::vector<double> all = all_gather(communicator, mine[rows]);
    for (std::size_t i = 0; i < all.size(); i += 3)
      if (all[i + 2] != 0.)
      {
        Border &border = borders[static_cast<unsigned int>(all[i])];
        (rows ? border.row : border.column).emplace_back(static_cast<int>(all[i + 1]), all[i + 2]);
      }
  }
  return borders;
}

std::vector<double>
BorderedSolver::solve_columns(const std::vector<const SparseVector *> &right_hand_sides)
{
  std::vector<int> starts = {1}, rows;
  std::vector<double> values;
  for (const SparseVector *b : right_hand_sides)
  {
    for (const auto &[i, value] : *b)
    {
      rows.push_back(i + 1);
      values.push_back(value);
    }
    starts.push_back(static_cast<int>(rows.size()) + 1);
  }
  std::vector<double> x(is_root ? right_hand_sides.size() * factor->size() : 0);
  factor->solve_sparse(starts, rows, values, x);
  return x;
}

void BorderedSolver::forget_unused()
{
  std::vector<unsigned int> kept(place);
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  if (!kept.empty() && kept.back() == no_place)
    kept.pop_back();
  std::vector<Border> few;
  std::vector<std::vector<double>> few_products;
  for (const unsigned int i : kept)
  {
    few.push_back(std::move(known[i]));
    few_products.emplace_back();
    for (const unsigned int j : kept)
      few_products.back().push_back(products[i][j]);
  }
  for (unsigned int &p : place)
    if (p != no_place)
      p = std::lower_bound(kept.begin(), kept.end(), p) - kept.begin();
  known = std::move(few);
  products = std::move(few_products);
}

std::vector<double> BorderedSolver::multiply(SparseVector Border::*left,
                                             SparseVector Border::*right,
                                             const unsigned int begin,
                                             const unsigned int end)
{
  std::vector<const SparseVector *> right_hand_sides;
  for (unsigned int e = begin; e < end; ++e)
    right_hand_sides.push_back(&(known[e].*right));
  const std::vector<double> x = solve_columns(right_hand_sides);

  std::vector<double> result;
  result.reserve((end - begin) * known.size());
  if (is_root)
    for (unsigned int e = begin; e < end; ++e)
      for (const Border &border : known)
      {
        const double *solution = x.data() + std::size_t(e - begin) * factor->size();
        double sum = 0.;
        for (const auto &[i, value] : border.*left)
          sum += value * solution[i];
        result.push_back(sum);
      }
  result.resize((end - begin) * known.size());
  MPI_Bcast(result.data(), static_cast<int>(result.size()), MPI_DOUBLE, 0, communicator);
  return result;
}

void BorderedSolver::update_products(const std::vector<Border> &borders)
{
  // Known borders by their first entry and size: few candidates to compare in full.
  const auto key = [](const Border &b)
  {
    return std::make_tuple(b.column.size(), b.column.empty() ? -1 : b.column.front().first,
                           b.column.empty() ? 0. : b.column.front().second);
  };
  std::multimap<decltype(key(Border())), unsigned int> candidates;
  for (unsigned int i = 0; i < known.size(); ++i)
    candidates.emplace(key(known[i]), i);

  const unsigned int n_old = known.size();
  place.assign(borders.size(), no_place);
  for (unsigned int e = 0; e < borders.size(); ++e)
    if (!borders[e].empty())
    {
      const auto [begin, end] = candidates.equal_range(key(borders[e]));
      const auto match = std::find_if(
        begin, end, [&](const auto &candidate) { return known[candidate.second] == borders[e]; });
      if (match != end)
        place[e] = match->second;
      else
      {
        place[e] = known.size();
        candidates.emplace(key(borders[e]), known.size());
        known.push_back(borders[e]);
      }
    }

  // A is symmetric: rows of the product are solves with rows of the border as right-hand sides,
  // and where the border is symmetric, they are the columns.
  const bool symmetric = std::all_of(
    known.begin(), known.end(), [](const Border &border) { return border.row == border.column; });
  const unsigned int n = known.size();
  for (auto &row : products)
    row.resize(n);
  products.resize(n, std::vector<double>(n));
  for (unsigned int begin = n_old; begin < n; begin += batch)
  {
    const unsigned int end = std::min(begin + batch, n);
    const auto columns = multiply(&Border::row, &Border::column, begin, end);
    const auto rows = symmetric ? columns : multiply(&Border::column, &Border::row, begin, end);
    for (unsigned int e = begin; e < end; ++e)
      for (unsigned int i = 0; i < n; ++i)
      {
        products[i][e] = columns[(e - begin) * n + i];
        products[e][i] = rows[(e - begin) * n + i];
      }
  }
  if (known.size() > 2 * borders.size() + 100)
    forget_unused();
}

void BorderedSolver::factorise_schur(const SystemOperator &op)
{
  const unsigned int n = op.n_extra();
  schur_corner = op.extra_extra();
  schur_place = place;
  has_schur = false;

  dealii::FullMatrix<double> s(n, n);
  for (const auto &e : op.extra_extra())
    s(e.row, e.column) += e.value;
  for (unsigned int i = 0; i < n; ++i)
    if (place[i] != no_place)
      for (unsigned int j = 0; j < n; ++j)
        if (place[j] != no_place)
          s(i, j) -= products[place[i]][place[j]];

  // Equilibrate rows and columns alike (Ruiz 2001), so that pivoting compares like with like.
  schur_scaling.assign(n, 1.);
  for (unsigned int sweep = 0; sweep < 3; ++sweep)
    for (unsigned int i = 0; i < n; ++i)
    {
      double size = 0.;
      for (unsigned int j = 0; j < n; ++j)
        size = std::max(
          {size, std::abs(s(i, j)) * schur_scaling[j], std::abs(s(j, i)) * schur_scaling[j]});
      if (!(size > 0.) || !std::isfinite(size))
        throw_singular();
      schur_scaling[i] = std::sqrt(schur_scaling[i] / size);
    }
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      s(i, j) *= schur_scaling[i] * schur_scaling[j];

  schur.reinit(n, n);
  schur = s;
  try
  {
    schur.compute_lu_factorization();
  }
  catch (const dealii::ExceptionBase &)
  {
    throw_singular();
  }
  has_schur = true;
}

void BorderedSolver::eliminate(const SystemOperator &op,
                               const SystemVector &r,
                               SystemVector &dx,
                               const bool skip_bulk_load)
{
  const BulkTransfer transfer(op.system().residual_bulk, communicator);
  std::vector<double> x(is_root ? factor->size() : 0);
  SystemVector y = op.make_vector();
  const auto solve_bulk = [&](const SystemVector &load)
  {
    transfer.to_root(load.bulk, factor_scaling.bulk, x.data());
    factor->solve(x);
    transfer.from_root(x.data(), factor_scaling.bulk, y.bulk);
  };

  SystemVector load = r;
  if (op.n_extra() > 0)
  {
    // S z = r_extra - C A^-1 r_bulk
    std::vector<double> z(op.n_extra(), 0.);
    if (!skip_bulk_load)
    {
      solve_bulk(r);
      for (const auto &e : op.extra_bulk())
      {
        const auto [block, local] = op.locate(e.column);
        z[e.row] -= e.value * SystemOperator::entry(y.bulk, block, local);
      }
      dealii::Utilities::MPI::sum(z, communicator, z);
    }
    dealii::Vector<double> right(op.n_extra());
    for (unsigned int i = 0; i < op.n_extra(); ++i)
      right(i) = schur_scaling[i] * (z[i] + r.extra[i]);
    schur.solve(right);
    for (unsigned int i = 0; i < op.n_extra(); ++i)
    {
      z[i] = schur_scaling[i] * right(i);
      dx.extra[i] -= z[i];
    }
    for (const auto &e : op.bulk_extra())
    {
      const auto [block, local] = op.locate(e.row);
      SystemOperator::entry(load.bulk, block, local) -= e.value * z[e.column];
    }
  }
  solve_bulk(load);
  dx.bulk -= y.bulk;
}

LinearReport BorderedSolver::solve(const LinearSystem &system,
                                   const SystemStamps &stamps,
                                   const double tolerance,
                                   dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                   std::vector<double> &dx_extra)
{
  if (!system.definite)
    return direct.solve(system, stamps, tolerance, dx_bulk, dx_extra);

  const SystemOperator op(system, communicator);
  LinearReport report;
  const auto prepare = [&](const bool anew)
  {
    if (anew)
      factorise(op, stamps);
    report.factorised |= anew;
    if (op.n_extra() == 0)
      return;
    update_products(gather_borders(op));
    const auto &corner = op.extra_extra();
    const bool same =
      has_schur && place == schur_place &&
      std::equal(corner.begin(), corner.end(), schur_corner.begin(), schur_corner.end(),
                 [](const auto &a, const auto &b)
                 { return a.row == b.row && a.column == b.column && a.value == b.value; });
    if (!same)
      factorise_schur(op);
  };
  prepare(!factor || stamps.mesh != factor_stamps.mesh ||
          stamps.bulk_values != factor_stamps.bulk_values);

  SystemVector dx = op.make_vector(), r = op.make_vector();
  r.bulk = system.residual_bulk;
  r.extra = system.residual_extra;
  const double size = op.scaled_norm(r);
  double last = size;
  if (size == 0.)
    report.converged = true;
  for (unsigned int k = 0; k <= max_refinements && !report.converged; ++k)
  {
    // In a Newton iteration after the first, the bulk is in equilibrium already: its load would
    // be rounding errors.
    SystemVector bulk_only = op.make_vector();
    bulk_only.bulk = r.bulk;
    const bool in_balance = op.scaled_norm(bulk_only) <= 1e-2 * tolerance * size;
    eliminate(op, r, dx, in_balance);

    op.residual(r, dx);
    const double now = op.scaled_norm(r);
    report.iterations = k;
    report.relative_residual = now / size;
    report.converged = now <= tolerance * size;
    if (!report.converged && !(now < 0.5 * last))
    {
      if (report.factorised)
        break;
      prepare(true); // the values have changed behind the stamps' back
      dx = op.make_vector();
      r.bulk = system.residual_bulk;
      r.extra = system.residual_extra;
      last = size;
      continue;
    }
    last = now;
  }
  if (!(report.relative_residual < 1e-3))
    throw_singular();
  dx_bulk = dx.bulk;
  dx_extra = dx.extra;
  return report;
}
} // namespace stockwork
