#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace stockwork
{
class RockLaw;

/// A cell that a discontinuity passes through: its own quadrature, and the extra shape functions
/// that jump inside it. The displacement in the cell is the ordinary one plus
/// sum_c a_c value(c, q) e_component(c).
template <int dim>
struct CutCell
{
  std::vector<dealii::Point<dim>> points; ///< in unit-cell coordinates
  std::vector<double> weights;            ///< times the Jacobian: they sum to the cell's volume

  std::vector<unsigned int> extra;               ///< index of the unknown, one per column
  std::vector<unsigned int> component;           ///< direction of displacement, one per column
  std::vector<double> values;                    ///< [q * n_columns + c]
  std::vector<dealii::Tensor<1, dim>> gradients; ///< real space, [q * n_columns + c]

  /// The discontinuity, as the plane that it is in unit-cell coordinates: a point of it, and a
  /// normal of any length. Zero: none passes through the cell, which sees a tip nearby.
  dealii::Point<dim> on_plane;
  dealii::Tensor<1, dim> normal;

  unsigned int n_columns() const
  {
    return extra.size();
  }

  /// On which side a point is, in unit-cell coordinates: 1 where the normal points, -1 on the
  /// other, 0 where nothing passes. The plane goes on where the discontinuity ends in the cell.
  int side(const dealii::Point<dim> &unit_point) const
  {
    if (normal.norm_square() == 0.)
      return 0;
    return normal * (unit_point - on_plane) > 0. ? 1 : -1;
  }
};

/// How the bulk kernel treats a cell. Default: an ordinary one.
template <int dim>
struct CellRole
{
  const CutCell<dim> *cut = nullptr;

  /// Momentum rows (one flag per vertex) whose stiffness somebody else provides (peridynamic
  /// nodes). Inertia, pressure coupling and loads stay with the bulk.
  const std::vector<bool> *skip_stiffness = nullptr;

  /// Unit normal of a fracture in the cell whose opening is part of the elements' strain: the
  /// strain along it makes room in the fracture and not in pores, and the pore pressure does not
  /// act on the faces, so the Biot tensor is alpha (I - n n).
  const dealii::Tensor<1, dim> *fracture_normal = nullptr;

  /// A law in place of the rock's, which it may have inside (Scene::rock_law); see
  /// Requirements::law. Null: the rock's own.
  const RockLaw *law = nullptr;

  /// Key of the segment whose fluid pressure that law sees.
  std::optional<std::uint64_t> segment = std::nullopt;

  /// The mass is that of points at the vertices, the row sums of the elements' mass matrix. Linear
  /// elements only.
  bool lumps_mass = false;
};
} // namespace stockwork
