#pragma once

#include <deal.II/base/symmetric_tensor.h>

#include "stockwork/exchange/collectives.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/state.h"
#include "stockwork/mesh/mesh_view.h"

#include <functional>
#include <vector>

namespace stockwork
{
/// A half disc, in 3-D a half ball, ahead of a crack.
template <int dim>
struct HalfDisc
{
  dealii::Point<dim> centre;
  dealii::Tensor<1, dim> direction; ///< unit
  double radius;
};

/// What the rock ahead of a crack bears.
template <int dim>
struct RockAhead
{
  dealii::SymmetricTensor<2, dim> stress; ///< total, tension positive [Pa]
  double pore_pressure = 0.;              ///< with that in situ [Pa]
};

/// Averages over the cells without a crack in each half disc with the weight exp(-4 r^2/R^2) (Wells
/// and Sluys 2001). The same on all ranks.
/// @param is_cracked whether a cell, by active cell index, is left out
template <int dim>
std::vector<RockAhead<dim>> average_ahead(const std::vector<HalfDisc<dim>> &discs,
                                          const MeshView<dim> &mesh_view,
                                          const std::function<bool(unsigned int)> &is_cracked,
                                          const Scene<dim> &scene,
                                          const State &state,
                                          const Collectives &collectives);
} // namespace stockwork
