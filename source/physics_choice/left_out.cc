#include "physics_choice/left_out.h"

#include "stockwork/rock/linear_stiffness.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Stress in three dimensions of a strain in the plane, or in space, of isotropic rock [Pa].
template <int dim>
SymmetricTensor<2, 3> stress_in_space(const RockProperties &rock,
                                      const SymmetricTensor<2, dim> &strain)
{
  const SymmetricTensor<2, dim> in_plane = LinearStiffness<dim>(rock).stress(strain);
  SymmetricTensor<2, 3> stress;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      stress[i][j] = in_plane[i][j];
  if (dim == 2 && !rock.plane_stress)
    stress[2][2] = rock.lame_lambda() * trace(strain);
  return stress;
}
} // namespace


template <int dim>
LeftOut observe_left_out(const Case<dim> &the_case,
                         const CoupledSystem<dim> &system,
                         const Stepper<dim> &stepper)
{
  const MeshView<dim> mesh = system.mesh_view();
  const State state = stepper.last_state();
  const double rate = stepper.last_context().rate;
  const FEValuesExtractors::Vector displacement(0);
  FEValues<dim> values(mesh.mapping, mesh.dof_handler.get_fe(), QGauss<dim>(1),
                       update_values | update_gradients | update_quadrature_points |
                         update_JxW_values);
  std::vector<Tensor<1, dim>> now(1), before(1);
  std::vector<SymmetricTensor<2, dim>> strain(1);
  double kinetic = 0., stored = 0., used = 0.;
  for (const auto &cell : mesh.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && the_case.model->role(cell).cut == nullptr)
    {
      values.reinit(cell);
      values[displacement].get_function_values(state.current.bulk, now);
      values[displacement].get_function_values(state.rate_reference.bulk, before);
      values[displacement].get_function_symmetric_gradients(state.current.bulk, strain);
      const RockProperties rock = the_case.rock.at(cell->material_id(), cell->center());
      kinetic +=
        0.5 * rock.density * rate * rate * (now[0] - before[0]).norm_square() * values.JxW(0);
      stored += 0.5 * (LinearStiffness<dim>(rock).stress(strain[0]) * strain[0]) * values.JxW(0);
      for (const PhysicsDecision &decision : the_case.decisions)
        if (decision.left_out && decision.strength_used)
        {
          Point<3> place;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = values.quadrature_point(0)[d];
          used = std::max(used, decision.strength_used(cell->material_id(), place,
                                                       stress_in_space(rock, strain[0])));
        }
    }
  std::vector<double> sums{kinetic, stored};
  system.collectives().sum(sums);
  return {sums[1] > 0. ? sums[0] / sums[1] : 0., system.collectives().max(used)};
}


template LeftOut observe_left_out(const Case<2> &, const CoupledSystem<2> &, const Stepper<2> &);
template LeftOut observe_left_out(const Case<3> &, const CoupledSystem<3> &, const Stepper<3> &);
} // namespace stockwork
