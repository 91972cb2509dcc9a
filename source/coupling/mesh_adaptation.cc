#include "coupling/mesh_adaptation.h"

#include "stockwork/base/error.h"

#include "mesh/partition.h"
#include "mesh/refinement.h"

#include <deal.II/distributed/solution_transfer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace stockwork
{
using namespace dealii;

template <int dim>
MeshAdaptation<dim>::MeshAdaptation(RunContext &run,
                                    const Geometry<dim> &geometry,
                                    const Rock &rock,
                                    parallel::distributed::Triangulation<dim> &triangulation,
                                    const FractureModel<dim> &model)
  : run(run)
  , geometry(geometry)
  , triangulation(triangulation)
  , model(model)
  , max_cells(geometry.maximum_number_of_cells())
  , pores(rock)
{
}


template <int dim>
std::vector<float> MeshAdaptation<dim>::wanted_sizes() const
{
  std::vector<float> wanted(triangulation.n_active_cells(), std::numeric_limits<float>::infinity());
  model.wanted_cell_size(triangulation, wanted);
  return wanted;
}


template <int dim>
bool MeshAdaptation<dim>::flag(const bool merge)
{
  std::vector<float> wanted = wanted_sizes();
  if (Utilities::MPI::min(wanted == settled ? 1 : 0, triangulation.get_communicator()) == 1)
    return false;
  settled.clear();
  const bool changes = flag_cells(triangulation, geometry, wanted);
  if (!changes)
    settled = std::move(wanted);
  else if (merge)
    flag_cells(triangulation, geometry, wanted, {}, true);
  return changes;
}


template <int dim>
bool MeshAdaptation<dim>::may_merge(const CoupledSystem<dim> &system,
                                    const Stepper<dim> &stepper) const
{
  return model.requirements().lets_cells_merge && system.nonlinear_rock() == nullptr &&
         system.nodal_fields() == nullptr && stepper.starts_from_last_state() &&
         (!system.mesh_view().has_pore_pressure || pores_can_take_up(system, stepper));
}


template <int dim>
bool MeshAdaptation<dim>::pores_can_take_up(const CoupledSystem<dim> &system,
                                            const Stepper<dim> &stepper) const
{
  const MeshView<dim> mesh_view = system.mesh_view();
  return mesh_view.has_pore_pressure && stepper.starts_from_last_state() &&
         pores.can_take_up(mesh_view);
}


template <int dim>
void MeshAdaptation<dim>::refine_initial_mesh(const unsigned int degree)
{
  refuse_tiny_cells();
  while (flag(false))
  {
    refuse_too_many_cells(triangulation, max_cells,
                          "unless the fracture model's wanted cell size is a mistake");
    triangulation.execute_coarsening_and_refinement();
  }
  share_out(triangulation, degree);
  settled.clear(); // cells may be others' now
}


template <int dim>
void MeshAdaptation<dim>::refuse_tiny_cells() const
{
  const std::vector<float> wanted = wanted_sizes();
  // At least a row of small cells crosses each large one that is to be split; one in four of them
  // may be touched at a corner only.
  double n_cells = 0.;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const double ratio = cell_size(cell) / wanted[cell->active_cell_index()]; ratio > 1.)
        n_cells += 0.25 * std::pow(ratio, dim - 1);
  n_cells = Utilities::MPI::sum(n_cells, triangulation.get_communicator());
  if (n_cells > max_cells)
  {
    std::ostringstream text;
    text << "at least " << n_cells
         << ", the cells that the fracture model wants along its cracks, unless their wanted size "
            "is a mistake";
    throw EntryError("Mesh/Maximum number of cells", std::to_string(max_cells), text.str());
  }
}


template <int dim>
void MeshAdaptation<dim>::change(CoupledSystem<dim> &system,
                                 Stepper<dim> &stepper,
                                 const bool merges,
                                 const std::function<void()> &change_mesh)
{
  const bool changes_pores =
    (merges || geometry.has_region_boxes()) && pores_can_take_up(system, stepper);
  const auto vectors = stepper.bulk_vectors();
  const ExtraNumbering numbering = system.extra_numbering();

  // One transfer for all vectors; it reads ghosted ones and fills owned ones.
  std::vector<TrilinosWrappers::MPI::BlockVector> before(vectors.size());
  std::vector<const TrilinosWrappers::MPI::BlockVector *> sources;
  for (unsigned int i = 0; i < vectors.size(); ++i)
  {
    before[i] = system.ghosted_vector();
    before[i] = *vectors[i];
    sources.push_back(&before[i]);
  }
  parallel::distributed::SolutionTransfer<dim, TrilinosWrappers::MPI::BlockVector> transfer(
    system.bulk_dofs());
  transfer.prepare_for_coarsening_and_refinement(sources);
  NonlinearRock<dim> *const rock = system.nonlinear_rock();
  if (rock != nullptr)
    rock->history().prepare_for_refinement(triangulation);
  if (NodalFields<dim> *const fields = system.nodal_fields())
    fields->prepare_for_refinement();
  if (changes_pores)
    pores.prepare(triangulation, system.mesh_view(), *vectors[0]);
  change_mesh();
  if (rock != nullptr)
    rock->history().finish_refinement(triangulation);
  if (triangulation.n_global_active_cells() > max_cells)
    throw SolveError("The mesh has grown to more than " + std::to_string(max_cells) +
                     " cells ('Mesh/Maximum number of cells').");
  system.setup_mesh(stepper.last_context().time);

  std::vector<TrilinosWrappers::MPI::BlockVector> after(vectors.size(), system.owned_vector());
  std::vector<TrilinosWrappers::MPI::BlockVector *> targets;
  for (auto &vector : after)
    targets.push_back(&vector);
  transfer.interpolate(targets);
  for (unsigned int i = 0; i < vectors.size(); ++i)
  {
    // The first is the last state, from which the next step's content is counted.
    const bool gives_back = changes_pores && i == 0;
    TrilinosWrappers::MPI::BlockVector carried_over;
    if (gives_back)
    {
      carried_over = system.ghosted_vector();
      carried_over = after[i];
    }
    system.make_conforming(after[i]);
    *vectors[i] = system.ghosted_vector();
    *vectors[i] = after[i];
    if (gives_back)
    {
      pores.finish(system.mesh_view(), carried_over, *vectors[i], after[i],
                   [this](const auto &parent) { return geometry.region(parent); });
      system.make_conforming(after[i]);
      *vectors[i] = after[i];
    }
  }
  system.adopt_extra(numbering, stepper.extra_vectors());
}


template <int dim>
std::vector<double> MeshAdaptation<dim>::region_volumes() const
{
  std::vector<double> volumes(Rock::max_regions + 1);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      volumes[cell->material_id()] += cell->measure();
  Utilities::MPI::sum(volumes, triangulation.get_communicator(), volumes);
  return volumes;
}


template <int dim>
void MeshAdaptation<dim>::warn_of_regions(const std::vector<double> &before,
                                          const double time,
                                          const bool pores_keep)
{
  const std::vector<double> now = region_volumes();
  double differing = 0., all = 0.;
  for (unsigned int region = 0; region < now.size(); ++region)
  {
    differing += 0.5 * std::abs(now[region] - before[region]);
    all += now[region];
  }
  if (differing <= 1e-9 * all)
    return;
  warned_of_regions = true;
  std::ostringstream text;
  text << "Cells across the edge of a region were split or merged at t = " << time << " s, and "
       << differing << (dim == 2 ? " m^2" : " m^3")
       << " of rock are in another region than before: a cell belongs to the box of 'Mesh/Region "
          "boxes' that holds its centre. "
       << (pores_keep ? "" : "What its pores hold has changed with it. ")
       << "Put the edges of boxes on lines of the mesh.";
  run.warn(text.str());
}


template <int dim>
std::pair<unsigned int, unsigned int> MeshAdaptation<dim>::flagged() const
{
  unsigned int n_split = 0, n_merged = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      n_split += cell->refine_flag_set();
      n_merged += cell->coarsen_flag_set();
    }
  return {Utilities::MPI::sum(n_split, run.communicator),
          Utilities::MPI::sum(n_merged, run.communicator)};
}


template <int dim>
bool MeshAdaptation<dim>::adapt(CoupledSystem<dim> &system, Stepper<dim> &stepper)
{
  bool changed = false, wanted = stepper.wants_setup(), merge = may_merge(system, stepper);
  while (flag(merge) || wanted)
  {
    if (merge && system.mesh_view().has_pore_pressure)
    {
      keep_at_wells(system);
      pores.keep_uneven(triangulation, system.mesh_view(), stepper.committed.bulk);
    }
    triangulation.prepare_coarsening_and_refinement();
    const auto [n_to_split, n_to_merge] = flagged();
    const double n_before = triangulation.n_global_active_cells();
    const bool looks_at_regions = geometry.has_region_boxes() && !warned_of_regions;
    const std::vector<double> volumes = looks_at_regions ? region_volumes() : std::vector<double>();
    change(system, stepper, n_to_merge > 0,
           [this]() { triangulation.execute_coarsening_and_refinement(); });
    if (looks_at_regions)
      warn_of_regions(volumes, stepper.last_context().time,
                      !system.mesh_view().has_pore_pressure || pores_can_take_up(system, stepper));
    // Flagged cells stay where neighbours would be two levels smaller.
    const double n_children = GeometryInfo<dim>::max_children_per_cell,
                 n_merged = n_to_split -
                            (triangulation.n_global_active_cells() - n_before) / (n_children - 1.);
    if (n_to_merge > 0 && n_merged > 0.)
      run.out << "  " << n_children * n_merged
              << " small cells away from the front and the cracks are merged" << std::endl;
    changed = true;
    wanted = merge = false; // in every pass, cells could be split and merged by turns
  }
  if (changed)
    balance(system, stepper);
  return changed;
}


template <int dim>
void MeshAdaptation<dim>::keep_at_wells(const CoupledSystem<dim> &system)
{
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->coarsen_flag_set() &&
        system.wells_reach(cell->parent()->center(), cell->parent()->diameter()))
      cell->clear_coarsen_flag();
}


template <int dim>
bool MeshAdaptation<dim>::divides_families() const
{
  bool divided = false;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->level() > 0)
    {
      const auto siblings = cell->parent()->child_iterators();
      const bool is_whole = std::all_of(siblings.begin(), siblings.end(),
                                        [](const auto &one) { return one->is_active(); });
      divided |= is_whole && std::any_of(siblings.begin(), siblings.end(),
                                         [&cell](const auto &one)
                                         { return one->subdomain_id() != cell->subdomain_id(); });
    }
  return Utilities::MPI::max(divided ? 1 : 0, triangulation.get_communicator()) == 1;
}


template <int dim>
void MeshAdaptation<dim>::balance(CoupledSystem<dim> &system, Stepper<dim> &stepper)
{
  const auto work = [this, &system]()
  {
    // A crack's patch of rock and its cut cell cost about what an element does in the solves
    // between two changes of the mesh.
    const auto of_one = static_cast<unsigned int>(
      std::lround(100. * system.n_free_unknowns() /
                  std::max(1u, triangulation.n_locally_owned_active_cells())));
    std::vector<unsigned int> of_cells(triangulation.n_active_cells(), std::max(1u, of_one));
    for (const auto &cell : system.bulk_dofs().active_cell_iterators())
      if (cell->is_locally_owned() && model.role(cell).cut != nullptr)
        of_cells[cell->active_cell_index()] *= 2;
    return of_cells;
  };
  // Below, a new mesh on all ranks costs more than is gained.
  constexpr double tolerated = 1.1;
  const double before = greatest_share(triangulation, work());
  if (before * run.n_ranks < tolerated &&
      !(model.requirements().lets_cells_merge && divides_families()))
    return;
  change(system, stepper, false, [&]() { share_out(triangulation, work()); });
  settled.clear(); // cells may be others' now
  run.out << "  cells shared out anew: the rank with most had " << 100. * before
          << " % of the work, now it has " << 100. * greatest_share(triangulation, work()) << " %"
          << std::endl;
}


template class MeshAdaptation<2>;
template class MeshAdaptation<3>;
} // namespace stockwork
