#pragma once

#include "mesh/box_list.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/types.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/mapping.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace stockwork
{
/// The domain of a case and its initial mesh, as subsection Mesh of the deck describes them:
/// shape, names of the sides and regions, cell sizes.
///
/// Sides of a box are called left, right (x), bottom, top (y in 2-D, z in 3-D) and front, back (y
/// in 3-D). A quarter disc has left (x = 0), bottom (y = 0) and surface, an octant of a ball left,
/// front, bottom and surface; a quarter ring or an octant of a shell has a wall inside as well. A
/// gmsh file names its own, by its physical groups.
template <int dim>
class Geometry
{
public:
  using Triangulation = dealii::parallel::distributed::Triangulation<dim>;

  static void declare_parameters(dealii::ParameterHandler &prm);

  /// @param deck_directory where a relative name of a mesh file starts
  /// @throws InputError for whatever cannot be built; nothing is left to fail later
  void parse_parameters(dealii::ParameterHandler &prm, const std::string &deck_directory = ".");

  /// The initial mesh: coarse cells, uniform refinement and the refinement boxes. The
  /// triangulation must be empty; if it shares cells out on request only, children are still with
  /// their parents' ranks. Regions and sides are set now and after every later change of the
  /// mesh.
  /// @throws EntryError if that makes too many cells
  void create(Triangulation &triangulation) const;

  /// The coarse cells of create() alone: what Triangulation::load() needs on a restart.
  void create_coarse(Triangulation &triangulation) const;

  /// Whether the initial mesh splits a cell of this place and size (again), so that coarsening must
  /// not bring it back.
  bool splits(const typename dealii::Triangulation<dim>::cell_iterator &cell) const;

  /// The map from the unit cell that fits the shape: Cartesian for boxes, quadratic where the
  /// boundary is curved.
  std::unique_ptr<dealii::Mapping<dim>> mapping() const;

  /// @throws InputError naming the known sides
  dealii::types::boundary_id side(const std::string &name) const;

  std::vector<std::string> side_names() const;

  /// More cells than this end the run with a message.
  unsigned int maximum_number_of_cells() const
  {
    return max_cells;
  }

  /// A region by its name. @throws InputError naming the known regions
  dealii::types::material_id region(const std::string &name) const;

  /// The region of a cell of a mesh that create() has made, active or not.
  dealii::types::material_id
  region(const typename dealii::Triangulation<dim>::cell_iterator &cell) const;

  /// Whether cells have other regions than their parents: boxes, whose edges lie anywhere.
  bool has_region_boxes() const
  {
    return !region_boxes.empty();
  }

  /// All regions but the unnamed one, 0, that everything else belongs to.
  std::vector<std::string> region_names() const;

  /// @throws EntryError if a box of regions holds the centre of no cell, or a box of refinement
  /// lies beside the mesh: it would do nothing
  void check_boxes(const Triangulation &triangulation) const;

  /// A sentence for each extent of a box of regions that is another by a quarter or more once its
  /// cells are those whose centre it holds. Nothing of shapes that are not boxes. Collective.
  std::vector<std::string> misfits_of_regions(const Triangulation &triangulation) const;

  /// Corners of the bounding box.
  dealii::Point<dim> lower() const;
  dealii::Point<dim> upper() const;

  /// Of the bounding box [m].
  double diameter() const;

  /// Whether a point lies on a side of the bounding box.
  bool on_side(const dealii::Point<dim> &point) const;

  /// Of the hole of a ring or a shell [m]; zero: no hole.
  double hole_radius() const
  {
    return inner_radius;
  }

private:
  /// Before they are made. @throws EntryError if cells, refined so many times, are too many
  void refuse_cells(double n_coarse, unsigned int refinements) const;

  void make_box(dealii::ParameterHandler &prm);
  void make_ball(dealii::ParameterHandler &prm);
  void make_ring(dealii::ParameterHandler &prm);
  /// Cells between the radii, so many along a quarter of a circle; and names of the sides.
  void make_ring_cells(const std::vector<double> &radii, unsigned int n_arc);
  void read_gmsh(dealii::ParameterHandler &prm, const std::string &deck_directory);
  void parse_refinement(dealii::ParameterHandler &prm);
  void parse_regions(dealii::ParameterHandler &prm);
  void parse_sides(dealii::ParameterHandler &prm);
  void set_regions(Triangulation &triangulation) const;
  void set_sides(Triangulation &triangulation) const;

  struct RefinementBox
  {
    dealii::BoundingBox<dim> box;
    double cell_size;
  };
  struct RegionBox
  {
    dealii::BoundingBox<dim> box;
    dealii::types::material_id region;
    std::string label;
  };

  struct SideBox
  {
    dealii::BoundingBox<dim> box;
    dealii::types::boundary_id side;
    std::string label;
  };

  enum class Cells
  {
    cartesian,
    straight,
    curved,
    ring
  };

  /// Manifold of the cells of a quarter disc or octant of a ball; 0 is that of the surface.
  static constexpr dealii::types::manifold_id interior_manifold = 1;

  static constexpr std::array<const char *, 3> spacing_entry{
    {"X spacing", "Y spacing", "Z spacing"}};

  std::shared_ptr<dealii::Triangulation<dim>> coarse;
  Cells cells = Cells::cartesian;
  double inner_radius = 0.; ///< of a ring or a shell
  unsigned int uniform_refinements = 0;
  unsigned int max_cells = 0;
  std::vector<RefinementBox> refinement_boxes;
  std::vector<RegionBox> region_boxes;
  std::vector<SideBox> side_boxes;
  std::map<std::string, dealii::types::boundary_id> sides;
  std::map<std::string, dealii::types::material_id> regions;
  dealii::BoundingBox<dim> bounds;
};

template <>
void Geometry<2>::make_ring_cells(const std::vector<double> &, unsigned int);
template <>
void Geometry<3>::make_ring_cells(const std::vector<double> &, unsigned int);

/// The longest edge of a cell, measured along its axes [m].
template <class CellIterator>
double cell_size(const CellIterator &cell)
{
  double size = 0.;
  for (unsigned int d = 0; d < CellIterator::AccessorType::dimension; ++d)
    size = std::max(size, cell->extent_in_direction(d));
  return size;
}
} // namespace stockwork
