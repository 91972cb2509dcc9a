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


class Cholesky::Local : public LocalInverse
{
public:
  using Vector = dealii::Vector<double>;

  Local(const CholmodFactor &factor, const std::vector<int> &unknowns)
    : factor(factor)
    , all(factor.all_supernodes())
    , path(factor.path_to_root(unknowns))
    , places(factor.places_in_factor())
    , work(factor.size())
  {
    for (const int unknown : unknowns)
      few.push_back(places[unknown]);
  }

  std::vector<double> forward(const double *const b) const override
  {
    std::vector<double> half(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      half[places[i]] = b[i];
    factor.forward(all, half.data());
    return half;
  }

  void backward(std::vector<double> half, double *const x) const override
  {
    factor.backward(all, half.data());
    for (std::size_t i = 0; i < places.size(); ++i)
      x[i] = half[places[i]];
  }

  void add_forward(const Vector &y, std::vector<double> &half) const override
  {
    forward_few(y);
    factor.for_each_range(path,
                          [&](const int first, const int last)
                          {
                            for (int i = first; i < last; ++i)
                              half[i] += work[i];
                          });
  }

  void backward_to_few(const std::vector<double> &half, Vector &x) const override
  {
    factor.for_each_range(path,
                          [&](const int first, const int last) {
                            std::copy(&half[first], &half[first] + (last - first), &work[first]);
                          });
    backward_few(x);
  }

  void vmult(Vector &x, const Vector &y) const override
  {
    forward_few(y);
    backward_few(x);
  }

  double cost() const override
  {
    return factor.entries(path) / factor.entries(all);
  }

private:
  void forward_few(const Vector &y) const
  {
    factor.for_each_range(path, [&](const int first, const int last)
                          { std::fill(&work[first], &work[first] + (last - first), 0.); });
    for (std::size_t i = 0; i < few.size(); ++i)
      work[few[i]] += y(i);
    factor.forward(path, work.data());
  }

  void backward_few(Vector &x) const
  {
    factor.backward(path, work.data());
    for (std::size_t i = 0; i < few.size(); ++i)
      x(i) = work[few[i]];
  }

  const CholmodFactor &factor;
  const std::vector<int> all, path, places;
  std::vector<int> few; ///< places of the few unknowns
  mutable std::vector<double> work;
};

std::unique_ptr<LocalInverse> Cholesky::local_inverse(const std::vector<int> &unknowns) const
{
  return std::make_unique<Local>(*factor, unknowns);
}
} // namespace stockwork
