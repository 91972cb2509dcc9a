#include "fracture/peridynamics/separation.h"

#include "fracture/peridynamics/lattice_moduli.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
template <int dim>
double separation_energy(const std::vector<StencilBond<dim>> &stencil,
                         const BondLaw &law,
                         const double spacing,
                         const SofteningLaw &softening)
{
  BondLaw springs = law;
  springs.dilatation_modulus = 0.;
  const double energy =
    crossing_energy<dim>(stencil, springs, spacing, std::sqrt(softening.first * softening.last));
  if (!law.state_based())
    return energy;
  if (softening.brittle()) // all at one stretch
    return crossing_energy<dim>(stencil, law, spacing, softening.last);

  struct BondAcross
  {
    int climb;       // layers
    double stretch;  // per opening
    double dilation; // theta of an end, per opening
  };
  std::vector<BondAcross> bonds;
  double most_opening = 0.;
  int most_climb = 0;
  const auto coefficients = bond_coefficients<dim>(stencil, law, spacing);
  for (unsigned int b = 0; b < stencil.size(); ++b)
    if (const int climb = stencil[b].offset[dim - 1]; climb > 0)
    {
      const double cosine = coefficients[b].direction[dim - 1];
      bonds.push_back(
        {climb, cosine / coefficients[b].length, coefficients[b].dilatation * cosine});
      most_opening = std::max(most_opening, softening.last / bonds.back().stretch);
      most_climb = std::max(most_climb, climb);
    }
  // Damage has kinks where bonds begin to soften and where they break.
  constexpr unsigned int n_parts = 400;
  const dealii::QIterated<1> way(dealii::QGauss<1>(3), n_parts);
  double of_dilatations = 0.;
  for (unsigned int q = 0; q < way.size(); ++q)
  {
    const double opening = way.point(q)[0] * most_opening;
    // A bond that climbs k layers begins in one of the k layers below the plane.
    for (int layer = 0; layer < most_climb; ++layer)
    {
      double left = 0.;
      for (const BondAcross &bond : bonds)
        if (layer < bond.climb)
          left += (1. - softening.damage(bond.stretch * opening)) * bond.dilation;
      // theta times what still counts of the elongations, below the plane and above.
      of_dilatations += 2. * way.weight(q) * most_opening * left * left * opening;
    }
  }
  return energy + law.dilatation_modulus * spacing * of_dilatations;
}

template double separation_energy<2>(const std::vector<StencilBond<2>> &,
                                     const BondLaw &,
                                     const double,
                                     const SofteningLaw &);
template double separation_energy<3>(const std::vector<StencilBond<3>> &,
                                     const BondLaw &,
                                     const double,
                                     const SofteningLaw &);
} // namespace stockwork::peridynamics
