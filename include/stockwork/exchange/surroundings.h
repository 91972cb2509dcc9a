#pragma once

#include <deal.II/distributed/tria.h>

#include "stockwork/exchange/scene.h"

#include <memory>
#include <vector>

namespace stockwork
{
/// Places around which cells of one size are wanted (FractureModel::wanted_cell_size()).
template <int dim>
class Surroundings
{
public:
  /// @param reach how far around each place [m]
  Surroundings(const std::vector<dealii::Point<dim>> &places, double reach);

  /// Whether a cell, a ball around its centre, comes closer than the reach to any of them.
  bool include(const dealii::Point<dim> &centre, double radius) const;

private:
  struct Tree;
  std::shared_ptr<const Tree> tree;
  double reach;
};


/// The middles of the blocks of this size [m] in which places lie, each once. What is asked for
/// around them does not change whenever a crack has grown by a cell: another mesh costs all that
/// has been computed with the old one.
template <int dim>
std::vector<dealii::Point<dim>> in_blocks(const std::vector<dealii::Point<dim>> &places,
                                          double block);

/// Ask for cells of a size, where they are larger, in the surroundings of places / as far as
/// @p reach around the cracks of the scene; all [m].
/// @param sizes by active cell index, of owned cells lowered where need be
template <int dim>
void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                       const Surroundings<dim> &surroundings,
                       double size,
                       std::vector<float> &sizes);
template <int dim>
void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                       const std::vector<InitialCrack<dim>> &cracks,
                       double reach,
                       double size,
                       std::vector<float> &sizes);
} // namespace stockwork
