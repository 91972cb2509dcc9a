#include "fracture/peridynamics/lattice_moduli.h"

#include <cmath>

namespace stockwork::peridynamics
{
namespace
{
template <int dim>
double cell_volume(const double spacing)
{
  return dealii::Utilities::fixed_power<dim>(spacing);
}
} // namespace

template <int dim>
std::vector<BondCoefficients<dim>> bond_coefficients(const std::vector<StencilBond<dim>> &stencil,
                                                     const BondLaw &law,
                                                     const double spacing)
{
  const double volume = cell_volume<dim>(spacing);
  std::vector<BondCoefficients<dim>> coefficients;
  coefficients.reserve(stencil.size());
  for (const auto &bond : stencil)
  {
    const double length = bond.length() * spacing;
    coefficients.push_back({bond.direction(), length,
                            law.micromodulus * bond.volume_fraction * volume * volume / length,
                            dim * bond.volume_fraction * volume / law.weighted_volume});
  }
  return coefficients;
}

template <int dim>
LatticeModuli lattice_moduli(const std::vector<StencilBond<dim>> &stencil,
                             const BondLaw &law,
                             const double spacing)
{
  LatticeModuli moduli{0., 0., 0., dim};
  for (const auto &bond : stencil)
  {
    const auto e = bond.direction();
    const double factor = 0.5 * law.micromodulus * bond.volume_fraction *
                          cell_volume<dim>(spacing) * bond.length() * spacing;
    moduli.c11 += factor * e[0] * e[0] * e[0] * e[0];
    moduli.c12 += factor * e[0] * e[0] * e[1] * e[1];
  }
  moduli.c44 = moduli.c12; // central forces
  moduli.c11 += law.dilatation_modulus;
  moduli.c12 += law.dilatation_modulus;
  return moduli;
}

template <int dim>
double weighted_volume(const std::vector<StencilBond<dim>> &stencil, const double spacing)
{
  double sum = 0.;
  for (const auto &bond : stencil)
    sum += bond.volume_fraction * bond.length();
  return sum * cell_volume<dim>(spacing) * spacing;
}

template <int dim>
BondLaw bond_based_law(const RockProperties &rock,
                       const std::vector<StencilBond<dim>> &stencil,
                       const double spacing)
{
  const double q = weighted_volume(stencil, spacing);
  return {2. * dim * (dim + 2.) * rock.shear_modulus() / q, 0., q};
}

double bond_based_poisson_ratio(const bool plane_stress)
{
  return plane_stress ? 1. / 3. : 0.25;
}

template <int dim>
double crossing_energy(const std::vector<StencilBond<dim>> &stencil,
                       const BondLaw &law,
                       const double spacing,
                       const double stretch)
{
  const double volume = cell_volume<dim>(spacing);
  // A bond that climbs k layers crosses the plane from each of the k layers below it.
  double energy = 0.; // per site and volume
  std::vector<double> dilatation;
  for (const auto &bond : stencil)
    if (const int climb = bond.offset[dim - 1]; climb > 0)
    {
      const double elongation = stretch * bond.length() * spacing;
      energy +=
        climb * 0.5 * law.micromodulus * bond.volume_fraction * volume * stretch * elongation;
      if (dilatation.size() < static_cast<unsigned int>(climb))
        dilatation.resize(climb, 0.);
      for (int layer = 0; layer < climb; ++layer)
        dilatation[layer] += dim * bond.volume_fraction * volume / law.weighted_volume * elongation;
    }
  for (const double theta : dilatation) // the same on both sides
    energy += 2. * 0.5 * law.dilatation_modulus * theta * theta;
  return energy * spacing;
}

template <int dim>
double continuum_critical_stretch(const RockProperties &rock, const double horizon)
{
  const double stiffness = (dim == 2 ? 6. / M_PI : 3.) * rock.shear_modulus();
  return std::sqrt(rock.energy_release_rate / (stiffness * horizon));
}

double trapping_factor(const unsigned int m, const double dilatation)
{
  const double driving_force = m <= 2   ? 1.785
                               : m == 3 ? 1.477
                               : m == 4 ? 1.38
                               : m == 5 ? 1.215
                                        : 1. + 0.157 * 36. / (m * m);
  // Poisson's ratio in plane strain, less 1/4. 1.57: a line through the forces of the header,
  // within 2.5 %.
  const double more = (1. + dilatation) / (2. * (2. + dilatation)) - 0.25;
  return 1. / std::sqrt(1. + (driving_force - 1.) * (1. - 1.57 * more));
}

#define STOCKWORK_INSTANTIATE(dim)                                                             \
  template std::vector<BondCoefficients<dim>> bond_coefficients<dim>(                          \
    const std::vector<StencilBond<dim>> &, const BondLaw &, const double);                     \
  template LatticeModuli lattice_moduli<dim>(const std::vector<StencilBond<dim>> &,            \
                                             const BondLaw &, const double);                   \
  template double weighted_volume<dim>(const std::vector<StencilBond<dim>> &, const double);   \
  template BondLaw bond_based_law<dim>(const RockProperties &,                                 \
                                       const std::vector<StencilBond<dim>> &, const double);   \
  template double crossing_energy<dim>(const std::vector<StencilBond<dim>> &, const BondLaw &, \
                                       const double, const double);                            \
  template double continuum_critical_stretch<dim>(const RockProperties &, const double);

STOCKWORK_INSTANTIATE(2)
STOCKWORK_INSTANTIATE(3)
#undef STOCKWORK_INSTANTIATE
} // namespace stockwork::peridynamics
