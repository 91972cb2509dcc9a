#include "coupling/mesh_adaptation.h"

#include "stockwork/base/error.h"

#include "mesh/partition.h"
#include "mesh/refinement.h"

#include <deal.II/distributed/solution_transfer.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace stockwork
{
using namespace dealii;

template <int dim>
MeshAdaptation<dim>::MeshAdaptation(RunContext &run,
                                    const Geometry<dim> &geometry,
                                    parallel::distributed::Triangulation<dim> &triangulation,
                                    const FractureModel<dim> &model)
  : run(run)
  , geometry(geometry)
  , triangulation(triangulation)
  , model(model)
  , max_cells(geometry.maximum_number_of_cells())
{
}


template <int dim>
bool MeshAdaptation<dim>::flag()
{
  std::vector<float> wanted(triangulation.n_active_cells(), std::numeric_limits<float>::infinity());
  model.wanted_cell_size(triangulation, wanted);
  if (Utilities::MPI::min(wanted == settled ? 1 : 0, triangulation.get_communicator()) == 1)
    return false;
  settled.clear();
  const bool changes = flag_cells(triangulation, geometry, wanted);
  if (!changes)
    settled = std::move(wanted);
  return changes;
}


template <int dim>
void MeshAdaptation<dim>::refine_initial_mesh()
{
  refuse_tiny_cells();
  bool changed = false;
  while (flag())
  {
    changed = true;
    refuse_too_many_cells(triangulation, max_cells,
                          "unless the fracture model's wanted cell size is a mistake");
    triangulation.execute_coarsening_and_refinement();
  }
  if (!changed)
    return; // as Geometry::create() has shared the cells out
  share_out(triangulation);
  settled.clear(); // cells may be others' now
}


template <int dim>
void MeshAdaptation<dim>::refuse_tiny_cells() const
{
  std::vector<float> wanted(triangulation.n_active_cells(), std::numeric_limits<float>::infinity());
  model.wanted_cell_size(triangulation, wanted);
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
void MeshAdaptation<dim>::prepare(CoupledSystem<dim> &system, const double time)
{
  refine_initial_mesh();
  system.setup_mesh(time);
}


template <int dim>
void MeshAdaptation<dim>::change(CoupledSystem<dim> &system,
                                 Stepper<dim> &stepper,
                                 const std::function<void()> &change_mesh)
{
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
    system.make_conforming(after[i]);
    *vectors[i] = system.ghosted_vector();
    *vectors[i] = after[i];
  }
  system.adopt_extra(numbering, stepper.extra_vectors());
}


template <int dim>
bool MeshAdaptation<dim>::adapt(CoupledSystem<dim> &system, Stepper<dim> &stepper)
{
  bool changed = false, wanted = stepper.wants_setup();
  while (flag() || wanted)
  {
    changed = true;
    wanted = false;
    triangulation.prepare_coarsening_and_refinement();
    change(system, stepper, [this]() { triangulation.execute_coarsening_and_refinement(); });
  }
  if (changed)
    balance(system, stepper);
  return changed;
}


template <int dim>
void MeshAdaptation<dim>::balance(CoupledSystem<dim> &system, Stepper<dim> &stepper)
{
  const auto work = [this, &system]()
  {
    // A crack's patch of rock and its cut cell cost about what an element does in the solves
    // between two changes of the mesh.
    std::vector<unsigned int> of_cells(triangulation.n_active_cells(), 1);
    for (const auto &cell : system.bulk_dofs().active_cell_iterators())
      if (cell->is_locally_owned() && model.role(cell).cut != nullptr)
        ++of_cells[cell->active_cell_index()];
    return of_cells;
  };
  // Below, a new mesh on all ranks costs more than is gained.
  constexpr double tolerated = 1.1;
  const double before = greatest_share(triangulation, work());
  if (before * run.n_ranks < tolerated)
    return;
  change(system, stepper, [&]() { share_out(triangulation, work()); });
  settled.clear(); // cells may be others' now
  run.out << "  cells shared out anew: the rank with most had " << 100. * before
          << " % of the work, now it has " << 100. * greatest_share(triangulation, work()) << " %"
          << std::endl;
}


template class MeshAdaptation<2>;
template class MeshAdaptation<3>;
} // namespace stockwork
