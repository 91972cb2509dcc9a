#include "solvers/mumps.h"

#include "stockwork/base/error.h"

#include <dmumps_c.h>

#include <string>

namespace stockwork
{
namespace
{
constexpr int initialise_job = -1, finish_job = -2, analyse_job = 1, factorise_job = 2,
              solve_job = 3;

/// INFOG(1), see the MUMPS users' guide, "Error diagnostics".
constexpr int no_error = 0, structurally_singular = -6, workspace_too_small = -8,
              real_workspace_too_small = -9, singular = -10, out_of_memory = -13,
              indefinite_pivot = -40;
} // namespace

struct Mumps::Instance
{
  DMUMPS_STRUC_C data{};
  MPI_Comm communicator;
  std::vector<int> rows, columns;
  bool alive = false;
  bool is_root = false;

  /// The users' guide counts from one.
  int &icntl(const int i)
  {
    return data.icntl[i - 1];
  }

  int run(const int job)
  {
    data.job = job;
    dmumps_c(&data);
    return data.infog[0];
  }

  [[noreturn]] void fail(const std::string &doing)
  {
    const int code = data.infog[0], detail = data.infog[1];
    if (code == out_of_memory)
      throw MemoryError(
        "there is not enough memory for a factor of the matrix. 'stockwork --check' "
        "estimates how much a run needs. Use larger cells, more machines or "
        "'Linear solver/Type = iterative'");
    std::string text = "The direct solver (MUMPS) failed while " + doing + ": ";
    if (code == singular || code == structurally_singular)
      text += "the matrix is singular (rank " + std::to_string(code == singular ? detail : 0) +
              " of " + std::to_string(data.n) +
              "). Usual causes: a body that no boundary condition holds, a fracture that cuts a "
              "piece off, a pressure without storage, conductivity or boundary value.";
    else if (code == indefinite_pivot)
      text += "a matrix that should be positive definite is not.";
    else
      text += "error " + std::to_string(code) + ", detail " + std::to_string(detail) +
              " (INFOG(1), INFOG(2) in the MUMPS users' guide).";
    throw SolveError(text);
  }
};

Mumps::Mumps(const MPI_Comm communicator, const Kind kind)
  : instance(std::make_unique<Instance>())
{
  auto &data = instance->data;
  instance->communicator = communicator;
  int rank;
  MPI_Comm_rank(communicator, &rank);
  instance->is_root = rank == 0;
  data.comm_fortran = MPI_Comm_c2f(communicator);
  data.sym = static_cast<int>(kind);
  data.par = 1;
  if (instance->run(initialise_job) < no_error)
    instance->fail("starting");
  instance->alive = true;

  instance->icntl(1) = -1; // no output streams
  instance->icntl(2) = -1;
  instance->icntl(3) = -1;
  instance->icntl(4) = 0;
  instance->icntl(18) = 3;  // entries spread over the ranks
  instance->icntl(14) = 30; // per cent of memory above the estimate
  instance->icntl(8) = 0;   // no scaling: the callers do that
  instance->icntl(24) = 0;  // a null pivot is an error
}

Mumps::~Mumps()
{
  if (instance->alive)
    instance->run(finish_job);
}

void Mumps::analyse(const int n, std::vector<int> rows, std::vector<int> columns)
{
  instance->rows = std::move(rows);
  instance->columns = std::move(columns);
  auto &data = instance->data;
  data.n = n;
  data.nnz_loc = instance->rows.size();
  data.irn_loc = instance->rows.data();
  data.jcn_loc = instance->columns.data();
  data.a_loc = nullptr;
  if (instance->run(analyse_job) < no_error)
    instance->fail("ordering the matrix");
}

void Mumps::factorise(std::vector<double> &values)
{
  instance->data.a_loc = values.data();
  int code = instance->run(factorise_job);
  // Pivoting may need more room than the analysis foresaw.
  while ((code == workspace_too_small || code == real_workspace_too_small) &&
         instance->icntl(14) < 2000)
  {
    instance->icntl(14) *= 2;
    code = instance->run(factorise_job);
  }
  instance->data.a_loc = nullptr;
  if (code < no_error)
    instance->fail("factorising");
}

void Mumps::solve(std::vector<double> &x, const int n_right_hand_sides)
{
  auto &data = instance->data;
  instance->icntl(20) = 0;
  data.nrhs = n_right_hand_sides;
  data.lrhs = data.n;
  data.rhs = x.data();
  if (instance->run(solve_job) < no_error)
    instance->fail("solving");
}

void Mumps::solve_sparse(std::vector<int> &column_starts,
                         std::vector<int> &rows,
                         std::vector<double> &values,
                         std::vector<double> &x)
{
  auto &data = instance->data;
  instance->icntl(20) = 1;
  // The number of columns is known on rank 0 only.
  int n_columns = static_cast<int>(column_starts.size()) - 1;
  MPI_Bcast(&n_columns, 1, MPI_INT, 0, instance->communicator);
  data.nrhs = n_columns;
  instance->icntl(27) = n_columns; // all at once
  data.lrhs = data.n;
  if (instance->is_root)
    data.nz_rhs = rows.size();
  data.irhs_ptr = instance->is_root ? column_starts.data() : nullptr;
  data.irhs_sparse = instance->is_root ? rows.data() : nullptr;
  data.rhs_sparse = instance->is_root ? values.data() : nullptr;
  data.rhs = x.data();
  if (instance->run(solve_job) < no_error)
    instance->fail("solving");
}

int Mumps::size() const
{
  return instance->data.n;
}

double Mumps::memory() const
{
  return instance->data.info[15];
}
} // namespace stockwork
