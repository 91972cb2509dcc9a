#include "solvers/local_elimination.h"

#include "stockwork/base/all_gather.h"

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace stockwork
{
using dealii::types::global_dof_index;

namespace
{
struct Triplet
{
  global_dof_index row, column;
  double value;
};

/// The triplets of all ranks for which `is_wanted`; the others of this rank go to `rest`.
template <class Predicate>
std::vector<Triplet> gather(const Triplets &triplets,
                            const MPI_Comm communicator,
                            const Predicate &is_wanted,
                            Triplets &rest)
{
  std::vector<Triplet> wanted;
  for (std::size_t i = 0; i < triplets.values.size(); ++i)
    if (is_wanted(triplets.rows[i], triplets.columns[i]))
      wanted.push_back({triplets.rows[i], triplets.columns[i], triplets.values[i]});
    else
      rest.add(triplets.rows[i], triplets.columns[i], triplets.values[i]);
  return all_gather(communicator, wanted);
}

/// Sort, and add up what is there several times.
void tidy(std::vector<std::pair<global_dof_index, double>> &entries)
{
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto &a, const auto &b) { return a.first < b.first; });
  std::size_t n = 0;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (n > 0 && entries[n - 1].first == entries[i].first)
      entries[n - 1].second += entries[i].second;
    else
      entries[n++] = entries[i];
  entries.resize(n);
}
} // namespace

LocalElimination::LocalElimination(const LinearSystem &system, const MPI_Comm communicator)
  : communicator(communicator)
{
  choose(system);
  sort_out(system);
  system_without.symmetric = false;
  system_without.elastic = system.elastic;
  system_without.bulk.reinit(1, 1);
  system_without.bulk.block(0, 0).copy_from(system.bulk.block(0, 0));
  system_without.bulk.collect_sizes();
  reduce_bulk();

  system_without.residual_bulk = system.residual_bulk;
  auto &bulk = system_without.residual_bulk.block(0);
  system_without.residual_extra.resize(n_left);
  for (unsigned int e = 0; e < place.size(); ++e)
    if (!is_eliminated[e])
    {
      system_without.residual_extra[place[e]] = system.residual_extra[e];
      system_without.n_mechanical_extra += e < system.n_mechanical_extra;
    }
  const bool is_root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  for (Unknown &one : unknowns)
  {
    one.residual = system.residual_extra[one.number];
    for (const auto &[row, of_row] : one.bulk_column)
      if (bulk.in_local_range(row))
        bulk[row] -= of_row / one.pivot * one.residual;
    for (const auto &[row, of_row] : one.extra_column)
      system_without.residual_extra[row] -= of_row / one.pivot * one.residual;
    if (!is_root)
      continue;
    for (const auto &[row, of_row] : one.bulk_column)
      for (const auto &[column, of_column] : one.extra_row)
        system_without.bulk_extra.add(row, column, -of_row * of_column / one.pivot);
    for (const auto &[row, of_row] : one.extra_column)
    {
      for (const auto &[column, of_column] : one.bulk_row)
        system_without.extra_bulk.add(row, column, -of_row * of_column / one.pivot);
      for (const auto &[column, of_column] : one.extra_row)
        system_without.extra_extra.add(row, column, -of_row * of_column / one.pivot);
    }
  }
  bulk.compress(dealii::VectorOperation::add);
}

void LocalElimination::choose(const LinearSystem &system)
{
  const std::size_t n = system.residual_extra.size();
  std::vector<Triplet> all;
  {
    Triplets none;
    all = gather(
      system.extra_extra, communicator, [](auto, auto) { return true; }, none);
  }
  std::vector<double> pivots(n, 0.);
  std::vector<std::vector<unsigned int>> tied(n);
  for (const Triplet &entry : all)
    if (entry.row == entry.column)
      pivots[entry.row] += entry.value;
    else
    {
      tied[entry.row].push_back(entry.column);
      tied[entry.column].push_back(entry.row);
    }
  is_eliminated.assign(n, false);
  place.assign(n, 0);
  for (unsigned int e = 0; e < n; ++e)
    if (e < system.n_mechanical_extra && pivots[e] != 0. &&
        std::none_of(tied[e].begin(), tied[e].end(),
                     [this](const unsigned int other) { return is_eliminated[other]; }))
    {
      is_eliminated[e] = true;
      place[e] = unknowns.size();
      unknowns.emplace_back();
      unknowns.back().number = e;
    }
    else
      place[e] = n_left++;
}

void LocalElimination::sort_out(const LinearSystem &system)
{
  Triplets others;
  for (const Triplet &entry : gather(
         system.bulk_extra, communicator,
         [this](auto, const auto column) { return is_eliminated[column]; }, others))
    unknowns[place[entry.column]].bulk_column.emplace_back(entry.row, entry.value);
  for (std::size_t i = 0; i < others.values.size(); ++i)
    system_without.bulk_extra.add(others.rows[i], place[others.columns[i]], others.values[i]);
  others.clear();
  for (const Triplet &entry : gather(
         system.extra_bulk, communicator,
         [this](const auto row, auto) { return is_eliminated[row]; }, others))
    unknowns[place[entry.row]].bulk_row.emplace_back(entry.column, entry.value);
  for (std::size_t i = 0; i < others.values.size(); ++i)
    system_without.extra_bulk.add(place[others.rows[i]], others.columns[i], others.values[i]);
  others.clear();
  for (const Triplet &entry : gather(
         system.extra_extra, communicator,
         [this](const auto row, const auto column)
         { return is_eliminated[row] || is_eliminated[column]; },
         others))
    if (entry.row == entry.column)
      unknowns[place[entry.row]].pivot += entry.value;
    else if (is_eliminated[entry.row])
      unknowns[place[entry.row]].extra_row.emplace_back(place[entry.column], entry.value);
    else
      unknowns[place[entry.column]].extra_column.emplace_back(place[entry.row], entry.value);
  for (std::size_t i = 0; i < others.values.size(); ++i)
    system_without.extra_extra.add(place[others.rows[i]], place[others.columns[i]],
                                   others.values[i]);
  for (Unknown &one : unknowns)
    for (Entries *entries : {&one.bulk_column, &one.bulk_row, &one.extra_column, &one.extra_row})
      tidy(*entries);
}

void LocalElimination::reduce_bulk()
{
  // deal.II's add() does not tell, in a Release build, whether an entry has a place. The matrix is
  // this object's own.
  auto &matrix = const_cast<Epetra_CrsMatrix &>(system_without.bulk.block(0, 0).trilinos_matrix());
  using Index = dealii::TrilinosWrappers::types::int_type;
  std::vector<double> values;
  std::vector<Index> columns;
  for (const Unknown &one : unknowns)
    for (const auto &[row, of_row] : one.bulk_column)
    {
      if (of_row == 0. || !matrix.RowMap().MyGID(static_cast<Index>(row)))
        continue;
      values.clear();
      columns.clear();
      for (const auto &[column, of_column] : one.bulk_row)
        if (of_column != 0.)
        {
          columns.push_back(column);
          values.push_back(-of_row * of_column / one.pivot);
        }
      // Tells by a positive code that an entry has no place.
      if (!columns.empty() && matrix.SumIntoGlobalValues(static_cast<Index>(row), columns.size(),
                                                         values.data(), columns.data()) != 0)
        fits_pattern = false;
    }
  fits_pattern = dealii::Utilities::MPI::min(fits_pattern ? 1 : 0, communicator) == 1;
}

std::vector<double>
LocalElimination::recover(const dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                          const std::vector<double> &dx_left) const
{
  const auto &bulk = dx_bulk.block(0);
  std::vector<double> products(unknowns.size(), 0.);
  for (unsigned int k = 0; k < unknowns.size(); ++k)
    for (const auto &[column, of_column] : unknowns[k].bulk_row)
      if (bulk.in_local_range(column))
        products[k] += of_column * bulk(column);
  dealii::Utilities::MPI::sum(products, communicator, products);
  std::vector<double> dx(place.size());
  for (unsigned int e = 0; e < place.size(); ++e)
    if (!is_eliminated[e])
      dx[e] = dx_left[place[e]];
  for (unsigned int k = 0; k < unknowns.size(); ++k)
  {
    double sum = -unknowns[k].residual - products[k];
    for (const auto &[column, of_column] : unknowns[k].extra_row)
      sum -= of_column * dx_left[column];
    dx[unknowns[k].number] = sum / unknowns[k].pivot;
  }
  return dx;
}
} // namespace stockwork
