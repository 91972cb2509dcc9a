#include "solvers/cholesky.h"

#include "stockwork/base/error.h"

#include <cholmod.h>

#include <algorithm>
#include <string>

namespace stockwork
{
struct Cholesky::Instance
{
  cholmod_common common{};
  cholmod_sparse *matrix = nullptr; ///< pattern by column of what lies above the diagonal
  cholmod_factor *factor = nullptr;
  cholmod_dense *work_1 = nullptr, *work_2 = nullptr;
  std::vector<int> places; ///< in the matrix, of the values given; empty: they come in its order

  Instance()
  {
    cholmod_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
  }

  ~Instance()
  {
    free();
    cholmod_finish(&common);
  }

  Instance(const Instance &) = delete;
  Instance &operator=(const Instance &) = delete;

  void free()
  {
    cholmod_free_sparse(&matrix, &common);
    cholmod_free_factor(&factor, &common);
    for (cholmod_dense **dense : {&work_1, &work_2})
      cholmod_free_dense(dense, &common);
  }

  [[noreturn]] void fail(const std::string &doing) const
  {
    std::string text = "The direct solver (CHOLMOD) failed while " + doing + ": ";
    if (common.status == CHOLMOD_NOT_POSDEF)
      text += "a matrix that should be positive definite is not. Usual causes: a body that no "
              "boundary condition holds, a fracture that cuts a piece off.";
    else if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
      text += "not enough memory. Use more ranks, a coarser mesh, or the iterative solver (set "
              "Linear solver/Type = iterative).";
    else
      text += "status " + std::to_string(common.status) + ".";
    throw SolveError(text);
  }

  /// In place: CHOLMOD permutes the right-hand sides into `work_1`, solves there, and permutes back
  /// into what it is given for the solution, which it takes as it is where the size fits.
  void solve(double *const x, const std::size_t n_columns)
  {
    cholmod_dense b{};
    b.nrow = b.d = matrix->nrow;
    b.ncol = n_columns;
    b.nzmax = b.nrow * b.ncol;
    b.x = x;
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_dense same = b, *solution = &same;
    if (!cholmod_solve2(CHOLMOD_A, factor, &b, nullptr, &solution, nullptr, &work_1, &work_2,
                        &common))
      fail("solving");
  }
};

Cholesky::Cholesky()
  : instance(std::make_unique<Instance>())
{
}

Cholesky::~Cholesky() = default;

void Cholesky::analyse(const int n, std::vector<int> rows, std::vector<int> columns)
{
  instance->free();
  const std::size_t n_entries = rows.size();
  cholmod_sparse *&matrix = instance->matrix;
  matrix = cholmod_allocate_sparse(n, n, n_entries, 0, 1, 1, CHOLMOD_PATTERN, &instance->common);
  if (matrix == nullptr)
    instance->fail("starting");
  // The columns of the upper triangle are the rows of the lower one.
  int *const starts = static_cast<int *>(matrix->p), *const indices = static_cast<int *>(matrix->i);
  std::fill(starts, starts + n + 1, 0);
  for (const int row : rows)
    ++starts[row];
  for (int i = 0; i < n; ++i)
    starts[i + 1] += starts[i];
  std::vector<int> next(starts, starts + n);
  instance->places.resize(n_entries);
  for (std::size_t k = 0; k < n_entries; ++k)
  {
    const int place = next[rows[k] - 1]++;
    indices[place] = columns[k] - 1;
    instance->places[k] = place;
  }
  if (std::is_sorted(rows.begin(), rows.end()))
    instance->places = {};
  instance->factor = cholmod_analyze(matrix, &instance->common);
  if (instance->factor == nullptr)
    instance->fail("ordering the matrix");
}

void Cholesky::factorise(std::vector<double> &values)
{
  std::vector<double> in_order(instance->places.size());
  for (std::size_t k = 0; k < in_order.size(); ++k)
    in_order[instance->places[k]] = values[k];
  cholmod_sparse &matrix = *instance->matrix;
  matrix.x = in_order.empty() ? values.data() : in_order.data();
  matrix.xtype = CHOLMOD_REAL;
  const bool done = cholmod_factorize(&matrix, instance->factor, &instance->common) &&
                    instance->common.status == CHOLMOD_OK;
  matrix.x = nullptr; // nobody asks for the values again
  matrix.xtype = CHOLMOD_PATTERN;
  if (!done)
    instance->fail("factorising");
}

void Cholesky::solve(std::vector<double> &x, const int n_right_hand_sides)
{
  instance->solve(x.data(), n_right_hand_sides);
}

void Cholesky::solve_sparse(std::vector<int> &column_starts,
                            std::vector<int> &rows,
                            std::vector<double> &values,
                            std::vector<double> &x)
{
  const std::size_t n = size(), n_columns = column_starts.size() - 1;
  std::fill(x.begin(), x.end(), 0.);
  for (std::size_t column = 0; column < n_columns; ++column)
    for (int k = column_starts[column] - 1; k < column_starts[column + 1] - 1; ++k)
      x[column * n + rows[k] - 1] += values[k];
  solve(x, static_cast<int>(n_columns));
}

int Cholesky::size() const
{
  return static_cast<int>(instance->matrix->nrow);
}
} // namespace stockwork
