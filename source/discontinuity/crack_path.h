#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/cell_id.h>

#include <boost/serialization/array.hpp>

#include "stockwork/exchange/collectives.h"
#include "stockwork/mesh/mesh_view.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stockwork
{
/// First and second vertex of each face of a quadrilateral, in the direction of its unit
/// coordinate.
constexpr unsigned int face_vertices[4][2] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};

/// The straight part of a crack inside one cell. It enters and leaves through faces of the cell and
/// carries all that is needed to know its place and its unknowns without access to the cell, so
/// that every rank can hold every crack.
template <int dim>
struct CrackPiece
{
  static constexpr unsigned int n_corners = 1 << dim;

  dealii::CellId cell;
  dealii::types::material_id region = 0;             ///< of the rock in the cell
  std::array<dealii::Point<dim>, n_corners> corners; ///< vertices of the cell
  std::array<unsigned char, 2> faces;                ///< through which it enters and leaves
  std::array<dealii::Point<dim>, 2> ends;            ///< where it enters and leaves
  std::array<dealii::Point<dim>, 2> unit_ends;       ///< the same in unit-cell coordinates
  std::array<bool, 2> at_boundary{{false, false}};   ///< the face is on the domain's boundary
  std::array<bool, 2> inside{{false, false}};        ///< ends in the cell; its face means nothing

  /// Share of the piece, from its first end, at which its two parts meet: where another crack ends
  /// on it, if one does.
  double split = 0.5;

  /// Unit vector along the crack, from entry to exit. It belongs to the crack and not to the mesh:
  /// a crossing that is kept clear of a vertex turns the line between the ends, but not this
  /// vector.
  dealii::Tensor<1, dim> along;

  /// The crack does not rest at this end: the next piece belongs to the same span, see CrackSpan.
  std::array<bool, 2> joined{{false, false}};

  /// Components of displacement that a boundary condition holds at each corner, one bit each.
  std::array<unsigned char, n_corners> constrained{};

  double length() const
  {
    return ends[0].distance(ends[1]);
  }

  dealii::Point<dim> centre() const
  {
    return ends[0] + 0.5 * (ends[1] - ends[0]);
  }

  /// Unit normal, to the left of `along`: it points from the minus to the plus side.
  dealii::Tensor<1, dim> normal() const;

  /// Whether the face of an end lies across the crack rather than along it. Of two equal ones the
  /// face that is normal to the first unit coordinate.
  bool crosses_transverse_face(const unsigned int end) const;

  /// Normal in unit-cell coordinates, to the plus side, as long as the piece is there.
  dealii::Tensor<1, dim> unit_normal() const;

  /// Is a point of the unit cell on the plus side?
  bool plus_side(const dealii::Point<dim> &unit_point) const;

  /// Size of the cell, the square root of its area [m].
  double cell_size() const;

  /// The same on every rank and on every mesh that keeps this cell.
  std::uint64_t key(const double domain_size) const;

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &cell &region &corners &faces &ends &unit_ends &at_boundary &inside &split &along &joined
      &constrained;
  }
};

/// A tip or a mouth: the end of a crack.
enum class CrackEnd : unsigned char
{
  first = 0,
  last = 1
};

/// A crack as a chain of pieces. The last end of a piece is the first end of the next one.
template <int dim>
struct CrackPath
{
  std::vector<CrackPiece<dim>> pieces;
  /// An end that can grow; false at a mouth on the boundary and where growth has stopped.
  std::array<bool, 2> is_tip{{true, true}};
  /// The crack that an end lies on; negative: none. The cell of the end's piece holds both.
  std::array<int, 2> ends_on{{-1, -1}};

  const CrackPiece<dim> &piece_at(const CrackEnd end) const
  {
    return end == CrackEnd::first ? pieces.front() : pieces.back();
  }

  dealii::Point<dim> tip(const CrackEnd end) const
  {
    return piece_at(end).ends[static_cast<int>(end)];
  }

  /// Unit vector out of the crack at an end.
  dealii::Tensor<1, dim> direction(const CrackEnd end) const
  {
    return (end == CrackEnd::first ? -1. : 1.) * piece_at(end).along;
  }

  double length() const;

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &pieces &is_tip &ends_on;
  }
};

/// The part of a crack between two faces that lie across it: one piece, or more where the crack
/// cuts off the corner of a cell on its way. Spans are about as long as a cell whatever the angle
/// and the place of the crack in the mesh. A tip rests at the end of a span only, and the fluid
/// sees a span as one segment: what is short is geometry then, and not physics.
struct CrackSpan
{
  unsigned int first; ///< piece
  unsigned int last;  ///< piece, of the span
};

/// The spans of a crack in their order.
template <int dim>
std::vector<CrackSpan> spans_of(const CrackPath<dim> &path);

/// Crossings stay this share of an edge away from its ends. Larger values trap shallow cracks along
/// a mesh line, smaller ones gain nothing.
constexpr double corner_clearance = 1e-3;

/// In cells: what a tip cuts off less would be a segment to the fluid, and too short to break.
constexpr double shortest_span = 0.25;

/// Cut the mesh along a polyline: the chain of pieces, the same on all ranks.
///
/// Without @p exact_ends a crack consists of whole spans: an end moves along the crack to the
/// nearest face that lies across it. A kink inside a cell is cut short. A vertex on the polyline
/// counts as being on the plus side, so a crack along a mesh line runs `corner_clearance` of an
/// edge beside it.
/// @throws InputError if the crack lies outside the mesh or passes cells of different size
template <int dim>
CrackPath<dim> cut_polyline(const MeshView<dim> &mesh_view,
                            const std::vector<dealii::Point<dim>> &polyline,
                            const double domain_size,
                            const Collectives &collectives,
                            const bool exact_ends = false);

/// The piece that continues a crack from @p tip on face @p face of @p cell along @p direction. The
/// direction keeps a component of at least 0.01 into the cell.
template <int dim>
CrackPiece<dim> continue_into(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                              const unsigned int face,
                              const dealii::Point<dim> &tip,
                              const dealii::Tensor<1, dim> &direction);

/// The piece that continues a crack from @p tip on face @p face of the cell of @p other, and ends
/// on that piece of another crack, in this cell: where the way along @p direction meets it, or as
/// near to that as the other piece goes.
/// @param share of the other piece at which it does; given if something ends there already
template <int dim>
CrackPiece<dim> continue_onto(const CrackPiece<dim> &other,
                              const unsigned int face,
                              const dealii::Point<dim> &tip,
                              const dealii::Tensor<1, dim> &direction,
                              std::optional<double> &share);

/// The piece that leaves another one from where its two parts meet along @p direction.
template <int dim>
CrackPiece<dim> leave_from(const CrackPiece<dim> &other, const dealii::Tensor<1, dim> &direction);

/// A piece with its first and last end exchanged.
template <int dim>
CrackPiece<dim> reversed(const CrackPiece<dim> &piece);

/// Look up which displacements boundary conditions hold at the corners of a cell.
/// @throws InputError where a hanging node meets the crack
template <int dim>
std::array<unsigned char, CrackPiece<dim>::n_corners>
constrained_components(const MeshView<dim> &mesh_view,
                       const typename dealii::DoFHandler<dim>::active_cell_iterator &cell);

/// A hash of integers, for keys.
std::uint64_t hash_combine(const std::uint64_t seed, const std::int64_t value);

/// A hash of a place, exact to 1e-9 of the size of the domain.
template <int dim>
std::uint64_t
hash_point(const std::uint64_t seed, const dealii::Point<dim> &point, const double domain_size);
} // namespace stockwork
