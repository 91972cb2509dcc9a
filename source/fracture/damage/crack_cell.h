#pragma once

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/grid/cell_id.h>

#include <boost/serialization/array.hpp>

#include <array>
#include <cstdint>

namespace stockwork::damage
{
/// A cell that is cracked: the crack parts its vertices into those on its plus and those on its
/// minus side. It holds all that is needed to know the crack without access to the mesh, so that
/// every rank can hold every cracked cell.
///
/// With phi = sum of the Q1 functions of the vertices on the plus side, a jump a adds the strain
/// -sym(a grad phi) to that of the nodes. Two bodies that move apart as they are then leave no
/// stress in the cells between them, along whatever stairs these lie; a strain -sym(a n)/h, which
/// is what a damaged stiffness makes of it, would leave some wherever n is not normal to the mesh.
/// The jump may be that of a rigid body that turns as well (Linder and Armero 2007 call such jumps
/// linear); then that holds in the mean over a cell where both sides have as many vertices.
template <int dim>
struct CrackCell
{
  static constexpr unsigned int n_vertices = 1 << dim;
  static constexpr unsigned int n_points = 1 << (dim - 1);

  dealii::CellId id;
  dealii::types::material_id region = 0;
  std::array<dealii::Point<dim>, n_vertices> vertices;
  dealii::Tensor<1, dim> normal;           ///< unit, to the plus side; fixed once cracked
  dealii::Point<dim> on_plane;             ///< a point of the crack in or near the cell
  unsigned int plus = 0;                   ///< vertices on the plus side, one bit each
  std::array<double, n_points> greatest{}; ///< equivalent opening reached, committed [m]
  double carried = 0.;                     ///< by faces that touch: normal traction, committed [Pa]
  dealii::Tensor<1, dim> slip; ///< by which they have rubbed, committed, see ContactLaw [m]
  dealii::Tensor<1, dim> held; ///< shear traction in situ, which the seam holds while intact [Pa]
  double reached = 1.;         ///< committed: share to which the fluid has come
  bool bare = false;         ///< no strength was left behind it when it cracked, nor a process zone
  unsigned int boundary = 0; ///< faces on the domain's boundary, one bit each

  dealii::Point<dim> centre() const;

  /// Whether the crack passes through a face: it has vertices on either side.
  bool crosses(unsigned int face) const;

  bool is_on_plus_side(const unsigned int vertex) const
  {
    return (plus >> vertex) & 1;
  }

  bool is_at_boundary(const unsigned int face) const
  {
    return (boundary >> face) & 1;
  }

  /// Whether there are vertices on either side.
  bool is_cut() const
  {
    return plus != 0 && plus != (1u << n_vertices) - 1;
  }

  /// Whether each side has as many vertices as the other, so that these know how the sides turn.
  bool is_cut_evenly() const
  {
    unsigned int n = 0;
    for (unsigned int v = 0; v < n_vertices; ++v)
      n += is_on_plus_side(v);
    return 2 * n == n_vertices;
  }

  /// Angle between the crack and the nearest direction of the mesh's lines [degrees].
  double angle_to_mesh() const;

  /// Put the vertices on the sides of the plane through on_plane; those on it on the minus side.
  void part_by_plane();

  /// Area of the crack, n . int grad phi [m^2], [m] in 2-D. Summed over the cells that a plane
  /// passes, the plane's own.
  double area() const;

  double volume() const;

  /// By how much int grad phi / A, whose component across the crack is one, points along it: zero
  /// where the stairs of cells lie along the crack.
  dealii::Tensor<1, dim> lean() const;

  /// Size of the cell across the crack [m].
  double size_across() const
  {
    return volume() / area();
  }

  /// Middle of the crack in the cell: its centre, moved onto the plane.
  dealii::Point<dim> middle() const
  {
    const dealii::Point<dim> c = centre();
    return c - ((c - on_plane) * normal) * normal;
  }

  /// Unit vectors along the crack, along the cell's edges as far as possible.
  std::array<dealii::Tensor<1, dim>, dim - 1> axes() const;

  /// Points of the crack, from middle(), that share its area: Gauss points of a square.
  std::array<dealii::Tensor<1, dim>, n_points> points() const;

  /// Length of a side [m].
  double size() const;

  dealii::Point<dim> face_centre(unsigned int face) const;

  /// Where the plane of the crack meets the edges of a face that it crosses, on average.
  dealii::Point<dim> crossing(unsigned int face) const;

  std::uint64_t key() const;

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &id &region &vertices &normal &on_plane &plus &greatest;
    ar &carried &slip &held &reached &bare &boundary;
  }

private:
  /// int grad phi over the cell, by the mean Jacobian.
  dealii::Tensor<1, dim> gradient_integral(double &volume) const;
};
} // namespace stockwork::damage
