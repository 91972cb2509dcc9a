#include "discontinuity/cut_cell.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <array>

namespace stockwork
{
using dealii::Point;

namespace
{
/// Position of a point on the boundary of the unit square, counted counterclockwise from the
/// origin, 0 to 4.
double around(const Point<2> &p, const unsigned int face)
{
  switch (face)
  {
  case 0:
    return 4. - p[1];
  case 1:
    return 1. + p[1];
  case 2:
    return p[0];
  default:
    return 3. - p[0];
  }
}

/// Add the rule on a triangle.
void add_triangle(const Point<2> &a,
                  const Point<2> &b,
                  const Point<2> &c,
                  const dealii::Quadrature<2> &rule,
                  std::vector<Point<2>> &points,
                  std::vector<double> &weights)
{
  const dealii::Tensor<1, 2> ab = b - a, ac = c - a;
  const double determinant = std::abs(ab[0] * ac[1] - ab[1] * ac[0]);
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    points.push_back(a + rule.point(q)[0] * ab + rule.point(q)[1] * ac);
    weights.push_back(rule.weight(q) * determinant);
  }
}

/// Add the rule on a convex polygon as a fan of triangles.
void add_polygon(const std::vector<Point<2>> &corners,
                 const dealii::Quadrature<2> &rule,
                 std::vector<Point<2>> &points,
                 std::vector<double> &weights)
{
  for (unsigned int i = 1; i + 1 < corners.size(); ++i)
    add_triangle(corners[0], corners[i], corners[i + 1], rule, points, weights);
}
} // namespace

dealii::Quadrature<2> split_quadrature(const CrackPiece<2> &piece, const unsigned int degree)
{
  // Gradients of Q_k functions have total degree 2k-1 at most; their products need 4k-2.
  const dealii::QWitherdenVincentSimplex<2> rule(degree + 2);

  const Point<2> corner[4] = {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}};
  // Walk counterclockwise from one end of the piece to the other; what lies between is one part.
  const auto part = [&](const unsigned int from, const unsigned int to)
  {
    const double start = around(piece.unit_ends[from], piece.faces[from]);
    double stop = around(piece.unit_ends[to], piece.faces[to]);
    if (stop < start)
      stop += 4.;
    std::vector<Point<2>> polygon{piece.unit_ends[from]};
    for (unsigned int i = static_cast<unsigned int>(start) + 1; i < stop; ++i)
      polygon.push_back(corner[i % 4]);
    polygon.push_back(piece.unit_ends[to]);
    return polygon;
  };

  std::vector<Point<2>> points;
  std::vector<double> weights;
  add_polygon(part(0, 1), rule, points, weights);
  add_polygon(part(1, 0), rule, points, weights);
  return dealii::Quadrature<2>(points, weights);
}

dealii::Quadrature<2> fan_quadrature(const Point<2> &tip,
                                     const std::optional<std::pair<Point<2>, unsigned int>> &mouth,
                                     const unsigned int n_points_per_direction)
{
  std::vector<Point<2>> polygon{{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}};
  if (mouth)
  {
    const int corner = static_cast<int>(around(mouth->first, mouth->second)) % 4;
    polygon.insert(polygon.begin() + corner + 1, mouth->first);
  }
  const dealii::QGauss<1> line(n_points_per_direction);
  std::vector<Point<2>> points;
  std::vector<double> weights;
  for (unsigned int i = 0; i < polygon.size(); ++i)
  {
    const dealii::Tensor<1, 2> a = polygon[i] - tip, b = polygon[(i + 1) % polygon.size()] - tip;
    const double determinant = std::abs(a[0] * b[1] - a[1] * b[0]);
    if (determinant < 1e-12)
      continue; // the tip is on this edge
    // The distance is s^2 along every ray, so that roots of it become polynomials.
    for (unsigned int q = 0; q < line.size(); ++q)
      for (unsigned int k = 0; k < line.size(); ++k)
      {
        const double s = line.point(q)[0], v = line.point(k)[0];
        points.push_back(tip + s * s * (a + v * (b - a)));
        weights.push_back(line.weight(q) * line.weight(k) * 2. * s * s * s * determinant);
      }
  }
  return dealii::Quadrature<2>(points, weights);
}

template <int dim>
std::array<double, CrackPiece<dim>::n_corners> corner_functions(const Point<dim> &unit_point)
{
  std::array<double, CrackPiece<dim>::n_corners> values;
  for (unsigned int v = 0; v < values.size(); ++v)
    values[v] = dealii::GeometryInfo<dim>::d_linear_shape_function(unit_point, v);
  return values;
}

template <int dim>
CutGeometry<dim>
make_cut_geometry(const dealii::Mapping<dim> &mapping,
                  const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
                  const PiecesInCell<dim> &pieces,
                  const unsigned int degree)
{
  if (pieces.size() == 1)
    return make_cut_geometry(mapping, cell, pieces[0], split_quadrature(*pieces[0], degree));
  const dealii::QWitherdenVincentSimplex<2> rule(degree + 2); // see split_quadrature()
  std::vector<Point<dim>> points;
  std::vector<double> weights;
  std::vector<unsigned char> part_of_point;
  const auto parts = cell_parts(pieces);
  for (unsigned int part = 0; part < parts.size(); ++part)
  {
    add_polygon(parts[part].corners, rule, points, weights);
    part_of_point.resize(points.size(), part);
  }
  auto geometry = make_cut_geometry(mapping, cell, pieces[0], {points, weights});
  geometry.part = part_of_point;
  return geometry;
}

template <int dim>
CutGeometry<dim>
make_cut_geometry(const dealii::Mapping<dim> &mapping,
                  const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
                  const CrackPiece<dim> *piece,
                  const dealii::Quadrature<dim> &rule)
{
  constexpr unsigned int n_corners = CutGeometry<dim>::n_corners;

  const dealii::FE_Q<dim> q1(1);
  dealii::FEValues<dim> fe_values(mapping, q1, rule,
                                  dealii::update_values | dealii::update_gradients |
                                    dealii::update_JxW_values);
  fe_values.reinit(cell);

  CutGeometry<dim> geometry;
  geometry.points = rule.get_points();
  geometry.weights = fe_values.get_JxW_values();
  if (piece == nullptr)
    return geometry;
  geometry.on_plane = piece->unit_ends[0];
  geometry.normal = piece->unit_normal();
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    geometry.part.push_back(piece->plus_side(rule.point(q)));
    for (unsigned int v = 0; v < n_corners; ++v)
    {
      geometry.values.push_back(fe_values.shape_value(v, q));
      geometry.gradients.push_back(fe_values.shape_grad(v, q));
    }
  }
  return geometry;
}

template <int dim>
CutCell<dim> make_cut_cell(const CutGeometry<dim> &geometry,
                           const std::vector<EnrichedColumn> &columns,
                           const TabulatedColumns<dim> &more)
{
  constexpr unsigned int n_corners = CutGeometry<dim>::n_corners;

  CutCell<dim> cut;
  cut.points = geometry.points;
  cut.weights = geometry.weights;
  cut.on_plane = geometry.on_plane;
  cut.normal = geometry.normal;
  const unsigned int n_more = more.extra.size();
  const std::size_t size = geometry.points.size() * (columns.size() + n_more);
  cut.values.reserve(size);
  cut.gradients.reserve(size);
  for (const EnrichedColumn &column : columns)
  {
    cut.extra.push_back(column.extra);
    cut.component.push_back(column.component);
  }
  cut.extra.insert(cut.extra.end(), more.extra.begin(), more.extra.end());
  cut.component.insert(cut.component.end(), more.component.begin(), more.component.end());
  for (unsigned int q = 0; q < geometry.points.size(); ++q)
  {
    for (const EnrichedColumn &column : columns)
    {
      const double factor = column.in_part[geometry.part[q]];
      cut.values.push_back(factor * geometry.values[q * n_corners + column.corner]);
      cut.gradients.push_back(factor * geometry.gradients[q * n_corners + column.corner]);
    }
    for (unsigned int c = q * n_more; c < (q + 1) * n_more; ++c)
    {
      cut.values.push_back(more.values[c]);
      cut.gradients.push_back(more.gradients[c]);
    }
  }
  return cut;
}

template std::array<double, 4> corner_functions(const Point<2> &);
template CutGeometry<2> make_cut_geometry(const dealii::Mapping<2> &,
                                          const dealii::Triangulation<2>::active_cell_iterator &,
                                          const PiecesInCell<2> &,
                                          const unsigned int);
template CutGeometry<2> make_cut_geometry(const dealii::Mapping<2> &,
                                          const dealii::Triangulation<2>::active_cell_iterator &,
                                          const CrackPiece<2> *,
                                          const dealii::Quadrature<2> &);
template CutCell<2> make_cut_cell(const CutGeometry<2> &,
                                  const std::vector<EnrichedColumn> &,
                                  const TabulatedColumns<2> &);
} // namespace stockwork
