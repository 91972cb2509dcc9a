#include "solvers/dense_solver.h"

#include "stockwork/base/error.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string_view>
#include <unordered_map>

namespace stockwork
{
using dealii::FullMatrix;
using dealii::LAPACKFullMatrix;
using dealii::Vector;

namespace
{
/// Fewer unknowns are not worth keeping a factor for.
constexpr unsigned int minimum_kept = 64;
/// The kept part is chosen anew when so many more unknowns are outside of it.
constexpr unsigned int most_new = 48;
/// Matrices, at most, before what to keep is looked for again where it was of no use.
constexpr unsigned int most_waits = 64;

/// The entries of a row as bytes: equal or not, nothing else matters.
std::string_view bytes_of_row(const FullMatrix<double> &matrix, const unsigned int row)
{
  return {reinterpret_cast<const char *>(&matrix(row, 0)), matrix.n() * sizeof(double)};
}
/// Few vertices of a graph of which each edge has one: those with the most edges first. A row of
/// the fluid changes against several openings, an opening against few rows of the fluid.
std::vector<bool> cover(const std::vector<std::vector<unsigned int>> &neighbours)
{
  std::vector<unsigned int> n_left;
  for (const auto &list : neighbours)
    n_left.push_back(list.size());
  std::vector<bool> taken(n_left.size(), false);
  while (!n_left.empty())
  {
    const auto most = std::max_element(n_left.begin(), n_left.end());
    if (*most == 0)
      break;
    const unsigned int i = most - n_left.begin();
    taken[i] = true;
    *most = 0;
    for (const unsigned int j : neighbours[i])
      if (!taken[j])
        --n_left[j];
  }
  return taken;
}

bool same_bytes(const FullMatrix<double> &a, const FullMatrix<double> &b)
{
  return a.m() == b.m() && a.n() == b.n() &&
         (a.empty() || std::memcmp(&a(0, 0), &b(0, 0), a.n_elements() * sizeof(double)) == 0);
}
} // namespace


void DenseSolver::forget()
{
  kept.clear();
  kept_identities.clear();
  last_identities.clear();
  if (n_used > 0)
    waits_for = 1; // otherwise there is no more use for one after this than before
  n_used = 0;
  has_chosen = false;
  columns.reinit(0, 0);
}


bool DenseSolver::find_kept(const FullMatrix<double> &matrix,
                            const std::vector<unsigned int> &identities)
{
  kept.clear();
  if (kept_identities.empty())
    return false;
  std::unordered_map<unsigned int, unsigned int> places;
  for (unsigned int i = 0; i < identities.size(); ++i)
    places.emplace(identities[i], i);
  for (const unsigned int identity : kept_identities)
  {
    const auto found = places.find(identity);
    if (found == places.end())
      return false;
    kept.push_back(found->second);
  }
  for (unsigned int i = 0; i < kept.size(); ++i)
    for (unsigned int j = 0; j < kept.size(); ++j)
      if (matrix(kept[i], kept[j]) != kept_matrix(i, j))
        return false;
  return true;
}


void DenseSolver::choose_kept(const FullMatrix<double> &matrix,
                              const std::vector<unsigned int> &identities)
{
  std::unordered_map<unsigned int, unsigned int> last_places;
  for (unsigned int i = 0; i < last_identities.size(); ++i)
    last_places.emplace(last_identities[i], i);
  std::vector<unsigned int> candidates, last;
  for (unsigned int i = 0; i < identities.size(); ++i)
    if (identities[i] != anonymous)
      if (const auto found = last_places.find(identities[i]);
          found != last_places.end() && matrix(i, i) == last_matrix(found->second, found->second))
      {
        candidates.push_back(i);
        last.push_back(found->second);
      }
  std::vector<std::vector<unsigned int>> changed(candidates.size());
  for (unsigned int i = 0; i < candidates.size(); ++i)
    for (unsigned int j = 0; j < candidates.size(); ++j)
      if (matrix(candidates[i], candidates[j]) != last_matrix(last[i], last[j]))
      {
        changed[i].push_back(j);
        changed[j].push_back(i);
      }
  const std::vector<bool> dropped = cover(changed);

  kept.clear();
  for (unsigned int i = 0; i < candidates.size(); ++i)
    if (!dropped[i])
      kept.push_back(candidates[i]);
  if (kept.size() < minimum_kept)
    kept.clear();

  kept_identities.clear();
  for (const unsigned int i : kept)
    kept_identities.push_back(identities[i]);
  rest_when_chosen = matrix.m() - kept.size();
  columns.reinit(0, 0);
  if (kept.empty())
    return;
  kept_matrix.reinit(kept.size(), kept.size());
  kept_matrix.extract_submatrix_from(matrix, kept, kept);
  try
  {
    kept_factor.reinit(kept_matrix);
  }
  catch (const SolveError &) // which says nothing about the whole matrix
  {
    kept.clear();
    kept_identities.clear();
  }
}


bool DenseSolver::eliminate(const FullMatrix<double> &matrix)
{
  FullMatrix<double> wanted(rest.size(), kept.size());
  for (unsigned int i = 0; i < rest.size(); ++i)
    for (unsigned int j = 0; j < kept.size(); ++j)
      wanted(i, j) = matrix(kept[j], rest[i]);
  if (same_bytes(wanted, columns))
    return false;

  // Most columns have been solved for before: they are known by their contents.
  std::unordered_map<std::string_view, unsigned int> known;
  for (unsigned int i = 0; i < columns.m(); ++i)
    known.emplace(bytes_of_row(columns, i), i);
  FullMatrix<double> result(rest.size(), kept.size());
  std::vector<unsigned int> others;
  for (unsigned int i = 0; i < rest.size(); ++i)
    if (const auto found = known.find(bytes_of_row(wanted, i)); found != known.end())
      std::memcpy(&result(i, 0), &eliminated(found->second, 0), kept.size() * sizeof(double));
    else
      others.push_back(i);
  // All others at once: the factor is read once for several of them.
  if (!others.empty())
  {
    LAPACKFullMatrix<double> x(kept.size(), others.size());
    for (unsigned int j = 0; j < others.size(); ++j)
      std::copy(&wanted(others[j], 0), &wanted(others[j], 0) + kept.size(), &x(0, j));
    kept_factor.solve(x);
    for (unsigned int j = 0; j < others.size(); ++j)
      std::copy(&x(0, j), &x(0, j) + kept.size(), &result(others[j], 0));
  }
  known.clear();
  columns.swap(wanted);
  eliminated.swap(result);
  eliminated_by_row.reinit(kept.size(), rest.size());
  eliminated_by_row.copy_transposed(eliminated);
  return true;
}


void DenseSolver::factorise(FullMatrix<double> matrix, const std::vector<unsigned int> &identities)
{
  if (waits > 0)
    --waits;
  else if (find_kept(matrix, identities) && matrix.m() - kept.size() <= rest_when_chosen + most_new)
    ++n_used;
  else
  {
    // What changes all over from one matrix to the next is not worth a factor to be kept.
    if (n_used > 0)
      waits_for = 1;
    waits = has_chosen && n_used == 0 ? waits_for : 0;
    n_used = 0;
    has_chosen = waits == 0 && !last_identities.empty(); // the first shows nothing
    if (has_chosen)
      choose_kept(matrix, identities);
    else
    {
      if (waits > 0)
        waits_for = std::min(2 * waits, most_waits);
      kept.clear();
      kept_identities.clear();
    }
  }
  std::vector<bool> is_kept(matrix.m(), false);
  for (const unsigned int i : kept)
    is_kept[i] = true;
  rest.clear();
  for (unsigned int i = 0; i < matrix.m(); ++i)
    if (!is_kept[i])
      rest.push_back(i);

  FullMatrix<double> small;
  if (!kept.empty() && !rest.empty())
  {
    small.reinit(rest.size(), rest.size());
    small.extract_submatrix_from(matrix, rest, rest);
    const bool anew = eliminate(matrix);
    rows.reinit(rest.size(), kept.size());
    rows.extract_submatrix_from(matrix, rest, kept);
    // The rows of the fluid have few entries, those of the tips are full.
    std::vector<unsigned int> full, entries;
    for (unsigned int i = 0; i < rest.size(); ++i)
    {
      entries.clear();
      for (unsigned int k = 0; k < kept.size(); ++k)
        if (rows(i, k) != 0.)
          entries.push_back(k);
      if (4 * entries.size() > kept.size())
        full.push_back(i);
      else
        for (const unsigned int k : entries)
        {
          const double entry = rows(i, k), *const from = &eliminated_by_row(k, 0);
          double *const to = &small(i, 0);
          for (unsigned int j = 0; j < rest.size(); ++j)
            to[j] -= entry * from[j];
        }
    }
    if (!full.empty())
    {
      FullMatrix<double> now(full.size(), kept.size());
      for (unsigned int i = 0; i < full.size(); ++i)
        std::copy(&rows(full[i], 0), &rows(full[i], 0) + kept.size(), &now(i, 0));
      if (anew || !same_bytes(now, full_rows))
      {
        full_rows.swap(now);
        full_product.reinit(full.size(), rest.size());
        full_rows.mTmult(full_product, eliminated);
      }
      for (unsigned int i = 0; i < full.size(); ++i)
        for (unsigned int j = 0; j < rest.size(); ++j)
          small(full[i], j) -= full_product(i, j);
    }
  }
  if (kept.empty())
    small = waits > 0 ? std::move(matrix) : matrix;
  // What comes while one waits is not compared with this one.
  last_identities.clear();
  if (waits == 0)
  {
    last_matrix = std::move(matrix);
    last_identities = identities;
  }
  if (!rest.empty())
    try
    {
      rest_factor.reinit(std::move(small));
    }
    catch (const SolveError &)
    {
      forget();
      throw;
    }
}


void DenseSolver::solve(Vector<double> &x) const
{
  Vector<double> x_kept(kept.size()), x_rest(rest.size());
  for (unsigned int i = 0; i < kept.size(); ++i)
    x_kept(i) = x(kept[i]);
  for (unsigned int i = 0; i < rest.size(); ++i)
    x_rest(i) = x(rest[i]);
  if (!kept.empty())
    kept_factor.solve(x_kept);
  if (!rest.empty())
  {
    if (!kept.empty())
    {
      Vector<double> product(rest.size());
      rows.vmult(product, x_kept);
      x_rest -= product;
    }
    rest_factor.solve(x_rest);
    if (!kept.empty())
    {
      Vector<double> product(kept.size());
      eliminated.Tvmult(product, x_rest);
      x_kept -= product;
    }
  }
  for (unsigned int i = 0; i < kept.size(); ++i)
    x(kept[i]) = x_kept(i);
  for (unsigned int i = 0; i < rest.size(); ++i)
    x(rest[i]) = x_rest(i);
}
} // namespace stockwork
