#pragma once

#include "solvers/system_operator.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

class Epetra_CrsMatrix;

namespace stockwork
{
/// C K^-1 B, sparse: the stiffness matrix K of the rock is inverted on a patch around each column
/// of B alone, its unknowns and their neighbours, beyond which nothing moves (theory, section 6).
/// So it has the null vectors of the true product, which a kernel of unbounded rock has not; it
/// errs with long waves, for which a patch is too stiff.
///
/// Columns that share their unknowns, such as the jump's components in a cell, share a patch. What
/// has been solved is found again by the contents of its columns, so a growing fracture asks for
/// its new cells only.
class StiffnessPatches
{
public:
  explicit StiffnessPatches(MPI_Comm communicator);

  /// K is another one.
  void forget();

  /// C K_patch^-1 B: this rank's shares of its entries, and a layout in which it sees their rows
  /// and columns.
  struct Product
  {
    std::vector<SystemOperator::Entry> entries; ///< by row; each is the sum over the ranks
    ExtraLayout layout;
  };

  /// Collective.
  Product product(const SystemOperator &op, const Epetra_CrsMatrix &K);

  /// Patches of this rank.
  std::size_t size() const
  {
    return known.size();
  }

private:
  /// Columns of B with entries in the same rows.
  struct Group
  {
    std::vector<int> rows;
    std::vector<unsigned int> columns; ///< numbers of extra unknowns
    std::vector<double> values;        ///< by column
    std::uint64_t key;                 ///< of rows and values
  };

  /// K_patch^-1 B of a group, where it counts: a preconditioner needs no more than that, in single
  /// precision.
  struct Solution
  {
    std::vector<int> rows;
    std::vector<float> values; ///< by column
  };

  class Rows;
  struct Workspace;

  std::vector<Group> find_groups(const SystemOperator &) const;

  /// Unknowns of a group's patch.
  static std::vector<int> unknowns_of_patch(const Group &, const Rows &);

  static Solution solve(const Group &, const std::vector<int> &patch, const Rows &, Workspace &);

  /// diag(K)^-1 B of a group.
  static Solution by_diagonal(const Group &, const Rows &);

  void solve_new(const std::vector<Group> &, const Epetra_CrsMatrix &K);

  void forget_unused(const std::vector<Group> &);

  MPI_Comm communicator;
  std::unordered_map<std::uint64_t, Solution> known; ///< by Group::key
};
} // namespace stockwork
