#include "solvers/cholesky.h"

#include "solvers/cholmod_factor.h"

#include <algorithm>

namespace stockwork
{
Cholesky::Cholesky()
  : factor(std::make_unique<CholmodFactor>())
{
}

Cholesky::~Cholesky() = default;

void Cholesky::analyse(const int n, std::vector<int> rows, std::vector<int> columns)
{
  factor->analyse(n, rows, columns);
}

void Cholesky::factorise(std::vector<double> &values)
{
  factor->factorise(values);
}

void Cholesky::solve(std::vector<double> &x, const int n_right_hand_sides)
{
  factor->solve(x.data(), n_right_hand_sides);
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
  return factor->size();
}
} // namespace stockwork
