#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

#include "solvers/dense_factor.h"

namespace stockwork
{
/// Solves dense systems one after another, most of whose matrix stays as it is: of the Schur
/// complement of a growing fracture, only what belongs to its tips and its fluid changes from one
/// iteration to the next. Unknowns between which all entries have stayed the same are eliminated
/// with a factor that is kept,
///
///   [F C; R D],  F = L U kept,  D - R F^-1 C factorised anew.
class DenseSolver
{
public:
  /// An unknown that has no place in later matrices, or whose place there is not known.
  static constexpr unsigned int anonymous = -1;

  /// @param identities of the unknowns, by which those of an earlier matrix are found again
  /// @throws SolveError when the matrix is singular; nothing is kept then
  void factorise(dealii::FullMatrix<double>, const std::vector<unsigned int> &identities);

  /// x := A^-1 x
  void solve(dealii::Vector<double> &x) const;

  /// Nothing that was kept is valid any more.
  void forget();

  /// So many unknowns of the present matrix are eliminated with the factor that is kept.
  unsigned int n_kept() const
  {
    return kept.size();
  }

private:
  /// Whether the kept unknowns are all there, with the same matrix between them; fills `kept`.
  bool find_kept(const dealii::FullMatrix<double> &, const std::vector<unsigned int> &identities);

  /// Keep what has not changed since the last matrix.
  void choose_kept(const dealii::FullMatrix<double> &, const std::vector<unsigned int> &identities);

  /// Fill `eliminated`. Returns whether it has become another.
  bool eliminate(const dealii::FullMatrix<double> &);

  // Kept.
  std::vector<unsigned int> kept_identities;
  dealii::FullMatrix<double> kept_matrix; ///< F
  DenseFactor kept_factor;
  unsigned int rest_when_chosen = 0;
  bool has_chosen = false;    ///< what to keep, and does not wait
  unsigned int n_used = 0;    ///< matrices for which it has been of use
  unsigned int waits = 0;     ///< so many to come without
  unsigned int waits_for = 1; ///< the next time that it is of no use

  // The last matrix: what has changed since is not kept.
  dealii::FullMatrix<double> last_matrix;
  std::vector<unsigned int> last_identities;

  // Of the present matrix.
  std::vector<unsigned int> kept, rest;         ///< indices
  dealii::FullMatrix<double> rows;              ///< R
  dealii::FullMatrix<double> eliminated;        ///< F^-1 C, transposed
  dealii::FullMatrix<double> eliminated_by_row; ///< F^-1 C
  DenseFactor rest_factor;

  dealii::FullMatrix<double> full_rows;    ///< those of R that are full,
  dealii::FullMatrix<double> full_product; ///< times F^-1 C

  dealii::FullMatrix<double> columns; ///< C, transposed, for which `eliminated` has been computed
};
} // namespace stockwork
