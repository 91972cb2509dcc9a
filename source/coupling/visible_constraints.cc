#include "coupling/visible_constraints.h"

#include "stockwork/base/all_gather.h"

namespace stockwork
{
using namespace dealii;

void make_visible(AffineConstraints<double> &constraints,
                  const IndexSet &owned,
                  const IndexSet &visible,
                  const MPI_Comm communicator)
{
  AffineConstraints<double> all(visible);
  std::vector<types::global_dof_index> held;
  for (const auto &line : constraints.get_lines())
  {
    all.add_line(line.index);
    all.add_entries(line.index, line.entries);
    if (owned.is_element(line.index) && line.entries.empty())
      held.push_back(line.index);
  }
  for (const types::global_dof_index dof : all_gather(communicator, held))
    if (visible.is_element(dof))
      all.add_line(dof);
  all.close();
  constraints = std::move(all);
}
} // namespace stockwork
