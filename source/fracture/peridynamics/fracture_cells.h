#pragma once

#include "fracture/peridynamics/bond_set.h"
#include "stockwork/exchange/segment.h"

#include <functional>

namespace stockwork::peridynamics
{
/// A cell that a fracture passes through.
template <int dim>
struct FractureCell
{
  Place<dim> place;
  dealii::Tensor<1, dim> normal; ///< unit

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &place &normal;
  }
};

/// The cells with enough of their own bonds (between two of their corners) broken that cross the
/// fracture: two of them, seven in space. Its normal is the direction of most of the broken bonds
/// of the cell's corners. In the order of the places. If the zone is divided, those of this rank.
template <int dim>
std::vector<FractureCell<dim>> find_fracture_cells(const Zone<dim> &zone,
                                                   const BondSet<dim> &bonds);

/// Where the fracture cells within @p radius cells lie along a line (plane), normals are those of
/// that line: what is broken around a tip alone is too few bonds to tell, and a normal that is
/// wrong there loads the faces unevenly and turns the fracture.
/// @param cells in the order of the places
/// @param is_settled of the place of a cell whose normal is to stay as it is
template <int dim>
void align_normals(std::vector<FractureCell<dim>> &cells,
                   const unsigned int radius,
                   const std::function<bool(const Place<dim> &)> &is_settled);

/// Mean damage of the bonds of the cell's corners that lead across the fracture: one where nothing
/// holds any more, less within a horizon of a tip.
/// @param damage of a bond, from its site and its number
template <int dim>
double broken_share(const Zone<dim> &zone,
                    const std::vector<StencilBond<dim>> &stencil,
                    const FractureCell<dim> &cell,
                    const std::function<double(unsigned int, unsigned int)> &damage);

/// Whether a cell is beside a fracture rather than in it: one across from it, no farther than @p
/// reach cells, with the same normal, is open ten times as wide. Of a fracture that is oblique to
/// the mesh and hardly open, cells are so as well.
template <int dim>
bool is_beside(const std::vector<FractureCell<dim>> &cells,
               const std::vector<double> &apertures,
               const double reach,
               const unsigned int cell);

/// Area of the fracture in a cell, such that a long one has the right area in all [m^(dim-1)]: a
/// plane passes through |n_x| + |n_y| (+ |n_z|) cells per area of a face.
template <int dim>
double fracture_area(const dealii::Tensor<1, dim> &normal, const double spacing);

/// Jump of the displacement over a fracture cell that each displacement of its corners makes: the
/// cell's volume over the fracture's area times 2 t.eps.n in a direction t of the fracture, and
/// n.eps.n along the normal, eps being the strain at the centre. Then area times opening is volume
/// times n.eps.n, and summed over the cells of a fracture it is what its faces enclose. In the
/// order of the corners, and at each of the components.
template <int dim>
std::vector<dealii::Tensor<1, dim>> jumps(const Zone<dim> &zone, const FractureCell<dim> &cell);

/// Segments of all fracture cells, with opening and pore pressure, if the zone is divided of this
/// rank's; pressures are left to the model.
/// In space, of a fracture oblique to the mesh, conductances between neighbours are approximate.
/// @param cells in the order of the places
template <int dim>
std::vector<Segment<dim>> make_segments(const Zone<dim> &zone,
                                        const std::vector<FractureCell<dim>> &cells);

/// Does the fracture end at this cell, within rock? A segment's `at_tip` says so in 2-D, of ends
/// where the pressure is singular along the fracture.
template <int dim>
bool is_at_front(const Zone<dim> &zone, const FractureCell<dim> &cell, const Segment<dim> &segment);
} // namespace stockwork::peridynamics
