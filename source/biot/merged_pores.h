#pragma once

#include <deal.II/distributed/cell_data_transfer.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include "stockwork/mesh/mesh_view.h"
#include "stockwork/rock/rock.h"

#include "biot/cell_integrals.h"

#include <functional>
#include <memory>
#include <vector>

namespace stockwork
{
/// The pores of cells that are merged.
///
/// A merged cell keeps the values at its vertices, and a field that was not linear between its
/// children changes, and with it the fluid content alpha div u + p/M. So cells stay apart where the
/// pore pressure is far from linear, and what content changes elsewhere is given back: the pore
/// pressure at the vertices of such a cell is shifted so that a change of the mesh neither makes
/// fluid nor loses any. The rock follows in the next step.
///
/// Pressures are over in situ.
template <int dim>
class MergedPores
{
public:
  using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;
  using Mesh = dealii::parallel::distributed::Triangulation<dim>;
  using RegionOf = std::function<dealii::types::material_id(
    const typename dealii::Triangulation<dim>::cell_iterator &)>;

  explicit MergedPores(const Rock &rock)
    : rock(rock)
  {
  }

  /// Whether content can be given back: pores and fluid are compressible everywhere. Collective.
  bool can_take_up(const MeshView<dim> &mesh_view) const;

  /// Take back the flags of families whose parent would have another pore pressure in its middle
  /// than they have, by more than a hundredth of the greatest in the rock. Collective.
  /// @param values with ghosts
  void keep_uneven(Mesh &mesh, const MeshView<dim> &mesh_view, const BlockVector &values) const;

  /// Before the mesh changes. @param values with ghosts
  void prepare(const Mesh &mesh, const MeshView<dim> &mesh_view, const BlockVector &values);

  /// On the new mesh: shift the pressures. Hanging nodes are the caller's to follow up.
  /// @param region_of_parent of a cell that has been split, where its rock may be another
  /// @param carried_over with ghosts: in cells that were not merged, what they had
  /// @param conforming the same with ghosts, where hanging nodes have followed
  /// @param values the owned ones of these, to be shifted
  void finish(const MeshView<dim> &mesh_view,
              const BlockVector &carried_over,
              const BlockVector &conforming,
              BlockVector &values,
              const RegionOf &region_of_parent);

private:
  /// Fluid in the pores of a cell in rock of this region, over in situ [m^3 (/m)].
  double content(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                 dealii::types::material_id region,
                 const CellIntegrals<dim> &integrals,
                 const BlockVector &values) const;

  const Rock &rock;
  std::vector<double> before; ///< content() of the old mesh's cells
  std::unique_ptr<dealii::parallel::distributed::CellDataTransfer<dim, dim, std::vector<double>>>
    transfer;
};
} // namespace stockwork
