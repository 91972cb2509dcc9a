#include "solvers/system_operator.h"

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "stockwork/base/all_gather.h"

namespace stockwork
{
namespace
{
using dealii::types::global_dof_index;
using Entries = std::vector<SystemOperator::Entry>;

/// Sort by (column, row) or (row, column) and add up repeated entries.
void sort_and_sum(Entries &entries, const bool columns_first)
{
  const auto key = [columns_first](const SystemOperator::Entry &e)
  { return columns_first ? std::make_pair(e.column, e.row) : std::make_pair(e.row, e.column); };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const auto &a, const auto &b) { return key(a) < key(b); });
  std::size_t n = 0;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (n > 0 && key(entries[n - 1]) == key(entries[i]))
      entries[n - 1].value += entries[i].value;
    else
      entries[n++] = entries[i];
  entries.resize(n);
}

/// Send each entry to where `owner` says.
template <class Owner>
Entries send_to_owners(const Triplets &triplets, const MPI_Comm communicator, const Owner &owner)
{
  const unsigned int me = dealii::Utilities::MPI::this_mpi_process(communicator);
  Entries mine;
  mine.reserve(triplets.values.size());
  std::map<unsigned int, std::vector<double>> others; // indices are exact in a double
  for (std::size_t i = 0; i < triplets.values.size(); ++i)
  {
    const SystemOperator::Entry e{triplets.rows[i], triplets.columns[i], triplets.values[i]};
    const unsigned int rank = owner(e);
    if (rank == me)
      mine.push_back(e);
    else
    {
      auto &to = others[rank];
      to.insert(to.end(), {static_cast<double>(e.row), static_cast<double>(e.column), e.value});
    }
  }
  if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
    for (const auto &[rank, data] : dealii::Utilities::MPI::some_to_some(communicator, others))
      for (std::size_t i = 0; i < data.size(); i += 3)
        mine.push_back({static_cast<global_dof_index>(data[i]),
                        static_cast<global_dof_index>(data[i + 1]), data[i + 2]});
  return mine;
}

Entries send_to_all(const Triplets &triplets, const MPI_Comm communicator)
{
  std::vector<double> packed;
  packed.reserve(3 * triplets.values.size());
  for (std::size_t i = 0; i < triplets.values.size(); ++i)
    packed.insert(packed.end(), {static_cast<double>(triplets.rows[i]),
                                 static_cast<double>(triplets.columns[i]), triplets.values[i]});
  Entries all;
  packed = all_gather(communicator, packed);
  for (std::size_t i = 0; i < packed.size(); i += 3)
    all.push_back({static_cast<global_dof_index>(packed[i]),
                   static_cast<global_dof_index>(packed[i + 1]), packed[i + 2]});
  return all;
}

/// Which rank owns a bulk dof: the ranks' ranges in each block, one after another.
class Owners
{
public:
  Owners(const dealii::TrilinosWrappers::MPI::BlockVector &vector,
         const std::vector<global_dof_index> &offsets,
         const MPI_Comm communicator)
  {
    for (unsigned int b = 0; b < vector.n_blocks(); ++b)
    {
      const auto end = offsets[b] + vector.block(b).local_range().second;
      const auto all = all_gather(communicator, std::vector<global_dof_index>{end});
      for (unsigned int rank = 0; rank < all.size(); ++rank)
        ends.emplace_back(all[rank], rank);
    }
  }

  unsigned int operator()(const global_dof_index i) const
  {
    return std::upper_bound(ends.begin(), ends.end(), i,
                            [](const auto a, const auto &b) { return a < b.first; })
      ->second;
  }

private:
  std::vector<std::pair<global_dof_index, unsigned int>> ends;
};
} // namespace

SystemOperator::SystemOperator(const LinearSystem &system,
                               const MPI_Comm communicator,
                               const dealii::TrilinosWrappers::MPI::BlockVector *bulk_scaling,
                               const Extra extra)
  : linear_system(&system)
  , communicator(communicator)
{
  offsets.push_back(0);
  for (unsigned int b = 0; b < system.residual_bulk.n_blocks(); ++b)
    offsets.push_back(offsets.back() + system.residual_bulk.block(b).size());

  scale.bulk.reinit(system.residual_bulk);
  if (const unsigned int n = system.residual_extra.size(); n > 0)
  {
    if (extra == Extra::shared_out)
      share_out_border();
    else
    {
      layout = ExtraLayout::everywhere(n, communicator);
      extend(own_border, n, system.bulk_extra, system.extra_bulk, system.extra_extra);
    }
  }
  if (bulk_scaling != nullptr)
    scale.bulk = *bulk_scaling;
  else
    scale_bulk();
  if (n_extra() > 0)
    scale_extra();
}

void SystemOperator::extend(Border &border,
                            const unsigned int n,
                            const Triplets &bulk_extra,
                            const Triplets &extra_bulk,
                            const Triplets &extra_extra) const
{
  const Owners owner(linear_system->residual_bulk, offsets, communicator);
  const auto add = [](Entries &to, const Entries &from, const bool columns_first)
  {
    to.insert(to.end(), from.begin(), from.end());
    sort_and_sum(to, columns_first);
  };
  border.n = n;
  add(border.bulk_extra,
      send_to_owners(bulk_extra, communicator, [&](const Entry &e) { return owner(e.row); }), true);
  add(border.extra_bulk,
      send_to_owners(extra_bulk, communicator, [&](const Entry &e) { return owner(e.column); }),
      false);
  add(border.extra_extra, send_to_all(extra_extra, communicator), false);
}

void SystemOperator::share_out_border()
{
  const unsigned int n = linear_system->residual_extra.size();
  const Owners owner(linear_system->residual_bulk, offsets, communicator);
  own_border.n = n;
  Entries &B = own_border.bulk_extra, &C = own_border.extra_bulk, &D = own_border.extra_extra;
  B = send_to_owners(linear_system->bulk_extra, communicator,
                     [&](const Entry &e) { return owner(e.row); });
  C = send_to_owners(linear_system->extra_bulk, communicator,
                     [&](const Entry &e) { return owner(e.column); });
  // Who owns a row of D does not depend on what is wanted.
  const ExtraLayout rows = ExtraLayout::shared_out(n, dealii::IndexSet(n), communicator);
  D = send_to_owners(linear_system->extra_extra, communicator,
                     [&](const Entry &e) { return rows.owner(e.row); });
  sort_and_sum(B, true);
  sort_and_sum(C, false);
  sort_and_sum(D, false);

  std::vector<global_dof_index> touched;
  for (const Entry &e : B)
    touched.push_back(e.column);
  for (const Entry &e : C)
    touched.push_back(e.row);
  for (const Entry &e : D)
    touched.push_back(e.column);
  std::sort(touched.begin(), touched.end());
  dealii::IndexSet wanted(n);
  wanted.add_indices(touched.begin(), std::unique(touched.begin(), touched.end()));
  layout = ExtraLayout::shared_out(n, wanted, communicator);
  for (Entry &e : B)
    e.column = layout.place(e.column);
  for (Entry &e : C)
    e.row = layout.place(e.row);
  for (Entry &e : D)
  {
    e.row = layout.place(e.row);
    e.column = layout.place(e.column);
  }
}

Entries SystemOperator::to_owners_of_rows(const Triplets &triplets) const
{
  const Owners owner(linear_system->residual_bulk, offsets, communicator);
  return send_to_owners(triplets, communicator, [&](const Entry &e) { return owner(e.row); });
}

Entries SystemOperator::to_hosts_of_columns(const Triplets &triplets,
                                            const std::vector<double> &hosts) const
{
  return send_to_owners(triplets, communicator,
                        [&](const Entry &e)
                        { return static_cast<unsigned int>(hosts[layout.place(e.column)]); });
}

double &SystemOperator::entry(dealii::TrilinosWrappers::MPI::BlockVector &vector,
                              const unsigned int block,
                              const int local)
{
  return vector.block(block).trilinos_vector()[0][local];
}

double SystemOperator::entry(const dealii::TrilinosWrappers::MPI::BlockVector &vector,
                             const unsigned int block,
                             const int local)
{
  return vector.block(block).trilinos_vector()[0][local];
}

std::pair<unsigned int, int> SystemOperator::locate(const global_dof_index i) const
{
  unsigned int block = 0;
  while (i >= offsets[block + 1])
    ++block;
  return {block, static_cast<int>(i - offsets[block] -
                                  linear_system->residual_bulk.block(block).local_range().first)};
}

std::vector<double> SystemOperator::at_columns(const Epetra_CrsMatrix &matrix,
                                               const dealii::TrilinosWrappers::MPI::Vector &vector)
{
  const auto &source = vector.trilinos_vector();
  if (matrix.Importer() == nullptr)
    return std::vector<double>(source[0], source[0] + source.MyLength());
  Epetra_MultiVector target(matrix.ColMap(), 1);
  target.Import(source, *matrix.Importer(), Insert);
  return std::vector<double>(target[0], target[0] + target.MyLength());
}

void SystemOperator::scale_bulk()
{
  const auto &bulk = linear_system->bulk;
  for (unsigned int b = 0; b < bulk.n_block_rows(); ++b)
  {
    auto &epetra_diagonal = scale.bulk.block(b).trilinos_vector();
    double *d = epetra_diagonal[0];
    const int n = epetra_diagonal.MyLength();
    {
      Epetra_Vector diagonal(View, epetra_diagonal.Map(), d);
      bulk.block(b, b).trilinos_matrix().ExtractDiagonalCopy(diagonal);
    }
    for (int i = 0; i < n; ++i)
      d[i] = std::sqrt(std::abs(d[i]));
    for (unsigned int c = 0; c < b; ++c)
    {
      const Epetra_CrsMatrix &matrix = bulk.block(b, c).trilinos_matrix();
      const auto columns = at_columns(matrix, scale.bulk.block(c));
      for (int i = 0; i < n; ++i)
      {
        int n_entries;
        double *values;
        int *indices;
        matrix.ExtractMyRowView(i, n_entries, values, indices);
        for (int k = 0; k < n_entries; ++k)
          d[i] = std::max(d[i], std::abs(values[k]) * columns[indices[k]]);
      }
    }
    for (int i = 0; i < n; ++i)
      d[i] = d[i] > 0. ? 1. / d[i] : 1.;
  }
}

void SystemOperator::scale_extra()
{
  const auto update_from_rows = [this](std::vector<double> &values)
  {
    if (!layout.are_seen_everywhere()) // else all rows are everywhere, too
      layout.update(values);
  };
  std::vector<double> size(layout.n_seen(), 0.);
  for (const Entry &e : own_border.extra_bulk)
  {
    const auto [block, local] = locate(e.column);
    size[e.row] = std::max(size[e.row], std::abs(e.value) * entry(scale.bulk, block, local));
  }
  layout.combine(size, dealii::VectorOperation::max);
  for (const Entry &e : own_border.extra_extra)
    if (e.row == e.column)
      size[e.row] = std::max(size[e.row], std::sqrt(std::abs(e.value)));
  update_from_rows(size);
  scale.extra.resize(size.size());
  for (std::size_t i = 0; i < size.size(); ++i)
    scale.extra[i] = size[i] > 0. ? 1. / size[i] : 0.;
  // What is coupled to other extra unknowns only, and has no diagonal.
  for (const Entry &e : own_border.extra_extra)
    if (size[e.row] == 0. && scale.extra[e.column] > 0. && size[e.column] > 0.)
      scale.extra[e.row] =
        scale.extra[e.row] == 0.
          ? 1. / (std::abs(e.value) * scale.extra[e.column])
          : std::min(scale.extra[e.row], 1. / (std::abs(e.value) * scale.extra[e.column]));
  for (double &s : scale.extra)
    if (!(s > 0.) || !std::isfinite(s))
      s = 1.;
  update_from_rows(scale.extra);
}

std::vector<double> SystemOperator::scaling_in(const ExtraLayout &other) const
{
  std::vector<double> result(other.n_seen());
  std::copy_n(scale.extra.begin(), other.n_owned(), result.begin());
  other.update(result);
  return result;
}

void SystemOperator::vmult(SystemVector &dst, const SystemVector &src) const
{
  linear_system->bulk.vmult(dst.bulk, src.bulk);
  if (linear_system->rock_change != nullptr)
    linear_system->rock_change->vmult_add(dst.bulk, src.bulk);
  if (n_extra() == 0)
    return;

  for (const Entry &e : own_border.bulk_extra)
  {
    const auto [block, local] = locate(e.row);
    entry(dst.bulk, block, local) += e.value * src.extra[e.column];
  }
  std::fill(dst.extra.begin(), dst.extra.end(), 0.);
  for (const Entry &e : own_border.extra_bulk)
  {
    const auto [block, local] = locate(e.column);
    dst.extra[e.row] += e.value * entry(src.bulk, block, local);
  }
  for (const Entry &e : own_border.extra_extra)
    if (e.row < layout.n_owned())
      dst.extra[e.row] += e.value * src.extra[e.column];
  layout.combine(dst.extra);
}

void SystemOperator::residual(SystemVector &r, const SystemVector &dx) const
{
  vmult(r, dx);
  r.bulk += linear_system->residual_bulk;
  for (std::size_t i = 0; i < r.extra.size(); ++i)
    r.extra[i] += linear_system->residual_extra[layout.number(i)];
}

double SystemOperator::scaled_norm(const SystemVector &r) const
{
  double sum = 0.;
  for (unsigned int b = 0; b < r.bulk.n_blocks(); ++b)
  {
    const auto &v = r.bulk.block(b).trilinos_vector();
    const double *x = v[0], *d = scale.bulk.block(b).trilinos_vector()[0];
    for (int i = 0; i < v.MyLength(); ++i)
      sum += (x[i] * d[i]) * (x[i] * d[i]);
  }
  for (unsigned int i = 0; i < layout.n_owned(); ++i)
    sum += (r.extra[i] * scale.extra[i]) * (r.extra[i] * scale.extra[i]);
  return std::sqrt(dealii::Utilities::MPI::sum(sum, communicator));
}

SystemVector SystemOperator::make_vector() const
{
  SystemVector v;
  v.bulk.reinit(scale.bulk);
  v.extra.assign(layout.n_seen(), 0.);
  return v;
}

SystemVector SystemOperator::load() const
{
  SystemVector v = make_vector();
  v.bulk = linear_system->residual_bulk;
  for (std::size_t i = 0; i < v.extra.size(); ++i)
    v.extra[i] = linear_system->residual_extra[layout.number(i)];
  return v;
}
} // namespace stockwork
