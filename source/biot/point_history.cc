#include "biot/point_history.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/distributed/cell_data_transfer.templates.h>

#include <algorithm>
#include <limits>

namespace stockwork
{
using namespace dealii;

template <int dim>
PointHistory<dim>::PointHistory(const unsigned int n_values, const std::vector<Point<dim>> &points)
  : n(n_values)
  , ordinary_points(points)
{
}


template <int dim>
void PointHistory<dim>::reinit(const unsigned int n_active_cells)
{
  records.assign(n_active_cells, Record());
}


template <int dim>
const double *PointHistory<dim>::nearest(const unsigned int cell,
                                         const Point<dim> &unit_point,
                                         const CutCell<dim> *const cut) const
{
  const Record &record = records[cell];
  const int side = cut != nullptr ? cut->side(unit_point) : 0;
  const double *found = nullptr;
  double least = std::numeric_limits<double>::infinity();
  bool found_across = true;
  for (std::size_t k = 0; k < record.size(); k += dim + n)
  {
    Point<dim> other;
    for (unsigned int d = 0; d < dim; ++d)
      other[d] = record[k + d];
    const double distance = other.distance_square(unit_point);
    const bool across = side != 0 && cut->side(other) != side;
    if (across == found_across ? distance < least : found_across)
    {
      least = distance;
      found = &record[k + dim];
      found_across = across;
    }
  }
  return found;
}


template <int dim>
void PointHistory<dim>::set(const unsigned int cell,
                            const std::vector<Point<dim>> &unit_points,
                            const std::vector<double> &values)
{
  Record &record = records[cell];
  record.resize(unit_points.size() * (dim + n));
  double *out = record.data();
  for (std::size_t q = 0; q < unit_points.size(); ++q)
  {
    for (unsigned int d = 0; d < dim; ++d)
      *out++ = unit_points[q][d];
    out = std::copy_n(values.begin() + q * n, n, out);
  }
}


template <int dim>
std::size_t PointHistory<dim>::bytes() const
{
  std::size_t n_numbers = 0;
  for (const Record &record : records)
    n_numbers += record.size();
  return n_numbers * sizeof(double);
}


template <int dim>
std::vector<typename PointHistory<dim>::Record>
PointHistory<dim>::of_children(const Record &parent, const unsigned int n_children) const
{
  std::vector<Record> children(n_children, parent);
  for (unsigned int c = 0; c < n_children; ++c)
    for (std::size_t k = 0; k < parent.size(); k += dim + n)
    {
      Point<dim> point;
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = parent[k + d];
      point = GeometryInfo<dim>::cell_to_child_coordinates(point, c);
      for (unsigned int d = 0; d < dim; ++d)
        children[c][k + d] = point[d];
    }
  return children;
}


template <int dim>
typename PointHistory<dim>::Record
PointHistory<dim>::of_parent(const std::vector<Record> &children) const
{
  Record parent;
  if (std::all_of(children.begin(), children.end(),
                  [](const Record &record) { return record.empty(); }))
    return parent;
  const auto add = [&](const Point<dim> &in_child, const unsigned int child, const double *values)
  {
    const Point<dim> point = GeometryInfo<dim>::child_to_cell_coordinates(in_child, child);
    for (unsigned int d = 0; d < dim; ++d)
      parent.push_back(point[d]);
    for (unsigned int i = 0; i < n; ++i)
      parent.push_back(values != nullptr ? values[i] : 0.);
  };
  for (unsigned int c = 0; c < children.size(); ++c)
  {
    const Record &child = children[c];
    if (child.empty()) // where nothing has happened there are zeros, and not what is next door
      for (const Point<dim> &point : ordinary_points)
        add(point, c, nullptr);
    for (std::size_t k = 0; k < child.size(); k += dim + n)
    {
      Point<dim> point;
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = child[k + d];
      add(point, c, &child[k + dim]);
    }
  }
  return parent;
}


template <int dim>
std::unique_ptr<typename PointHistory<dim>::Transfer> PointHistory<dim>::make_transfer(
  const parallel::distributed::Triangulation<dim> &triangulation) const
{
  using Parent = typename Triangulation<dim>::cell_iterator;
  return std::make_unique<Transfer>(
    triangulation, true,
    [this](const Parent &parent, const Record value)
    { return of_children(value, parent->n_children()); },
    [this](const Parent &, const std::vector<Record> &values) { return of_parent(values); });
}


template <int dim>
void PointHistory<dim>::prepare_for_refinement(
  const parallel::distributed::Triangulation<dim> &triangulation)
{
  transfer = make_transfer(triangulation);
  transfer->prepare_for_coarsening_and_refinement(records);
}


template <int dim>
void PointHistory<dim>::finish_refinement(
  const parallel::distributed::Triangulation<dim> &triangulation)
{
  Records moved(triangulation.n_active_cells());
  transfer->unpack(moved);
  records = std::move(moved);
  transfer.reset();
}


template <int dim>
void PointHistory<dim>::prepare_for_save(
  const parallel::distributed::Triangulation<dim> &triangulation)
{
  transfer = make_transfer(triangulation);
  transfer->prepare_for_serialization(records);
}


template <int dim>
void PointHistory<dim>::finish_save()
{
  transfer.reset();
}


template <int dim>
void PointHistory<dim>::load(const parallel::distributed::Triangulation<dim> &triangulation)
{
  records.assign(triangulation.n_active_cells(), Record());
  transfer = make_transfer(triangulation);
  transfer->deserialize(records);
  transfer.reset();
}


template class PointHistory<2>;
template class PointHistory<3>;
} // namespace stockwork
