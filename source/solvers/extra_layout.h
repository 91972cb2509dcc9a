#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/lac/vector_operation.h>

#include <memory>
#include <vector>

namespace stockwork
{
/// Where the values of the extra unknowns are. A rank *owns* a range of their numbers and *sees*
/// these and some more; a vector of them has a value for each that the rank sees, the owned ones
/// first.
class ExtraLayout
{
public:
  /// None.
  ExtraLayout() = default;

  /// Rank 0 owns all of them, all ranks see all: for solvers with a dense block of them.
  static ExtraLayout everywhere(unsigned int n, MPI_Comm communicator);

  /// Owned in even ranges, seen where they are owned or wanted. Collective.
  static ExtraLayout
  shared_out(unsigned int n, const dealii::IndexSet &wanted, MPI_Comm communicator);

  /// Of all ranks.
  unsigned int size() const
  {
    return starts.back();
  }

  unsigned int n_owned() const
  {
    return starts[me + 1] - starts[me];
  }

  unsigned int n_seen() const
  {
    return see_all ? size() : partitioner->locally_owned_size() + partitioner->n_ghost_indices();
  }

  /// Number of the unknown at a place of a vector.
  unsigned int number(const unsigned int place) const
  {
    return see_all ? place : static_cast<unsigned int>(partitioner->local_to_global(place));
  }

  /// Place of an unknown that this rank sees.
  unsigned int place(const unsigned int number) const
  {
    return see_all ? number : partitioner->global_to_local(number);
  }

  /// Rank that owns it.
  unsigned int owner(unsigned int number) const;

  bool are_seen_everywhere() const
  {
    return see_all;
  }

  dealii::IndexSet owned() const;

  /// The owners' values to all who see them. Collective.
  void update(std::vector<double> &values) const;

  /// The sum (minimum, maximum) of the values of all who see an unknown to all of them. Collective.
  void combine(std::vector<double> &values,
               dealii::VectorOperation::values operation = dealii::VectorOperation::add) const;

  /// All values, by number, on rank 0, and back. Collective.
  std::vector<double> to_root(const std::vector<double> &values) const;
  void from_root(const std::vector<double> &all, std::vector<double> &values) const;

  /// All values, by number, on every rank. Collective.
  std::vector<double> to_all(const std::vector<double> &values) const;

private:
  ExtraLayout(std::vector<int> starts, MPI_Comm communicator);

  /// How many each rank owns.
  std::vector<int> counts() const;

  MPI_Comm communicator = MPI_COMM_SELF;
  unsigned int me = 0;
  std::vector<int> starts = {0, 0}; ///< of the ranks' ranges, and the end
  bool see_all = true;
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner; ///< unless they do
};
} // namespace stockwork
