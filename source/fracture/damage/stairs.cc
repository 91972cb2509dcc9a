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
std::vector<typename Damage<dim>::SlipSpring> Damage<dim>::slip_springs() const
{
  std::vector<SlipSpring> springs;
  if (dim == 2)
    return springs;
  std::vector<Tensor<1, dim>> leans;
  for (const CrackCell<dim> &crack : band.cells)
    leans.push_back(crack.lean());
  for (unsigned int i = 0; i < band.cells.size(); ++i)
    for (unsigned int f = 0; f < Band<dim>::n_faces; ++f)
    {
      const unsigned int j = band.neighbour(i, f);
      if (j == Band<dim>::none || j < i)
        continue;
      const CrackCell<dim> &crack = band.cells[i], &other = band.cells[j];
      const double side = crack.normal * other.normal < 0. ? -1. : 1.;
      const double lean = (leans[i] - side * leans[j]).norm_square();
      if (lean < 1e-12)
        continue;
      Tensor<1, dim> normal = crack.normal + side * other.normal;
      normal /= normal.norm();
      springs.push_back({i, j, side,
                         lean * 0.25 * (crack.area() + other.area()) *
                           (rock_stiffness(crack) + rock_stiffness(other)) *
                           (dealii::unit_symmetric_tensor<dim>() -
                            dealii::symmetrize(dealii::outer_product(normal, normal)))});
    }
  return springs;
}


template <int dim>
Tensor<1, dim> Damage<dim>::difference(const SlipSpring &spring,
                                       const std::vector<double> &extra) const
{
  return band.jump(spring.cell, extra) - spring.side * band.jump(spring.other, extra);
}


template <int dim>
void Damage<dim>::hold_stairs(const State &state, Sink &sink) const
{
  if (springs.empty())
    return;
  std::vector<bool> is_owned(band.cells.size(), false);
  for (const auto &owned : band.owned())
    is_owned[owned.number] = true;
  LocalSystem local;
  local.extra.resize(2 * dim);
  for (const SlipSpring &spring : springs)
  {
    if (!is_owned[spring.cell])
      continue;
    for (unsigned int d = 0; d < dim; ++d)
    {
      local.extra[d] = band.first_unknown(spring.cell) + d;
      local.extra[dim + d] = band.first_unknown(spring.other) + d;
    }
    local.reinit();
    const Tensor<1, dim> force = spring.stiffness * difference(spring, state.current.extra);
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


template <int dim>
double Damage<dim>::energy_of(const SlipSpring &spring, const std::vector<double> &extra) const
{
  const Tensor<1, dim> apart = difference(spring, extra);
  return 0.5 * (apart * (spring.stiffness * apart));
}


template std::vector<typename Damage<2>::SlipSpring> Damage<2>::slip_springs() const;
template std::vector<typename Damage<3>::SlipSpring> Damage<3>::slip_springs() const;
template void Damage<2>::hold_stairs(const State &, Sink &) const;
template void Damage<3>::hold_stairs(const State &, Sink &) const;
template double Damage<2>::energy_of(const SlipSpring &, const std::vector<double> &) const;
template double Damage<3>::energy_of(const SlipSpring &, const std::vector<double> &) const;
} // namespace stockwork::damage
