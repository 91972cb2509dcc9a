// The stress in the mean around a place, of bonds and of the elements beside them.
#include "fracture/peridynamics/peridynamics.h"

#include <cmath>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

template <int dim>
std::map<BondView, double> Peridynamics<dim>::lost_elongations(const State &state,
                                                               const unsigned int first) const
{
  std::map<BondView, double> lost;
  for (unsigned int n = 0; n < softening_bonds.size(); ++n)
    for (const BondView &view :
         lattice.bonds.views_of(softening_bonds[n].view.first, softening_bonds[n].view.second))
      lost[view] = state.current.extra[first + n];
  return lost;
}


template <int dim>
SymmetricTensor<2, dim> Peridynamics<dim>::stress_of_bonds(const unsigned int site,
                                                           const std::map<BondView, double> &lost,
                                                           const OfCells &of_cells) const
{
  SymmetricTensor<2, dim> stress;
  for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
  {
    const Tensor<1, dim> &e = lattice.coefficients[b].direction;
    double force = 0.;
    if (lattice.bonds.is_broken(site, b))
      for (const auto &[cell, share] : pressure_in_bonds.shares(site, b, false))
        force -= share * (lattice.coefficients[b].stiffness * lattice.coefficients[b].length *
                            (e * (of_cells.strain[cell] * e)) +
                          2. * lattice.force_of_dilatation(b) * trace(of_cells.strain[cell]));
    else
    {
      const auto found = lost.find({site, b});
      force = lattice.stiffness(site, b) * (lattice.elongation(site, b, displacement) -
                                            (found != lost.end() ? found->second : 0.));
      force += lattice.force_of_dilatations(site, b, of_cells.dilatation_forces);
    }
    stress += 0.5 * force * lattice.coefficients[b].length * symmetrize(outer_product(e, e));
  }
  return stress / std::pow(lattice.zone.spacing(), dim);
}


template <int dim>
std::optional<SymmetricTensor<2, dim>>
Peridynamics<dim>::stress_of_elements(const unsigned int site) const
{
  SymmetricTensor<2, dim> strain;
  for (unsigned int d = 0; d < dim; ++d)
  {
    std::array<unsigned int, 2> beside;
    for (const unsigned int side : {0u, 1u})
    {
      Place<dim> place = lattice.zone.sites()[site].place;
      place[d] += side == 0 ? -1 : 1;
      beside[side] = lattice.zone.find(place);
      if (beside[side] == dealii::numbers::invalid_unsigned_int)
        return {};
    }
    for (unsigned int c = 0; c < dim; ++c)
      strain[c][d] += (c == d ? 1. : 0.5) *
                      (displacement[beside[1] * dim + c] - displacement[beside[0] * dim + c]) /
                      (2. * lattice.zone.spacing());
  }
  const RockProperties &rock = scene.rock.main();
  return lattice.rock_of_bonds.modulus(site) *
         (rock.lame_lambda() * trace(strain) * dealii::unit_symmetric_tensor<dim>() +
          2. * rock.shear_modulus() * strain);
}


template <int dim>
SymmetricTensor<2, dim>
Peridynamics<dim>::mean_stress(const Point<dim> &centre,
                               const double reach,
                               const std::function<double(const Tensor<1, dim> &)> &weight_of,
                               const State &state,
                               const OfCells &of_cells) const
{
  std::map<BondView, double> lost = lost_elongations(state, 0);
  if (parameters.state_based)
    for (const auto &[view, elongation] :
         lost_elongations(state, softening_bonds.unknown_of_lost_force(0)))
      lost[view] += elongation;
  SymmetricTensor<2, dim> sum;
  double weights = 0.;
  for (unsigned int i = 0; i < lattice.zone.sites().size(); ++i)
  {
    const Point<dim> place = lattice.zone.position(lattice.zone.sites()[i].place);
    const Tensor<1, dim> away = place - centre;
    if (away.norm_square() > reach * reach)
      continue;
    const double weight = weight_of(away);
    if (weight == 0.)
      continue;
    auto stress = lattice.zone.sites()[i].peridynamic
                    ? std::optional<SymmetricTensor<2, dim>>(stress_of_bonds(i, lost, of_cells))
                    : stress_of_elements(i);
    if (!stress)
      continue;
    if (!lattice.in_situ_is_zero)
      *stress += scene.in_situ_stress(place);
    sum += weight * *stress;
    weights += weight;
  }
  return weights > 0. ? sum / weights : sum;
}

#define INSTANTIATE(dim)                                                                       \
  template std::map<BondView, double> Peridynamics<dim>::lost_elongations(const State &,       \
                                                                          unsigned int) const; \
  template SymmetricTensor<2, dim> Peridynamics<dim>::stress_of_bonds(                         \
    unsigned int, const std::map<BondView, double> &, const OfCells &) const;                  \
  template std::optional<SymmetricTensor<2, dim>> Peridynamics<dim>::stress_of_elements(       \
    unsigned int) const;                                                                       \
  template SymmetricTensor<2, dim> Peridynamics<dim>::mean_stress(                             \
    const Point<dim> &, double, const std::function<double(const Tensor<1, dim> &)> &,         \
    const State &, const OfCells &) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
