#pragma once

#include <deal.II/base/quadrature.h>
#include <deal.II/distributed/cell_data_transfer.h>
#include <deal.II/distributed/tria.h>

#include "stockwork/exchange/cell_role.h"

#include <memory>
#include <vector>

namespace stockwork
{
/// What the rock remembers at points of cells: so many numbers each, zero until they are set. Cells
/// of which nothing is remembered take no room.
///
/// The points are kept with the numbers, so a cell may ask with others than it was given: those of
/// an ordinary cell that a crack comes to cut, of a child that asks its parent, of a parent its
/// children. The answer is that of the nearest point and no mean, for a mean of two states on a
/// yield surface lies off it. Where a crack passes, it is that of the nearest on the same side.
template <int dim>
class PointHistory
{
public:
  /// @param points of ordinary cells, in unit coordinates
  PointHistory(const unsigned int n_values, const std::vector<dealii::Point<dim>> &points);

  /// As many cells as the mesh has; all is forgotten.
  void reinit(unsigned int n_active_cells);

  bool has(const unsigned int cell) const
  {
    return !records[cell].empty();
  }

  /// The numbers at the nearest point; null where nothing is remembered of the cell.
  /// @param cut how a crack cuts the cell now: the nearest point on its own side, and the nearest
  /// of all where nothing is remembered on that side. Null: it does not.
  const double *
  nearest(unsigned int cell, const dealii::Point<dim> &unit_point, const CutCell<dim> *cut) const;

  /// @param values n_values for each point, one point after another
  void set(unsigned int cell,
           const std::vector<dealii::Point<dim>> &unit_points,
           const std::vector<double> &values);

  /// That the owned cells' records take.
  std::size_t bytes() const;

  unsigned int n_values() const
  {
    return n;
  }

  /// Move with a mesh that is about to change / has changed. Collective.
  void prepare_for_refinement(const dealii::parallel::distributed::Triangulation<dim> &);
  void finish_refinement(const dealii::parallel::distributed::Triangulation<dim> &);

  /// Into the checkpoint that is about to be written of a mesh, and after that / out of the mesh
  /// that has been loaded. Collective.
  void prepare_for_save(const dealii::parallel::distributed::Triangulation<dim> &);
  void finish_save();
  void load(const dealii::parallel::distributed::Triangulation<dim> &);

private:
  /// Point after point: its unit coordinates, then its numbers.
  using Record = std::vector<double>;
  using Records = std::vector<Record>;
  using Transfer = dealii::parallel::distributed::CellDataTransfer<dim, dim, Records>;

  std::unique_ptr<Transfer>
  make_transfer(const dealii::parallel::distributed::Triangulation<dim> &) const;

  /// The record of a cell as its child or its parent sees it.
  std::vector<Record> of_children(const Record &parent, unsigned int n_children) const;
  Record of_parent(const std::vector<Record> &children) const;

  unsigned int n;
  std::vector<dealii::Point<dim>> ordinary_points;
  Records records; ///< by active cell index
  std::unique_ptr<Transfer> transfer;
};
} // namespace stockwork
