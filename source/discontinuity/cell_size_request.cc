#include "discontinuity/cell_size_request.h"

#include "mesh/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork
{
using dealii::Point;

namespace
{
/// Distance of a point from the line between two others.
template <int dim>
double distance_from_line(const Point<dim> &x, const Point<dim> &from, const Point<dim> &to)
{
  const dealii::Tensor<1, dim> edge = to - from;
  const double square = edge.norm_square();
  return x.distance(square > 0. ? from + std::clamp((x - from) * edge / square, 0., 1.) * edge
                                : from);
}

template <int dim>
double longest_edge(const CrackPiece<dim> &piece)
{
  double longest = 0.;
  for (const auto &edge : face_vertices)
    longest = std::max(longest, piece.corners[edge[0]].distance(piece.corners[edge[1]]));
  return longest;
}

/// How often the cell of a piece has been split.
template <int dim>
int level(const CrackPiece<dim> &piece)
{
  return piece.cell.get_child_indices().size();
}
} // namespace

template <int dim>
void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                       const Discontinuity<dim> &discontinuity,
                       const unsigned int rings_ahead,
                       std::vector<float> &sizes)
{
  // What is asked for ahead of a tip reaches as far at the next few advances: a change of the mesh
  // costs all that has been computed with the old one.
  constexpr unsigned int stride = 16;
  struct Line
  {
    Point<dim> from, to;
    double margin;
    int level;
  };
  std::vector<Line> lines;
  for (const auto &path : discontinuity.paths())
  {
    const unsigned int n = path.pieces.size();
    for (const CrackPiece<dim> &piece : path.pieces)
      lines.push_back({piece.centre(), piece.centre(),
                       1.5 * longest_edge(piece) + 0.5 * piece.length(), level(piece)});
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
      if (path.is_tip[static_cast<int>(end)])
      {
        const Point<dim> tip = path.tip(end);
        const double h = longest_edge(path.piece_at(end));
        lines.push_back({tip, tip + (stride - n % stride) * h * path.direction(end),
                         rings_ahead * h, level(path.piece_at(end))});
      }
  }

  // Most cells are far from all of this.
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
  {
    lower[d] = std::numeric_limits<double>::infinity();
    upper[d] = -lower[d];
    for (const Line &line : lines)
    {
      lower[d] = std::min({lower[d], line.from[d] - line.margin, line.to[d] - line.margin});
      upper[d] = std::max({upper[d], line.from[d] + line.margin, line.to[d] + line.margin});
    }
  }

  // A crack passes cells of one level only, so it is the level that is asked for: on a mesh whose
  // cells grow, the size would differ from cell to cell and leave hanging nodes on the way.
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const Point<dim> centre = cell->center();
      const double reach = 0.5 * cell->diameter();
      bool is_near = true;
      for (unsigned int d = 0; d < dim; ++d)
        is_near = is_near && centre[d] > lower[d] - reach && centre[d] < upper[d] + reach;
      if (!is_near)
        continue;
      const double own_size = cell_size(cell);
      float &size = sizes[cell->active_cell_index()];
      for (const Line &line : lines)
        if (const double wanted = std::ldexp(own_size, cell->level() - line.level);
            wanted < size && distance_from_line(centre, line.from, line.to) < line.margin + reach)
          size = static_cast<float>(wanted);
    }
}

template void request_cell_size(const dealii::parallel::distributed::Triangulation<2> &,
                                const Discontinuity<2> &,
                                const unsigned int,
                                std::vector<float> &);
} // namespace stockwork
