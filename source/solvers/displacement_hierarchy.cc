#include "solvers/displacement_hierarchy.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Where a displacement dof sits and which way it points.
template <int dim>
struct Place
{
  Point<dim> point;
  unsigned int direction = dim; ///< dim: not seen yet
  bool at_vertex = false;
};

template <int dim>
std::vector<std::vector<double>> rigid_body_modes(const std::vector<Place<dim>> &places,
                                                  const bool vertices_only,
                                                  const MPI_Comm communicator)
{
  // Rotations about the centre, in units of the size, so that all modes are of order one.
  Point<dim> centre;
  double size = 0.;
  for (unsigned int d = 0; d < dim; ++d)
  {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const auto &place : places)
    {
      low = std::min(low, place.point[d]);
      high = std::max(high, place.point[d]);
    }
    low = Utilities::MPI::min(low, communicator);
    high = Utilities::MPI::max(high, communicator);
    centre[d] = 0.5 * (low + high);
    size = std::max(size, 0.5 * (high - low));
  }

  const unsigned int n_rotations = dim == 2 ? 1 : 3;
  std::vector<std::vector<double>> modes(dim + n_rotations);
  for (const auto &place : places)
    if (place.at_vertex || !vertices_only)
    {
      const Tensor<1, dim> x = (place.point - centre) / size;
      for (unsigned int d = 0; d < dim; ++d)
        modes[d].push_back(d == place.direction ? 1. : 0.);
      for (unsigned int r = 0; r < n_rotations; ++r)
      {
        // In the plane of two axes: (-x_b, x_a).
        const unsigned int a = dim == 2 ? 0 : (r + 1) % dim, b = dim == 2 ? 1 : (r + 2) % dim;
        modes[dim + r].push_back(place.direction == a ? -x[b] : place.direction == b ? x[a] : 0.);
      }
    }
  return modes;
}


/// The displacement's own unknowns of this rank, in their order.
template <int dim>
std::vector<Place<dim>>
places_of(const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler, const IndexSet &owned)
{
  const FiniteElement<dim> &fe = dof_handler.get_fe();
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  std::vector<Place<dim>> places(owned.n_elements());
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (fe.system_to_component_index(i).first < dim && owned.is_element(dofs[i]))
        {
          auto &place = places[owned.index_within_set(dofs[i])];
          if (place.direction < dim)
            continue;
          place.point = mapping.transform_unit_to_real_cell(cell, fe.unit_support_point(i));
          place.direction = fe.system_to_component_index(i).first;
          place.at_vertex = i < fe.n_dofs_per_vertex() * cell->n_vertices();
        }
    }
  return places;
}


/// Whether on every rank the unknowns of a node follow one another.
template <int dim>
bool are_ordered(const std::vector<Place<dim>> &places,
                 const IndexSet &owned,
                 const MPI_Comm communicator)
{
  const bool torn = places.size() % dim != 0;
  bool ordered = !torn && (owned.n_elements() == 0 || owned.nth_index_in_set(0) % dim == 0);
  for (unsigned int i = 0; ordered && i < places.size(); ++i)
    ordered =
      places[i].direction == i % dim && places[i].point.distance(places[i - i % dim].point) == 0.;
  return Utilities::MPI::min(ordered ? 1 : 0, communicator) == 1;
}


/// Those of the unknowns that belong to vertices, numbered over all ranks.
struct VertexNumbers
{
  IndexSet owned;                       ///< of the numbers
  TrilinosWrappers::MPI::Vector number; ///< of an unknown, also of the neighbours'; -1: none

  template <int dim>
  VertexNumbers(const std::vector<Place<dim>> &places,
                const IndexSet &owned_dofs,
                const IndexSet &relevant,
                const MPI_Comm communicator)
    : number(owned_dofs, relevant, communicator)
  {
    const unsigned int mine =
      std::count_if(places.begin(), places.end(), [](const auto &p) { return p.at_vertex; });
    const auto counts = Utilities::MPI::all_gather(communicator, mine);
    const auto rank = Utilities::MPI::this_mpi_process(communicator);
    const auto begin = std::accumulate(counts.begin(), counts.begin() + rank, 0u);
    owned.set_size(std::accumulate(counts.begin(), counts.end(), 0u));
    owned.add_range(begin, begin + mine);
    TrilinosWrappers::MPI::Vector own(owned_dofs, communicator);
    for (unsigned int i = 0, next = begin; i < places.size(); ++i)
      own(owned_dofs.nth_index_in_set(i)) = places[i].at_vertex ? next++ : -1.;
    own.compress(VectorOperation::insert);
    number = own;
  }
};
} // namespace


template <int dim>
DisplacementHierarchy make_displacement_hierarchy(const Mapping<dim> &mapping,
                                                  const DoFHandler<dim> &dof_handler,
                                                  const AffineConstraints<double> &constraints)
{
  const FiniteElement<dim> &fe = dof_handler.get_fe();
  const MPI_Comm communicator = dof_handler.get_communicator();

  // The first block: the displacement comes first on every rank, and blockwise over all ranks.
  std::vector<unsigned int> blocks(fe.n_components(), 1);
  std::fill(blocks.begin(), blocks.begin() + dim, 0u);
  const auto n = DoFTools::count_dofs_per_fe_block(dof_handler, blocks)[0];
  IndexSet relevant;
  DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  const IndexSet owned = dof_handler.locally_owned_dofs().get_view(0, n);
  relevant = relevant.get_view(0, n);

  const std::vector<Place<dim>> places = places_of(mapping, dof_handler, owned);
  DisplacementHierarchy hierarchy;
  hierarchy.dim = dim;
  hierarchy.nodes_together = are_ordered(places, owned, communicator);
  const bool quadratic = fe.base_element(0).degree > 1;
  hierarchy.rigid_body_modes = rigid_body_modes(places, quadratic, communicator);
  if (!quadratic)
    return hierarchy;

  const VertexNumbers vertices(places, owned, relevant, communicator);

  // Interpolate from the vertices of one cell to all its dofs: the same for each component.
  const unsigned int n_vertices = GeometryInfo<dim>::vertices_per_cell;
  DynamicSparsityPattern pattern(n, vertices.owned.size(), owned);
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  const auto for_each_entry = [&](const auto &action)
  {
    std::vector<bool> done(places.size(), false);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const unsigned int direction = fe.system_to_component_index(i).first;
          if (direction >= dim || !owned.is_element(dofs[i]))
            continue;
          const auto k = owned.index_within_set(dofs[i]);
          if (done[k])
            continue;
          done[k] = true;
          if (constraints.is_constrained(dofs[i]))
          {
            // Decoupled in the fine matrix. A fixed vertex keeps a row of its own in the coarse
            // one, a hanging vertex gets it from the free dofs around it.
            if (places[k].at_vertex && constraints.get_constraint_entries(dofs[i])->empty())
              action(dofs[i], static_cast<unsigned int>(vertices.number(dofs[i])), 1.);
            continue;
          }
          for (unsigned int v = 0; v < n_vertices; ++v)
          {
            const auto vertex_dof = cell->vertex_dof_index(v, direction);
            const double weight =
              GeometryInfo<dim>::d_linear_shape_function(fe.unit_support_point(i), v);
            const auto *lines = constraints.get_constraint_entries(vertex_dof);
            const bool fixed = lines != nullptr && lines->empty();
            if (std::abs(weight) > 1e-12 && !fixed)
              action(dofs[i], static_cast<unsigned int>(vertices.number(vertex_dof)), weight);
          }
        }
      }
  };
  for_each_entry([&](const auto row, const auto column, double) { pattern.add(row, column); });
  hierarchy.from_linear = std::make_shared<TrilinosWrappers::SparseMatrix>();
  hierarchy.from_linear->reinit(owned, vertices.owned, pattern, communicator);
  for_each_entry([&](const auto row, const auto column, const double weight)
                 { hierarchy.from_linear->set(row, column, weight); });
  hierarchy.from_linear->compress(VectorOperation::insert);
  return hierarchy;
}

template DisplacementHierarchy make_displacement_hierarchy<2>(const Mapping<2> &,
                                                              const DoFHandler<2> &,
                                                              const AffineConstraints<double> &);
template DisplacementHierarchy make_displacement_hierarchy<3>(const Mapping<3> &,
                                                              const DoFHandler<3> &,
                                                              const AffineConstraints<double> &);
} // namespace stockwork
