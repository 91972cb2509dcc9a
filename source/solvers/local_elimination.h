#pragma once

#include "solvers/linear_system.h"

#include <utility>
#include <vector>

namespace stockwork
{
/// A linear system without those mechanical extra unknowns that are tied to the bulk and to few
/// others, as bonds that soften are: none of them to another one, and what one of them is tied to
/// in the bulk is tied together there already. They are eliminated one by one, exactly, so the
/// pattern of the bulk stays as it is, however many there are and whichever. Of an elastic bulk.
class LocalElimination
{
public:
  /// Collective.
  LocalElimination(const LinearSystem &system, MPI_Comm communicator);

  /// Whether the pattern of the bulk has room for what they add to it. Else nothing here is of use.
  bool fits() const
  {
    return fits_pattern;
  }

  const LinearSystem &reduced() const
  {
    return system_without;
  }

  /// All extra unknowns, from a solution of the reduced system. Collective.
  std::vector<double> recover(const dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                              const std::vector<double> &dx_left) const;

private:
  using Entries = std::vector<std::pair<dealii::types::global_dof_index, double>>;

  /// One that is eliminated: its column and row, of all ranks, and its diagonal entry.
  struct Unknown
  {
    unsigned int number;
    Entries bulk_column, bulk_row, extra_column, extra_row; ///< by numbers that are left
    double pivot = 0., residual = 0.;
  };

  /// Choose them, and number what is left.
  void choose(const LinearSystem &system);

  /// Their columns and rows; all other triplets go to the reduced system.
  void sort_out(const LinearSystem &system);

  /// Add to the bulk what they add to it.
  void reduce_bulk();

  MPI_Comm communicator;
  LinearSystem system_without;
  std::vector<Unknown> unknowns;
  std::vector<unsigned int> place; ///< of each extra unknown among those, or among what is left
  std::vector<bool> is_eliminated;
  unsigned int n_left = 0;
  bool fits_pattern = true;
};
} // namespace stockwork
