#pragma once

#include <deal.II/distributed/tria.h>

#include "coupling/stepper.h"
#include "mesh/geometry.h"

namespace stockwork
{
/// Makes cells as small as the fracture model wants them, where and when it does, and moves all
/// unknowns along. The mesh never changes inside a step.
template <int dim>
class MeshAdaptation
{
public:
  MeshAdaptation(const Geometry<dim> &geometry,
                 dealii::parallel::distributed::Triangulation<dim> &triangulation,
                 const FractureModel<dim> &model);

  /// Before the first step, when there are no unknowns to move yet.
  /// @throws EntryError if that makes too many cells
  void refine_initial_mesh();

  /// The same, and make the system ready.
  void prepare(CoupledSystem<dim> &system, double time);

  /// Between steps. Returns whether the mesh has changed.
  bool adapt(CoupledSystem<dim> &system, Stepper<dim> &stepper);

private:
  /// Set flags; is there anything to do?
  bool flag();

  /// Before any cell is made: a size that is a slip of the pen.
  void refuse_tiny_cells() const;

  const Geometry<dim> &geometry;
  dealii::parallel::distributed::Triangulation<dim> &triangulation;
  const FractureModel<dim> &model;
  unsigned int max_cells;
  std::vector<float> settled; ///< wanted sizes that the mesh as it is fulfils; empty: not known
};
} // namespace stockwork
