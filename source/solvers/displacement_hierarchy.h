#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>
#include <vector>

namespace stockwork
{
/// What multigrid wants to know of the displacement unknowns, the first block of the bulk. Of the
/// mesh alone.
struct DisplacementHierarchy
{
  unsigned int dim = 0;

  /// Whether the components of one node always follow one another, x y (z) x y (z) … The fast
  /// smoother needs that; renumberings that tear nodes apart forgo it.
  bool nodes_together = false;

  /// For quadratic elements: the values at all displacement dofs (rows) of the multilinear function
  /// with given values at the vertices (columns). Homogeneous constraints are built in. Null for
  /// linear elements.
  std::shared_ptr<dealii::TrilinosWrappers::SparseMatrix> from_linear;

  /// The motions that strain nothing: translations in x, y (, z), then rotations about the centre
  /// of the mesh; at the owned vertices when there is a `from_linear`, else at the owned dofs.
  std::vector<std::vector<double>> rigid_body_modes;
};

/// Components 0 … dim-1 of the element are the displacement, numbered before anything else and of
/// degree one or two. `constraints` are those of an increment. Collective.
template <int dim>
DisplacementHierarchy
make_displacement_hierarchy(const dealii::Mapping<dim> &mapping,
                            const dealii::DoFHandler<dim> &dof_handler,
                            const dealii::AffineConstraints<double> &constraints);
} // namespace stockwork
