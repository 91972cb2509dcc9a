#include "discontinuity/crack_path.h"

#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/reference_cell.h>

#include "stockwork/base/error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace stockwork
{
using dealii::Point;
using dealii::Tensor;

namespace
{
double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

std::string text(const Point<2> &p)
{
  std::ostringstream out;
  out << '(' << p[0] << ", " << p[1] << ')';
  return out.str();
}

/// The unit coordinates of the point that divides a face in the given proportion.
Point<2> unit_point_on_face(const unsigned int face, const double share)
{
  Point<2> p;
  const unsigned int normal_axis = face / 2;
  p[normal_axis] = face % 2;
  p[1 - normal_axis] = share;
  return p;
}

/// Put one end of a piece on a face, away from the corners.
void place_end(CrackPiece<2> &piece, const unsigned int end, const unsigned int face, double share)
{
  share = std::min(std::max(share, corner_clearance), 1. - corner_clearance);
  const Point<2> &a = piece.corners[face_vertices[face][0]];
  const Point<2> &b = piece.corners[face_vertices[face][1]];
  piece.faces[end] = face;
  piece.ends[end] = a + share * (b - a);
  piece.unit_ends[end] = unit_point_on_face(face, share);
}

/// Where a polyline crosses a face of a cell.
struct Crossing
{
  double arc; ///< along the polyline from its first point
  unsigned int face;
  double share;      ///< along the face from its first vertex
  unsigned int line; ///< of the polyline's straight lines
};

/// A polyline with both ends prolonged to rays, so that every cell is crossed as a whole.
class ProlongedPolyline
{
public:
  ProlongedPolyline(const std::vector<Point<2>> &given, const double domain_size)
    : points(given)
    , tolerance(1e-9 * domain_size)
  {
    for (unsigned int k = 1; k < given.size(); ++k)
      length += given[k].distance(given[k - 1]);
    const Tensor<1, 2> first = given[0] - given[1];
    const Tensor<1, 2> last = given.back() - given[given.size() - 2];
    points.front() += domain_size * first / first.norm();
    points.back() += domain_size * last / last.norm();
    start = -domain_size;
  }

  /// All crossings of the edge from a to b, by arc and share from a.
  void cross_edge(const Point<2> &a,
                  const Point<2> &b,
                  const unsigned int face,
                  std::vector<Crossing> &crossings) const
  {
    // Both cells at an edge must find the same crossing to the last digit.
    const bool swap = b[0] < a[0] || (b[0] == a[0] && b[1] < a[1]);
    const Point<2> &p = swap ? b : a, &q = swap ? a : b;
    const Tensor<1, 2> edge = q - p;
    double arc = start;
    for (unsigned int k = 0; k + 1 < points.size(); ++k)
    {
      const Tensor<1, 2> line = points[k + 1] - points[k];
      const double extent = line.norm();
      // A vertex on the line counts as being on its left.
      const double to_p = cross(line, p - points[k]) / extent;
      const double to_q = cross(line, q - points[k]) / extent;
      const bool left_p = to_p > -tolerance, left_q = to_q > -tolerance;
      const bool left_k = cross(edge, points[k] - p) >= 0.,
                 left_k1 = cross(edge, points[k + 1] - p) >= 0.;
      if (left_p != left_q && left_k != left_k1)
      {
        // Away from the corners, so that crossings near one corner keep their order.
        const double share =
          std::min(std::max(to_p / (to_p - to_q), corner_clearance), 1. - corner_clearance);
        const Tensor<1, 2> way = p + share * edge - points[k];
        crossings.push_back({arc + way * line / extent, face, swap ? 1. - share : share, k});
      }
      arc += extent;
    }
  }

  /// Unit vector along one of the straight lines.
  Tensor<1, 2> direction(const unsigned int k) const
  {
    const Tensor<1, 2> line = points[k + 1] - points[k];
    return line / line.norm();
  }

  double length = 0.;

private:
  std::vector<Point<2>> points;
  double tolerance;
  double start;
};

struct Found
{
  std::array<double, 2> arcs; ///< of both ends
  CrackPiece<2> piece;
  std::string fault; ///< why the crack cannot pass this cell; empty if it can

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &arcs &piece &fault;
  }
};

/// Pieces that meet at a face along the crack belong together.
void join_across_shallow_faces(std::vector<Found> &found)
{
  for (unsigned int i = 0; i + 1 < found.size(); ++i)
    if (CrackPiece<2> &piece = found[i].piece, &next = found[i + 1].piece;
        !piece.inside[1] && !piece.at_boundary[1])
      next.joined[0] = piece.joined[1] = !piece.crosses_transverse_face(1);
}

/// The spans that lie on the polyline by more than half of their length.
std::vector<Found> spans_inside(const std::vector<Found> &found, const double length)
{
  std::vector<Found> inside;
  for (unsigned int i = 0, next = 0; i < found.size(); i = next)
  {
    for (next = i + 1; next < found.size() && found[next].piece.joined[0];)
      ++next;
    const double begin = found[i].arcs[0], end = found[next - 1].arcs[1];
    const double middle = 0.5 * (begin + end);
    const double rounding = 1e-9 * (end - begin);
    if (middle >= -rounding && middle <= length + rounding)
      inside.insert(inside.end(), found.begin() + i, found.begin() + next);
  }
  // What is left out beyond the ends is no part of a span.
  if (!inside.empty())
    inside.front().piece.joined[0] = inside.back().piece.joined[1] = false;
  return inside;
}
} // namespace

std::uint64_t hash_combine(const std::uint64_t seed, const std::int64_t value)
{
  // The finalizer of splitmix64 (Steele, Lea and Flood 2014).
  std::uint64_t x = seed + 0x9e3779b97f4a7c15ull + static_cast<std::uint64_t>(value);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

template <int dim>
std::uint64_t
hash_point(const std::uint64_t seed, const Point<dim> &point, const double domain_size)
{
  std::uint64_t hash = seed;
  for (unsigned int d = 0; d < dim; ++d)
    hash = hash_combine(hash, std::llround(point[d] / (1e-9 * domain_size)));
  return hash;
}

template <int dim>
Tensor<1, dim> CrackPiece<dim>::normal() const
{
  static_assert(dim == 2, "a polyline has a normal in two dimensions only");
  Tensor<1, dim> n;
  n[0] = -along[1];
  n[1] = along[0];
  return n;
}

template <int dim>
bool CrackPiece<dim>::crosses_transverse_face(const unsigned int end) const
{
  // How much of the crack's direction is normal to the faces of an axis, at most.
  const auto normal_part = [this](const unsigned int face)
  {
    const Tensor<1, dim> edge = corners[face_vertices[face][1]] - corners[face_vertices[face][0]];
    return std::abs(cross(along, edge)) / edge.norm();
  };
  const unsigned int face = faces[end], other = face < 2 ? 2 : 0;
  const double here = normal_part(face),
               there = std::max(normal_part(other), normal_part(other + 1));
  constexpr double tie = 1e-3;
  return face < 2 ? here > (1. - tie) * there : here > (1. + tie) * there;
}

template <int dim>
std::vector<CrackSpan> spans_of(const CrackPath<dim> &path)
{
  std::vector<CrackSpan> spans;
  for (unsigned int i = 0; i < path.pieces.size(); ++i)
    if (i > 0 && path.pieces[i - 1].joined[1])
      spans.back().last = i;
    else
      spans.push_back({i, i});
  return spans;
}

template <int dim>
Tensor<1, dim> CrackPiece<dim>::unit_normal() const
{
  const Tensor<1, dim> along_it = unit_ends[1] - unit_ends[0];
  Tensor<1, dim> normal;
  normal[0] = -along_it[1];
  normal[1] = along_it[0];
  return normal;
}

template <int dim>
bool CrackPiece<dim>::plus_side(const Point<dim> &unit_point) const
{
  return unit_normal() * (unit_point - unit_ends[0]) > 0.;
}

template <int dim>
double CrackPiece<dim>::cell_size() const
{
  return std::sqrt(0.5 * std::abs(cross(corners[3] - corners[0], corners[2] - corners[1])));
}

template <int dim>
std::uint64_t CrackPiece<dim>::key(const double domain_size) const
{
  return hash_point(0x5e6, centre(), domain_size);
}

template <int dim>
double CrackPath<dim>::length() const
{
  double sum = 0.;
  for (const auto &piece : pieces)
    sum += piece.length();
  return sum;
}

template <int dim>
CrackPiece<dim> reversed(const CrackPiece<dim> &piece)
{
  CrackPiece<dim> r = piece;
  std::swap(r.faces[0], r.faces[1]);
  std::swap(r.ends[0], r.ends[1]);
  std::swap(r.unit_ends[0], r.unit_ends[1]);
  std::swap(r.at_boundary[0], r.at_boundary[1]);
  std::swap(r.inside[0], r.inside[1]);
  std::swap(r.joined[0], r.joined[1]);
  r.split = 1. - r.split;
  r.along *= -1.;
  return r;
}

template <int dim>
std::array<unsigned char, CrackPiece<dim>::n_corners>
constrained_components(const MeshView<dim> &mesh_view,
                       const typename dealii::DoFHandler<dim>::active_cell_iterator &cell)
{
  std::array<unsigned char, CrackPiece<dim>::n_corners> constrained{};
  const auto &fe = cell->get_fe();
  std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
  cell->get_dof_indices(dofs);
  const unsigned int per_vertex = fe.n_dofs_per_vertex();
  for (unsigned int v = 0; v < CrackPiece<dim>::n_corners; ++v)
    for (unsigned int i = 0; i < per_vertex; ++i)
    {
      // Degrees of freedom at vertices come first in a cell, vertex by vertex.
      const unsigned int local = v * per_vertex + i;
      const unsigned int component = fe.system_to_component_index(local).first;
      if (component >= dim || !mesh_view.constraints.is_constrained(dofs[local]))
        continue;
      const auto *entries = mesh_view.constraints.get_constraint_entries(dofs[local]);
      if (entries != nullptr && !entries->empty())
        throw InputError("A crack passes the hanging node " + text(cell->vertex(v)) +
                         "; the cells along a crack must have one size. Refine the mesh around "
                         "the crack or shift the crack.");
      constrained[v] |= 1u << component;
    }
  return constrained;
}

namespace
{
/// Add the pieces of a line within a cell of this rank to those found.
template <int dim, typename CellIterator>
void cut_cell_by(const ProlongedPolyline &line,
                 const std::vector<Point<dim>> &polyline,
                 const MeshView<dim> &mesh_view,
                 const CellIterator &cell,
                 const bool exact_ends,
                 std::vector<Found> &found)
{
  std::vector<Crossing> crossings;
  for (unsigned int f = 0; f < 4; ++f)
    line.cross_edge(cell->vertex(face_vertices[f][0]), cell->vertex(face_vertices[f][1]), f,
                    crossings);
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing &a, const Crossing &b) { return a.arc < b.arc; });
  for (unsigned int i = 0; i + 1 < crossings.size(); i += 2)
  {
    const std::array<double, 2> arcs = {{crossings[i].arc, crossings[i + 1].arc}};
    // A tip this close to an edge is taken to be on it: of the stress intensity, pressure on a
    // part e of the half length a makes sqrt(2 e/a). Whole spans are chosen below, from what
    // lies a few cells beyond the ends as well.
    const double sliver =
      exact_ends ? 1e-7 * (arcs[1] - arcs[0]) : -3. * cell->vertex(0).distance(cell->vertex(3));
    if (arcs[1] < sliver || arcs[0] > line.length - sliver ||
        crossings[i].face == crossings[i + 1].face)
      continue;
    Found f;
    f.arcs = arcs;
    f.piece.cell = cell->id();
    f.piece.region = cell->material_id();
    for (unsigned int v = 0; v < 4; ++v)
      f.piece.corners[v] = cell->vertex(v);
    for (unsigned int e = 0; e < 2; ++e)
    {
      place_end(f.piece, e, crossings[i + e].face, crossings[i + e].share);
      f.piece.at_boundary[e] = cell->face(crossings[i + e].face)->at_boundary();
    }
    if (exact_ends)
    {
      const auto end_inside = [&](const unsigned int e, const Point<dim> &tip)
      {
        f.piece.inside[e] = true;
        f.piece.at_boundary[e] = false;
        f.piece.ends[e] = tip;
        f.piece.unit_ends[e] = mesh_view.mapping.transform_real_to_unit_cell(cell, tip);
      };
      if (arcs[0] < -sliver)
        end_inside(0, polyline.front());
      if (arcs[1] > line.length + sliver)
        end_inside(1, polyline.back());
    }
    f.piece.along = crossings[i].line == crossings[i + 1].line
                      ? line.direction(crossings[i].line)
                      : (f.piece.ends[1] - f.piece.ends[0]) / f.piece.length();
    try
    {
      f.piece.constrained = constrained_components(mesh_view, cell);
    }
    catch (const InputError &error)
    {
      f.fault = error.what();
    }
    found.push_back(f);
  }
}
} // namespace


template <int dim>
CrackPath<dim> cut_polyline(const MeshView<dim> &mesh_view,
                            const std::vector<Point<dim>> &polyline,
                            const double domain_size,
                            const Collectives &collectives,
                            const bool exact_ends)
{
  if (polyline.size() < 2)
    throw InputError("A crack needs at least two points.");
  const ProlongedPolyline line(polyline, domain_size);

  std::vector<Found> found;
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      cut_cell_by(line, polyline, mesh_view, cell, exact_ends, found);
  found = collectives.gather(found);
  std::stable_sort(found.begin(), found.end(),
                   [](const Found &a, const Found &b)
                   { return a.arcs[0] + a.arcs[1] < b.arcs[0] + b.arcs[1]; });
  join_across_shallow_faces(found);
  if (!exact_ends)
    found = spans_inside(found, line.length);

  if (found.empty())
    throw InputError("The crack from " + text(polyline.front()) + " to " + text(polyline.back()) +
                     " is shorter than half a cell or lies outside the mesh.");
  CrackPath<dim> path;
  for (const Found &f : found)
  {
    if (!f.fault.empty())
      throw InputError(f.fault);
    if (f.piece.inside[0] && f.piece.inside[1])
      throw InputError("The crack from " + text(polyline.front()) + " to " + text(polyline.back()) +
                       " lies inside one cell. Refine the mesh around it.");
    if (!path.pieces.empty() &&
        path.pieces.back().ends[1].distance(f.piece.ends[0]) > 1e-8 * domain_size)
      throw InputError("The crack cannot be followed from cell to cell near " +
                       text(f.piece.ends[0]) +
                       ": the cells change their size there, the crack leaves the mesh, or one of "
                       "its corners lies on a line of the mesh. It needs cells of one refinement "
                       "level along its way, and corners inside of cells.");
    path.pieces.push_back(f.piece);
  }
  path.is_tip = {{!path.pieces.front().at_boundary[0], !path.pieces.back().at_boundary[1]}};
  return path;
}

namespace
{
/// Let a piece leave its cell where the ray from @p start along @p d does, not through @p entry.
void place_exit(CrackPiece<2> &piece,
                const unsigned int entry,
                const Point<2> &start,
                const Tensor<1, 2> &d)
{
  // The first of the other faces that the ray meets; with straight edges there is exactly one, but
  // a ray into a corner may miss both by a rounding error, so the nearest miss is taken.
  double best = std::numeric_limits<double>::infinity();
  unsigned int exit = 0;
  double share = 0.5;
  for (unsigned int f = 0; f < 4; ++f)
    if (f != entry)
    {
      const Point<2> &p = piece.corners[face_vertices[f][0]];
      const Tensor<1, 2> e = piece.corners[face_vertices[f][1]] - p;
      const double determinant = cross(d, e);
      if (std::abs(determinant) < 1e-14 * e.norm())
        continue;
      const double along_ray = cross(p - start, e) / determinant;
      const double along_edge = cross(p - start, d) / determinant;
      if (along_ray <= 0.)
        continue;
      const double miss = std::max({0., -along_edge, along_edge - 1.});
      if (miss < best)
      {
        best = miss;
        exit = f;
        share = along_edge;
      }
    }
  if (!std::isfinite(best))
    throw SolveError("A crack at " + text(start) + " does not find its way through the next cell.");
  place_end(piece, 1, exit, share);
}

/// The corners and the place in the mesh of another piece's cell.
CrackPiece<2> piece_in_cell_of(const CrackPiece<2> &other)
{
  CrackPiece<2> piece;
  piece.cell = other.cell;
  piece.region = other.region;
  piece.corners = other.corners;
  piece.constrained = other.constrained;
  return piece;
}
} // namespace


template <int dim>
CrackPiece<dim> continue_into(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                              const unsigned int face,
                              const Point<dim> &tip,
                              const Tensor<1, dim> &direction)
{
  CrackPiece<dim> piece;
  piece.cell = cell->id();
  piece.region = cell->material_id();
  for (unsigned int v = 0; v < 4; ++v)
    piece.corners[v] = cell->vertex(v);

  const Point<dim> &a = piece.corners[face_vertices[face][0]];
  const Tensor<1, dim> edge = piece.corners[face_vertices[face][1]] - a;
  place_end(piece, 0, face, (tip - a) * edge / edge.norm_square());
  piece.ends[0] = tip;

  // The normal of the face into the cell.
  Tensor<1, dim> inward;
  inward[0] = -edge[1] / edge.norm();
  inward[1] = edge[0] / edge.norm();
  if (inward * (cell->center() - tip) < 0.)
    inward *= -1.;
  Tensor<1, dim> d = direction / direction.norm();
  if (const double into = d * inward; into < 0.01)
  {
    const Tensor<1, dim> along = d - into * inward;
    d = 0.01 * inward + (along.norm() > 0. ? along / along.norm() : Tensor<1, dim>());
  }

  place_exit(piece, face, tip, d);
  const unsigned int exit = piece.faces[1];
  piece.along = d / d.norm();
  piece.at_boundary = {{cell->face(face)->at_boundary(), cell->face(exit)->at_boundary()}};
  return piece;
}

template <int dim>
CrackPiece<dim> continue_onto(const CrackPiece<dim> &other,
                              const unsigned int face,
                              const Point<dim> &tip,
                              const Tensor<1, dim> &direction,
                              std::optional<double> &share)
{
  CrackPiece<dim> piece = piece_in_cell_of(other);
  const Point<dim> &a = piece.corners[face_vertices[face][0]];
  const Tensor<1, dim> edge = piece.corners[face_vertices[face][1]] - a;
  place_end(piece, 0, face, (tip - a) * edge / edge.norm_square());
  piece.ends[0] = tip;

  if (!share)
  {
    const Tensor<1, dim> along = other.ends[1] - other.ends[0], to = other.ends[0] - tip;
    const double determinant = cross(direction, along);
    const double ahead =
      std::abs(determinant) > 1e-12 * along.norm() ? cross(to, along) / determinant : -1.;
    // Away from the ends of the other piece, as crossings are from the corners.
    constexpr double clearance = 0.02;
    // A way that leads off leads to the end of it that is further ahead.
    share = std::clamp(ahead > 0.               ? cross(to, direction) / determinant
                       : along * direction > 0. ? 1.
                                                : 0.,
                       clearance, 1. - clearance);
  }
  piece.faces[1] = piece.faces[0];
  piece.inside[1] = true;
  piece.ends[1] = other.ends[0] + *share * (other.ends[1] - other.ends[0]);
  piece.unit_ends[1] = other.unit_ends[0] + *share * (other.unit_ends[1] - other.unit_ends[0]);
  piece.along = (piece.ends[1] - piece.ends[0]) / piece.length();
  return piece;
}

template <int dim>
CrackPiece<dim> leave_from(const CrackPiece<dim> &other, const Tensor<1, dim> &direction)
{
  CrackPiece<dim> piece = piece_in_cell_of(other);
  piece.faces[0] = 0;
  piece.inside[0] = true;
  piece.ends[0] = other.ends[0] + other.split * (other.ends[1] - other.ends[0]);
  piece.unit_ends[0] = other.unit_ends[0] + other.split * (other.unit_ends[1] - other.unit_ends[0]);
  piece.along = direction / direction.norm();
  place_exit(piece, 4, piece.ends[0], piece.along);
  return piece;
}

template struct CrackPiece<2>;
template struct CrackPath<2>;
template std::vector<CrackSpan> spans_of(const CrackPath<2> &);
template std::uint64_t hash_point<2>(const std::uint64_t, const Point<2> &, const double);
template CrackPiece<2> reversed(const CrackPiece<2> &);
template std::array<unsigned char, 4>
constrained_components(const MeshView<2> &, const dealii::DoFHandler<2>::active_cell_iterator &);
template CrackPath<2> cut_polyline(const MeshView<2> &,
                                   const std::vector<Point<2>> &,
                                   const double,
                                   const Collectives &,
                                   const bool);
template CrackPiece<2> continue_into<2>(const dealii::DoFHandler<2>::active_cell_iterator &,
                                        const unsigned int,
                                        const Point<2> &,
                                        const Tensor<1, 2> &);
template CrackPiece<2> continue_onto(const CrackPiece<2> &,
                                     const unsigned int,
                                     const Point<2> &,
                                     const Tensor<1, 2> &,
                                     std::optional<double> &);
template CrackPiece<2> leave_from(const CrackPiece<2> &, const Tensor<1, 2> &);
} // namespace stockwork
