#include "solvers/sparse_fracture_schur.h"

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>

#include <boost/functional/hash.hpp>

#include <algorithm>

namespace stockwork
{
namespace
{
using BorderEntries = std::vector<SystemOperator::Entry>;

void add_to_hash(std::size_t &hash, const BorderEntries &entries, const bool with_values)
{
  boost::hash_combine(hash, entries.size());
  for (const auto &e : entries)
  {
    boost::hash_combine(hash, e.row);
    boost::hash_combine(hash, e.column);
    if (with_values)
      boost::hash_combine(hash, e.value);
  }
}
} // namespace


SparseFractureSchur::SparseFractureSchur(const MPI_Comm communicator)
  : communicator(communicator)
  , patches(communicator)
{
}


void SparseFractureSchur::forget()
{
  patches.forget();
  border_seen = 0;
}


void SparseFractureSchur::update(const SystemOperator &op, const Epetra_CrsMatrix &K)
{
  const auto on_any_rank = [this](const bool here)
  { return dealii::Utilities::MPI::max(here ? 1 : 0, communicator) == 1; };
  std::size_t border = op.n_extra();
  add_to_hash(border, op.bulk_extra(), true);
  add_to_hash(border, op.extra_bulk(), true);
  if (on_any_rank(border != border_seen))
  {
    product = patches.product(op, K);
    border_seen = border;
    pattern_seen = values_seen = 0;
  }
  std::size_t pattern = border, values = border;
  add_to_hash(pattern, op.extra_extra(), false);
  add_to_hash(values, op.extra_extra(), true);
  if (!on_any_rank(values != values_seen))
    return;
  const bool new_pattern = on_any_rank(!factor || pattern != pattern_seen);
  values_seen = pattern_seen = 0;
  factorise(op, new_pattern);
  pattern_seen = pattern;
  values_seen = values;
}


void SparseFractureSchur::factorise(const SystemOperator &op, const bool new_pattern)
{
  // Each rank brings its shares of the product, and some of the rows that all of them know.
  const unsigned int n = op.n_extra(), me = dealii::Utilities::MPI::this_mpi_process(communicator),
                     n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  scaling = op.scaling().extra;
  std::vector<int> rows, columns;
  std::vector<double> values;
  const auto add = [&](const auto &e, const double sign)
  {
    values.push_back(sign * e.value * scaling[e.row] * scaling[e.column]);
    if (new_pattern)
    {
      rows.push_back(static_cast<int>(e.row) + 1);
      columns.push_back(static_cast<int>(e.column) + 1);
    }
  };
  for (const auto &e : op.extra_extra())
    if (std::size_t(e.row) * n_ranks / n == me)
      add(e, 1.);
  for (const auto &e : product)
    add(e, -1.);
  if (new_pattern)
  {
    factor = std::make_unique<Mumps>(communicator, Mumps::Kind::unsymmetric);
    factor->analyse(static_cast<int>(n), std::move(rows), std::move(columns));
  }
  factor->factorise(values);
}


void SparseFractureSchur::solve(std::vector<double> &x) const
{
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] *= scaling[i];
  factor->solve(x);
  MPI_Bcast(x.data(), static_cast<int>(x.size()), MPI_DOUBLE, 0, communicator);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] *= scaling[i];
}
} // namespace stockwork
