#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "solvers/dense_solver.h"
#include "solvers/system_operator.h"

namespace stockwork
{
/// The Schur complement of the extra unknowns,
///
///   [ A  B ]
///   [ C  D ],   S = D - C A^-1 B,
///
/// dense, on every rank. Of C A^-1 B only the rows and columns of new extra unknowns are computed;
/// an unknown is known by the contents of its row and column, each up to a factor, so renumbering
/// costs nothing, nor does a bond whose tangent stiffness changes, and S follows a growing fracture
/// and Newton's iterations at the price of a dense factorisation of what changes.
class ExtraSchur
{
public:
  /// Entries of one row or column of the border: global index in the bulk and value, on every rank.
  using SparseVector = std::vector<std::pair<int, double>>;
  using SparseVectors = std::vector<const SparseVector *>;

  /// left_i . A^-1 right_j of all pairs, on every rank, [j * left.size() + i].
  using Multiply =
    std::function<std::vector<double>(const SparseVectors &left, const SparseVectors &right)>;

  ExtraSchur(MPI_Comm communicator, Multiply multiply);

  /// A is another one.
  void forget();

  /// Compute what is new of the Schur complement of a border and factorise. Borders are taken
  /// between A's unknowns below `end`, scaled if a scaling is given. Where A is not symmetric,
  /// products of new rows with all columns are asked for: whoever solves then keeps the solutions.
  /// Throws SolveError when S is singular. Collective.
  void update(const SystemOperator &op,
              const SystemOperator::Border &border,
              dealii::types::global_dof_index end,
              bool symmetric_bulk,
              const dealii::TrilinosWrappers::MPI::BlockVector *scaling = nullptr);

  /// The first half of update(): the products.
  void update_border(const SystemOperator &op,
                     const SystemOperator::Border &border,
                     dealii::types::global_dof_index end,
                     bool symmetric_bulk,
                     const dealii::TrilinosWrappers::MPI::BlockVector *scaling = nullptr);

  /// C A^-1 B of the border of the last update, times a factor.
  dealii::FullMatrix<double> product(double factor = 1.) const;

  /// Factorise S = D - C A^-1 B with that border, the same on every rank. Throws SolveError when S
  /// is singular.
  void factorise(dealii::FullMatrix<double> s);

  /// x <- S^-1 x
  void solve(std::vector<double> &x) const;

  /// Of each extra unknown of the last update its column of B, as one that products have been asked
  /// for times a factor. Null: it has none.
  std::vector<std::pair<const SparseVector *, double>> columns() const;

  /// SolveError with the usual causes.
  [[noreturn]] static void throw_singular();

private:
  /// The border of one extra unknown.
  struct Border
  {
    SparseVector column; ///< of B
    SparseVector row;    ///< of C
    bool empty() const
    {
      return column.empty() && row.empty();
    }
  };

  /// Where the border of an extra unknown is found: it is a known one times these factors.
  struct Known
  {
    unsigned int place; ///< unsigned -1: it has none
    double column, row; ///< factors
    bool operator==(const Known &other) const
    {
      return place == other.place && column == other.column && row == other.row;
    }
  };

  std::vector<Border> gather_borders(const SystemOperator &,
                                     const SystemOperator::Border &,
                                     dealii::types::global_dof_index end,
                                     const dealii::TrilinosWrappers::MPI::BlockVector *) const;

  /// Find each border among the known ones, computing what is new.
  void update_products(const std::vector<Border> &borders, bool symmetric_bulk);

  /// Drop known borders that are no longer in use.
  void forget_unused();

  MPI_Comm communicator;
  Multiply multiply;

  std::vector<Border> known;
  std::vector<std::vector<double>> products; ///< [i][j] = row_i A^-1 column_j of known borders
  std::vector<Known> found;                  ///< of each extra unknown

  DenseSolver schur;
  std::vector<SystemOperator::Entry> corner_of_factor; ///< D
  std::vector<Known> found_for_factor;
  bool has_factor = false;
};
} // namespace stockwork
