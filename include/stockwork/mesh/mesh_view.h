#pragma once

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

namespace stockwork
{
/// What everyone may know of the mesh and of the bulk unknowns on it. The bulk unknowns are the
/// displacement (components 0 … dim-1) and, where the case needs it, the pore pressure
/// (component dim). Valid from one `setup` call to the next.
template <int dim>
struct MeshView
{
  const dealii::parallel::distributed::Triangulation<dim> &triangulation;
  const dealii::DoFHandler<dim> &dof_handler;
  const dealii::Mapping<dim> &mapping;

  /// Hanging nodes and boundary conditions of an *increment* (all inhomogeneities zero).
  const dealii::AffineConstraints<double> &constraints;

  bool has_pore_pressure;
};
} // namespace stockwork
