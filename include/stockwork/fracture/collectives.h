#pragma once

#include <deal.II/base/mpi.h>

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

  /// Everyone's objects, in the order of the ranks. T needs boost serialization.
  template <class T>
  std::vector<T> gather(const std::vector<T> &mine) const
  {
    std::vector<T> all;
    for (auto &part : dealii::Utilities::MPI::all_gather(communicator, mine))
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

private:
  MPI_Comm communicator;
};
} // namespace stockwork
