#include "solvers/dense_factor.h"

#include "stockwork/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace stockwork
{
using dealii::FullMatrix;
using dealii::LAPACKFullMatrix;
using dealii::Vector;

namespace
{
/// A row or column with more entries beside the diagonal is a full one.
constexpr unsigned int most_few = 8;
/// Of the greatest of the few entries, what a pivot must have: what is added to others is no
/// greater multiple of what is there.
constexpr double least_pivot = 0.1;
/// Entries are of order one; a line that has so little left is for the dense factor, which sees
/// whether it is a zero.
constexpr double nothing_left = 1e-10;
/// Unknowns below which a dense factorisation takes no time to speak of.
constexpr unsigned int worth_while = 256;

/// Of entries, as wide as these, so that several are counted at a time.
using Counts = std::vector<std::uint64_t>;

/// max |a_i| b_i, several at a time.
double greatest_product(const double *const a, const std::vector<double> &b)
{
  constexpr unsigned int lanes = 8;
  double greatest[lanes] = {};
  unsigned int i = 0;
  for (; i + lanes <= b.size(); i += lanes)
    for (unsigned int lane = 0; lane < lanes; ++lane)
      greatest[lane] = std::max(greatest[lane], std::abs(a[i + lane]) * b[i + lane]);
  for (; i < b.size(); ++i)
    greatest[0] = std::max(greatest[0], std::abs(a[i]) * b[i]);
  return *std::max_element(greatest, greatest + lanes);
}
} // namespace


/// In which rows columns with few entries have them, so that nobody has to look through a matrix
/// that is stored by rows.
class DenseFactor::ShortColumns
{
public:
  /// @param n_entries of each column; nothing if no column is asked for
  ShortColumns(const FullMatrix<double> &a, const Counts &n_entries)
    : is_short(a.n(), false)
    , rows(a.n())
  {
    std::vector<unsigned int> columns;
    for (unsigned int j = 0; j < n_entries.size(); ++j)
      if (n_entries[j] <= most_few)
      {
        is_short[j] = true;
        columns.push_back(j);
      }
    for (unsigned int i = 0; i < a.m() && !columns.empty(); ++i)
    {
      const double *const row = &a(i, 0);
      for (const unsigned int j : columns)
        if (row[j] != 0.)
          rows[j].push_back(i);
    }
  }

  bool has(const unsigned int column) const
  {
    return is_short[column];
  }

  /// Ascending. What has become zero by chance is still among them.
  const std::vector<unsigned int> &rows_of(const unsigned int column) const
  {
    return rows[column];
  }

  /// A new entry.
  void add(const unsigned int row, const unsigned int column)
  {
    if (!is_short[column])
      return;
    std::vector<unsigned int> &list = rows[column];
    const auto place = std::lower_bound(list.begin(), list.end(), row);
    if (place == list.end() || *place != row)
      list.insert(place, row);
  }

private:
  std::vector<bool> is_short;
  std::vector<std::vector<unsigned int>> rows;
};


void DenseFactor::scale(const FullMatrix<double> &matrix)
{
  const unsigned int n = matrix.m();
  scaling.assign(n, 1.);
  std::vector<double> size(n);
  for (unsigned int sweep = 0; sweep < 3; ++sweep)
  {
    std::fill(size.begin(), size.end(), 0.);
    for (unsigned int i = 0; i < n; ++i)
    {
      const double *const row = &matrix(i, 0);
      const double greatest = greatest_product(row, scaling);
      for (unsigned int j = 0; j < n; ++j)
        size[j] = std::max(size[j], std::abs(row[j]) * scaling[i]);
      size[i] = std::max(size[i], greatest);
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      if (!(size[i] > 0.) || !std::isfinite(size[i]))
        throw SolveError("a row of the matrix is zero or not a number");
      scaling[i] = std::sqrt(scaling[i] / size[i]);
    }
  }
}


void DenseFactor::eliminate(FullMatrix<double> &a,
                            ShortColumns &short_columns,
                            const unsigned int row,
                            const unsigned int column)
{
  row_is_left[row] = column_is_left[column] = false;
  const Pivot pivot{row, column, lower.size(), upper.size(), 1. / a(row, column)};
  for (unsigned int j = 0; j < a.n(); ++j)
    if (column_is_left[j] && a(row, j) != 0.)
      upper.push_back({j, a(row, j)});
  const auto take_off = [&](const unsigned int i)
  {
    if (!row_is_left[i] || a(i, column) == 0.)
      return;
    const double multiple = a(i, column) * pivot.reciprocal;
    lower.push_back({i, multiple});
    for (std::size_t e = pivot.begin_upper; e < upper.size(); ++e)
    {
      double &entry = a(i, upper[e].index);
      if (entry == 0.)
        short_columns.add(i, upper[e].index);
      entry -= multiple * upper[e].value;
    }
  };
  if (short_columns.has(column))
    for (const unsigned int i : short_columns.rows_of(column))
      take_off(i);
  else
    for (unsigned int i = 0; i < a.m(); ++i)
      take_off(i);
  pivots.push_back(pivot);
}


void DenseFactor::eliminate(FullMatrix<double> &a)
{
  const unsigned int n = a.m();
  Counts in_row(n, 0), in_column(n, 0);
  for (unsigned int i = 0; i < n; ++i)
  {
    const double *const row = &a(i, 0);
    std::uint64_t count = 0;
    for (unsigned int j = 0; j < n; ++j)
    {
      const std::uint64_t one = row[j] != 0.;
      count += one;
      in_column[j] += one;
    }
    in_row[i] = count;
  }
  struct Line
  {
    std::uint64_t count;
    unsigned int index;
    bool is_row;
  };
  std::vector<Line> lines;
  for (unsigned int k = 0; k < n && n >= worth_while; ++k)
  {
    if (in_row[k] <= most_few)
      lines.push_back({in_row[k], k, true});
    if (in_column[k] <= most_few)
      lines.push_back({in_column[k], k, false});
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Line &l, const Line &m) { return l.count < m.count; });

  ShortColumns short_columns(a, lines.empty() ? Counts() : in_column);
  row_is_left.assign(n, true);
  column_is_left.assign(n, true);
  pivots.clear();
  lower.clear();
  upper.clear();
  std::vector<unsigned int> across;
  for (const auto &[count, k, is_row] : lines)
  {
    if (!(is_row ? row_is_left : column_is_left)[k])
      continue;
    // By now there may be more entries, or fewer.
    const auto entry = [&](const unsigned int i) { return std::abs(is_row ? a(k, i) : a(i, k)); };
    const std::vector<bool> &others_left = is_row ? column_is_left : row_is_left;
    const Counts &in_other = is_row ? in_column : in_row;
    across.clear();
    double greatest = 0.;
    const auto look_at = [&](const unsigned int i)
    {
      if (!others_left[i] || entry(i) == 0.)
        return;
      across.push_back(i);
      greatest = std::max(greatest, entry(i));
    };
    if (is_row)
      for (unsigned int i = 0; i < n; ++i)
        look_at(i);
    else
      for (const unsigned int i : short_columns.rows_of(k))
        look_at(i);
    if (across.size() > most_few || !(greatest > nothing_left))
      continue;
    // Of the entries that are great enough, the one across the shortest line.
    unsigned int best = n;
    for (const unsigned int i : across)
      if (entry(i) >= least_pivot * greatest && (best == n || in_other[i] < in_other[best]))
        best = i;
    eliminate(a, short_columns, is_row ? k : best, is_row ? best : k);
  }
  rows_left.clear();
  columns_left.clear();
  for (unsigned int k = 0; k < n; ++k)
  {
    if (row_is_left[k])
      rows_left.push_back(k);
    if (column_is_left[k])
      columns_left.push_back(k);
  }
}


void DenseFactor::reinit(FullMatrix<double> matrix)
{
  scale(matrix);
  for (unsigned int i = 0; i < matrix.m(); ++i)
  {
    double *const row = &matrix(i, 0);
    for (unsigned int j = 0; j < matrix.n(); ++j)
      row[j] = row[j] * scaling[i] * scaling[j];
  }
  eliminate(matrix);
  const unsigned int n_left = rows_left.size();
  if (n_left == 0)
    return;
  // LAPACK stores by column: of the transposed matrix.
  lu.reinit(n_left, n_left);
  for (unsigned int i = 0; i < n_left; ++i)
    for (unsigned int j = 0; j < n_left; ++j)
      lu(j, i) = matrix(rows_left[i], columns_left[j]);
  try
  {
    lu.compute_lu_factorization();
  }
  catch (const dealii::LACExceptions::ExcSingular &)
  {
    throw SolveError("the matrix is singular");
  }
  // Entries are of order one, so a pivot of the size of their rounding errors is a zero.
  for (unsigned int i = 0; i < n_left; ++i)
    if (!(std::abs(lu(i, i)) > std::numeric_limits<double>::epsilon()))
      throw SolveError("the matrix is singular");
}


void DenseFactor::forward(double *const x, double *const of_left) const
{
  for (unsigned int i = 0; i < scaling.size(); ++i)
    x[i] *= scaling[i];
  for (unsigned int p = 0; p < pivots.size(); ++p)
  {
    const double of_pivot = x[pivots[p].row];
    const std::size_t end = p + 1 < pivots.size() ? pivots[p + 1].begin_lower : lower.size();
    for (std::size_t e = pivots[p].begin_lower; e < end; ++e)
      x[lower[e].index] -= lower[e].value * of_pivot;
  }
  for (unsigned int i = 0; i < rows_left.size(); ++i)
    of_left[i] = x[rows_left[i]];
}


void DenseFactor::backward(const double *const of_left, double *const x) const
{
  std::vector<double> solution(scaling.size());
  for (unsigned int i = 0; i < columns_left.size(); ++i)
    solution[columns_left[i]] = of_left[i];
  std::size_t end = upper.size();
  for (unsigned int p = pivots.size(); p-- > 0; end = pivots[p].begin_upper)
  {
    double sum = x[pivots[p].row];
    for (std::size_t e = pivots[p].begin_upper; e < end; ++e)
      sum -= upper[e].value * solution[upper[e].index];
    solution[pivots[p].column] = sum * pivots[p].reciprocal;
  }
  for (unsigned int i = 0; i < scaling.size(); ++i)
    x[i] = solution[i] * scaling[i];
}


void DenseFactor::solve(LAPACKFullMatrix<double> &columns) const
{
  LAPACKFullMatrix<double> of_left(rows_left.size(), columns.n());
  const auto column_left = [&](const unsigned int j)
  { return rows_left.empty() ? nullptr : &of_left(0, j); };
  for (unsigned int j = 0; j < columns.n(); ++j)
    forward(&columns(0, j), column_left(j));
  if (!rows_left.empty())
    lu.solve(of_left, true);
  for (unsigned int j = 0; j < columns.n(); ++j)
    backward(column_left(j), &columns(0, j));
}


void DenseFactor::solve(Vector<double> &x) const
{
  Vector<double> of_left(rows_left.size());
  forward(x.begin(), of_left.begin());
  if (!rows_left.empty())
    lu.solve(of_left, true);
  backward(of_left.begin(), x.begin());
}
} // namespace stockwork
