#pragma once

#include <deal.II/base/quadrature.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>

#include "discontinuity/cell_parts.h"
#include "stockwork/exchange/cell_role.h"

#include <optional>
#include <utility>
#include <vector>

namespace stockwork
{
/// Quadrature on the parts of a cell that cracks cut apart, and the Q1 functions of its corners
/// there. A column is such a function times a whole number in each part. For a single crack these
/// make the shifted enrichment N_i (H - H_i) with H = 1 on the plus, 0 on the minus side
/// (Belytschko et al. 2001 with the shift of Zi and Belytschko 2003). It vanishes at all corners
/// and on all faces that the crack does not meet, so neighbouring cells need not know of it.
template <int dim>
struct CutGeometry
{
  static constexpr unsigned int n_corners = CrackPiece<dim>::n_corners;

  std::vector<dealii::Point<dim>> points;        ///< in unit-cell coordinates
  std::vector<double> weights;                   ///< times the Jacobian
  std::vector<unsigned char> part;               ///< of the cell, of each point; see cell_parts()
  std::vector<double> values;                    ///< [q * n_corners + corner]
  std::vector<dealii::Tensor<1, dim>> gradients; ///< real space, [q * n_corners + corner]

  dealii::Point<dim> on_plane; ///< see CutCell
  dealii::Tensor<1, dim> normal;
};

/// Unknown index, corner and component of one column of a cut cell, and what its function is in
/// each part of the cell: that of the corner times this number.
struct EnrichedColumn
{
  unsigned int extra;
  unsigned int corner;
  unsigned int component;
  std::array<signed char, most_cell_parts> in_part{};
};

/// A quadrature rule on the unit cell that is split by the straight line between two points on
/// faces of it. Exact for polynomials of total degree 2 degree + 3 on either side; weights sum
/// to 1.
dealii::Quadrature<2> split_quadrature(const CrackPiece<2> &piece, const unsigned int degree);

/// A rule on the unit cell for functions that behave as the root of the distance to @p tip, a point
/// of the cell or of its boundary, and their derivatives: a fan of triangles around it.
/// @param mouth where a crack that ends at the tip enters the cell, with its face; the triangles
/// are aligned with it
dealii::Quadrature<2>
fan_quadrature(const dealii::Point<2> &tip,
               const std::optional<std::pair<dealii::Point<2>, unsigned int>> &mouth,
               const unsigned int n_points_per_direction);

/// Geometry of a cell that pieces of cracks cut, for bulk displacements of polynomial degree
/// @p degree.
template <int dim>
CutGeometry<dim>
make_cut_geometry(const dealii::Mapping<dim> &mapping,
                  const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
                  const PiecesInCell<dim> &pieces,
                  const unsigned int degree);

/// The same for any rule and at most one piece; null: none.
template <int dim>
CutGeometry<dim>
make_cut_geometry(const dealii::Mapping<dim> &mapping,
                  const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
                  const CrackPiece<dim> *piece,
                  const dealii::Quadrature<dim> &rule);

/// Columns that are tabulated and not made from the functions of corners.
template <int dim>
struct TabulatedColumns
{
  std::vector<unsigned int> extra;
  std::vector<unsigned int> component;
  std::vector<double> values;                    ///< [q * n_columns + c]
  std::vector<dealii::Tensor<1, dim>> gradients; ///< real space, [q * n_columns + c]
};

/// The cut cell as the bulk sees it.
template <int dim>
CutCell<dim> make_cut_cell(const CutGeometry<dim> &geometry,
                           const std::vector<EnrichedColumn> &columns,
                           const TabulatedColumns<dim> &more = {});

/// Q1 functions of the corners at a point of the unit cell.
template <int dim>
std::array<double, CrackPiece<dim>::n_corners>
corner_functions(const dealii::Point<dim> &unit_point);
} // namespace stockwork
