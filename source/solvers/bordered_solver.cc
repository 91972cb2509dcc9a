#include "solvers/bordered_solver.h"

#include "solvers/bulk_transfer.h"
#include "solvers/cholesky.h"
#include "solvers/mumps.h"
#include "solvers/stopwatch.h"
#include "solvers/substructured_cholesky.h"
#include "stockwork/base/all_gather.h"
#include "stockwork/base/error.h"

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <cmath>

namespace stockwork
{
namespace
{
constexpr unsigned int max_refinements = 4;
/// Right-hand sides solved for at once, as the memory of their dense solutions permits [numbers]:
/// a factor is read once for all of them.
constexpr std::size_t least_batch = 32, greatest_batch = 256, memory_of_batch = 1 << 22;
/// Rows of a changed bulk matrix, above which it is factorised anew.
constexpr unsigned int most_changes = 128;
/// Entries by which a row differs, over its diagonal entry, that are rounding errors.
constexpr double same_entry = 1e-14;
/// Memory for solutions that are kept, at least [numbers].
constexpr std::size_t minimum_memory = 1 << 26;

/// Call use(matrix, row block, column block, local row, entries, their values, local columns) for
/// this rank's rows of the bulk.
template <class Function>
void for_each_row(const LinearSystem &system, const Function &use)
{
  for (unsigned int b = 0; b < system.bulk.n_block_rows(); ++b)
    for (unsigned int c = 0; c < system.bulk.n_block_cols(); ++c)
    {
      const Epetra_CrsMatrix &matrix = system.bulk.block(b, c).trilinos_matrix();
      for (int i = 0; i < matrix.NumMyRows(); ++i)
      {
        int n_entries;
        double *values;
        int *indices;
        matrix.ExtractMyRowView(i, n_entries, values, indices);
        use(matrix, b, c, i, n_entries, values, indices);
      }
    }
}

/// Sparse vectors that all lie in the same small part of a long one, to be multiplied by many of
/// these, of which only that part is read, once.
struct FewEntries
{
  explicit FewEntries(const ExtraSchur::SparseVectors &vectors)
  {
    for (const auto *vector : vectors)
      for (const auto &[i, value] : *vector)
        indices.push_back(i);
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    for (const auto *vector : vectors)
    {
      for (const auto &[i, value] : *vector)
        entries.emplace_back(std::lower_bound(indices.begin(), indices.end(), i) - indices.begin(),
                             value);
      ends.push_back(entries.size());
    }
  }

  /// The products of all vectors with that one. `few` is memory for the part.
  void multiply(const double *one, std::vector<double> &few, double *products) const
  {
    for (std::size_t i = 0; i < indices.size(); ++i)
      few[i] = one[indices[i]];
    std::size_t k = 0;
    for (std::size_t v = 0; v < ends.size(); ++v)
    {
      double sum = 0.;
      for (; k < ends[v]; ++k)
        sum += entries[k].second * few[entries[k].first];
      products[v] = sum;
    }
  }

  std::vector<int> indices;                             ///< of the part, ascending
  std::vector<std::pair<unsigned int, double>> entries; ///< place in the part, and value
  std::vector<std::size_t> ends;                        ///< of each vector's
};

/// sum += weight * vector, four vectors at once: what takes the time is to read memory. (For BLAS
/// those that are wanted would have to lie side by side.)
void add_multiples(std::vector<std::pair<const double *, double>> terms, std::vector<double> &sum)
{
  constexpr std::size_t at_once = 4;
  for (std::size_t i = 0; i < terms.size(); i += at_once)
  {
    while (terms.size() < i + at_once)
      terms.emplace_back(terms[i].first, 0.);
    const auto &[a, of_a] = terms[i];
    const auto &[b, of_b] = terms[i + 1];
    const auto &[c, of_c] = terms[i + 2];
    const auto &[d, of_d] = terms[i + 3];
    for (std::size_t k = 0; k < sum.size(); ++k)
      sum[k] += of_a * a[k] + of_b * b[k] + of_c * c[k] + of_d * d[k];
  }
}

/// Values of this rank's rows of the bulk, not scaled.
std::vector<double> bulk_values(const LinearSystem &system)
{
  std::vector<double> result;
  for_each_row(system, [&](const auto &, auto, auto, int, const int n, const double *values,
                           const int *) { result.insert(result.end(), values, values + n); });
  return result;
}
} // namespace

BorderedSolver::BorderedSolver(const MPI_Comm communicator)
  : communicator(communicator)
  , is_root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  , schur(communicator,
          [this](const auto &left, const auto &right) { return multiply(left, right); })
{
}

void BorderedSolver::factorise(const SystemOperator &op, const SystemStamps &stamps)
{
  // The products belong to the old factor, whatever happens below.
  schur.forget();
  const bool definite = op.system().definite;
  std::unique_ptr<SparseFactor> now = std::move(factor); // where it fails there is none
  if (!now || stamps.mesh != factor_stamps.mesh ||
      static_cast<unsigned int>(now->size()) != op.n_bulk())
  {
    const int n = static_cast<int>(op.n_bulk());
    std::vector<int> rows, columns;
    append_bulk_indices(op, definite, rows, columns);
    if (!definite)
      now = std::make_unique<Mumps>(communicator, Mumps::Kind::unsymmetric);
    else if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      now = std::make_unique<Cholesky>();
    else
    {
      auto substructured = std::make_unique<SubstructuredCholesky>(communicator);
      if (substructured->suits(n, rows, columns))
        now = std::move(substructured);
      else
        now = std::make_unique<Mumps>(communicator, Mumps::Kind::definite);
    }
    now->analyse(n, std::move(rows), std::move(columns));
  }
  std::vector<double> values;
  append_bulk_values(op, definite, values);
  now->factorise(values);
  factor = std::move(now);
  factor_scaling.copy_from(op.scaling());
  factor_stamps = stamps;

  forget_solutions();
  most_solutions = 0;
  values_with_changes = stamps.bulk_values;
  n_changes = 0;
  change_columns.clear();
  change_rows.clear();
  keeps_values = !definite;
  factor_values = definite ? std::vector<double>() : bulk_values(op.system());
}

void BorderedSolver::forget_solutions()
{
  solutions.clear();
  batches.clear();
}

bool BorderedSolver::find_changes(const SystemOperator &op)
{
  const auto told = op.system().bulk_changes.since(factor_stamps.bulk_values);
  const auto may_differ = [&](const auto row)
  { return !told || (told->n_elements() > 0 && told->is_element(row)); };
  change_columns.clear();
  change_rows.clear();
  std::vector<dealii::types::global_dof_index> changed;
  const double *of_factor = factor_values.data();
  for_each_row(op.system(),
               [&](const Epetra_CrsMatrix &matrix, const unsigned int b, const unsigned int c,
                   const int i, const int n_entries, const double *values, const int *indices)
               {
                 const double *const before = of_factor;
                 of_factor += n_entries;
                 const dealii::types::global_dof_index row = matrix.GRID64(i) + op.offset(b);
                 if (!may_differ(row) || std::equal(values, values + n_entries, before))
                   return;
                 const double d = SystemOperator::entry(factor_scaling.bulk, b, i);
                 for (int k = 0; k < n_entries; ++k)
                 {
                   if (!(std::abs(values[k] - before[k]) * d * d > same_entry))
                     continue;
                   if (changed.empty() || changed.back() != row)
                   {
                     changed.push_back(row);
                     change_columns.add(row, 0, 1. / d);
                   }
                   change_rows.add(row, matrix.GCID64(indices[k]) + op.offset(c),
                                   d * (before[k] - values[k]));
                 }
               });
  // Where the bulk has several blocks, a row comes once for each.
  std::vector<dealii::types::global_dof_index> all = all_gather(communicator, changed);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  n_changes = all.size();
  if (n_changes > most_changes)
    return false;
  const auto number = [&](const auto row)
  { return std::lower_bound(all.begin(), all.end(), row) - all.begin(); };
  for (std::size_t k = 0; k < change_columns.rows.size(); ++k)
    change_columns.columns[k] = number(change_columns.rows[k]);
  for (auto &row : change_rows.rows)
    row = number(row);
  return true;
}

SystemOperator::Border BorderedSolver::border_with_changes(const SystemOperator &op) const
{
  SystemOperator::Border border = op.border();
  if (n_changes == 0)
    return border;
  Triplets columns = change_columns, rows = change_rows, corner;
  for (auto &column : columns.columns)
    column += op.n_extra();
  for (auto &row : rows.rows)
    row += op.n_extra();
  if (is_root)
    for (unsigned int i = 0; i < n_changes; ++i)
      corner.add(op.n_extra() + i, op.n_extra() + i, 1.);
  op.extend(border, op.n_extra() + n_changes, columns, rows, corner);
  return border;
}

std::vector<double> BorderedSolver::solve_columns(const ExtraSchur::SparseVectors &right_hand_sides)
{
  std::vector<int> starts = {1}, rows;
  std::vector<double> values;
  for (const auto *b : right_hand_sides)
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

std::vector<double> BorderedSolver::multiply(const ExtraSchur::SparseVectors &left,
                                             const ExtraSchur::SparseVectors &right)
{
  const bool keep = keeps_values;
  if (!keep)
    if (auto products = factor->products(left, right))
      return std::move(*products);
  const std::size_t n = factor->size();
  std::vector<double> result(left.size() * right.size());
  const FewEntries of_left(left);
  std::vector<double> few(of_left.indices.size());
  const auto multiply_one = [&](const std::size_t j, const double *solution)
  { of_left.multiply(solution, few, result.data() + j * left.size()); };
  std::vector<std::size_t> wanted;
  for (std::size_t j = 0; j < right.size(); ++j)
    if (const auto known = solutions.find(*right[j]); known == solutions.end())
      wanted.push_back(j);
    else if (is_root)
      multiply_one(j, known->second);
  const std::size_t batch = std::clamp(memory_of_batch / n, least_batch, greatest_batch);
  for (std::size_t begin = 0; begin < wanted.size(); begin += batch)
  {
    const std::size_t n_now = std::min<std::size_t>(batch, wanted.size() - begin);
    ExtraSchur::SparseVectors columns;
    for (std::size_t k = 0; k < n_now; ++k)
      columns.push_back(right[wanted[begin + k]]);
    std::vector<double> x = solve_columns(columns);
    for (std::size_t k = 0; k < n_now; ++k)
    {
      if (is_root)
        multiply_one(wanted[begin + k], x.data() + k * n);
      if (keep)
        solutions[*columns[k]] = is_root ? x.data() + k * n : nullptr;
    }
    if (keep)
      batches.push_back(std::move(x));
  }
  MPI_Bcast(result.data(), static_cast<int>(result.size()), MPI_DOUBLE, 0, communicator);
  return result;
}

void BorderedSolver::solve_bulk(const LinearSystem &system,
                                const dealii::TrilinosWrappers::MPI::BlockVector &load,
                                dealii::TrilinosWrappers::MPI::BlockVector &solution)
{
  const BulkTransfer transfer(system.residual_bulk, communicator);
  std::vector<double> x(is_root ? factor->size() : 0);
  transfer.to_root(load, factor_scaling.bulk, x.data());
  factor->solve(x);
  transfer.from_root(x.data(), factor_scaling.bulk, solution);
}

bool BorderedSolver::subtract_answer(const SystemOperator &op,
                                     const std::vector<double> &z,
                                     dealii::TrilinosWrappers::MPI::BlockVector &solution) const
{
  if (!keeps_values)
    return false;
  std::vector<std::pair<const double *, double>> terms;
  const auto columns = schur.columns();
  for (unsigned int i = 0; i < columns.size(); ++i)
    if (const auto &[column, factor_of_known] = columns[i]; column != nullptr && z[i] != 0.)
    {
      const auto found = solutions.find(*column);
      if (found == solutions.end())
        return false;
      terms.emplace_back(found->second, factor_of_known * z[i]);
    }
  std::vector<double> sum(is_root ? factor->size() : 0, 0.);
  if (is_root)
    add_multiples(terms, sum);
  SystemVector answer = op.make_vector();
  BulkTransfer(op.system().residual_bulk, communicator)
    .from_root(sum.data(), factor_scaling.bulk, answer.bulk);
  solution -= answer.bulk;
  return true;
}

void BorderedSolver::eliminate(const SystemOperator &op,
                               const SystemOperator::Border &border,
                               const SystemVector &r,
                               SystemVector &dx,
                               const bool skip_bulk_load)
{
  SystemVector y = op.make_vector(), load = r;
  if (border.n > 0)
  {
    // S z = r_extra - C A^-1 r_bulk
    std::vector<double> z(border.n, 0.);
    if (!skip_bulk_load)
    {
      solve_bulk(op.system(), r.bulk, y.bulk);
      for (const auto &e : border.extra_bulk)
      {
        const auto [block, local] = op.locate(e.column);
        z[e.row] -= e.value * SystemOperator::entry(y.bulk, block, local);
      }
      dealii::Utilities::MPI::sum(z, communicator, z);
    }
    for (unsigned int i = 0; i < op.n_extra(); ++i)
      z[i] += r.extra[i];
    schur.solve(z);
    for (unsigned int i = 0; i < op.n_extra(); ++i)
      dx.extra[i] -= z[i];
    if (subtract_answer(op, z, y.bulk))
    {
      dx.bulk -= y.bulk;
      return;
    }
    for (const auto &e : border.bulk_extra)
    {
      const auto [block, local] = op.locate(e.row);
      SystemOperator::entry(load.bulk, block, local) -= e.value * z[e.column];
    }
  }
  solve_bulk(op.system(), load.bulk, y.bulk);
  dx.bulk -= y.bulk;
}

bool BorderedSolver::has_factor(const LinearSystem &system, const SystemStamps &stamps) const
{
  return factor && stamps.mesh == factor_stamps.mesh && stamps.matrix == factor_stamps.matrix &&
         factor_scaling.bulk.n_blocks() == system.residual_bulk.n_blocks() &&
         factor_scaling.bulk.size() == system.residual_bulk.size();
}

bool BorderedSolver::in_balance(const SystemOperator &op,
                                const SystemVector &r,
                                const double allowed)
{
  SystemVector bulk_only = op.make_vector();
  bulk_only.bulk = r.bulk;
  return op.scaled_norm(bulk_only) <= 1e-2 * allowed;
}

LinearReport BorderedSolver::solve(const LinearSystem &system,
                                   const SystemStamps &stamps,
                                   const double tolerance,
                                   dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                                   std::vector<double> &dx_extra)
{
  const Stopwatch stopwatch;
  const bool has_one = has_factor(system, stamps);
  const bool same_bulk = has_one && stamps.bulk_values == values_with_changes;
  const bool has_room =
    has_one && solutions.size() <= std::max(most_solutions, minimum_memory / factor->size());
  const bool may_keep = has_one && keeps_values && has_room;
  if (same_bulk && !has_room)
    forget_solutions(); // products stay
  auto op = std::make_unique<SystemOperator>(
    system, communicator, same_bulk || may_keep ? &factor_scaling.bulk : nullptr);
  LinearReport report;
  SystemOperator::Border border;
  const auto prepare = [&](const bool anew)
  {
    if (anew)
    {
      if (same_bulk || may_keep) // its scaling is the old factor's
        op = std::make_unique<SystemOperator>(system, communicator);
      factorise(*op, stamps);
    }
    report.factorised |= anew;
    border = border_with_changes(*op);
    if (border.n == 0)
      return;
    schur.update(*op, border, op->n_bulk(), system.definite, &factor_scaling.bulk);
    if (anew)
      most_solutions = 2 * solutions.size();
  };
  bool anew = !same_bulk;
  if (!same_bulk && may_keep)
  {
    anew = !find_changes(*op);
    values_with_changes = stamps.bulk_values;
  }
  prepare(anew);
  report.setup_seconds = stopwatch.seconds();

  SystemVector dx = op->make_vector(), r = op->load();
  const double size = op->scaled_norm(r);
  double last = size;
  if (size == 0.)
    report.converged = true;
  for (unsigned int k = 0; k <= max_refinements && !report.converged; ++k)
  {
    // In a Newton iteration after the first, the bulk is in equilibrium already: its load would
    // be rounding errors.
    if (system.rock_change != nullptr)
      report.iterations += eliminate_tangent(*op, border, r, 0.9 * tolerance * size, dx);
    else
    {
      eliminate(*op, border, r, dx, in_balance(*op, r, tolerance * size));
      report.iterations = k;
    }

    op->residual(r, dx);
    const double now = op->scaled_norm(r);
    report.relative_residual = now / size;
    report.converged = now <= tolerance * size;
    if (!report.converged && !(now < 0.5 * last))
    {
      if (report.factorised || system.rock_change != nullptr)
        break;
      prepare(true); // the values have changed behind the stamps' back
      dx = op->make_vector();
      r = op->load();
      last = size;
      continue;
    }
    last = now;
  }
  if (system.rock_change == nullptr && !(report.relative_residual < 1e-3))
    ExtraSchur::throw_singular();
  dx_bulk = dx.bulk;
  dx_extra = dx.extra;
  return report;
}
} // namespace stockwork
