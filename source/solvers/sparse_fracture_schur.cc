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

/// With extra unknowns by their numbers, for their places change with what a rank sees.
template <class Row, class Column>
void add_to_hash(std::size_t &hash,
                 const BorderEntries &entries,
                 const bool with_values,
                 const Row &row,
                 const Column &column)
{
  boost::hash_combine(hash, entries.size());
  for (const auto &e : entries)
  {
    boost::hash_combine(hash, row(e.row));
    boost::hash_combine(hash, column(e.column));
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
  const auto bulk = [](const auto i) { return i; };
  const auto extra = [&op](const auto place) { return op.extra_layout().number(place); };
  std::size_t border = op.n_extra();
  add_to_hash(border, op.bulk_extra(), true, bulk, extra);
  add_to_hash(border, op.extra_bulk(), true, extra, bulk);
  if (on_any_rank(border != border_seen))
  {
    product = patches.product(op, K);
    border_seen = border;
    pattern_seen = values_seen = 0;
  }
  std::size_t pattern = border, values = border;
  add_to_hash(pattern, op.extra_extra(), false, extra, extra);
  add_to_hash(values, op.extra_extra(), true, extra, extra);
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
  std::vector<int> rows, columns;
  std::vector<double> values;
  const auto add = [&](const BorderEntries &entries, const ExtraLayout &of_entries,
                       const std::vector<double> &scale, const double sign)
  {
    for (const auto &e : entries)
    {
      values.push_back(sign * e.value * scale[e.row] * scale[e.column]);
      if (new_pattern)
      {
        rows.push_back(static_cast<int>(of_entries.number(e.row)) + 1);
        columns.push_back(static_cast<int>(of_entries.number(e.column)) + 1);
      }
    }
  };
  layout = op.extra_layout();
  scaling = op.scaling().extra;
  add(op.extra_extra(), layout, scaling, 1.);
  add(product.entries, product.layout, op.scaling_in(product.layout), -1.);
  if (new_pattern)
  {
    factor = std::make_unique<Mumps>(communicator, Mumps::Kind::unsymmetric);
    factor->analyse(static_cast<int>(op.n_extra()), std::move(rows), std::move(columns));
  }
  factor->factorise(values);
}


void SparseFractureSchur::solve(std::vector<double> &x) const
{
  const auto scale = [&]()
  {
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] *= scaling[i];
  };
  scale();
  std::vector<double> all = layout.to_root(x);
  factor->solve(all);
  layout.from_root(all, x);
  scale();
}
} // namespace stockwork
