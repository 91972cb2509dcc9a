#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include "stockwork/base/all_gather.h"

#include <type_traits>
#include <vector>

namespace stockwork
{
/// The only communication a fracture model may do. All calls are collective.
class Collectives
{
public:
  explicit Collectives(const MPI_Comm communicator)
    : communicator(communicator)
  {
  }

  double sum(const double value) const
  {
    return dealii::Utilities::MPI::sum(value, communicator);
  }

  void sum(std::vector<double> &values) const
  {
    dealii::Utilities::MPI::sum(values, communicator, values);
  }

  double max(const double value) const
  {
    return dealii::Utilities::MPI::max(value, communicator);
  }

  double min(const double value) const
  {
    return dealii::Utilities::MPI::min(value, communicator);
  }

  unsigned int rank() const
  {
    return dealii::Utilities::MPI::this_mpi_process(communicator);
  }

  /// Everyone's objects, in the order of the ranks. T needs boost serialization, unless its bytes
  /// are all that it is.
  template <class T>
  std::vector<T> gather(const std::vector<T> &mine) const
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return mine;
    if constexpr (std::is_trivially_copyable<T>::value)
      return all_gather(communicator, mine);
    else
    {
      std::vector<std::size_t> ends;
      const std::vector<char> bytes =
        all_gather(communicator, dealii::Utilities::pack(mine, false), &ends);
      std::vector<T> all;
      auto begin = bytes.begin();
      for (const std::size_t end : ends)
      {
        const auto part =
          dealii::Utilities::unpack<std::vector<T>>(begin, bytes.begin() + end, false);
        all.insert(all.end(), part.begin(), part.end());
        begin = bytes.begin() + end;
      }
      return all;
    }
  }

private:
  MPI_Comm communicator;
};
} // namespace stockwork
