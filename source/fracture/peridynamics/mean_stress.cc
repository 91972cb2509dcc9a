// The stress in the mean around a place, of bonds and of the elements beside them.
#include "fracture/peridynamics/peridynamics.h"

#include <cmath>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Of the greater principal stress, less than which they do not differ.
constexpr double same_stress = 1e-9;
} // namespace


template <int dim>
Tensor<1, 2> Peridynamics<dim>::across_greatest(const SymmetricTensor<2, 2> &stress,
                                                const Tensor<1, 2> &ahead)
{
  const double half = 0.5 * (stress[0][0] - stress[1][1]), shear = stress[0][1];
  if (std::hypot(half, shear) <= same_stress * stress.norm())
    return ahead;
  const double angle = 0.5 * std::atan2(shear, half) + 0.5 * M_PI;
  const Tensor<1, 2> direction({std::cos(angle), std::sin(angle)});
  return direction * ahead < 0. ? -direction : direction;
}

template <int dim>
SymmetricTensor<2, dim>
Peridynamics<dim>::stress_of_bonds(const unsigned int site,
                                   const std::map<BondView, double> &softened,
                                   const OfCells &of_cells) const
{
  SymmetricTensor<2, dim> stress;
  for (unsigned int b = 0; b < stencil.size(); ++b)
  {
    const Tensor<1, dim> &e = coefficients[b].direction;
    double force = 0.;
    if (bonds.is_broken(site, b))
      for (const auto &[cell, share] : shares_of(site, b, false))
        force -= coefficients[b].stiffness * coefficients[b].length * share *
                 (e * (of_cells.strain[cell] * e));
    else
    {
      const auto found = softened.find({site, b});
      force = stiffness(site, b) *
              (elongation(site, b, displacement) - (found != softened.end() ? found->second : 0.));
    }
    stress += 0.5 * force * coefficients[b].length * symmetrize(outer_product(e, e));
  }
  return stress / std::pow(zone.spacing(), dim);
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
      Place<dim> place = zone.sites()[site].place;
      place[d] += side == 0 ? -1 : 1;
      beside[side] = zone.find(place);
      if (beside[side] == dealii::numbers::invalid_unsigned_int)
        return {};
    }
    for (unsigned int c = 0; c < dim; ++c)
      strain[c][d] += (c == d ? 1. : 0.5) *
                      (displacement[beside[1] * dim + c] - displacement[beside[0] * dim + c]) /
                      (2. * zone.spacing());
  }
  const RockProperties &rock = scene.rock.main();
  return rock_of_bonds.modulus(site) *
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
  std::map<BondView, double> softened;
  for (unsigned int n = 0; n < softening_bonds.size(); ++n)
    for (const BondView &view :
         views_of(softening_bonds[n].view.first, softening_bonds[n].view.second))
      softened[view] = state.current.extra[n];
  SymmetricTensor<2, dim> sum;
  double weights = 0.;
  for (unsigned int i = 0; i < zone.sites().size(); ++i)
  {
    const Point<dim> place = zone.position(zone.sites()[i].place);
    const Tensor<1, dim> away = place - centre;
    if (away.norm_square() > reach * reach)
      continue;
    const double weight = weight_of(away);
    if (weight == 0.)
      continue;
    auto stress = zone.sites()[i].peridynamic
                    ? std::optional<SymmetricTensor<2, dim>>(stress_of_bonds(i, softened, of_cells))
                    : stress_of_elements(i);
    if (!stress)
      continue;
    if (!in_situ_is_zero)
      *stress += scene.in_situ_stress(place);
    sum += weight * *stress;
    weights += weight;
  }
  return weights > 0. ? sum / weights : sum;
}

#define INSTANTIATE(dim)                                                                  \
  template SymmetricTensor<2, dim> Peridynamics<dim>::stress_of_bonds(                    \
    unsigned int, const std::map<BondView, double> &, const OfCells &) const;             \
  template std::optional<SymmetricTensor<2, dim>> Peridynamics<dim>::stress_of_elements(  \
    unsigned int) const;                                                                  \
  template SymmetricTensor<2, dim> Peridynamics<dim>::mean_stress(                        \
    const Point<dim> &, double, const std::function<double(const Tensor<1, dim> &)> &,    \
    const State &, const OfCells &) const;                                                \
  template Tensor<1, 2> Peridynamics<dim>::across_greatest(const SymmetricTensor<2, 2> &, \
                                                           const Tensor<1, 2> &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
