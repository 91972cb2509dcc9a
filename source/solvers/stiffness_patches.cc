#include "solvers/stiffness_patches.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace stockwork
{
namespace
{
/// Unknowns of a patch, at most: those that are coupled most strongly. Around a cell of linear
/// elements in three dimensions there are 4^3 nodes. A column that touches more by itself, as a
/// crack tip's function does, is divided by the diagonal of K.
constexpr std::size_t largest_patch = 400;

/// Unknowns at which each column of a patch's solution has less of its greatest value are left out:
/// half of a patch.
constexpr double smallest_share = 0.1;

/// Entries of the product that are smaller, after scaling, are left out: those of unknowns far
/// apart.
constexpr double smallest_entry = 0.06;

/// C X, where C is sorted by row and X, too; what is small between scalings of the extra unknowns
/// is left out.
std::vector<SystemOperator::Entry> multiply(const std::vector<SystemOperator::Entry> &C,
                                            const std::vector<SystemOperator::Entry> &X,
                                            const std::vector<double> &scaling)
{
  const std::size_t n = scaling.size();
  std::vector<SystemOperator::Entry> result;
  std::vector<double> sum(n, 0.);
  std::vector<bool> is_used(n, false);
  std::vector<unsigned int> used;
  for (std::size_t first = 0, last; first < C.size(); first = last)
  {
    for (last = first; last < C.size() && C[last].row == C[first].row; ++last)
      for (auto x = std::lower_bound(X.begin(), X.end(), C[last].column,
                                     [](const auto &a, const auto row) { return a.row < row; });
           x != X.end() && x->row == C[last].column; ++x)
      {
        if (!is_used[x->column])
          used.push_back(x->column);
        is_used[x->column] = true;
        sum[x->column] += C[last].value * x->value;
      }
    for (const unsigned int column : used)
    {
      if (std::abs(sum[column]) * scaling[C[first].row] * scaling[column] >= smallest_entry)
        result.push_back({C[first].row, column, sum[column]});
      sum[column] = 0.;
      is_used[column] = false;
    }
    used.clear();
  }
  return result;
}
} // namespace


/// Rows of a matrix, this rank's and others that are asked for.
class StiffnessPatches::Rows
{
public:
  explicit Rows(const Epetra_CrsMatrix &matrix)
    : matrix(matrix)
  {
  }

  /// Let rows of other ranks be seen. Collective.
  void see(const std::vector<int> &rows)
  {
    std::vector<int> others;
    for (const int row : rows)
      if (!matrix.MyGRID(row))
        others.push_back(row);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    const Epetra_Map map(-1, static_cast<int>(others.size()), others.data(), 0, matrix.Comm());
    ghosts = std::make_unique<Epetra_CrsMatrix>(Copy, map, 0);
    if (map.NumGlobalElements() > 0)
      ghosts->Import(matrix, Epetra_Import(map, matrix.RowMap()), Insert);
  }

  /// Call use(column, value) for the entries of a row that is seen.
  template <class Function>
  void for_each(const int row, const Function &use) const
  {
    int n = 0;
    double *values = nullptr;
    int *columns = nullptr;
    const int local = matrix.LRID(row);
    if (local >= 0)
      matrix.ExtractMyRowView(local, n, values, columns);
    else
      ghosts->ExtractGlobalRowView(row, n, values, columns);
    for (int k = 0; k < n; ++k)
      use(local >= 0 ? matrix.GCID(columns[k]) : columns[k], values[k]);
  }

private:
  const Epetra_CrsMatrix &matrix;
  std::unique_ptr<Epetra_CrsMatrix> ghosts;
};


StiffnessPatches::StiffnessPatches(const MPI_Comm communicator)
  : communicator(communicator)
{
}


void StiffnessPatches::forget()
{
  known.clear();
}


std::vector<StiffnessPatches::Group> StiffnessPatches::find_groups(const SystemOperator &op) const
{
  // A column is solved for by the lowest rank that has entries of it.
  const ExtraLayout &layout = op.extra_layout();
  const unsigned int me = dealii::Utilities::MPI::this_mpi_process(communicator);
  const auto end = op.system().residual_bulk.block(0).size();
  std::vector<double> hosts(layout.n_seen(), std::numeric_limits<double>::max());
  Triplets mine;
  for (const auto &e : op.bulk_extra())
    if (e.row < end && e.value != 0.)
    {
      hosts[e.column] = me;
      mine.add(e.row, layout.number(e.column), e.value);
    }
  layout.combine(hosts, dealii::VectorOperation::min);
  auto entries = op.to_hosts_of_columns(mine, hosts);
  std::sort(entries.begin(), entries.end(),
            [](const auto &a, const auto &b)
            { return a.column < b.column || (a.column == b.column && a.row < b.row); });

  std::vector<Group> groups;
  std::map<std::vector<int>, std::size_t> group_of_rows;
  for (std::size_t first = 0, last; first < entries.size(); first = last)
  {
    std::vector<int> rows;
    for (last = first; last < entries.size() && entries[last].column == entries[first].column;
         ++last)
      rows.push_back(static_cast<int>(entries[last].row));
    const auto [place, is_new] = group_of_rows.emplace(rows, groups.size());
    if (is_new)
      groups.push_back({std::move(rows), {}, {}, 0});
    Group &group = groups[place->second];
    group.columns.push_back(entries[first].column);
    for (std::size_t i = first; i < last; ++i)
      group.values.push_back(entries[i].value);
  }
  for (Group &group : groups)
  {
    std::size_t key = boost::hash_range(group.rows.begin(), group.rows.end());
    boost::hash_range(key, group.values.begin(), group.values.end());
    group.key = key;
  }
  return groups;
}


std::vector<int> StiffnessPatches::unknowns_of_patch(const Group &group, const Rows &rows)
{
  std::map<int, double> strength; // of the coupling to the group
  for (const int row : group.rows)
    rows.for_each(row, [&](const int column, const double value)
                  { strength[column] = std::max(strength[column], std::abs(value)); });
  for (const int row : group.rows)
    strength[row] = std::numeric_limits<double>::infinity();
  double weakest = 0.;
  if (strength.size() > largest_patch)
  {
    std::vector<double> all;
    for (const auto &unknown : strength)
      all.push_back(unknown.second);
    std::nth_element(all.begin(), all.begin() + largest_patch, all.end(), std::greater<>());
    weakest = all[largest_patch];
  }
  std::vector<int> patch;
  for (const auto &[unknown, size] : strength)
    if (size > weakest)
      patch.push_back(unknown);
  return patch;
}


/// One for all patches: freed after each, it would leave holes too small for the next, for what
/// is kept would settle in them.
struct StiffnessPatches::Workspace
{
  dealii::LAPACKFullMatrix<double> matrix, x;
};


StiffnessPatches::Solution StiffnessPatches::by_diagonal(const Group &group, const Rows &rows)
{
  const std::size_t n = group.rows.size();
  Solution solution{group.rows, std::vector<float>(group.values.size())};
  for (std::size_t i = 0; i < n; ++i)
  {
    double diagonal = 0.;
    rows.for_each(group.rows[i],
                  [&](const int column, const double value)
                  {
                    if (column == group.rows[i])
                      diagonal = value;
                  });
    for (std::size_t c = 0; c < group.columns.size(); ++c)
      solution.values[c * n + i] = static_cast<float>(group.values[c * n + i] / diagonal);
  }
  return solution;
}


StiffnessPatches::Solution StiffnessPatches::solve(const Group &group,
                                                   const std::vector<int> &patch,
                                                   const Rows &rows,
                                                   Workspace &workspace)
{
  const auto n = patch.size(), m = group.columns.size();
  const auto place = [&](const int unknown) -> std::size_t
  {
    const auto i = std::lower_bound(patch.begin(), patch.end(), unknown);
    return i != patch.end() && *i == unknown ? i - patch.begin() : n;
  };
  auto &matrix = workspace.matrix, &x = workspace.x;
  matrix.reinit(n, n);
  x.reinit(n, m);
  for (std::size_t i = 0; i < n; ++i)
    rows.for_each(patch[i],
                  [&](const int column, const double value)
                  {
                    if (const std::size_t j = place(column); j < n)
                      matrix(i, j) = value;
                  });
  for (std::size_t c = 0; c < m; ++c)
    for (std::size_t i = 0; i < group.rows.size(); ++i)
      x(place(group.rows[i]), c) = group.values[c * group.rows.size() + i];
  matrix.compute_lu_factorization();
  matrix.solve(x);

  std::vector<bool> is_kept(n, false);
  for (std::size_t c = 0; c < m; ++c)
  {
    double greatest = 0.;
    for (std::size_t i = 0; i < n; ++i)
      greatest = std::max(greatest, std::abs(x(i, c)));
    for (std::size_t i = 0; i < n; ++i)
      if (std::abs(x(i, c)) > smallest_share * greatest)
        is_kept[i] = true;
  }
  const std::size_t n_kept = std::count(is_kept.begin(), is_kept.end(), true);
  Solution solution;
  solution.rows.reserve(n_kept);
  solution.values.reserve(n_kept * m);
  for (std::size_t i = 0; i < n; ++i)
    if (is_kept[i])
      solution.rows.push_back(patch[i]);
  for (std::size_t c = 0; c < m; ++c)
    for (std::size_t i = 0; i < n; ++i)
      if (is_kept[i])
        solution.values.push_back(static_cast<float>(x(i, c)));
  return solution;
}


void StiffnessPatches::solve_new(const std::vector<Group> &groups, const Epetra_CrsMatrix &K)
{
  std::vector<const Group *> unsolved;
  std::vector<int> wanted;
  for (const Group &group : groups)
    if (known.count(group.key) == 0)
    {
      unsolved.push_back(&group);
      wanted.insert(wanted.end(), group.rows.begin(), group.rows.end());
    }
  if (dealii::Utilities::MPI::max(unsolved.size(), communicator) == 0)
    return;
  Rows rows(K);
  rows.see(wanted);
  std::vector<std::vector<int>> patches;
  wanted.clear();
  for (const Group *group : unsolved)
  {
    patches.emplace_back(); // none: too many unknowns
    if (group->rows.size() <= largest_patch)
      patches.back() = unknowns_of_patch(*group, rows);
    for (const int row : patches.back())
      if (!K.MyGRID(row))
        wanted.push_back(row);
  }
  rows.see(wanted);
  Workspace workspace;
  for (std::size_t i = 0; i < unsolved.size(); ++i)
    known.emplace(unsolved[i]->key, patches[i].empty()
                                      ? by_diagonal(*unsolved[i], rows)
                                      : solve(*unsolved[i], patches[i], rows, workspace));
}


void StiffnessPatches::forget_unused(const std::vector<Group> &groups)
{
  if (known.size() <= 2 * groups.size() + 100)
    return;
  std::unordered_map<std::uint64_t, Solution> in_use;
  for (const Group &group : groups)
    if (const auto found = known.find(group.key); found != known.end())
      in_use.insert(known.extract(found));
  known = std::move(in_use);
}


StiffnessPatches::Product StiffnessPatches::product(const SystemOperator &op,
                                                    const Epetra_CrsMatrix &K)
{
  const std::vector<Group> groups = find_groups(op);
  solve_new(groups, K);

  // C is where its columns are; so X = K^-1 B goes there, where anybody looks at it.
  std::vector<SystemOperator::Entry> C;
  std::vector<bool> is_read(K.NumMyRows(), false);
  for (const auto &e : op.extra_bulk())
    if (e.column < op.system().residual_bulk.block(0).size())
    {
      C.push_back(e);
      is_read[K.LRID(static_cast<int>(e.column))] = true;
    }
  Triplets solved;
  std::size_t most = 0;
  for (const Group &group : groups)
    most += known.at(group.key).values.size();
  solved.rows.reserve(most);
  solved.columns.reserve(most);
  solved.values.reserve(most);
  for (const Group &group : groups)
  {
    const Solution &solution = known.at(group.key);
    const std::size_t n = solution.rows.size();
    for (std::size_t i = 0; i < n; ++i)
      if (const int local = K.LRID(solution.rows[i]); local < 0 || is_read[local])
        for (std::size_t c = 0; c < group.columns.size(); ++c)
          solved.add(solution.rows[i], group.columns[c], solution.values[c * n + i]);
  }
  forget_unused(groups);
  auto X = op.to_owners_of_rows(solved);
  solved = {};
  std::sort(X.begin(), X.end(), [](const auto &a, const auto &b) { return a.row < b.row; });

  dealii::IndexSet wanted(op.n_extra());
  std::vector<dealii::types::global_dof_index> touched;
  for (auto &e : C)
    touched.push_back(e.row = op.extra_layout().number(e.row));
  for (const auto &e : X)
    touched.push_back(e.column);
  std::sort(touched.begin(), touched.end());
  wanted.add_indices(touched.begin(), std::unique(touched.begin(), touched.end()));
  const ExtraLayout layout = ExtraLayout::shared_out(op.n_extra(), wanted, communicator);
  for (auto &e : C)
    e.row = layout.place(e.row);
  for (auto &e : X)
    e.column = layout.place(e.column);
  return {multiply(C, X, op.scaling_in(layout)), layout};
}
} // namespace stockwork
