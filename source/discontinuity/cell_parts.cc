#include "discontinuity/cell_parts.h"

namespace stockwork
{
using dealii::Point;

namespace
{
/// What of a convex polygon lies on one side of the line through a piece.
std::vector<Point<2>>
clipped(const std::vector<Point<2>> &polygon, const CrackPiece<2> &piece, const bool plus)
{
  const dealii::Tensor<1, 2> normal = (plus ? 1. : -1.) * piece.unit_normal();
  // Corners on the line belong to both sides.
  const double on_line = 1e-14 * normal.norm();
  std::vector<Point<2>> part;
  for (unsigned int i = 0; i < polygon.size(); ++i)
  {
    const Point<2> &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = normal * (a - piece.unit_ends[0]), to = normal * (b - piece.unit_ends[0]);
    if (from >= -on_line)
      part.push_back(a);
    if ((from > on_line && to < -on_line) || (from < -on_line && to > on_line))
      part.push_back(a + from / (from - to) * (b - a));
  }
  return part;
}
} // namespace

template <int dim>
int side_of(const CrackPiece<dim> &passing, const CrackPiece<dim> &other)
{
  // The further of its ends: the other one may be on the piece.
  const auto normal = passing.unit_normal();
  const double first = normal * (other.unit_ends[0] - passing.unit_ends[0]),
               last = normal * (other.unit_ends[1] - passing.unit_ends[0]);
  return std::abs(first) > std::abs(last) ? first > 0. : last > 0.;
}


template <int dim>
std::vector<CellPart<dim>> cell_parts(const PiecesInCell<dim> &pieces)
{
  const std::vector<Point<dim>> cell{{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}};
  std::vector<CellPart<dim>> parts;
  for (const int side : {0, 1})
  {
    CellPart<dim> half;
    half.corners = clipped(cell, *pieces[0], side == 1);
    half.side[0] = side;
    unsigned int other = 1;
    while (other < pieces.size() && side_of(*pieces[0], *pieces[other]) != side)
      ++other;
    if (other == pieces.size())
    {
      parts.push_back(half);
      continue;
    }
    for (const int of_other : {0, 1})
    {
      CellPart<dim> part = half;
      part.corners = clipped(half.corners, *pieces[other], of_other == 1);
      part.side[other] = of_other;
      parts.push_back(part);
    }
  }
  return parts;
}

template int side_of(const CrackPiece<2> &, const CrackPiece<2> &);
template std::vector<CellPart<2>> cell_parts(const PiecesInCell<2> &);
} // namespace stockwork
