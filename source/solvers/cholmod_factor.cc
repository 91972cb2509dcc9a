#include "solvers/cholmod_factor.h"

#include "stockwork/base/error.h"

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <numeric>

/// BLAS: x <- A^-1 x, A triangular.
extern "C" void dtrsv_(const char *triangle,
                       const char *transposed,
                       const char *unit_diagonal,
                       const int *n,
                       const double *a,
                       const int *leading_dimension,
                       double *x,
                       const int *step);

namespace stockwork
{
CholmodFactor::CholmodFactor()
{
  cholmod_start(&common);
  common.print = 0;
  common.error_handler = nullptr;
}


CholmodFactor::~CholmodFactor()
{
  free();
  cholmod_finish(&common);
}


void CholmodFactor::free()
{
  cholmod_free_sparse(&matrix, &common);
  cholmod_free_factor(&factor, &common);
  for (cholmod_dense **dense : {&work_1, &work_2})
    cholmod_free_dense(dense, &common);
}


void CholmodFactor::fail(const std::string &doing) const
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


cholmod_sparse *CholmodFactor::upper_triangle(const int n,
                                              const std::vector<int> &rows,
                                              const std::vector<int> &columns,
                                              std::vector<int> &places,
                                              cholmod_common &common)
{
  const std::size_t n_entries = rows.size();
  cholmod_sparse *const matrix =
    cholmod_allocate_sparse(n, n, n_entries, 0, 1, 1, CHOLMOD_PATTERN, &common);
  if (matrix == nullptr)
    return nullptr;
  int *const starts = static_cast<int *>(matrix->p), *const indices = static_cast<int *>(matrix->i);
  std::fill(starts, starts + n + 1, 0);
  for (std::size_t k = 0; k < n_entries; ++k)
    ++starts[std::max(rows[k], columns[k])];
  for (int i = 0; i < n; ++i)
    starts[i + 1] += starts[i];
  std::vector<int> next(starts, starts + n);
  places.resize(n_entries);
  for (std::size_t k = 0; k < n_entries; ++k)
  {
    places[k] = next[std::max(rows[k], columns[k]) - 1]++;
    indices[places[k]] = std::min(rows[k], columns[k]) - 1;
  }
  return matrix;
}


std::vector<int>
CholmodFactor::bisect(const int n, const std::vector<int> &rows, const std::vector<int> &columns)
{
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  std::vector<int> unused, part(n);
  cholmod_sparse *graph = upper_triangle(n, rows, columns, unused, common);
  // Unknowns with the same neighbours, as the components of a node, stay together.
  const int together = 1;
  if (graph == nullptr || cholmod_bisect(graph, nullptr, 0, together, part.data(), &common) < 0)
    part.clear();
  cholmod_free_sparse(&graph, &common);
  cholmod_finish(&common);
  return part;
}


void CholmodFactor::analyse(const int n,
                            const std::vector<int> &rows,
                            const std::vector<int> &columns,
                            const std::vector<int> &last)
{
  free();
  matrix = upper_triangle(n, rows, columns, places, common);
  if (matrix == nullptr)
    fail("starting");
  if (std::is_sorted(places.begin(), places.end()))
    places = {};

  common.supernodal = CHOLMOD_SUPERNODAL;
  if (last.empty())
    factor = cholmod_analyze(matrix, &common);
  else
  {
    std::vector<int> member(last), order(n);
    if (!cholmod_camd(matrix, nullptr, 0, member.data(), order.data(), &common))
      fail("ordering the matrix");
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    factor = cholmod_analyze_p(matrix, order.data(), nullptr, 0, &common);
  }
  if (factor == nullptr)
    fail("ordering the matrix");
}


void CholmodFactor::factorise(std::vector<double> &values)
{
  std::vector<double> in_order(places.size());
  for (std::size_t k = 0; k < in_order.size(); ++k)
    in_order[places[k]] = values[k];
  matrix->x = in_order.empty() ? values.data() : in_order.data();
  matrix->xtype = CHOLMOD_REAL;
  const bool done = cholmod_factorize(matrix, factor, &common) && common.status == CHOLMOD_OK;
  matrix->x = nullptr; // nobody asks for the values again
  matrix->xtype = CHOLMOD_PATTERN;
  if (!done)
    fail("factorising");
}


void CholmodFactor::solve(double *const x, const std::size_t n_columns, const int system)
{
  // CHOLMOD permutes the right-hand sides into `work_1`, solves there, and permutes back into what
  // it is given for the solution, which it takes as it is where the size fits.
  cholmod_dense b{};
  b.nrow = b.d = matrix->nrow;
  b.ncol = n_columns;
  b.nzmax = b.nrow * b.ncol;
  b.x = x;
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_dense same = b, *solution = &same;
  if (!cholmod_solve2(system, factor, &b, nullptr, &solution, nullptr, &work_1, &work_2, &common))
    fail("solving");
}


std::vector<int> CholmodFactor::places_in_factor() const
{
  const int *const order = static_cast<int *>(factor->Perm);
  std::vector<int> result(size());
  for (int k = 0; k < size(); ++k)
    result[order[k]] = k;
  return result;
}


std::vector<int> CholmodFactor::all_supernodes() const
{
  std::vector<int> all(factor->nsuper);
  std::iota(all.begin(), all.end(), 0);
  return all;
}


std::vector<int> CholmodFactor::path_to_root(const std::vector<int> &unknowns) const
{
  const int *const super = static_cast<int *>(factor->super),
                   *const pi = static_cast<int *>(factor->pi),
                   *const s = static_cast<int *>(factor->s);
  const int n_supernodes = static_cast<int>(factor->nsuper);
  std::vector<int> supernode(size());
  for (int k = 0; k < n_supernodes; ++k)
    std::fill(supernode.begin() + super[k], supernode.begin() + super[k + 1], k);
  std::vector<char> passed(n_supernodes, 0);
  const std::vector<int> place = places_in_factor();
  for (const int unknown : unknowns)
    for (int k = supernode[place[unknown]]; k >= 0 && !passed[k];)
    {
      passed[k] = 1;
      const int n_columns = super[k + 1] - super[k];
      k = pi[k] + n_columns < pi[k + 1] ? supernode[s[pi[k] + n_columns]] : -1;
    }
  std::vector<int> path;
  for (int k = 0; k < n_supernodes; ++k)
    if (passed[k])
      path.push_back(k);
  return path;
}


double CholmodFactor::entries(const std::vector<int> &supernodes) const
{
  const int *const super = static_cast<int *>(factor->super), *const pi =
                                                                static_cast<int *>(factor->pi);
  double sum = 0.;
  for (const int k : supernodes)
    sum += static_cast<double>(super[k + 1] - super[k]) * (pi[k + 1] - pi[k]);
  return sum;
}


void CholmodFactor::forward(const std::vector<int> &supernodes, double *const x) const
{
  const int *const super = static_cast<int *>(factor->super),
                   *const pi = static_cast<int *>(factor->pi),
                   *const px = static_cast<int *>(factor->px),
                   *const s = static_cast<int *>(factor->s);
  const double *const values = static_cast<double *>(factor->x);
  const char lower = 'L', as_is = 'N';
  const int step = 1;
  const double one = 1., zero = 0.;
  std::vector<double> below(factor->maxesize);
  for (const int k : supernodes)
  {
    const int n_columns = super[k + 1] - super[k], n_rows = pi[k + 1] - pi[k],
              n_below = n_rows - n_columns;
    const double *const block = values + px[k];
    double *const here = x + super[k];
    dtrsv_(&lower, &as_is, &as_is, &n_columns, block, &n_rows, here, &step);
    if (n_below == 0)
      continue;
    dealii::gemv(&as_is, &n_below, &n_columns, &one, block + n_columns, &n_rows, here, &step, &zero,
                 below.data(), &step);
    const int *const rows = s + pi[k] + n_columns;
    for (int i = 0; i < n_below; ++i)
      x[rows[i]] -= below[i];
  }
}


void CholmodFactor::backward(const std::vector<int> &supernodes, double *const x) const
{
  const int *const super = static_cast<int *>(factor->super),
                   *const pi = static_cast<int *>(factor->pi),
                   *const px = static_cast<int *>(factor->px),
                   *const s = static_cast<int *>(factor->s);
  const double *const values = static_cast<double *>(factor->x);
  const char lower = 'L', as_is = 'N', transposed = 'T';
  const int step = 1;
  const double one = 1., minus_one = -1.;
  std::vector<double> below(factor->maxesize);
  for (auto k = supernodes.rbegin(); k != supernodes.rend(); ++k)
  {
    const int n_columns = super[*k + 1] - super[*k], n_rows = pi[*k + 1] - pi[*k],
              n_below = n_rows - n_columns;
    const double *const block = values + px[*k];
    double *const here = x + super[*k];
    const int *const rows = s + pi[*k] + n_columns;
    for (int i = 0; i < n_below; ++i)
      below[i] = x[rows[i]];
    if (n_below > 0)
      dealii::gemv(&transposed, &n_below, &n_columns, &minus_one, block + n_columns, &n_rows,
                   below.data(), &step, &one, here, &step);
    dtrsv_(&lower, &transposed, &as_is, &n_columns, block, &n_rows, here, &step);
  }
}
} // namespace stockwork
