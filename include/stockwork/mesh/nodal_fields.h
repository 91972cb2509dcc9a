#pragma once

#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <string>
#include <vector>

namespace stockwork
{
/// Fields of a fracture model's own: a number at each vertex, (multi-)linear in between, zero until
/// the model sets them. What is in them is committed: the core moves them when the mesh changes,
/// before it calls FractureModel::setup(), saves them with the other unknowns and writes them for
/// people. What the model tries in a step, it keeps beside them.
template <int dim>
class NodalFields
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Triangulation = dealii::parallel::distributed::Triangulation<dim>;

  /// @param names as in the files of fields: "damage"
  explicit NodalFields(const std::vector<std::string> &names)
    : names(names)
    , element(1)
    , values(names.size())
  {
  }

  const dealii::DoFHandler<dim> &dof_handler() const
  {
    return *handler;
  }

  /// Hanging nodes.
  const dealii::AffineConstraints<double> &constraints() const
  {
    return hanging;
  }

  /// Values of a field, at locally relevant nodes.
  const Vector &operator[](const unsigned int field) const
  {
    return values[field];
  }

  /// Collective, as what follows.
  /// @param owned with hanging nodes at the mean of their neighbours
  void set(const unsigned int field, const Vector &owned)
  {
    values[field] = owned;
  }

  /// A vector of zeros, at owned nodes.
  Vector owned_vector() const;

  // What the core does with them.

  /// The mesh is new, or the same; fields that were about to move have moved.
  void follow_mesh(const Triangulation &);

  void prepare_for_refinement();

  /// Into the checkpoint that is about to be written of a mesh, and after that / out of the mesh
  /// that has been loaded.
  void prepare_for_save();
  void finish_save();
  void load(const Triangulation &);

  const std::vector<std::string> names;

private:
  using Transfer = dealii::parallel::distributed::SolutionTransfer<dim, Vector>;

  void distribute(const Triangulation &);

  /// Of vectors that the library has filled.
  void take(std::vector<Vector> &filled);

  std::vector<const Vector *> pointers() const;

  const dealii::FE_Q<dim> element;
  std::unique_ptr<dealii::DoFHandler<dim>> handler;
  dealii::AffineConstraints<double> hanging;
  std::vector<Vector> values;
  std::unique_ptr<Transfer> transfer;
};
} // namespace stockwork
