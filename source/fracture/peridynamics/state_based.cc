#include "fracture/peridynamics/state_based.h"

#include "fracture/peridynamics/lattice_moduli.h"

namespace stockwork::peridynamics
{
template <int dim>
BondLaw state_based_law(const RockProperties &rock,
                        const std::vector<StencilBond<dim>> &stencil,
                        const double spacing)
{
  BondLaw law = bond_based_law<dim>(rock, stencil, spacing);
  law.dilatation_modulus = rock.lame_lambda() - rock.shear_modulus();
  return law;
}

template BondLaw
state_based_law<2>(const RockProperties &, const std::vector<StencilBond<2>> &, const double);
template BondLaw
state_based_law<3>(const RockProperties &, const std::vector<StencilBond<3>> &, const double);
} // namespace stockwork::peridynamics
