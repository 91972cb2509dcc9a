#pragma once

#include <deal.II/base/bounding_box.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include "fracture/peridynamics/far_ends.h"
#include "fracture/peridynamics/stencil.h"
#include "stockwork/base/error.h"
#include "stockwork/exchange/collectives.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/mesh/mesh_view.h"

#include <array>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace stockwork::peridynamics
{
/// That the mesh is such that there is no lattice.
inline EntryError unsuitable_mesh(const std::string &why)
{
  return EntryError("Fracture/Model", "peridynamics", "a model that suits the mesh. " + why);
}

/// Places that are nearer to one another are the same [spacings].
constexpr double same_place = 1e-6;

/// Place of a vertex on the lattice, in spacings from its origin.
template <int dim>
using Place = std::array<int, dim>;

/// Where rock is made of bonds: around the initial cracks, and in boxes that the deck names.
template <int dim>
struct ZoneShape
{
  std::vector<InitialCrack<dim>> cracks;
  std::vector<dealii::BoundingBox<dim>> boxes;
  double margin; ///< of cells around the cracks

  /// How far a point is outside, at lattice spacing h [m]; negative or zero inside.
  double distance(const dealii::Point<dim> &point, double spacing) const;

  /// At lattice spacing h [m], enlarged by so many cells.
  bool contains(const dealii::Point<dim> &point, double spacing, double enlarged_by = 0.) const;
};

/// A vertex of the uniform cells in the zone or around it.
template <int dim>
struct Site
{
  Place<dim> place;
  std::array<dealii::types::global_dof_index, dim> dofs;
  dealii::types::global_dof_index pressure_dof = dealii::numbers::invalid_dof_index;
  unsigned int owner = 0;   ///< the rank that gives its values; of a peridynamic site, of its rows
  bool peridynamic = false; ///< its momentum rows are bonds'
  bool has_bonds = false;   ///< it is peridynamic, and the far ends of its bonds are known here
  double share = 1.;        ///< of its cell that lies in the domain: a half on a plane of symmetry
  double volume = 1.;       ///< of its cell and its images that is rock: a half on a free boundary

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &place &dofs &pressure_dof &owner &share;
  }
};

/// Of a box, the lower and the upper bound in each direction [m].
template <int dim>
using Bounds = std::array<std::array<double, 2>, dim>;

/// The largest box that a zone may fill which is not to come nearer than a distance to any of the
/// obstacles. It holds the zone itself, whatever is near that.
/// @param obstacles known to this rank
/// @param bounds in which to look
/// @param distance [m]
template <int dim>
dealii::BoundingBox<dim> room_among(const std::vector<dealii::BoundingBox<dim>> &obstacles,
                                    const dealii::BoundingBox<dim> &zone,
                                    Bounds<dim> bounds,
                                    double distance,
                                    const Collectives &collectives);

/// The lattice: vertices of the cells that are uniform in and around the zone, and which of them
/// are peridynamic. The same on every rank, so that a horizon may cross any number of them; the
/// zone is a thin one around the cracks. Or, in a zone that is all of the rock, what each rank
/// needs: the bonds of all sites no farther than a horizon from its cells, and the sites that these
/// lead to. Sites are numbered on each rank then, in the same order.
template <int dim>
class Zone
{
public:
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;

  /// @param spacing [m]; zero: the edge of the smallest cell in the zone
  /// @param with_rim whether the bonds of sites count that a bond leads to from the zone
  /// @param moves_side whether a side of the domain is moved, and so no plane of symmetry
  /// @param divided whether each rank is to know no more than it needs
  /// @param free_boundaries whether a horizon may leave the domain through a boundary that is not a
  /// plane of symmetry, where bonds are absent then
  /// @throws InputError where cells in the zone differ, or a horizon leaves the domain and may not
  void setup(const ZoneShape<dim> &shape,
             double spacing,
             const std::vector<StencilBond<dim>> &stencil,
             const bool with_rim,
             const bool divided,
             const std::function<bool(dealii::types::boundary_id)> &moves_side,
             const bool free_boundaries,
             const MeshView<dim> &mesh_view,
             const Collectives &collectives);

  /// Whether this rank knows no more than it needs.
  bool is_divided() const
  {
    return knows_own_part;
  }

  /// Where place 0 is; of an earlier run, before the first setup().
  void set_origin(const dealii::Point<dim> &point);

  const dealii::Point<dim> &origin() const
  {
    return corner;
  }

  double spacing() const
  {
    return h;
  }

  /// Whether a point is inside the domain, and by so much.
  bool is_inside(const dealii::Point<dim> &point, const double distance) const
  {
    bool inside = true;
    for (unsigned int d = 0; d < dim; ++d)
      inside = inside && point[d] > domain.lower_bound(d) + distance &&
               point[d] < domain.upper_bound(d) - distance;
    return inside;
  }

  /// The box that holds the rock.
  const dealii::BoundingBox<dim> &all_rock() const
  {
    return domain;
  }

  /// A side that the deck moves and that is nearer than this to a peridynamic site, but holds none
  /// of them back as a plane of symmetry: direction and side.
  std::optional<std::array<unsigned int, 2>> moved_side_within(double distance) const;

  /// The largest box that the zone may fill: a horizon away from the boundaries of the domain that
  /// are not known to be planes of symmetry, and from cells that cannot be halved until they are
  /// those of the lattice.
  const dealii::BoundingBox<dim> &room() const
  {
    return largest;
  }

  /// Sorted by place.
  const std::vector<Site<dim>> &sites() const
  {
    return all_sites;
  }

  /// Numbers of those sites that are peridynamic and whose bonds are known.
  const std::vector<unsigned int> &peridynamic_sites() const
  {
    return inner_sites;
  }

  /// Peridynamic ones, of all ranks.
  unsigned int n_peridynamic_sites() const
  {
    return n_inner_sites;
  }

  /// Numbers of the sites beside the zone whose bonds are known, if asked for.
  const std::vector<unsigned int> &rim_sites() const
  {
    return outer_sites;
  }

  /// Invalid if there is none.
  unsigned int find(const Place<dim> &place) const;

  dealii::Point<dim> position(const Place<dim> &place) const;

  /// Far end of a bond of a site that has bonds, or of one of the rim.
  FarEnd far_end(const unsigned int site, const unsigned int bond) const
  {
    return far_ends(site, bond);
  }

  /// Of the bonds of a peridynamic site, the share by volume that is beyond free boundaries.
  double absent_share(const unsigned int site, const std::vector<StencilBond<dim>> &stencil) const;

  /// Planes of symmetry that a place lies on: bit d, one normal to direction d.
  unsigned int planes_of(const Place<dim> &place) const;

  /// Call `use(place, mirrored)` for a cell, and for its images beyond planes of symmetry that are
  /// no farther than @p reach cells from it.
  template <class Function>
  void for_each_image(const Place<dim> &cell, const int reach, const Function &use) const;

  /// Lower corners of the cells whose corners all have bonds.
  const std::vector<Place<dim>> &cells() const
  {
    return inner_cells;
  }

  /// Whether this rank owns that cell.
  bool owns(const Place<dim> &cell) const
  {
    return owned_cells.count(cell) != 0;
  }

  /// Lower corners of the cells of the lattice that this rank owns, in the zone and around it, with
  /// their active cell indices.
  const std::map<Place<dim>, unsigned int> &cells_of_this_rank() const
  {
    return owned_cells;
  }

  /// Active cell index of a cell that this rank owns.
  unsigned int active_cell_index(const Place<dim> &cell) const
  {
    return owned_cells.at(cell);
  }

  unsigned int n_active_cells() const
  {
    return pattern_of_cell.size();
  }

  /// Which of the cell's vertices are peridynamic, or null for none of them.
  const std::vector<bool> *skipped_rows(const unsigned int active_cell_index) const;

  /// Displacement of all sites, [site * dim + component]. Collective.
  std::vector<double> displacement(const dealii::TrilinosWrappers::MPI::BlockVector &bulk,
                                   const Collectives &collectives) const;

private:
  void find_spacing(const ZoneShape<dim> &, const MeshView<dim> &, const Collectives &);
  void gather_sites(const ZoneShape<dim> &,
                    unsigned int reach,
                    const std::function<bool(dealii::types::boundary_id)> &moves_side,
                    const MeshView<dim> &,
                    const Collectives &);
  /// For a zone between the vertices `first` and `last`.
  void find_room(const dealii::Point<dim> &first,
                 const dealii::Point<dim> &last,
                 unsigned int reach,
                 const MeshView<dim> &,
                 const Collectives &);
  void find_volumes();

  /// Leave the sites that are needed here, and mark those that have bonds.
  void leave_what_is_needed(int reach);

  void find_far_ends(const std::vector<StencilBond<dim>> &stencil,
                     const bool with_rim,
                     const Collectives &);

  /// Where a bond leads to no site, although there has to be one, and why.
  using Missing = std::pair<Place<dim>, std::string>;

  /// @param ends become those of the site
  /// @param missing the first of these, if empty so far
  void find_far_ends_of(const unsigned int site,
                        const std::vector<StencilBond<dim>> &stencil,
                        std::vector<FarEnd> &ends,
                        std::vector<Missing> &missing);

  dealii::Point<dim> corner;
  bool has_corner = false;
  double h = 0.;

  std::vector<Site<dim>> all_sites;
  std::vector<unsigned int> inner_sites, outer_sites;
  FarEnds far_ends; ///< of these sites
  std::vector<Place<dim>> inner_cells;
  std::map<Place<dim>, unsigned int> owned_cells;
  std::vector<unsigned int> pattern_of_cell; ///< by active cell index, bit v: vertex v
  std::vector<std::vector<bool>> patterns;

  /// Planes of symmetry: the place along each direction, of the lower and of the upper one.
  static constexpr int no_mirror = std::numeric_limits<int>::min();
  std::array<std::array<int, 2>, dim> mirrors;
  std::array<std::array<bool, 2>, dim> moved{}; ///< sides near the zone that the deck moves
  dealii::BoundingBox<dim> domain, largest;
  unsigned int rank = 0, n_inner_sites = 0;
  bool has_free_boundaries = false, knows_own_part = false;
};


template <int dim>
template <class Function>
void Zone<dim>::for_each_image(const Place<dim> &cell, const int reach, const Function &use) const
{
  // In each direction the cell itself, and its image in one plane or the other.
  unsigned int n = 1;
  for (unsigned int d = 0; d < dim; ++d)
    n *= 3;
  for (unsigned int k = 0; k < n; ++k)
  {
    Place<dim> place = cell;
    unsigned int mirrored = 0;
    bool is_near = true;
    for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= 3)
      if (rest % 3 != 0)
      {
        const int m = mirrors[d][rest % 3 - 1];
        is_near = is_near && m != no_mirror && std::abs(m - cell[d]) <= reach;
        if (!is_near)
          break;
        place[d] = 2 * m - cell[d] - 1;
        mirrored |= 1u << d;
      }
    if (is_near)
      use(place, mirrored);
  }
}
} // namespace stockwork::peridynamics
