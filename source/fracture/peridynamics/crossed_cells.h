#pragma once

#include "fracture/peridynamics/bond_law.h"
#include "fracture/peridynamics/fracture_cells.h"

#include <boost/container/static_vector.hpp>
#include <boost/functional/hash.hpp>

#include <unordered_map>
#include <utility>

namespace stockwork::peridynamics
{
/// Fracture cells that a bond belongs to, by index, with shares that add up to one; none where no
/// fracture is near. A bond that crosses the fracture right where two cells meet belongs to both.
using CellShares = boost::container::static_vector<std::pair<unsigned int, double>, 8>;

/// Which fracture cells' fluid a bond feels, and which of them the volume belongs to that it gives
/// the fluid: the cell where it crosses the fracture, or ahead of a tip the plane of it, no farther
/// than a horizon and one cell from there. Beyond a plane of symmetry there are the cells' images.
template <int dim>
class CrossedCells
{
public:
  void reinit(const Zone<dim> &zone,
              const std::vector<StencilBond<dim>> &stencil,
              const std::vector<FractureCell<dim>> &cells,
              const unsigned int horizon);

  /// @param always of a bond that crosses no cell's plane, the cells that are nearest to its middle
  CellShares of(unsigned int site, unsigned int bond, bool always) const;

private:
  void find_nearby();

  struct Image
  {
    unsigned int cell;
    dealii::Tensor<1, dim> normal;
  };

  /// A cell about the middle of a bond.
  struct Nearby
  {
    Place<dim> offset; ///< from the place whose components are those of the middle, rounded down
    double distance;   ///< of the centre from the middle, in spacings
  };

  const Zone<dim> *zone = nullptr;
  std::vector<StencilBond<dim>> stencil;
  unsigned int horizon = 0;
  /// By the place of the cell or of the image.
  std::unordered_map<Place<dim>, Image, boost::hash<Place<dim>>> cells_at;
  /// The nearest first. Bit d of the index: in direction d the middle is half-way between places.
  std::array<std::vector<Nearby>, 1 << dim> nearby;
};
} // namespace stockwork::peridynamics
