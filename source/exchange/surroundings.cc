#include "stockwork/exchange/surroundings.h"

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace stockwork
{
using dealii::Point;

template <int dim>
struct Surroundings<dim>::Tree
{
  dealii::RTree<Point<dim>> of_places;
};


template <int dim>
Surroundings<dim>::Surroundings(const std::vector<Point<dim>> &places, const double reach)
  : tree(std::make_shared<const Tree>(Tree{dealii::pack_rtree(places)}))
  , reach(reach)
{
}


template <int dim>
bool Surroundings<dim>::include(const Point<dim> &centre, const double radius) const
{
  std::vector<Point<dim>> nearest;
  tree->of_places.query(boost::geometry::index::nearest(centre, 1), std::back_inserter(nearest));
  return !nearest.empty() && nearest[0].distance(centre) < reach + radius;
}


template <int dim>
std::vector<Point<dim>> in_blocks(const std::vector<Point<dim>> &places, const double block)
{
  std::set<std::array<long, dim>> indices;
  for (const Point<dim> &place : places)
  {
    std::array<long, dim> index;
    for (unsigned int d = 0; d < dim; ++d)
      index[d] = std::lround(place[d] / block);
    indices.insert(index);
  }
  std::vector<Point<dim>> middles;
  for (const auto &index : indices)
  {
    Point<dim> &middle = middles.emplace_back();
    for (unsigned int d = 0; d < dim; ++d)
      middle[d] = block * index[d];
  }
  return middles;
}


namespace
{
template <int dim, class IsNear>
void request_size_where(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                        const IsNear &is_near,
                        const double size,
                        std::vector<float> &sizes)
{
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && is_near(cell->center(), 0.5 * cell->diameter()))
      sizes[cell->active_cell_index()] =
        std::min(sizes[cell->active_cell_index()], static_cast<float>(size));
}
} // namespace


template <int dim>
void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                       const Surroundings<dim> &surroundings,
                       const double size,
                       std::vector<float> &sizes)
{
  request_size_where(
    triangulation,
    [&](const Point<dim> &centre, const double radius)
    { return surroundings.include(centre, radius); },
    size, sizes);
}


template <int dim>
void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                       const std::vector<InitialCrack<dim>> &cracks,
                       const double reach,
                       const double size,
                       std::vector<float> &sizes)
{
  request_size_where(
    triangulation,
    [&](const Point<dim> &centre, const double radius)
    {
      return std::any_of(cracks.begin(), cracks.end(),
                         [&](const InitialCrack<dim> &crack)
                         { return crack.distance(centre) < reach + radius; });
    },
    size, sizes);
}


#define INSTANTIATE(dim)                                                                          \
  template class Surroundings<dim>;                                                               \
  template std::vector<Point<dim>> in_blocks(const std::vector<Point<dim>> &, const double);      \
  template void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &,      \
                                  const Surroundings<dim> &, const double, std::vector<float> &); \
  template void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &,      \
                                  const std::vector<InitialCrack<dim>> &, const double,           \
                                  const double, std::vector<float> &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork
