#include "mesh/refinement.h"

#include "stockwork/base/error.h"

namespace stockwork
{
namespace
{
/// A family beside finer cells waits until these have been merged, even if they are to be in the
/// same change: on another rank it could not be known, and cells would hang on the ranks.
template <int dim>
void keep_beside_finer(dealii::parallel::distributed::Triangulation<dim> &triangulation)
{
  std::vector<int> levels(triangulation.n_vertices());
  for (const auto &cell : triangulation.active_cell_iterators())
    if (!cell->is_artificial())
      for (const unsigned int v : cell->vertex_indices())
        levels[cell->vertex_index(v)] = std::max(levels[cell->vertex_index(v)], cell->level());
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->coarsen_flag_set())
      for (const unsigned int v : cell->vertex_indices())
        if (levels[cell->vertex_index(v)] > cell->level())
          cell->clear_coarsen_flag();
}
} // namespace


template <int dim>
bool flag_cells(dealii::parallel::distributed::Triangulation<dim> &triangulation,
                const Geometry<dim> &geometry,
                const std::vector<float> &wanted_size,
                const std::vector<bool> &holds_fracture,
                const bool coarsen)
{
  AssertDimension(wanted_size.size(), triangulation.n_active_cells());
  const auto held = [&holds_fracture](const auto &cell)
  { return !holds_fracture.empty() && holds_fracture[cell->active_cell_index()]; };
  const auto in_one_region = [](const auto &parent)
  {
    for (unsigned int c = 1; c < parent->n_children(); ++c)
      if (parent->child(c)->material_id() != parent->child(0)->material_id())
        return false;
    return true;
  };

  for (const auto &cell : triangulation.active_cell_iterators())
  {
    cell->clear_refine_flag();
    cell->clear_coarsen_flag();
    if (!cell->is_locally_owned() || held(cell))
      continue;
    // The wish is a float: do not split for its round-off.
    const double size = cell_size(cell), wanted = wanted_size[cell->active_cell_index()];
    if (size > wanted * (1. + 1e-5))
      cell->set_refine_flag();
    // A factor of two beyond what the merged cell needs, so that a wish that moves does not
    // split and merge by turns.
    else if (coarsen && 4. * size <= wanted * (1. + 1e-5) && cell->level() > 0 &&
             !geometry.splits(cell->parent()) && in_one_region(cell->parent()))
      cell->set_coarsen_flag();
  }
  if (coarsen)
    keep_beside_finer(triangulation);
  triangulation.prepare_coarsening_and_refinement();

  // 0: nothing changes, 1: something does, 2: a cell with a fracture would.
  unsigned int change = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && (cell->refine_flag_set() || cell->coarsen_flag_set()))
      change = std::max(change, held(cell) ? 2u : 1u);
  change = dealii::Utilities::MPI::max(change, triangulation.get_communicator());
  if (change == 2)
    throw SolveError("A cell that holds a fracture would have to be split, because cells beside it "
                     "are wanted more than twice as small. Ask for the small cells where the "
                     "fracture is, from the start, or nowhere near it.");
  return change == 1;
}

template <int dim>
void refuse_too_many_cells(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                           const unsigned int most,
                           const std::string &unless)
{
  // P4EST_QMAXLEVEL, P8EST_QMAXLEVEL
  constexpr unsigned int deepest = dim == 2 ? 29 : 18;
  double n_new = 0.;
  bool too_deep = false;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->refine_flag_set())
    {
      n_new += dealii::GeometryInfo<dim>::max_children_per_cell - 1.;
      too_deep = too_deep || static_cast<unsigned int>(cell->level()) >= deepest;
    }
  const auto communicator = triangulation.get_communicator();
  n_new = dealii::Utilities::MPI::sum(n_new, communicator);
  if (triangulation.n_global_active_cells() + n_new > most)
    throw EntryError("Mesh/Maximum number of cells", std::to_string(most), "more, " + unless);
  if (dealii::Utilities::MPI::max(too_deep ? 1 : 0, communicator) == 1)
    throw EntryError("Mesh/Maximum number of cells", std::to_string(most),
                     "a mesh whose cells are halved up to " + std::to_string(deepest) +
                       " times; this one asks for more. Start from smaller cells, " + unless);
}

template void refuse_too_many_cells<2>(const dealii::parallel::distributed::Triangulation<2> &,
                                       unsigned int,
                                       const std::string &);
template void refuse_too_many_cells<3>(const dealii::parallel::distributed::Triangulation<3> &,
                                       unsigned int,
                                       const std::string &);

template bool flag_cells<2>(dealii::parallel::distributed::Triangulation<2> &,
                            const Geometry<2> &,
                            const std::vector<float> &,
                            const std::vector<bool> &,
                            bool);
template bool flag_cells<3>(dealii::parallel::distributed::Triangulation<3> &,
                            const Geometry<3> &,
                            const std::vector<float> &,
                            const std::vector<bool> &,
                            bool);
} // namespace stockwork
