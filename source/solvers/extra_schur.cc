#include "solvers/extra_schur.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "stockwork/base/all_gather.h"
#include "stockwork/base/error.h"

namespace stockwork
{
namespace
{
constexpr unsigned int no_place = -1;
/// Of the greatest entry, by which two vectors that are a factor apart differ: rounding errors.
constexpr double same_direction = 1e-13;

/// f with b = f a, if there is one; 1 where both are empty.
std::optional<double> factor_between(const ExtraSchur::SparseVector &a,
                                     const ExtraSchur::SparseVector &b)
{
  if (a.size() != b.size())
    return {};
  if (a == b)
    return 1.;
  std::size_t greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i].second) > std::abs(a[greatest].second))
      greatest = i;
  const double factor = b[greatest].second / a[greatest].second;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].first != b[i].first || !(std::abs(b[i].second - factor * a[i].second) <=
                                      same_direction * std::abs(b[greatest].second)))
      return {};
  return factor;
}
} // namespace

void ExtraSchur::throw_singular()
{
  throw SolveError("The linear system is singular. Usual causes: a body that no boundary condition "
                   "holds, a fracture that cuts a piece off, a fracture pressure without storage, "
                   "flow or well.");
}
ExtraSchur::ExtraSchur(const MPI_Comm communicator, Multiply multiply)
  : communicator(communicator)
  , multiply(std::move(multiply))
{
}

void ExtraSchur::forget()
{
  known.clear();
  products.clear();
  schur.forget();
  has_factor = false;
}

std::vector<ExtraSchur::Border>
ExtraSchur::gather_borders(const SystemOperator &op,
                           const SystemOperator::Border &border,
                           const dealii::types::global_dof_index end,
                           const dealii::TrilinosWrappers::MPI::BlockVector *bulk_scaling) const
{
  // Pack what this rank holds as (extra, bulk, value), columns and rows apart.
  std::vector<double> mine[2];
  const auto add = [&](std::vector<double> &to, const auto extra, const auto i, const double value)
  {
    if (i >= end)
      return;
    const auto [block, local] = op.locate(i);
    const double factor =
      bulk_scaling != nullptr ? SystemOperator::entry(*bulk_scaling, block, local) : 1.;
    to.insert(to.end(), {double(extra), double(i), factor * value});
  };
  for (const auto &e : border.bulk_extra)
    add(mine[0], e.column, e.row, e.value);
  for (const auto &e : border.extra_bulk)
    add(mine[1], e.row, e.column, e.value);

  std::vector<Border> borders(border.n);
  for (const bool rows : {false, true})
  {
    const std::vector<double> all = all_gather(communicator, mine[rows]);
    for (std::size_t i = 0; i < all.size(); i += 3)
      if (all[i + 2] != 0.)
      {
        Border &one = borders[static_cast<unsigned int>(all[i])];
        (rows ? one.row : one.column).emplace_back(static_cast<int>(all[i + 1]), all[i + 2]);
      }
  }
  return borders;
}

void ExtraSchur::forget_unused()
{
  std::vector<unsigned int> kept;
  for (const Known &one : found)
    if (one.place != no_place)
      kept.push_back(one.place);
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  std::vector<Border> few;
  std::vector<std::vector<double>> few_products;
  for (const unsigned int i : kept)
  {
    few.push_back(std::move(known[i]));
    few_products.emplace_back();
    for (const unsigned int j : kept)
      few_products.back().push_back(products[i][j]);
  }
  for (Known &one : found)
    if (one.place != no_place)
      one.place = std::lower_bound(kept.begin(), kept.end(), one.place) - kept.begin();
  known = std::move(few);
  products = std::move(few_products);
  has_factor = false; // its places are numbered as before
}

void ExtraSchur::update_products(const std::vector<Border> &borders, const bool symmetric_bulk)
{
  // Known borders by where they begin and by their size: few candidates to compare in full.
  const auto key = [](const Border &b)
  {
    return std::make_tuple(b.column.size(), b.column.empty() ? -1 : b.column.front().first,
                           b.row.size(), b.row.empty() ? -1 : b.row.front().first);
  };
  std::multimap<decltype(key(Border())), unsigned int> candidates;
  for (unsigned int i = 0; i < known.size(); ++i)
    candidates.emplace(key(known[i]), i);
  const auto find = [&](const Border &border) -> std::optional<Known>
  {
    const auto [begin, end] = candidates.equal_range(key(border));
    for (auto candidate = begin; candidate != end; ++candidate)
      if (const auto column = factor_between(known[candidate->second].column, border.column))
        if (const auto row = factor_between(known[candidate->second].row, border.row))
          return Known{candidate->second, *column, *row};
    return {};
  };

  const unsigned int n_old = known.size();
  found.assign(borders.size(), {no_place, 1., 1.});
  for (unsigned int e = 0; e < borders.size(); ++e)
    if (!borders[e].empty())
    {
      if (const auto one = find(borders[e]))
      {
        found[e] = *one;
        continue;
      }
      found[e].place = known.size();
      candidates.emplace(key(borders[e]), known.size());
      known.push_back(borders[e]);
    }

  // Of a symmetric A, rows of the product are solves with rows of the border as right-hand sides;
  // where the border is symmetric, too, they are the columns.
  const bool symmetric =
    symmetric_bulk && std::all_of(known.begin(), known.end(),
                                  [](const Border &border) { return border.row == border.column; });
  const unsigned int n = known.size();
  if (n == n_old)
    return;
  for (auto &row : products)
    row.resize(n);
  products.resize(n, std::vector<double>(n));
  SparseVectors all_rows, all_columns;
  for (const Border &border : known)
  {
    all_rows.push_back(&border.row);
    all_columns.push_back(&border.column);
  }
  const SparseVectors new_rows(all_rows.begin() + n_old, all_rows.end()),
    new_columns(all_columns.begin() + n_old, all_columns.end());
  const unsigned int n_new = n - n_old;
  const std::vector<double> columns = multiply(all_rows, new_columns);
  for (unsigned int e = 0; e < n_new; ++e)
    for (unsigned int i = 0; i < n; ++i)
      products[i][n_old + e] = columns[e * n + i];
  const std::vector<double> rows = symmetric        ? columns
                                   : symmetric_bulk ? multiply(all_columns, new_rows)
                                                    : multiply(new_rows, all_columns);
  for (unsigned int e = 0; e < n_new; ++e)
    for (unsigned int i = 0; i < n; ++i)
      products[n_old + e][i] = symmetric_bulk ? rows[e * n + i] : rows[i * n_new + e];
  if (known.size() > 2 * borders.size() + 100)
    forget_unused();
}

std::vector<std::pair<const ExtraSchur::SparseVector *, double>> ExtraSchur::columns() const
{
  std::vector<std::pair<const SparseVector *, double>> result;
  for (const Known &one : found)
    if (one.place == no_place || known[one.place].column.empty())
      result.emplace_back(nullptr, 0.);
    else
      result.emplace_back(&known[one.place].column, one.column);
  return result;
}

dealii::FullMatrix<double> ExtraSchur::product(const double factor) const
{
  const unsigned int n = found.size();
  dealii::FullMatrix<double> result(n, n);
  for (unsigned int i = 0; i < n; ++i)
    if (found[i].place != no_place)
    {
      const std::vector<double> &row = products[found[i].place];
      const double of_row = factor * found[i].row;
      for (unsigned int j = 0; j < n; ++j)
        if (found[j].place != no_place)
          result(i, j) = of_row * found[j].column * row[found[j].place];
    }
  return result;
}

void ExtraSchur::factorise(dealii::FullMatrix<double> s)
{
  has_factor = false;
  try
  {
    std::vector<unsigned int> identities;
    for (const Known &one : found)
      identities.push_back(one.place);
    schur.factorise(std::move(s), identities);
  }
  catch (const SolveError &)
  {
    throw_singular();
  }
}

void ExtraSchur::update_border(const SystemOperator &op,
                               const SystemOperator::Border &border,
                               const dealii::types::global_dof_index end,
                               const bool symmetric_bulk,
                               const dealii::TrilinosWrappers::MPI::BlockVector *bulk_scaling)
{
  update_products(gather_borders(op, border, end, bulk_scaling), symmetric_bulk);
}

void ExtraSchur::update(const SystemOperator &op,
                        const SystemOperator::Border &border,
                        const dealii::types::global_dof_index end,
                        const bool symmetric_bulk,
                        const dealii::TrilinosWrappers::MPI::BlockVector *bulk_scaling)
{
  update_border(op, border, end, symmetric_bulk, bulk_scaling);
  const auto &corner = border.extra_extra;
  const bool same =
    has_factor && found == found_for_factor &&
    std::equal(corner.begin(), corner.end(), corner_of_factor.begin(), corner_of_factor.end(),
               [](const auto &a, const auto &b)
               { return a.row == b.row && a.column == b.column && a.value == b.value; });
  if (same)
    return;
  dealii::FullMatrix<double> s = product(-1.);
  for (const auto &e : corner)
    s(e.row, e.column) += e.value;
  factorise(std::move(s));
  corner_of_factor = corner;
  found_for_factor = found;
  has_factor = true;
}

void ExtraSchur::solve(std::vector<double> &x) const
{
  dealii::Vector<double> right(x.begin(), x.end());
  schur.solve(right);
  std::copy(right.begin(), right.end(), x.begin());
}
} // namespace stockwork
