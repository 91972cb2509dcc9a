// Extra unknowns shared out among the ranks: who has what, and what is exchanged.
#include <deal.II/base/mpi.h>

#include <doctest/doctest.h>

#include "solvers/extra_layout.h"

namespace stockwork::extra_layout_test
{
using namespace dealii;

/// Each rank wants every third unknown, beginning with its own number.
IndexSet wanted(const unsigned int n)
{
  IndexSet result(n);
  for (unsigned int i = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD); i < n; i += 3)
    result.add_index(i);
  return result;
}

TEST_CASE("what is wanted is seen, and sums are the same on all who see them")
{
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  for (const unsigned int n : {1u, 2u, 11u})
    for (const bool share_out : {true, false})
    {
      const ExtraLayout layout = share_out ? ExtraLayout::shared_out(n, wanted(n), MPI_COMM_WORLD)
                                           : ExtraLayout::everywhere(n, MPI_COMM_WORLD);
      CHECK(layout.size() == n);
      CHECK(Utilities::MPI::sum(layout.n_owned(), MPI_COMM_WORLD) == n);
      CHECK(layout.owned().n_elements() == layout.n_owned());
      for (const auto i : wanted(n))
        CHECK(layout.number(layout.place(i)) == i);

      // How many see each one: a one from each of them.
      std::vector<double> seen(layout.n_seen(), 1.), all_seen(n, 0.);
      for (unsigned int place = 0; place < layout.n_seen(); ++place)
        all_seen[layout.number(place)] += 1.;
      Utilities::MPI::sum(all_seen, MPI_COMM_WORLD, all_seen);
      layout.combine(seen);
      for (unsigned int place = 0; place < layout.n_seen(); ++place)
        CHECK(seen[place] == all_seen[layout.number(place)]);
      if (share_out && n == 11 && n_ranks == 2)
        CHECK(layout.n_seen() < n);

      // The owner's word counts.
      std::vector<double> values(layout.n_seen(), -1.);
      for (unsigned int place = 0; place < layout.n_owned(); ++place)
        values[place] = 10. * layout.number(place);
      layout.update(values);
      for (unsigned int place = 0; place < layout.n_seen(); ++place)
        CHECK(values[place] == 10. * layout.number(place));

      std::vector<double> all = layout.to_all(values);
      for (unsigned int i = 0; i < n; ++i)
        CHECK(all[i] == 10. * i);
      all = layout.to_root(values);
      for (unsigned int i = 0; i < all.size(); ++i)
        CHECK(all[i] == 10. * i);
      for (double &value : all)
        value += 1.;
      layout.from_root(all, values);
      for (unsigned int place = 0; place < layout.n_seen(); ++place)
        CHECK(values[place] == 10. * layout.number(place) + 1.);

      // The least of the ranks that see one, as for the host of a column.
      std::vector<double> hosts(layout.n_seen(), 1e9), least(n, 1e9);
      const double me = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      for (const auto i : wanted(n))
        hosts[layout.place(i)] = least[i] = me;
      layout.combine(hosts, VectorOperation::min);
      Utilities::MPI::min(least, MPI_COMM_WORLD, least);
      for (unsigned int place = 0; place < layout.n_seen(); ++place)
        CHECK(hosts[place] == least[layout.number(place)]);
      for (double &host : hosts)
        host = -host;
      layout.combine(hosts, VectorOperation::max);
      for (unsigned int place = 0; place < layout.n_seen(); ++place)
        CHECK(hosts[place] == -least[layout.number(place)]);
    }
}
} // namespace stockwork::extra_layout_test
