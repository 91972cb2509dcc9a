#pragma once

#include <cholmod.h>

#include <string>
#include <vector>

namespace stockwork
{
/// A symmetric positive definite matrix and its factor by CHOLMOD (Chen, Davis, Hager and
/// Rajamanickam, ACM Trans. Math. Softw. 35, 2008), on this rank alone.
class CholmodFactor
{
public:
  CholmodFactor();
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor &) = delete;
  CholmodFactor &operator=(const CholmodFactor &) = delete;

  /// Order a pattern of n > 0 unknowns: one triangle, either one for each entry, each entry once;
  /// indices count from one.
  /// @param last unknowns of which this is 1 come after those of which it is 0; empty: as it suits
  void analyse(int n,
               const std::vector<int> &rows,
               const std::vector<int> &columns,
               const std::vector<int> &last = {});

  /// The values in the order of the indices. Throws SolveError.
  void factorise(std::vector<double> &values);

  /// Solve in place for several right-hand sides, one after another.
  /// @param system CHOLMOD_A: with the matrix; CHOLMOD_L, CHOLMOD_Lt: with L of L L^T = P A P^T or
  /// its transpose, unknowns in the order of the factor
  void solve(double *x, std::size_t n_columns, int system = CHOLMOD_A);

  /// The place of each unknown in the order of the factor.
  std::vector<int> places_in_factor() const;

  /// The supernodes of L, which are blocks of columns of one pattern, ascending.
  std::vector<int> all_supernodes() const;

  /// Those that hold these unknowns, and all that lie on their way to the root of the elimination
  /// tree: where L^-1 b is not zero if b is on these unknowns alone, and all that L^-T asks for
  /// their values (Gilbert & Peierls 1988).
  std::vector<int> path_to_root(const std::vector<int> &unknowns) const;

  /// How many numbers these supernodes hold.
  double entries(const std::vector<int> &supernodes) const;

  /// x <- L^-1 x, x in the order of the factor, zero outside of these supernodes.
  void forward(const std::vector<int> &supernodes, double *x) const;

  /// x <- L^-T x on these supernodes.
  void backward(const std::vector<int> &supernodes, double *x) const;

  /// Call use(first, last) for the columns of these supernodes.
  template <class Function>
  void for_each_range(const std::vector<int> &supernodes, const Function &use) const
  {
    const int *const super = static_cast<int *>(factor->super);
    for (const int k : supernodes)
      use(super[k], super[k + 1]);
  }

  /// Call use(row, column, value) for each entry of L, in the order of the factor.
  template <class Function>
  void for_each_entry(const Function &use) const
  {
    const int *const super = static_cast<int *>(factor->super),
                     *const pi = static_cast<int *>(factor->pi),
                     *const px = static_cast<int *>(factor->px),
                     *const s = static_cast<int *>(factor->s);
    const double *const x = static_cast<double *>(factor->x);
    for (std::size_t k = 0; k < factor->nsuper; ++k)
      for (int column = super[k]; column < super[k + 1]; ++column)
        for (int i = column - super[k]; i < pi[k + 1] - pi[k]; ++i)
          use(s[pi[k] + i], column, x[px[k] + (column - super[k]) * (pi[k + 1] - pi[k]) + i]);
  }

  int size() const
  {
    return static_cast<int>(matrix->nrow);
  }

  /// Cut the graph of a pattern, as given to analyse(), in two (METIS): 0 and 1 for unknowns that
  /// are not coupled to one another, 2 for the few between them; nothing: it cannot be done.
  static std::vector<int>
  bisect(int n, const std::vector<int> &rows, const std::vector<int> &columns);

private:
  /// By column of the upper triangle, which is by row of the lower one.
  static cholmod_sparse *upper_triangle(int n,
                                        const std::vector<int> &rows,
                                        const std::vector<int> &columns,
                                        std::vector<int> &places,
                                        cholmod_common &common);

  void free();
  [[noreturn]] void fail(const std::string &doing) const;

  cholmod_common common{};
  cholmod_sparse *matrix = nullptr; ///< pattern by column of what lies above the diagonal
  cholmod_factor *factor = nullptr;
  cholmod_dense *work_1 = nullptr, *work_2 = nullptr;
  std::vector<int> places; ///< in the matrix, of the values given; empty: they come in its order
};
} // namespace stockwork
