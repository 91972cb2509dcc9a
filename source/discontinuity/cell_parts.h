#pragma once

#include "discontinuity/crack_path.h"

#include <array>
#include <vector>

namespace stockwork
{
/// Pieces of cracks in one cell: the first passes through, up to one on either side of it belongs
/// to a crack that ends on that of the first, in this cell or a next one.
template <int dim>
using PiecesInCell = std::vector<const CrackPiece<dim> *>;

/// A convex part of a cell that cracks cut apart.
template <int dim>
struct CellPart
{
  static constexpr unsigned int most_pieces = 3;

  std::vector<dealii::Point<dim>> corners; ///< in the unit cell, in order

  /// Of each piece: the part lies on its plus side, 1, or its minus side, 0; or beyond the first
  /// piece, where another one is not, -1.
  std::array<signed char, most_pieces> side{{-1, -1, -1}};
};

/// The most parts of a cell: two on either side of a crack.
constexpr unsigned int most_cell_parts = 4;

/// Cut a cell, in unit coordinates; first what is on the minus side of the first piece.
template <int dim>
std::vector<CellPart<dim>> cell_parts(const PiecesInCell<dim> &pieces);

/// On which side of the piece that passes through the cell another one is: the plus side, 1, or the
/// minus side, 0.
template <int dim>
int side_of(const CrackPiece<dim> &passing, const CrackPiece<dim> &other);
} // namespace stockwork
