#include "solvers/substructured_cholesky.h"

#include "solvers/cholmod_factor.h"
#include "stockwork/base/all_gather.h"
#include "stockwork/base/error.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace stockwork
{
namespace
{
/// Unknowns of the interface above which MUMPS, which shares its work among the ranks, takes over.
/// What every rank does for 1000 takes 0.7 ms per solve, in which CHOLMOD solves for 10000 unknowns
/// in two dimensions, 30 ms per factor, and 16 MB.
constexpr unsigned int most_of_interface = 1000;
/// Right-hand sides solved for at once where there are many.
constexpr std::size_t columns_at_once = 32;
/// Each rank repeats the dense work for the interface of all.
constexpr unsigned int most_ranks = 8;

/// Who is who; indices from zero, the same on every rank.
class Division
{
public:
  /// Nothing is divided yet.
  Division() = default;

  Division(const MPI_Comm communicator,
           const int n,
           const std::vector<int> &rows,
           const std::vector<int> &columns)
    : owner(n, 0)
    , numbers(n)
  {
    const int n_ranks = static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(communicator));
    const std::vector<int> all_rows = all_gather(communicator, rows),
                           all_columns = all_gather(communicator, columns);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      std::vector<int> all(n);
      std::iota(all.begin(), all.end(), 0);
      is_possible = share_out(all, all_rows, all_columns, 0, n_ranks);
    }
    MPI_Bcast(owner.data(), n, MPI_INT, 0, communicator);
    is_possible = dealii::Utilities::MPI::max(is_possible ? 1 : 0, communicator) == 1;
    for (int i = 0; i < n; ++i)
      if (owner[i] == of_interface)
        interface.push_back(i);
  }

  std::vector<int> owner;     ///< rank that has an unknown in its interior, or of_interface
  std::vector<int> interface; ///< its unknowns, ascending
  bool is_possible = false;

private:
  static constexpr int of_interface = -1;

  /// Give unknowns, coupled by these entries, to the ranks from `first` on, by halves.
  bool share_out(const std::vector<int> &unknowns,
                 const std::vector<int> &rows,
                 const std::vector<int> &columns,
                 const int first,
                 const int n_ranks)
  {
    for (const int i : unknowns)
      owner[i] = first;
    if (n_ranks == 1 || unknowns.empty())
      return true;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      numbers[unknowns[k]] = static_cast<int>(k) + 1;
    std::vector<int> own_rows(rows), own_columns(columns);
    for (std::vector<int> *list : {&own_rows, &own_columns})
      for (int &i : *list)
        i = numbers[i - 1];
    const std::vector<int> part =
      CholmodFactor::bisect(static_cast<int>(unknowns.size()), own_rows, own_columns);
    if (part.empty())
      return false;
    std::vector<int> halves[2], rows_of[2], columns_of[2];
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      if (part[k] < 2)
        halves[part[k]].push_back(unknowns[k]);
      else
        owner[unknowns[k]] = of_interface;
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (const int side = part[own_rows[k] - 1]; side < 2 && part[own_columns[k] - 1] == side)
      {
        rows_of[side].push_back(rows[k]);
        columns_of[side].push_back(columns[k]);
      }
    const int n_first = n_ranks / 2;
    return share_out(halves[0], rows_of[0], columns_of[0], first, n_first) &&
           share_out(halves[1], rows_of[1], columns_of[1], first + n_first, n_ranks - n_first);
  }

  std::vector<int> numbers; ///< work: of unknowns, from one, among those that are shared out
};

/// y := A x or A^T x for a square matrix by column and several x.
void multiply_dense(const char transposed,
                    const int n,
                    const std::vector<double> &matrix,
                    const std::vector<double> &x,
                    const int n_columns,
                    std::vector<double> &y)
{
  const double one = 1., zero = 0.;
  const int step = 1;
  const char not_transposed = 'N';
  y.resize(x.size());
  if (n == 0)
    return;
  if (n_columns == 1)
    dealii::gemv(&transposed, &n, &n, &one, matrix.data(), &n, x.data(), &step, &zero, y.data(),
                 &step);
  else
    dealii::gemm(&transposed, &not_transposed, &n, &n_columns, &n, &one, matrix.data(), &n,
                 x.data(), &n, &zero, y.data(), &n);
}
} // namespace


struct SubstructuredCholesky::Instance
{
  MPI_Comm communicator;
  int rank, n_ranks;
  Division division;
  int n = 0;
  int n_interior = 0; ///< of this rank
  std::vector<int>
    local; ///< number of each unknown in this rank's matrix, its interior first; or -1
  std::vector<int> interface; ///< unknowns, on every rank
  std::vector<int> interiors; ///< of all ranks, one after another; on rank 0
  std::vector<int> counts;    ///< of them; on rank 0

  // Entries of this rank's matrix, its interior and the interface: first those that it was given,
  // then those that others were given, too.
  std::vector<std::size_t> given, shared;  ///< among the entries given; those that others may need
  std::vector<std::size_t> needed;         ///< among the shared ones of all ranks
  std::vector<std::pair<int, int>> corner; ///< place in K_bb of each that is needed; -1: not there

  CholmodFactor factor;
  std::vector<int> places; ///< in the order of the factor, of interior and interface
  std::vector<double> l; ///< L_bb, rows in the order of `interface`, columns in that of the factor
  std::vector<int> l_columns;                    ///< of L_bb, in the order of the factor
  std::vector<double> s;                         ///< factor of S
  std::vector<double> x, b, b_of_factor, packed; ///< work

  int n_interface() const
  {
    return static_cast<int>(interface.size());
  }

  int n_local() const
  {
    return n_interior + n_interface();
  }

  bool is_interior(const int i) const
  {
    return local[i] >= 0 && local[i] < n_interior;
  }

  bool has_interior(const std::vector<std::pair<int, double>> &vector) const
  {
    return std::any_of(vector.begin(), vector.end(),
                       [&](const auto &entry) { return is_interior(entry.first); });
  }

  /// What fails on one rank fails on all.
  void on_all(const std::function<void()> &action) const
  {
    std::string error;
    try
    {
      action();
    }
    catch (const SolveError &e)
    {
      error = e.what();
    }
    const std::vector<char> all =
      all_gather(communicator, std::vector<char>(error.begin(), error.end()));
    if (!all.empty())
      throw SolveError(error.empty() ? std::string(all.begin(), all.end()) : error);
  }

  void analyse_entries(const std::vector<int> &rows,
                       const std::vector<int> &columns,
                       const std::vector<int> &owner);
  void factorise_interface(const std::vector<double> &k_bb);
  void solve(const double *right, int n_columns, bool has_right = true, bool wants_interior = true);
  void send_from_root(const std::vector<double> &all, int n_columns);
  void send_to_root(std::vector<double> &all, int n_columns);
};


void SubstructuredCholesky::Instance::analyse_entries(const std::vector<int> &rows,
                                                      const std::vector<int> &columns,
                                                      const std::vector<int> &owner)
{
  local.assign(n, -1);
  for (int k = 0; k < n_interface(); ++k)
    local[interface[k]] = k;
  std::vector<int> mine;
  for (int i = 0; i < n; ++i)
    if (owner[i] == rank && local[i] == -1)
      mine.push_back(i);
  n_interior = static_cast<int>(mine.size());
  for (const int i : interface)
    local[i] += n_interior;
  for (int k = 0; k < n_interior; ++k)
    local[mine[k]] = k;
  std::vector<std::size_t> ends;
  interiors = all_gather(communicator, mine, &ends);
  counts.assign(n_ranks, 0);
  for (int r = 0; r < n_ranks; ++r)
    counts[r] = static_cast<int>(ends[r] - (r > 0 ? ends[r - 1] : 0));

  std::vector<int> local_rows, local_columns, shared_rows, shared_columns;
  for (std::vector<std::size_t> *list : {&given, &shared, &needed})
    list->clear();
  corner.clear();
  const auto add = [&](const int i, const int j)
  {
    local_rows.push_back(local[i] + 1);
    local_columns.push_back(local[j] + 1);
  };
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const int i = rows[k] - 1, j = columns[k] - 1;
    if (is_interior(i) || is_interior(j))
    {
      given.push_back(k);
      add(i, j);
    }
    else
    {
      shared.push_back(k);
      shared_rows.push_back(i);
      shared_columns.push_back(j);
    }
  }
  shared_rows = all_gather(communicator, shared_rows);
  shared_columns = all_gather(communicator, shared_columns);
  for (std::size_t k = 0; k < shared_rows.size(); ++k)
    if (const int i = shared_rows[k], j = shared_columns[k]; local[i] >= 0 && local[j] >= 0)
    {
      needed.push_back(k);
      const bool between = !is_interior(i) && !is_interior(j);
      corner.emplace_back(between ? local[i] - n_interior : -1,
                          between ? local[j] - n_interior : -1);
      add(i, j);
    }
  // CAMD wants its sets numbered from zero.
  std::vector<int> last(n_local(), n_interior > 0 ? 1 : 0);
  std::fill(last.begin(), last.begin() + n_interior, 0);
  on_all(
    [&]()
    {
      if (n_local() > 0)
        factor.analyse(n_local(), local_rows, local_columns, last);
    });
}


void SubstructuredCholesky::Instance::factorise_interface(const std::vector<double> &k_bb)
{
  const int nb = n_interface();
  const std::size_t n_entries = static_cast<std::size_t>(nb) * nb;
  if (nb == 0)
    return;
  // Unknowns of the interface come in another order in each rank's factor, and not all of them at
  // its end; but no interior one depends on them.
  std::vector<int> unknown_at(n_local(), -1);
  for (int k = 0; k < nb; ++k)
    unknown_at[places[n_interior + k]] = k;
  l_columns.clear();
  std::vector<int> column_at(n_local(), -1);
  for (int place = 0; place < n_local(); ++place)
    if (unknown_at[place] >= 0)
    {
      column_at[place] = static_cast<int>(l_columns.size());
      l_columns.push_back(place);
    }
  l.assign(n_entries, 0.);
  factor.for_each_entry(
    [&](const int row, const int column, const double value)
    {
      // A supernode may have an interior row below a column of the interface, with a zero.
      if (column_at[column] >= 0 && unknown_at[row] >= 0)
        l[static_cast<std::size_t>(column_at[column]) * nb + unknown_at[row]] = value;
    });
  s = k_bb; // of rank 0; others have none
  const char lower = 'L', not_transposed = 'N';
  const double one = 1., factor_of_k = rank == 0 ? 1. - n_ranks : 0.;
  s.resize(n_entries, 0.);
  dealii::syrk(&lower, &not_transposed, &nb, &nb, &one, l.data(), &nb, &factor_of_k, s.data(), &nb);
  MPI_Allreduce(MPI_IN_PLACE, s.data(), static_cast<int>(n_entries), MPI_DOUBLE, MPI_SUM,
                communicator);
  int info = 0;
  dealii::potrf(&lower, &nb, s.data(), &nb, &info);
  if (info != 0)
    throw SolveError(
      "The direct solver failed while factorising: a matrix that should be positive definite is "
      "not. "
      "Usual causes: a body that no boundary condition holds, a fracture that cuts a piece off.");
}


/// From and to `x`, the right-hand sides of this rank's interior and then its solution, in the
/// order of the factor; `right` is that of the interface, on rank 0, and `b` its solution.
/// @param has_right there is anything in `x` on this rank
/// @param wants_interior somebody will look at `x` on this rank
void SubstructuredCholesky::Instance::solve(const double *const right,
                                            const int n_columns,
                                            const bool has_right,
                                            const bool wants_interior)
{
  const std::size_t nb = n_interface(), nl = n_local();
  if (has_right && nl > 0)
  {
    factor.solve(x.data(), n_columns, CHOLMOD_L);
    // Which leaves -L_bb^-1 L_bi y_i.
    b_of_factor.resize(nb * n_columns);
    for (int c = 0; c < n_columns; ++c)
      for (std::size_t k = 0; k < nb; ++k)
        b_of_factor[c * nb + k] = x[c * nl + l_columns[k]];
    multiply_dense('N', nb, l, b_of_factor, n_columns, b);
  }
  else
    b.assign(nb * n_columns, 0.);
  if (nb > 0)
  {
    if (rank == 0)
      for (std::size_t k = 0; k < b.size(); ++k)
        b[k] += right[k];
    MPI_Allreduce(MPI_IN_PLACE, b.data(), static_cast<int>(b.size()), MPI_DOUBLE, MPI_SUM,
                  communicator);
    const char lower = 'L';
    const int size = n_interface();
    int info = 0;
    dealii::potrs(&lower, &size, &n_columns, s.data(), &size, b.data(), &size, &info);
  }
  if (!wants_interior || nl == 0)
    return;
  // Backward substitution is to find b.
  multiply_dense('T', nb, l, b, n_columns, b_of_factor);
  for (int c = 0; c < n_columns; ++c)
    for (std::size_t k = 0; k < nb; ++k)
      x[c * nl + l_columns[k]] = b_of_factor[c * nb + k];
  factor.solve(x.data(), n_columns, CHOLMOD_Lt);
}


void SubstructuredCholesky::Instance::send_from_root(const std::vector<double> &all,
                                                     const int n_columns)
{
  std::vector<int> starts(n_ranks, 0), sizes(n_ranks, 0);
  if (rank == 0)
  {
    packed.resize(interiors.size() * n_columns);
    std::size_t k = 0, first = 0;
    for (int r = 0; r < n_ranks; first += counts[r], ++r)
    {
      starts[r] = static_cast<int>(k);
      sizes[r] = counts[r] * n_columns;
      for (int c = 0; c < n_columns; ++c)
        for (int i = 0; i < counts[r]; ++i)
          packed[k++] = all[static_cast<std::size_t>(c) * n + interiors[first + i]];
    }
  }
  std::vector<double> mine(static_cast<std::size_t>(n_interior) * n_columns);
  MPI_Scatterv(packed.data(), sizes.data(), starts.data(), MPI_DOUBLE, mine.data(),
               static_cast<int>(mine.size()), MPI_DOUBLE, 0, communicator);
  x.assign(static_cast<std::size_t>(n_local()) * n_columns, 0.);
  for (int c = 0; c < n_columns; ++c)
    for (int i = 0; i < n_interior; ++i)
      x[static_cast<std::size_t>(c) * n_local() + places[i]] =
        mine[static_cast<std::size_t>(c) * n_interior + i];
}


void SubstructuredCholesky::Instance::send_to_root(std::vector<double> &all, const int n_columns)
{
  std::vector<double> mine(static_cast<std::size_t>(n_interior) * n_columns);
  for (int c = 0; c < n_columns; ++c)
    for (int i = 0; i < n_interior; ++i)
      mine[static_cast<std::size_t>(c) * n_interior + i] =
        x[static_cast<std::size_t>(c) * n_local() + places[i]];
  std::vector<int> starts(n_ranks, 0), sizes(n_ranks, 0);
  if (rank == 0)
    for (int r = 0; r < n_ranks; ++r)
    {
      sizes[r] = counts[r] * n_columns;
      starts[r] = r > 0 ? starts[r - 1] + sizes[r - 1] : 0;
    }
  MPI_Gatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, packed.data(), sizes.data(),
              starts.data(), MPI_DOUBLE, 0, communicator);
  if (rank != 0)
    return;
  std::size_t k = 0, first = 0;
  for (int r = 0; r < n_ranks; first += counts[r], ++r)
    for (int c = 0; c < n_columns; ++c)
      for (int i = 0; i < counts[r]; ++i)
        all[static_cast<std::size_t>(c) * n + interiors[first + i]] = packed[k++];
  for (int c = 0; c < n_columns; ++c)
    for (int i = 0; i < n_interface(); ++i)
      all[static_cast<std::size_t>(c) * n + interface[i]] = b[c * interface.size() + i];
}


SubstructuredCholesky::SubstructuredCholesky(const MPI_Comm communicator)
  : instance(std::make_unique<Instance>())
{
  instance->communicator = communicator;
  instance->rank = static_cast<int>(dealii::Utilities::MPI::this_mpi_process(communicator));
  instance->n_ranks = static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(communicator));
}


SubstructuredCholesky::~SubstructuredCholesky() = default;


bool SubstructuredCholesky::suits(const int n,
                                  const std::vector<int> &rows,
                                  const std::vector<int> &columns)
{
  if (instance->n_ranks > static_cast<int>(most_ranks))
    return false;
  instance->division = Division(instance->communicator, n, rows, columns);
  return instance->division.is_possible && instance->division.interface.size() <= most_of_interface;
}


void SubstructuredCholesky::analyse(const int n, std::vector<int> rows, std::vector<int> columns)
{
  if (instance->division.owner.empty())
    instance->division = Division(instance->communicator, n, rows, columns);
  instance->n = n;
  instance->interface = instance->division.interface;
  instance->analyse_entries(rows, columns, instance->division.owner);
  instance->division = {};
  if (instance->n_local() > 0)
    instance->places = instance->factor.places_in_factor();
}


void SubstructuredCholesky::factorise(std::vector<double> &values)
{
  std::vector<double> local, shared;
  for (const std::size_t k : instance->given)
    local.push_back(values[k]);
  for (const std::size_t k : instance->shared)
    shared.push_back(values[k]);
  shared = all_gather(instance->communicator, shared);
  const std::size_t nb = instance->n_interface();
  std::vector<double> k_bb(instance->rank == 0 ? nb * nb : 0, 0.);
  for (std::size_t k = 0; k < instance->needed.size(); ++k)
  {
    const double value = shared[instance->needed[k]];
    local.push_back(value);
    const auto [i, j] = instance->corner[k];
    if (i >= 0 && instance->rank == 0)
      k_bb[std::min(i, j) * nb + std::max(i, j)] = value;
  }
  instance->on_all(
    [&]()
    {
      if (instance->n_local() > 0)
        instance->factor.factorise(local);
    });
  instance->factorise_interface(k_bb);
}


void SubstructuredCholesky::solve(std::vector<double> &x, const int n_right_hand_sides)
{
  const std::size_t nb = instance->n_interface();
  std::vector<double> right(instance->rank == 0 ? nb * n_right_hand_sides : 0);
  if (instance->rank == 0)
    for (int c = 0; c < n_right_hand_sides; ++c)
      for (std::size_t k = 0; k < nb; ++k)
        right[c * nb + k] = x[static_cast<std::size_t>(c) * instance->n + instance->interface[k]];
  instance->send_from_root(x, n_right_hand_sides);
  instance->solve(right.data(), n_right_hand_sides);
  instance->send_to_root(x, n_right_hand_sides);
}


void SubstructuredCholesky::solve_sparse(std::vector<int> &column_starts,
                                         std::vector<int> &rows,
                                         std::vector<double> &values,
                                         std::vector<double> &x)
{
  int n_columns = static_cast<int>(column_starts.size()) - 1;
  MPI_Bcast(&n_columns, 1, MPI_INT, 0, instance->communicator);
  std::fill(x.begin(), x.end(), 0.);
  if (instance->rank == 0)
    for (int c = 0; c < n_columns; ++c)
      for (int k = column_starts[c] - 1; k < column_starts[c + 1] - 1; ++k)
        x[static_cast<std::size_t>(c) * instance->n + rows[k] - 1] += values[k];
  solve(x, n_columns);
}


std::optional<std::vector<double>> SubstructuredCholesky::products(const SparseVectors &left,
                                                                   const SparseVectors &right)
{
  Instance &own = *instance;
  const auto has_interior = [&](const auto *vector) { return own.has_interior(*vector); };
  const bool wants_interior = std::any_of(left.begin(), left.end(), has_interior);
  const std::size_t nb = own.n_interface(), nl = own.n_local();
  std::vector<double> result(left.size() * right.size(), 0.), of_interface;
  for (std::size_t begin = 0; begin < right.size(); begin += columns_at_once)
  {
    const std::size_t end = std::min(begin + columns_at_once, right.size());
    const bool has_right = std::any_of(right.begin() + begin, right.begin() + end, has_interior);
    own.x.assign(nl * (end - begin), 0.);
    of_interface.assign(nb * (end - begin), 0.);
    for (std::size_t j = begin; j < end; ++j)
      for (const auto &[i, value] : *right[j])
        if (own.is_interior(i))
          own.x[(j - begin) * nl + own.places[own.local[i]]] += value;
        else if (own.local[i] >= 0)
          of_interface[(j - begin) * nb + own.local[i] - own.n_interior] += value;
    own.solve(of_interface.data(), static_cast<int>(end - begin), has_right, wants_interior);
    for (std::size_t j = begin; j < end; ++j)
      for (std::size_t l = 0; l < left.size(); ++l)
      {
        double &sum = result[j * left.size() + l];
        for (const auto &[i, value] : *left[l])
          if (own.is_interior(i))
            sum += value * own.x[(j - begin) * nl + own.places[own.local[i]]];
          else if (own.local[i] >= 0 && own.rank == 0)
            sum += value * own.b[(j - begin) * nb + own.local[i] - own.n_interior];
      }
  }
  MPI_Allreduce(MPI_IN_PLACE, result.data(), static_cast<int>(result.size()), MPI_DOUBLE, MPI_SUM,
                own.communicator);
  return result;
}


int SubstructuredCholesky::size() const
{
  return instance->n;
}
} // namespace stockwork
