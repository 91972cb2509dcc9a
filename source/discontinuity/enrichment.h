#pragma once

#include "discontinuity/crack_path.h"
#include "discontinuity/cut_cell.h"
#include "stockwork/exchange/extra_unknown.h"

#include <array>
#include <vector>

namespace stockwork
{
template <int dim>
struct CrackTip;

/// The unknowns of all cracks: one per crack, corner of a cut cell and component of displacement,
/// except where the crack must not open: at the corners of the face that holds a tip, and where a
/// boundary condition holds the displacement; and two per tip with functions of its own. Known on
/// all ranks.
template <int dim>
class Enrichment
{
public:
  /// Number the unknowns of these cracks anew and tell the tips theirs. Keys stay.
  void rebuild(const std::vector<CrackPath<dim>> &cracks,
               std::vector<CrackTip<dim>> &tips,
               const double domain_size);

  const std::vector<ExtraUnknown> &unknowns() const
  {
    return all_unknowns;
  }

  const std::vector<EnrichedColumn> &columns(const unsigned int crack,
                                             const unsigned int piece) const
  {
    return piece_columns[crack][piece];
  }

private:
  std::vector<ExtraUnknown> all_unknowns;
  std::vector<std::vector<std::vector<EnrichedColumn>>> piece_columns;
};

/// Functions of the corners at points along a piece; the displacement jumps there by
/// sum_c a_c N_corner(c) e_component(c), and all points have the same share of the length as
/// weight. Two points would do for what is smooth; with four, the peak of a cohesive law passes
/// from point to point smoothly enough for Newton's method.
template <int dim>
struct JumpShapes
{
  static constexpr unsigned int n_points = 4;
  std::array<std::array<double, CrackPiece<dim>::n_corners>, n_points> values;

  explicit JumpShapes(const CrackPiece<dim> &piece);

  /// Mean along the piece.
  double mean(const unsigned int corner) const
  {
    double sum = 0.;
    for (const auto &at_point : values)
      sum += at_point[corner];
    return sum / n_points;
  }

  /// Jump of the displacement at a point for the unknowns @p a.
  dealii::Tensor<1, dim> jump(const unsigned int point,
                              const std::vector<EnrichedColumn> &columns,
                              const std::vector<double> &a) const
  {
    dealii::Tensor<1, dim> sum;
    for (const EnrichedColumn &c : columns)
      sum[c.component] += values[point][c.corner] * a[c.extra];
    return sum;
  }
};
} // namespace stockwork
