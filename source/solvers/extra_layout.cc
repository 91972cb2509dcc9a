#include "solvers/extra_layout.h"

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <utility>

#include "stockwork/base/all_gather.h"

namespace stockwork
{
using dealii::VectorOperation;

ExtraLayout::ExtraLayout(std::vector<int> starts, const MPI_Comm communicator)
  : communicator(communicator)
  , me(dealii::Utilities::MPI::this_mpi_process(communicator))
  , starts(std::move(starts))
{
}


ExtraLayout ExtraLayout::everywhere(const unsigned int n, const MPI_Comm communicator)
{
  std::vector<int> starts(dealii::Utilities::MPI::n_mpi_processes(communicator) + 1, n);
  starts[0] = 0;
  return ExtraLayout(std::move(starts), communicator);
}


ExtraLayout ExtraLayout::shared_out(const unsigned int n,
                                    const dealii::IndexSet &wanted,
                                    const MPI_Comm communicator)
{
  const std::size_t n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  if (n_ranks == 1)
    return everywhere(n, communicator);
  std::vector<int> starts;
  for (std::size_t rank = 0; rank <= n_ranks; ++rank)
    starts.push_back(static_cast<int>(n * rank / n_ranks));
  ExtraLayout layout(std::move(starts), communicator);
  layout.see_all = false;
  layout.partitioner = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
    layout.owned(), wanted, communicator);
  return layout;
}


dealii::IndexSet ExtraLayout::owned() const
{
  dealii::IndexSet result(size());
  result.add_range(starts[me], starts[me + 1]);
  return result;
}


unsigned int ExtraLayout::owner(const unsigned int number) const
{
  return std::upper_bound(starts.begin(), starts.end(), static_cast<int>(number)) - starts.begin() -
         1;
}


void ExtraLayout::update(std::vector<double> &values) const
{
  if (see_all)
  {
    MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, 0, communicator);
    return;
  }
  dealii::LinearAlgebra::distributed::Vector<double> vector(partitioner);
  std::copy_n(values.begin(), n_owned(), vector.begin());
  vector.update_ghost_values();
  for (unsigned int place = n_owned(); place < values.size(); ++place)
    values[place] = vector.local_element(place);
}


void ExtraLayout::combine(std::vector<double> &values,
                          const VectorOperation::values operation) const
{
  if (see_all)
  {
    const auto all = dealii::make_array_view(values);
    const dealii::ArrayView<const double> mine(all);
    using namespace dealii::Utilities::MPI;
    switch (operation)
    {
    case VectorOperation::min:
      min(mine, communicator, all);
      break;
    case VectorOperation::max:
      max(mine, communicator, all);
      break;
    default:
      sum(mine, communicator, all);
    }
    return;
  }
  dealii::LinearAlgebra::distributed::Vector<double> vector(partitioner);
  for (unsigned int place = 0; place < values.size(); ++place)
    vector.local_element(place) = values[place];
  vector.compress(operation);
  std::copy_n(vector.begin(), n_owned(), values.begin());
  update(values);
}


std::vector<int> ExtraLayout::counts() const
{
  std::vector<int> result;
  for (std::size_t rank = 0; rank + 1 < starts.size(); ++rank)
    result.push_back(starts[rank + 1] - starts[rank]);
  return result;
}


std::vector<double> ExtraLayout::to_root(const std::vector<double> &values) const
{
  std::vector<double> all(me == 0 ? size() : 0);
  MPI_Gatherv(values.data(), static_cast<int>(n_owned()), MPI_DOUBLE, all.data(), counts().data(),
              starts.data(), MPI_DOUBLE, 0, communicator);
  return all;
}


void ExtraLayout::from_root(const std::vector<double> &all, std::vector<double> &values) const
{
  MPI_Scatterv(all.data(), counts().data(), starts.data(), MPI_DOUBLE, values.data(),
               static_cast<int>(n_owned()), MPI_DOUBLE, 0, communicator);
  update(values);
}


std::vector<double> ExtraLayout::to_all(const std::vector<double> &values) const
{
  if (see_all)
    return values;
  return all_gather(communicator, std::vector<double>(values.begin(), values.begin() + n_owned()));
}
} // namespace stockwork
