#pragma once

#include <deal.II/distributed/tria.h>

#include <functional>

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
  MeshAdaptation(RunContext &run,
                 const Geometry<dim> &geometry,
                 dealii::parallel::distributed::Triangulation<dim> &triangulation,
                 const FractureModel<dim> &model);

  /// Before the first step, when there are no unknowns to move yet.
  /// @throws EntryError if that makes too many cells
  void refine_initial_mesh();

  /// The same, and make the system ready.
  void prepare(CoupledSystem<dim> &system, double time);

  /// Between steps. Returns whether the mesh has changed. Where ranks are then out of balance, it
  /// shares the cells out anew and prints the share of the fullest before and after.
  bool adapt(CoupledSystem<dim> &system, Stepper<dim> &stepper);

private:
  /// Set flags; is there anything to do?
  bool flag();

  /// Change the mesh, and carry all unknowns over.
  void change(CoupledSystem<dim> &system,
              Stepper<dim> &stepper,
              const std::function<void()> &change_mesh);

  void balance(CoupledSystem<dim> &system, Stepper<dim> &stepper);

  /// Before any cell is made: a size that is a slip of the pen.
  void refuse_tiny_cells() const;

  RunContext &run;
  const Geometry<dim> &geometry;
  dealii::parallel::distributed::Triangulation<dim> &triangulation;
  const FractureModel<dim> &model;
  unsigned int max_cells;
  std::vector<float> settled; ///< wanted sizes that the mesh as it is fulfils; empty: not known
};
} // namespace stockwork
