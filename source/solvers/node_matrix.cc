#include "solvers/node_matrix.h"

#include <Epetra_Comm.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_MultiVector.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace stockwork
{
namespace
{
/// Smooth the part of the spectrum above the largest eigenvalue over this.
constexpr double smoothing_range = 10.;

/// Inverse of a small block by Gauss-Jordan; positive definite, so no pivoting.
template <int dim>
void invert(const float *block, float *inverse)
{
  double a[dim][2 * dim] = {};
  for (int i = 0; i < dim; ++i)
  {
    for (int j = 0; j < dim; ++j)
      a[i][j] = block[i * dim + j];
    a[i][dim + i] = 1.;
  }
  for (int k = 0; k < dim; ++k)
  {
    const double pivot = a[k][k] != 0. ? 1. / a[k][k] : 1.;
    for (int j = 0; j < 2 * dim; ++j)
      a[k][j] *= pivot;
    for (int i = 0; i < dim; ++i)
      if (i != k)
      {
        const double factor = a[i][k];
        for (int j = 0; j < 2 * dim; ++j)
          a[i][j] -= factor * a[k][j];
      }
  }
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      inverse[i * dim + j] = a[i][dim + j];
}
} // namespace


template <int dim>
NodeMatrix<dim>::NodeMatrix(const Epetra_CrsMatrix &matrix)
{
  const int n_rows = matrix.NumMyRows();
  const int n_nodes = n_rows / dim;

  // Nodes of the local columns: owned ones keep their place, others are numbered behind.
  std::vector<unsigned int> node_of_column(matrix.NumMyCols());
  std::map<long long, unsigned int> ghost_nodes;
  const auto &rows = matrix.RowMap();
  for (int j = 0; j < matrix.NumMyCols(); ++j)
  {
    const long long global = matrix.GCID64(j);
    const int local = rows.LID(global);
    if (local >= 0)
      node_of_column[j] = local / dim;
    else
      node_of_column[j] =
        ghost_nodes.emplace(global / dim, n_nodes + ghost_nodes.size()).first->second;
  }
  std::vector<int> component(matrix.NumMyCols());
  for (int j = 0; j < matrix.NumMyCols(); ++j)
    component[j] = matrix.GCID64(j) % dim;

  if (matrix.Importer() != nullptr)
  {
    std::vector<int> globals(dim * (n_nodes + ghost_nodes.size()));
    for (int i = 0; i < n_rows; ++i)
      globals[i] = static_cast<int>(rows.GID64(i));
    for (const auto &[node, place] : ghost_nodes)
      for (int d = 0; d < dim; ++d)
        globals[place * dim + d] = static_cast<int>(node * dim + d);
    owned_map = std::make_unique<Epetra_Map>(-1, n_rows, globals.data(), 0, matrix.Comm());
    ghosted_map = std::make_unique<Epetra_Map>(-1, static_cast<int>(globals.size()), globals.data(),
                                               0, matrix.Comm());
    import = std::make_unique<Epetra_Import>(*ghosted_map, *owned_map);
    ghosted.resize(globals.size());
  }
  direction.resize(n_rows);
  defect.resize(n_rows);

  const std::size_t n_blocks = matrix.NumMyNonzeros() / (dim * dim) * 11 / 10 + n_nodes;
  row_starts.reserve(n_nodes + 1);
  columns.reserve(n_blocks);
  values.reserve(n_blocks * dim * dim);
  inverse_diagonal.resize(n_nodes * dim * dim);
  constexpr std::size_t nowhere = -1;
  std::vector<std::size_t> block_of_node(n_nodes + ghost_nodes.size(), nowhere);
  for (int node = 0; node < n_nodes; ++node)
  {
    const std::size_t begin = columns.size();
    row_starts.push_back(begin);
    for (int d = 0; d < dim; ++d)
    {
      int n_entries;
      double *entries;
      int *indices;
      matrix.ExtractMyRowView(node * dim + d, n_entries, entries, indices);
      for (int k = 0; k < n_entries; ++k)
      {
        std::size_t &block = block_of_node[node_of_column[indices[k]]];
        if (block == nowhere)
        {
          block = columns.size();
          columns.push_back(node_of_column[indices[k]]);
          values.resize(values.size() + dim * dim, 0.f);
        }
        values[block * dim * dim + d * dim + component[indices[k]]] =
          static_cast<float>(entries[k]);
      }
    }
    invert<dim>(&values[block_of_node[node] * dim * dim], &inverse_diagonal[node * dim * dim]);
    for (std::size_t b = begin; b < columns.size(); ++b)
      block_of_node[columns[b]] = nowhere;
  }
  row_starts.push_back(columns.size());
  estimate_eigenvalue();
}


template <int dim>
NodeMatrix<dim>::~NodeMatrix() = default;


template <int dim>
const double *NodeMatrix<dim>::with_ghosts(const double *x) const
{
  if (!import)
    return x;
  const Epetra_MultiVector source(View, *owned_map, const_cast<double *>(x), 0, 1);
  Epetra_MultiVector target(View, *ghosted_map, ghosted.data(), 0, 1);
  target.Import(source, *import, Insert);
  return ghosted.data();
}


template <int dim>
void NodeMatrix<dim>::residual(double *r, const double *b, const double *x) const
{
  const double *y = with_ghosts(x);
  const unsigned int n = n_nodes();
  for (unsigned int node = 0; node < n; ++node)
  {
    double sum[dim] = {};
    for (std::size_t k = row_starts[node]; k < row_starts[node + 1]; ++k)
    {
      const float *a = &values[k * dim * dim];
      const double *yk = y + std::size_t(dim) * columns[k];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          sum[i] += a[i * dim + j] * yk[j];
    }
    for (int i = 0; i < dim; ++i)
      r[node * dim + i] = b[node * dim + i] - sum[i];
  }
}


template <int dim>
void NodeMatrix<dim>::smooth(double *x,
                             const double *b,
                             const unsigned int degree,
                             const bool zero_start) const
{
  const unsigned int n = n_nodes();
  const double high = 1.1 * eigenvalue, low = high / smoothing_range;
  const double theta = 0.5 * (high + low), delta = 0.5 * (high - low), sigma = theta / delta;

  // direction = old_factor direction + new_factor D^-1 r;  x += direction
  const auto update =
    [&](const double *r, const double old_factor, const double new_factor, const bool first)
  {
    for (unsigned int node = 0; node < n; ++node)
    {
      const float *inverse = &inverse_diagonal[node * dim * dim];
      for (int i = 0; i < dim; ++i)
      {
        double z = 0.;
        for (int j = 0; j < dim; ++j)
          z += inverse[i * dim + j] * r[node * dim + j];
        double &d = direction[node * dim + i];
        d = (old_factor == 0. ? 0. : old_factor * d) + new_factor * z;
        x[node * dim + i] = (first ? 0. : x[node * dim + i]) + d;
      }
    }
  };

  if (zero_start)
    update(b, 0., 1. / theta, true);
  else
  {
    residual(defect.data(), b, x);
    update(defect.data(), 0., 1. / theta, false);
  }
  double rho = 1. / sigma;
  for (unsigned int k = 1; k < degree; ++k)
  {
    const double next = 1. / (2. * sigma - rho);
    residual(defect.data(), b, x);
    update(defect.data(), next * rho, 2. * next / delta, false);
    rho = next;
  }
}


template <int dim>
void NodeMatrix<dim>::estimate_eigenvalue()
{
  // Power iteration from a rough vector, the same for any number of ranks up to numbering.
  const unsigned int n = direction.size();
  std::vector<double> x(n), r(n), zero(n, 0.);
  for (unsigned int i = 0; i < n; ++i)
    x[i] = std::sin(1.7 * i) + (i % 2 == 0 ? 0.5 : -0.5);
  const auto norm = [&](const std::vector<double> &v)
  {
    double mine = 0., all = 0.;
    for (const double value : v)
      mine += value * value;
    all = mine;
    if (owned_map)
      owned_map->Comm().SumAll(&mine, &all, 1);
    return std::sqrt(all);
  };
  constexpr unsigned int n_iterations = 12;
  for (unsigned int k = 0; k < n_iterations; ++k)
  {
    const double size = norm(x);
    for (double &value : x)
      value /= size;
    residual(r.data(), zero.data(), x.data());
    for (unsigned int node = 0; node < n_nodes(); ++node)
      for (int i = 0; i < dim; ++i)
      {
        double z = 0.;
        for (int j = 0; j < dim; ++j)
          z -= inverse_diagonal[(node * dim + i) * dim + j] * r[node * dim + j];
        x[node * dim + i] = z;
      }
  }
  eigenvalue = norm(x);
}


template <int dim>
double NodeMatrix<dim>::memory_consumption() const
{
  return row_starts.size() * sizeof(std::size_t) + columns.size() * sizeof(unsigned int) +
         (values.size() + inverse_diagonal.size()) * sizeof(float);
}

template class NodeMatrix<2>;
template class NodeMatrix<3>;
} // namespace stockwork
