// Whether the boxes of the deck and the cells of the mesh go together.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "mesh/box_list.h"
#include "mesh/geometry.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork
{
using namespace dealii;

template <int dim>
void Geometry<dim>::check_boxes(const Triangulation &triangulation) const
{
  for (const RefinementBox &item : refinement_boxes)
    for (unsigned int d = 0; d < dim; ++d)
      if (item.box.upper_bound(d) <= lower()[d] || item.box.lower_bound(d) >= upper()[d])
        throw EntryError("Mesh/Refinement boxes", to_string(item.box),
                         "boxes that hold some of the mesh: this one lies beside it");
  const std::size_t n_regions = region_boxes.size();
  std::vector<unsigned int> n_held(n_regions + side_boxes.size(), 0); // cells, then faces
  const auto count = [&](const auto &boxes, const std::size_t first, const Point<dim> &point)
  {
    for (std::size_t i = boxes.size(); i-- > 0;)
      if (boxes[i].box.point_inside(point))
      {
        ++n_held[first + i]; // the last one, which is on top
        return;
      }
  };
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      count(region_boxes, 0, cell->center());
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          count(side_boxes, n_regions, cell->face(f)->center());
    }
  Utilities::MPI::sum(n_held, triangulation.get_communicator(), n_held);
  const auto refuse_empty =
    [&](const auto &boxes, const std::size_t first, const std::string &name, const std::string &of)
  {
    for (unsigned int i = 0; i < boxes.size(); ++i)
      if (n_held[first + i] == 0)
        throw EntryError(
          "Mesh/" + name, boxes[i].label + ": " + to_string(boxes[i].box),
          "boxes that hold the centre of a " + of +
            ": this one lies beside the mesh, is smaller than its cells, or lies beneath "
            "later ones");
  };
  refuse_empty(region_boxes, 0, "Region boxes", "cell");
  refuse_empty(side_boxes, n_regions, "Side boxes", "face of the boundary");
}


template <int dim>
std::vector<std::string> Geometry<dim>::misfits_of_regions(const Triangulation &triangulation) const
{
  constexpr double tolerated = 0.25;
  std::vector<std::string> texts;
  if (cells != Cells::cartesian)
    return texts;
  for (const RegionBox &item : region_boxes)
  {
    std::vector<double> first(dim, std::numeric_limits<double>::infinity()), last(dim, -first[0]);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && item.box.point_inside(cell->center()))
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double half = 0.5 * cell->extent_in_direction(d);
          first[d] = std::min(first[d], cell->center()[d] - half);
          last[d] = std::max(last[d], cell->center()[d] + half);
        }
    Utilities::MPI::min(first, triangulation.get_communicator(), first);
    Utilities::MPI::max(last, triangulation.get_communicator(), last);
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double given = std::min(item.box.upper_bound(d), upper()[d]) -
                           std::max(item.box.lower_bound(d), lower()[d]),
                   of_cells = last[d] - first[d];
      if (!(std::abs(of_cells - given) > tolerated * given))
        continue;
      std::ostringstream text;
      text
        << "Region '" << item.label << "' ('Mesh/Region boxes') is " << given << " m in "
        << "xyz"[d] << " by the deck, and " << of_cells
        << " m by its cells: a cell belongs to the box that holds its centre. Put the edges of "
           "the box on lines of the mesh, or take smaller cells there ('Mesh/Refinement boxes').";
      texts.push_back(text.str());
    }
  }
  return texts;
}


#define INSTANTIATE(dim)                                                 \
  template void Geometry<dim>::check_boxes(const Triangulation &) const; \
  template std::vector<std::string> Geometry<dim>::misfits_of_regions(const Triangulation &) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork
