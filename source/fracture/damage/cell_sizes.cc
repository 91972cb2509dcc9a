#include "fracture/damage/damage.h"
#include "mesh/geometry.h"
#include "stockwork/exchange/surroundings.h"

#include <algorithm>
#include <cmath>

namespace stockwork::damage
{
using dealii::Point;

/// A crack passes cells of one level only: those along it, and ahead of its front more of them than
/// it needs, in blocks, so that they are not asked for anew whenever it has grown by a cell; a
/// change of the mesh costs all that has been computed with the old one. Cells whose parent would
/// be split again stay as they are.
template <int dim>
void Damage<dim>::wanted_cell_size(
  const dealii::parallel::distributed::Triangulation<dim> &triangulation,
  std::vector<float> &sizes) const
{
  if (!mesh_view)
  {
    if (parameters.cell_size > 0.)
      request_cell_size(triangulation, scene.cracks, parameters.rings_ahead * parameters.cell_size,
                        parameters.cell_size, sizes);
    return;
  }

  double h = 0.;
  unsigned int level = 0;
  for (const CrackCell<dim> &crack : band.cells)
  {
    h = std::max(h, crack.size());
    level = std::max<unsigned int>(level, crack.id.get_child_indices().size());
  }
  // In three dimensions cells are dearer than another mesh now and then.
  const double block = (dim == 2 ? 2. : 1.) * parameters.rings_ahead * h;
  std::vector<Point<dim>> along, front;
  for (unsigned int i = 0; i < band.cells.size(); ++i)
  {
    const Point<dim> centre = band.cells[i].centre();
    along.push_back(centre);
    if (parameters.growth && band.is_front(i))
      front.push_back(centre);
  }
  const Surroundings<dim> of_cells(along, 1.5 * h),
    of_front(in_blocks(front, block),
             0.5 * parameters.rings_ahead * h + 0.5 * std::sqrt(double(dim)) * block);
  // It is the level that is asked for: on a mesh whose cells grow, the size would differ from cell
  // to cell and leave hanging nodes on the way.
  const auto is_near = [&](const auto &cell)
  {
    const Point<dim> centre = cell->center();
    const double radius = 0.5 * cell->diameter();
    return of_cells.include(centre, radius) || of_front.include(centre, radius);
  };
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->level() <= static_cast<int>(level))
    {
      const int missing = static_cast<int>(level) - cell->level();
      float &size = sizes[cell->active_cell_index()];
      if (missing > 0 && is_near(cell))
        size = std::min(size, static_cast<float>(std::ldexp(cell_size(cell), -missing)));
      else if (cell->level() > 0 && is_near(cell->parent()))
        size = std::min(size, static_cast<float>(cell_size(cell)));
    }
}


template void Damage<2>::wanted_cell_size(const dealii::parallel::distributed::Triangulation<2> &,
                                          std::vector<float> &) const;
template void Damage<3>::wanted_cell_size(const dealii::parallel::distributed::Triangulation<3> &,
                                          std::vector<float> &) const;
} // namespace stockwork::damage
