// What conditions have to be once there is a mesh: sides with faces, that hold the body, and are
// not given what would do nothing.
#include "biot/boundary_conditions.h"
#include "biot/normal_axis.h"

#include "stockwork/base/error.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace stockwork
{
using namespace dealii;

namespace
{
/// What is left of the motions of a rigid body, as words; empty: nothing.
template <int dim>
std::string name_of_motion(const Vector<double> &motion)
{
  std::string translation, rotation;
  const double greatest = motion.linfty_norm();
  for (unsigned int i = 0; i < motion.size(); ++i)
    if (std::abs(motion[i]) > 0.1 * greatest)
    {
      std::string &words = i < dim ? translation : rotation;
      words += std::string(words.empty() ? "" : " and ") + "xyz"[i < dim    ? i
                                                                 : dim == 2 ? 2
                                                                            : i - dim];
    }
  return (translation.empty() ? "" : "shift along " + translation) +
         (translation.empty() || rotation.empty() ? "" : " with a ") +
         (rotation.empty() ? "" : "rotation about " + rotation);
}
} // namespace


template <int dim>
void BoundaryConditions<dim>::check_hold(const Triangulation<dim> &triangulation) const
{
  // A rigid motion is a shift and a rotation; each condition takes away what moves its side's
  // vertices. What the normal matrix of all conditions does not see is left.
  constexpr unsigned int n = dim == 2 ? 3 : 6;
  const auto box = GridTools::compute_bounding_box(triangulation).get_boundary_points();
  const auto communicator = triangulation.get_communicator();
  Point<dim> centre;
  double size = 0.;
  for (unsigned int d = 0; d < dim; ++d)
  {
    const double lower = Utilities::MPI::min(box.first[d], communicator),
                 upper = Utilities::MPI::max(box.second[d], communicator);
    centre[d] = 0.5 * (lower + upper);
    size = std::max(size, upper - lower);
  }

  FullMatrix<double> normal_matrix(n);
  for (const Dirichlet &condition : dirichlet)
  {
    const unsigned int component = condition.component == normal_component
                                     ? normal_axis(triangulation, condition.side)
                                     : condition.component;
    if (component >= dim)
      continue;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == condition.side)
            for (unsigned int v = 0; v < cell->face(f)->n_vertices(); ++v)
            {
              const Tensor<1, dim> x = (cell->face(f)->vertex(v) - centre) / size;
              Vector<double> row(n); // the component of the motion at this vertex
              row[component] = 1.;
              if (dim == 2)
                row[2] = component == 0 ? -x[1] : x[0];
              else
              {
                row[dim + (component + 1) % dim] = x[(component + 2) % dim];
                row[dim + (component + 2) % dim] = -x[(component + 1) % dim];
              }
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int j = 0; j < n; ++j)
                  normal_matrix(i, j) += row[i] * row[j];
            }
  }
  Utilities::MPI::sum(normal_matrix, communicator, normal_matrix);

  LAPACKFullMatrix<double> matrix(n);
  matrix = normal_matrix;
  Vector<double> values(n);
  FullMatrix<double> vectors(n, n);
  const double greatest = std::max(1., normal_matrix.linfty_norm());
  matrix.compute_eigenvalues_symmetric(-1., 1e-10 * greatest, 1e-14, values, vectors);
  if (values.size() == 0)
    return;
  std::string left;
  for (unsigned int k = 0; k < values.size(); ++k)
  {
    Vector<double> motion(n);
    for (unsigned int i = 0; i < n; ++i)
      motion[i] = vectors(i, k);
    left += (left.empty() ? "a " : ", a ") + name_of_motion<dim>(motion);
  }
  throw EntryError("Boundary conditions/Roller", rollers,
                   "sides that hold the body, here, in 'Fixed' or by a given displacement: nothing "
                   "holds it against " +
                     left);
}


template <int dim>
void BoundaryConditions<dim>::check(const Triangulation<dim> &triangulation,
                                    const bool inertia) const
{
  std::set<types::boundary_id> there;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          there.insert(cell->face(f)->boundary_id());
  for (const Mention &mention : mentions)
    if (Utilities::MPI::max(there.count(mention.side) > 0 ? 1 : 0,
                            triangulation.get_communicator()) == 0)
      throw EntryError("Boundary conditions/" + mention.entry, mention.name,
                       "a side with faces; no face of the mesh belongs to this one (a box of "
                       "'Mesh/Side boxes' must hold their centres)");
  for (const Dirichlet &condition : dirichlet)
    if (condition.component == normal_component)
      try
      {
        const unsigned int axis = normal_axis(triangulation, condition.side);
        for (const Dirichlet &other : dirichlet)
          if (other.side == condition.side && other.component == axis && !other.is_zero)
            throw EntryError("Boundary conditions/" + other.entry, other.side_name,
                             "other sides than those of 'Boundary conditions/" + condition.entry +
                               "', where this one does not move along its normal");
      }
      catch (const EntryError &)
      {
        throw;
      }
      catch (const InputError &error)
      {
        throw EntryError("Boundary conditions/" + condition.entry, condition.side_name,
                         error.what());
      }
  refuse_idle_normal_tractions(triangulation);
  if (!inertia)
    check_hold(triangulation);
}


template <int dim>
void BoundaryConditions<dim>::refuse_idle_normal_tractions(
  const Triangulation<dim> &triangulation) const
{
  for (const auto &[side, traction] : prescribed_loads.normal_traction)
  {
    std::map<unsigned int, const Dirichlet *> given; // by component
    for (const Dirichlet &condition : dirichlet)
      if (condition.side == side && condition.component < dim)
        given[condition.component] = &condition;
    if (given.empty())
      continue;
    // A side that has no single normal moves along some of it, unless it does not move at all.
    const Dirichlet *idle = given.size() == dim ? given.begin()->second : nullptr;
    try
    {
      const auto along_normal = given.find(normal_axis(triangulation, side));
      idle = along_normal == given.end() ? nullptr : along_normal->second;
    }
    catch (const InputError &)
    {
    }
    if (idle != nullptr)
      throw EntryError("Boundary conditions/Normal traction", idle->side_name,
                       "other sides than those whose displacement along their normal is given, by "
                       "'Boundary conditions/" +
                         idle->entry + "': a traction there would do nothing");
  }
}


template void BoundaryConditions<2>::check(const Triangulation<2> &, bool) const;
template void BoundaryConditions<3>::check(const Triangulation<3> &, bool) const;
} // namespace stockwork
