#include "stockwork/mesh/nodal_fields.h"

#include <deal.II/dofs/dof_tools.h>

namespace stockwork
{
using namespace dealii;

template <int dim>
typename NodalFields<dim>::Vector NodalFields<dim>::owned_vector() const
{
  return Vector(handler->locally_owned_dofs(), handler->get_communicator());
}


template <int dim>
void NodalFields<dim>::distribute(const Triangulation &triangulation)
{
  if (!handler)
    handler = std::make_unique<DoFHandler<dim>>(triangulation);
  handler->distribute_dofs(element);
  IndexSet relevant;
  DoFTools::extract_locally_relevant_dofs(*handler, relevant);
  hanging.reinit(relevant);
  DoFTools::make_hanging_node_constraints(*handler, hanging);
  hanging.close();
  for (Vector &field : values)
    field.reinit(handler->locally_owned_dofs(), relevant, handler->get_communicator());
}


template <int dim>
std::vector<const typename NodalFields<dim>::Vector *> NodalFields<dim>::pointers() const
{
  std::vector<const Vector *> all;
  for (const Vector &field : values)
    all.push_back(&field);
  return all;
}


template <int dim>
void NodalFields<dim>::take(std::vector<Vector> &filled)
{
  for (unsigned int f = 0; f < values.size(); ++f)
  {
    filled[f].compress(VectorOperation::insert);
    hanging.distribute(filled[f]);
    values[f] = filled[f];
  }
}


template <int dim>
void NodalFields<dim>::follow_mesh(const Triangulation &triangulation)
{
  if (!handler)
    distribute(triangulation);
  if (!transfer)
    return;
  distribute(triangulation);
  std::vector<Vector> filled(values.size(), owned_vector());
  std::vector<Vector *> targets;
  for (Vector &field : filled)
    targets.push_back(&field);
  transfer->interpolate(targets);
  transfer.reset();
  take(filled);
}


template <int dim>
void NodalFields<dim>::prepare_for_refinement()
{
  transfer = std::make_unique<Transfer>(*handler);
  transfer->prepare_for_coarsening_and_refinement(pointers());
}


template <int dim>
void NodalFields<dim>::prepare_for_save()
{
  transfer = std::make_unique<Transfer>(*handler);
  transfer->prepare_for_serialization(pointers());
}


template <int dim>
void NodalFields<dim>::finish_save()
{
  transfer.reset();
}


template <int dim>
void NodalFields<dim>::load(const Triangulation &triangulation)
{
  distribute(triangulation);
  std::vector<Vector> filled(values.size(), owned_vector());
  std::vector<Vector *> targets;
  for (Vector &field : filled)
    targets.push_back(&field);
  Transfer(*handler).deserialize(targets);
  take(filled);
}


template class NodalFields<2>;
template class NodalFields<3>;
} // namespace stockwork
