#pragma once

#include "fracture/peridynamics/bond_law.h"
#include "fracture/peridynamics/softening.h"

namespace stockwork::peridynamics
{
/// Work per area [J/m^2] that it takes to move the two halves of a lattice apart, at right angles
/// to a plane between two of its layers, until all bonds across it are broken.
///
/// Springs take what crossing_energy() says, in whatever order they break. A dilatation is the
/// family's, theta = sum g (1 - D) e, and long and slanting bonds break late: so what it takes is
/// summed over the way.
template <int dim>
double separation_energy(const std::vector<StencilBond<dim>> &stencil,
                         const BondLaw &law,
                         const double spacing,
                         const SofteningLaw &softening);
} // namespace stockwork::peridynamics
