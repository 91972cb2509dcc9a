#pragma once

#include <deal.II/base/mpi.h>

#include <numeric>
#include <type_traits>
#include <vector>

namespace stockwork
{
/// The arrays of all ranks, one after another. For types that may be copied byte by byte.
///
/// deal.II's function of this name takes any type, for which it archives and compresses what it
/// sends, even on a single rank; in the iterations of a fracture that took most of the time.
/// @param ends if given, receives where the part of each rank ends
template <class T>
std::vector<T> all_gather(const MPI_Comm communicator,
                          const std::vector<T> &mine,
                          std::vector<std::size_t> *ends = nullptr)
{
  static_assert(std::is_trivially_copyable<T>::value, "bytes are all that is sent");
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  if (n_ranks == 1)
  {
    if (ends != nullptr)
      *ends = {mine.size()};
    return mine;
  }
  const int n_bytes = static_cast<int>(mine.size() * sizeof(T));
  std::vector<int> counts(n_ranks), starts(n_ranks, 0);
  MPI_Allgather(&n_bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  std::vector<T> all((starts.back() + counts.back()) / sizeof(T));
  MPI_Allgatherv(mine.data(), n_bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE,
                 communicator);
  if (ends != nullptr)
  {
    ends->clear();
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      ends->push_back((starts[rank] + counts[rank]) / sizeof(T));
  }
  return all;
}
} // namespace stockwork
