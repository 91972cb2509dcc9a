#include "fracture/peridynamics/rows_of_nodes.h"

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;

namespace
{
/// Where other cracks are as seen from the legs of one that are along rows of nodes, farther away
/// than a cell.
struct Others
{
  bool left = false, right = false;
};

/// Of a crack without such legs, or that is no path: nowhere.
template <int dim>
Others others_beside(const unsigned int number, const Lattice<dim> &lattice)
{
  Others others;
  if (!lattice.parameters.tracked || lattice.zone.sites().empty())
    return others;
  const std::vector<InitialCrack<dim>> &cracks = lattice.scene.cracks;
  const InitialCrack<dim> &crack = cracks[number];
  if constexpr (dim == 2)
    for (unsigned int leg = 0; leg + 1 < crack.points.size(); ++leg)
    {
      const double h = lattice.zone.spacing();
      const Tensor<1, dim> along = crack.points[leg + 1] - crack.points[leg],
                           left = cross_product_2d(-along) / along.norm();
      const double rows =
        (lattice.zone.position(lattice.zone.sites()[0].place) - crack.points[leg]) * left / h;
      if (std::abs(along[0] * along[1]) > same_place * along.norm_square() ||
          std::abs(rows - std::round(rows)) > same_place)
        continue;
      for (unsigned int other = 0; other < cracks.size(); ++other)
        for (const Point<dim> &point : cracks[other].points)
        {
          const double distance = (point - crack.points[leg]) * left;
          others.left |= other != number && distance > h;
          others.right |= other != number && distance < -h;
        }
    }
  return others;
}
} // namespace


template <int dim>
std::vector<InitialCrack<dim>> oriented_cracks(const Lattice<dim> &lattice)
{
  std::vector<InitialCrack<dim>> cracks = lattice.scene.cracks;
  for (unsigned int c = 0; c < cracks.size(); ++c)
    if (const Others others = others_beside(c, lattice); others.left && !others.right)
      std::reverse(cracks[c].points.begin(), cracks[c].points.end());
  return cracks;
}


template <int dim>
std::vector<std::string> foresee_rows_of_nodes(const Lattice<dim> &lattice)
{
  std::vector<std::string> messages;
  for (unsigned int c = 0; c < lattice.scene.cracks.size(); ++c)
    if (const Others others = others_beside(c, lattice); others.left && others.right)
      messages.push_back(
        "The crack '" + lattice.scene.cracks[c].text +
        "' lies on a row of nodes, which belong to its left side, between other cracks. If a "
        "fracture comes from the left and meets it, the opening where they meet is read far too "
        "small (with a pressure at the well 30 % too high). If one comes only from there, list its "
        "ends in the other order; or move it to the left by a part of a cell.");
  return messages;
}

#define INSTANTIATE(dim)                                                         \
  template std::vector<InitialCrack<dim>> oriented_cracks(const Lattice<dim> &); \
  template std::vector<std::string> foresee_rows_of_nodes(const Lattice<dim> &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
