#pragma once

#include "discontinuity/crack_path.h"
#include "discontinuity/cut_cell.h"
#include "stockwork/exchange/extra_unknown.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace stockwork
{
template <int dim>
struct CrackTip;

/// What makes the faces of a piece part: an unknown, the corner whose function the jump has along
/// the piece, its component, and the number it is multiplied by on each of the piece's two parts.
struct JumpColumn
{
  unsigned int extra;
  unsigned int corner;
  unsigned int component;
  std::array<signed char, 2> on_part{{1, 1}};
};

/// A piece by the numbers of its crack and its place in it.
using PieceIndex = std::pair<unsigned int, unsigned int>;

/// The pieces in each cell; first the one that passes through, then those that end on its crack.
using PiecesOfCells = std::map<dealii::CellId, std::vector<PieceIndex>>;

/// The unknowns of all cracks: one per crack, corner of a cut cell and component of displacement,
/// except where the crack must not open: at the corners of the face that holds a tip, and where a
/// boundary condition holds the displacement; and two per tip with functions of its own. Known on
/// all ranks.
///
/// Where a crack S ends on a crack P, the jump functions of S are on its own side of P only (after
/// Daux et al. 2000): at corners on that side N_i (H_S - H_S,i), at those on the other side N_i
/// H_S. Together with the functions of P they are all that can move the three parts of rock apart
/// from one another. The latter functions do not vanish in the next cells along P: the displacement
/// jumps across P there.
template <int dim>
class Enrichment
{
public:
  /// Number the unknowns of these cracks anew and tell the tips theirs. Keys stay.
  void rebuild(const std::vector<CrackPath<dim>> &cracks,
               const PiecesOfCells &pieces_of_cells,
               std::vector<CrackTip<dim>> &tips,
               const double domain_size);

  const std::vector<ExtraUnknown> &unknowns() const
  {
    return all_unknowns;
  }

  /// What opens a piece.
  const std::vector<JumpColumn> &jumps(const unsigned int crack, const unsigned int piece) const
  {
    return piece_jumps[crack][piece];
  }

  /// The functions in the cell that a piece passes through; none for one that ends on another.
  const std::vector<EnrichedColumn> &columns(const unsigned int crack,
                                             const unsigned int piece) const
  {
    return cell_columns[crack][piece];
  }

private:
  class Numbering;

  void add_columns(const std::vector<CrackPath<dim>> &cracks,
                   const std::vector<PieceIndex> &in_cell,
                   const Numbering &numbering);

  std::vector<ExtraUnknown> all_unknowns;
  std::vector<std::vector<std::vector<JumpColumn>>> piece_jumps;
  std::vector<std::vector<std::vector<EnrichedColumn>>> cell_columns;
};

/// Functions of the corners at points along a piece, where the displacement jumps by
/// sum_c a_c m_c N_corner(c) e_component(c). Two points would do for what is smooth; with four, the
/// peak of a cohesive law passes from point to point smoothly enough for Newton's method.
template <int dim>
struct JumpShapes
{
  static constexpr unsigned int n_points = 4;
  std::array<std::array<double, CrackPiece<dim>::n_corners>, n_points> values;
  std::array<double, n_points> share; ///< of the piece's length, the weight of a point

  explicit JumpShapes(const CrackPiece<dim> &piece);

  /// The jump at a point that one of an unknown makes, in its component.
  double value(const unsigned int point, const JumpColumn &column) const
  {
    return column.on_part[2 * point / n_points] * values[point][column.corner];
  }

  /// Mean along the piece.
  double mean(const JumpColumn &column) const
  {
    double sum = 0.;
    for (unsigned int q = 0; q < n_points; ++q)
      sum += share[q] * value(q, column);
    return sum;
  }

  /// Jump of the displacement at a point for the unknowns @p a.
  dealii::Tensor<1, dim> jump(const unsigned int point,
                              const std::vector<JumpColumn> &columns,
                              const std::vector<double> &a) const
  {
    dealii::Tensor<1, dim> sum;
    for (const JumpColumn &c : columns)
      sum[c.component] += value(point, c) * a[c.extra];
    return sum;
  }
};
} // namespace stockwork
