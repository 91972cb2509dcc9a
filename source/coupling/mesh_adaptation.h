#pragma once

#include <deal.II/distributed/tria.h>

#include <functional>
#include <utility>
#include <vector>

#include "biot/merged_pores.h"
#include "coupling/stepper.h"
#include "mesh/geometry.h"

namespace stockwork
{
/// Makes cells as small as the fracture model wants them, where and when it does, merges them again
/// where it does no more, and moves all unknowns along. The mesh never changes inside a step.
template <int dim>
class MeshAdaptation
{
public:
  MeshAdaptation(RunContext &run,
                 const Geometry<dim> &geometry,
                 const Rock &rock,
                 dealii::parallel::distributed::Triangulation<dim> &triangulation,
                 const FractureModel<dim> &model);

  /// Before the first step, when there are no unknowns to move yet.
  /// @param degree of the elements, so that ranks get as many unknowns
  /// @throws EntryError if that makes too many cells
  void refine_initial_mesh(unsigned int degree);

  /// Between steps. Returns whether the mesh has changed. Cells are merged only when others are
  /// split: another mesh costs more than a few cells too many. Where ranks are then out of balance,
  /// it shares the cells out anew and prints the share of the fullest before and after.
  bool adapt(CoupledSystem<dim> &system, Stepper<dim> &stepper);

private:
  /// What the model wants, by active cell index [m].
  std::vector<float> wanted_sizes() const;

  /// Set flags of cells to be split; is there anything to do? If so and asked to, flag cells that
  /// nothing wants small to be merged.
  bool flag(bool merge);

  /// Whether cells may be merged: the model lets them, and nothing but values of the unknowns is
  /// kept in them. Of plastic rock and of waves more is.
  bool may_merge(const CoupledSystem<dim> &system, const Stepper<dim> &stepper) const;

  /// Take back the flags of families that a well in the rock gives fluid to: its source is no
  /// larger than their cells need, and it may rest, so that their pore pressure does not show it.
  void keep_at_wells(const CoupledSystem<dim> &system);

  /// Whether the pores' content can be given back to them when cells change.
  bool pores_can_take_up(const CoupledSystem<dim> &system, const Stepper<dim> &stepper) const;

  /// Of all ranks' rock, by region [m^3 (/m)].
  std::vector<double> region_volumes() const;

  /// A cell's region is that of its centre, so that rock changes where the edge of a region passes
  /// through cells.
  /// @param pores_keep their content, or have none
  void warn_of_regions(const std::vector<double> &before, double time, bool pores_keep);

  /// Cells that are flagged to be split and to be merged, of all ranks.
  std::pair<unsigned int, unsigned int> flagged() const;

  /// Change the mesh, and carry all unknowns over.
  /// @param merges cells, which may have pores
  void change(CoupledSystem<dim> &system,
              Stepper<dim> &stepper,
              bool merges,
              const std::function<void()> &change_mesh);

  /// Whether all of a cell's children are active and several ranks', which could not merge them:
  /// answers would hang on the number of ranks. p4est keeps such families together when it shares
  /// cells out, but one may become whole since, when a child's children are merged. Collective.
  bool divides_families() const;

  void balance(CoupledSystem<dim> &system, Stepper<dim> &stepper);

  /// Before any cell is made: a size that is a slip of the pen.
  void refuse_tiny_cells() const;

  RunContext &run;
  const Geometry<dim> &geometry;
  dealii::parallel::distributed::Triangulation<dim> &triangulation;
  const FractureModel<dim> &model;
  unsigned int max_cells;
  MergedPores<dim> pores;
  bool warned_of_regions = false;
  std::vector<float> settled; ///< wanted sizes that the mesh as it is fulfils; empty: not known
};
} // namespace stockwork
