#include "biot/opening_control.h"

#include "stockwork/base/error.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Call `visit(cell, f, side)` for the faces on three sides of the body.
template <int dim, class Function>
void for_faces(const MeshView<dim> &mesh_view,
               const ControlledLoad<dim> &load,
               const Function &visit)
{
  const std::array<types::boundary_id, 3> sides{{load.loaded, load.from, load.to}};
  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          for (unsigned int s = 0; s < sides.size(); ++s)
            if (cell->face(f)->boundary_id() == sides[s])
              visit(cell, f, s);
}
} // namespace


template <int dim>
OpeningControl<dim>::OpeningControl(const ControlledLoad<dim> &load,
                                    const double young_modulus,
                                    const MeshView<dim> &mesh_view,
                                    const Collectives &collectives)
  : load(load)
  , modulus(young_modulus)
{
  enum : unsigned int
  {
    loaded,
    from,
    to
  };
  std::vector<double> area(3, 0.), centres(3 * dim, 0.);
  for_faces(mesh_view, load,
            [&](const auto &cell, const unsigned int f, const unsigned int side)
            {
              area[side] += cell->face(f)->measure();
              for (unsigned int d = 0; d < dim; ++d)
                centres[side * dim + d] += cell->face(f)->measure() * cell->face(f)->center()[d];
            });
  collectives.sum(area);
  collectives.sum(centres);
  Tensor<1, dim> direction;
  for (unsigned int d = 0; d < dim; ++d)
    direction[d] = centres[to * dim + d] / area[to] - centres[from * dim + d] / area[from];
  if (!(direction.norm() > 0.))
    throw InputError("The two sides of 'Boundary conditions/Controlled opening' have the same "
                     "middle: their distance has no direction.");
  direction /= direction.norm();
  force_of_unknown = modulus * (dim == 3 ? std::sqrt(area[loaded]) : 1.);

  const auto &fe = mesh_view.dof_handler.get_fe();
  FEFaceValues<dim> values(mesh_view.mapping, fe, QGauss<dim - 1>(fe.degree + 1),
                           update_values | update_normal_vectors | update_JxW_values);
  const FEValuesExtractors::Vector displacement(0);
  std::vector<types::global_dof_index> dofs(fe.dofs_per_cell);
  for_faces(mesh_view, load,
            [&](const auto &cell, const unsigned int f, const unsigned int side)
            {
              values.reinit(cell, f);
              cell->get_dof_indices(dofs);
              Face face;
              for (unsigned int i = 0; i < dofs.size(); ++i)
              {
                if (!fe.has_support_on_face(i, f) || fe.system_to_component_index(i).first >= dim)
                  continue;
                double inward = 0., along = 0.;
                for (const unsigned int q : values.quadrature_point_indices())
                {
                  const Tensor<1, dim> u =
                    values.JxW(q) / area[side] * values[displacement].value(i, q);
                  inward -= u * values.normal_vector(q);
                  along += u * direction;
                }
                face.dofs.push_back(dofs[i]);
                face.inward.push_back(side == loaded ? inward : 0.);
                face.opening.push_back(side == to ? along : side == from ? -along : 0.);
              }
              if (side == to)
                face.share_of_opening = cell->face(f)->measure() / area[to];
              faces.push_back(std::move(face));
            });
}


template <int dim>
void OpeningControl<dim>::assemble(const StepContext &context,
                                   const State &state,
                                   const unsigned int index,
                                   Sink &sink) const
{
  const double given = load.opening.value(Point<dim>(), context.time);
  LocalSystem local;
  local.extra = {index};
  for (const Face &face : faces)
  {
    local.bulk = face.dofs;
    local.reinit();
    const unsigned int n = face.dofs.size();
    local.residual(n) = -modulus * face.share_of_opening * given;
    for (unsigned int i = 0; i < n; ++i)
    {
      local.matrix(i, n) = -force_of_unknown * face.inward[i];
      local.matrix(n, i) = modulus * face.opening[i];
      local.residual(i) = local.matrix(i, n) * state.current.extra[index];
      local.residual(n) += local.matrix(n, i) * state.current.bulk(face.dofs[i]);
    }
    sink.add(local);
  }
}


template <int dim>
double OpeningControl<dim>::displacement(const Unknowns &unknowns,
                                         const Collectives &collectives) const
{
  double sum = 0.;
  for (const Face &face : faces)
    for (unsigned int i = 0; i < face.dofs.size(); ++i)
      sum += face.inward[i] * unknowns.bulk(face.dofs[i]);
  return collectives.sum(sum);
}


template class OpeningControl<2>;
template class OpeningControl<3>;
} // namespace stockwork
