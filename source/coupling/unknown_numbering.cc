#include "coupling/unknown_numbering.h"

#include "biot/opening_control.h"
#include "coupling/row_numbering.h"
#include "coupling/visible_constraints.h"

#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace stockwork
{
using namespace dealii;

namespace
{
template <int dim>
FESystem<dim> make_element(const ElementSettings &elements)
{
  const FE_Q<dim> displacement(elements.displacement_degree), pressure(1);
  if (elements.has_pore_pressure)
    return FESystem<dim>(displacement, dim, pressure, 1);
  return FESystem<dim>(displacement, dim);
}
} // namespace


template <int dim>
UnknownNumbering<dim>::UnknownNumbering(parallel::distributed::Triangulation<dim> &triangulation,
                                        const Mapping<dim> &mapping,
                                        const BoundaryConditions<dim> &boundary_conditions,
                                        FractureModel<dim> &model,
                                        Network<dim> &network,
                                        const ElementSettings &elements)
  : communication(triangulation.get_communicator())
  , mapping(mapping)
  , elements(elements)
  , triangulation(triangulation)
  , boundary_conditions(boundary_conditions)
  , model(model)
  , network(network)
  , fe(make_element<dim>(elements))
  , handler(triangulation)
{
}


template <int dim>
void UnknownNumbering<dim>::number_bulk(const double time)
{
  // Cells come along a space-filling curve, so the numbering is local as it is; and the components
  // of a node stay together, which the multigrid smoother wants. Explicit steps read and write what
  // belongs to a row of the lattice one after the other.
  handler.distribute_dofs(fe);
  if (elements.numbered_along_rows)
    number_along_rows(handler);
  std::vector<unsigned int> block_of_component(fe.n_components(), 0);
  if (elements.has_pore_pressure)
    block_of_component[dim] = 1;
  DoFRenumbering::component_wise(handler, block_of_component);

  const auto dofs_per_block = DoFTools::count_dofs_per_fe_block(handler, block_of_component);
  DoFTools::extract_locally_relevant_dofs(handler, visible);
  own = handler.locally_owned_dofs().split_by_block(dofs_per_block);

  boundary_conditions.constrain(time, mapping, handler, with_values, of_increments);
  if (NodalFields<dim> *const fields = model.nodal_fields())
    fields->follow_mesh(triangulation);
  model.setup(mesh_view(), communication);

  // What the model couples across ranks it sees as well.
  std::vector<types::global_dof_index> coupled;
  if (const KeptTerms *kept = model.kept_terms())
    kept->add_couplings([&](const std::vector<types::global_dof_index> &dofs)
                        { coupled.insert(coupled.end(), dofs.begin(), dofs.end()); });
  std::sort(coupled.begin(), coupled.end());
  coupled.erase(std::unique(coupled.begin(), coupled.end()), coupled.end());
  visible.add_indices(coupled.begin(), coupled.end());
  seen = visible.split_by_block(dofs_per_block);
  if (communication.max(coupled.empty() ? 0. : 1.) > 0.)
    make_visible(of_increments, handler.locally_owned_dofs(), visible,
                 triangulation.get_communicator());

  owned_zero.reinit(own, triangulation.get_communicator());
  ghosted_zero.reinit(own, seen, triangulation.get_communicator());
  ghosts.reinit(owned_zero, ghosted_zero);
  find_lines();
}


template <int dim>
void UnknownNumbering<dim>::find_lines()
{
  lines.clear();
  std::vector<types::global_dof_index> offsets{0};
  for (const IndexSet &set : own)
    offsets.push_back(offsets.back() + set.size());
  const auto block_of = [&](const types::global_dof_index i)
  { return std::upper_bound(offsets.begin(), offsets.end(), i) - offsets.begin() - 1; };
  bool visible_here = true;
  for (const auto &line : with_values.get_lines())
  {
    const unsigned int b = block_of(line.index);
    const auto &owned_map = owned_zero.block(b).trilinos_vector().Map(),
               &ghosted_map = ghosted_zero.block(b).trilinos_vector().Map();
    const auto local = [&](const auto &map, const types::global_dof_index i)
    { return map.LID(static_cast<TrilinosWrappers::types::int_type>(i - offsets[b])); };
    const int place = local(owned_map, line.index);
    if (place < 0)
      continue;
    lines.push_back({line.index, b, place, {}});
    for (const auto &[master, weight] : line.entries)
    {
      const int there =
        static_cast<unsigned int>(block_of(master)) == b ? local(ghosted_map, master) : -1;
      visible_here = visible_here && there >= 0;
      lines.back().masters.emplace_back(there, weight);
    }
  }
  masters_are_visible = communication.min(visible_here ? 1. : 0.) == 1.;
}


template <int dim>
void UnknownNumbering<dim>::constrain(BlockVector &owned, BlockVector &ghosted) const
{
  if (masters_are_visible)
  {
    ghosts.update(ghosted, owned);
    for (const Line &line : lines)
    {
      const double *const values = ghosted.block(line.block).trilinos_vector()[0];
      double sum = with_values.get_inhomogeneity(line.index);
      for (const auto &[master, weight] : line.masters)
        sum += weight * values[master];
      owned.block(line.block).trilinos_vector()[0][line.place] = sum;
    }
  }
  else
    with_values.distribute(owned);
  ghosts.update(ghosted, owned);
}


template <int dim>
void UnknownNumbering<dim>::couple(BlockDynamicSparsityPattern &pattern) const
{
  DoFTools::make_sparsity_pattern(handler, pattern, of_increments, false);
  if (const KeptTerms *kept = model.kept_terms())
    kept->add_couplings(
      [&](std::vector<types::global_dof_index> dofs)
      {
        // A bond may lead back to its own node, across a plane of symmetry.
        std::sort(dofs.begin(), dofs.end());
        dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
        of_increments.add_entries_local_to_global(dofs, pattern, false);
      });
  SparsityTools::distribute_sparsity_pattern(pattern, handler.locally_owned_dofs(),
                                             triangulation.get_communicator(), visible);
}


template <int dim>
void UnknownNumbering<dim>::constrain(const double time)
{
  if (boundary_conditions.constant_in_time())
    return;
  AffineConstraints<double> unused;
  boundary_conditions.constrain(time, mapping, handler, with_values, unused);
}


template <int dim>
void UnknownNumbering<dim>::adopt_extra(const ExtraNumbering &from,
                                        const std::vector<std::vector<double> *> &values)
{
  std::vector<ExtraUnknown> unknowns = model.extra_unknowns();
  if (boundary_conditions.controlled_load())
    unknowns.push_back({OpeningControl<dim>::key});
  n_mechanical = unknowns.size();
  const std::vector<double> &earlier = *values.front();
  network.set_segments(model.segments(), communication,
                       [&](const std::uint64_t key)
                       {
                         const auto i = from.find(key);
                         return i ? std::optional<double>(earlier[*i]) : std::nullopt;
                       });
  network.set_offset(n_mechanical);
  const std::vector<ExtraUnknown> pressures = network.unknowns();
  unknowns.insert(unknowns.end(), pressures.begin(), pressures.end());

  ExtraNumbering now(std::move(unknowns));
  for (std::vector<double> *vector : values)
    if (vector->size() == from.size()) // a quasi-static run has no reference of acceleration
      *vector = now.transfer(from, *vector);
  extra_numbering = std::move(now);
}


template class UnknownNumbering<2>;
template class UnknownNumbering<3>;
} // namespace stockwork
