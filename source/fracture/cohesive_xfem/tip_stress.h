#pragma once

#include <deal.II/base/symmetric_tensor.h>

#include "discontinuity/discontinuity.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/state.h"

#include <vector>

namespace stockwork::cohesive_xfem
{
/// A half disc ahead of a crack tip.
template <int dim>
struct HalfDisc
{
  dealii::Point<dim> centre;
  dealii::Tensor<1, dim> direction; ///< unit
  double radius;
};

/// What the rock ahead of a crack tip bears.
template <int dim>
struct RockAhead
{
  dealii::SymmetricTensor<2, dim> stress; ///< total, tension positive [Pa]
  double pore_pressure = 0.;              ///< with that in situ [Pa]
};

/// Averages over the uncut cells in each half disc with the weight exp(-4 r^2/R^2) (Wells and
/// Sluys 2001). The same on all ranks.
template <int dim>
std::vector<RockAhead<dim>> average_ahead(const std::vector<HalfDisc<dim>> &discs,
                                          const MeshView<dim> &mesh_view,
                                          const Discontinuity<dim> &discontinuity,
                                          const Scene<dim> &scene,
                                          const State &state,
                                          const Collectives &collectives);
} // namespace stockwork::cohesive_xfem
