#include "fracture/damage/damage.h"

namespace stockwork::damage
{
using dealii::Tensor;

/// A cell in which the slope of phi leans against the crack's normal takes stress along the crack
/// for shear across it, because its tractions are the transpose of what its jump does to the rock
/// (the price of kinematically right and symmetric elements, Jirasek 2000). Along a plane leans
/// cancel; but cells that slip to and fro relieve the stress along the crack ahead of its front,
/// which then has to be driven harder in this direction. So neighbours whose leans differ by
/// dl resist a difference of their slips by a spring of the rock's stiffness times |dl|^2: nothing
/// for a slip that they have in common, and nothing where a crack lies along the mesh.
template <int dim>
std::vector<typename Damage<dim>::SlipSpring> Damage<dim>::slip_springs(const unsigned int i) const
{
  std::vector<SlipSpring> springs;
  if (dim == 2)
    return springs;
  const CrackCell<dim> &crack = band.cells[i];
  for (unsigned int f = 0; f < Band<dim>::n_faces; ++f)
  {
    const unsigned int j = band.neighbour(i, f);
    if (j == Band<dim>::none || j < i)
      continue;
    const CrackCell<dim> &other = band.cells[j];
    const double side = crack.normal * other.normal < 0. ? -1. : 1.;
    const double lean = (crack.lean() - side * other.lean()).norm_square();
    if (lean < 1e-12)
      continue;
    Tensor<1, dim> normal = crack.normal + side * other.normal;
    normal /= normal.norm();
    springs.push_back({j, side,
                       lean * 0.25 * (crack.area() + other.area()) *
                         (rock_stiffness(crack) + rock_stiffness(other)) *
                         (dealii::unit_symmetric_tensor<dim>() -
                          dealii::symmetrize(dealii::outer_product(normal, normal)))});
  }
  return springs;
}


template <int dim>
void Damage<dim>::hold_stairs(const State &state, Sink &sink) const
{
  LocalSystem local;
  for (const auto &owned : band.owned())
  {
    const unsigned int i = owned.number;
    for (const SlipSpring &spring : slip_springs(i))
    {
      local.extra.clear();
      for (unsigned int d = 0; d < dim; ++d)
        local.extra.push_back(band.first_unknown(i) + d);
      for (unsigned int d = 0; d < dim; ++d)
        local.extra.push_back(band.first_unknown(spring.other) + d);
      local.reinit();
      const Tensor<1, dim> force =
        spring.stiffness * (band.jump(i, state.current.extra) -
                            spring.side * band.jump(spring.other, state.current.extra));
      for (unsigned int d = 0; d < dim; ++d)
      {
        local.residual(d) += force[d];
        local.residual(dim + d) -= spring.side * force[d];
        for (unsigned int e = 0; e < dim; ++e)
        {
          local.matrix(d, e) += spring.stiffness[d][e];
          local.matrix(dim + d, dim + e) += spring.stiffness[d][e];
          local.matrix(d, dim + e) -= spring.side * spring.stiffness[d][e];
          local.matrix(dim + d, e) -= spring.side * spring.stiffness[d][e];
        }
      }
      sink.add(local);
    }
  }
}


template <int dim>
double Damage<dim>::energy_in_stairs(const unsigned int i, const std::vector<double> &extra) const
{
  double energy = 0.;
  for (const SlipSpring &spring : slip_springs(i))
  {
    const Tensor<1, dim> difference =
      band.jump(i, extra) - spring.side * band.jump(spring.other, extra);
    energy += 0.5 * (difference * (spring.stiffness * difference));
  }
  return energy;
}


template void Damage<2>::hold_stairs(const State &, Sink &) const;
template void Damage<3>::hold_stairs(const State &, Sink &) const;
template double Damage<2>::energy_in_stairs(unsigned int, const std::vector<double> &) const;
template double Damage<3>::energy_in_stairs(unsigned int, const std::vector<double> &) const;
} // namespace stockwork::damage
