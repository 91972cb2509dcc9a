#pragma once

#include "case.h"

#include <deal.II/distributed/tria.h>

#include <functional>

namespace stockwork
{
/// The cells that a line passes. Growing cracks split the cells before them as often as their own,
/// so cells that are split alike compare.
struct CellsAlong
{
  double unsplit = 0.; ///< greatest size that one of them has before it is split; 0: there is none
  unsigned int most_split = 0; ///< how often the most split of them has been

  void add(const CellsAlong &others);
};

/// What audit and choice ask of the mesh that a run starts on. Ranks must ask together, and get the
/// same answer. Valid as long as the mesh.
template <int dim>
struct MeshSizes
{
  explicit MeshSizes(const dealii::parallel::distributed::Triangulation<dim> &triangulation);

  double smallest; ///< longest edge of the smallest cell [m]

  std::function<CellsAlong(const dealii::Point<dim> &from, const dealii::Point<dim> &to)> along;

  /// Region of the rock at a place; 0 outside of the mesh.
  std::function<dealii::types::material_id(const dealii::Point<dim> &)> region_at;
};

/// How large the cells of the first crack are, and those that it will come to when it grows to this
/// half length or radius [m].
struct SizesOfPath
{
  double at_start, to_the_end;
};

template <int dim>
SizesOfPath
sizes_of_path(const Case<dim> &the_case, const MeshSizes<dim> &mesh, double half_length);

/// How many of the largest cells that the first fracture comes to make up its half length at the
/// end; NaN where nothing tells how long it will be.
template <int dim>
double cells_in_half_length(const Case<dim> &the_case, const MeshSizes<dim> &mesh);

/// Unknowns at the end of a run that has so many now, and so many segments: where cells are refined
/// ahead of a tip or of the front of a disc, they become more. As many where nothing tells.
template <int dim>
double unknowns_at_end(const Case<dim> &the_case,
                       const MeshSizes<dim> &mesh,
                       double n_unknowns,
                       double n_segments);
} // namespace stockwork
