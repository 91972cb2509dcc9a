#pragma once

#include "fracture/peridynamics/fracture_cells.h"

namespace stockwork::peridynamics
{
/// What the pressure in fracture cells does to the rock in the closure of Sun et al. (2021, Eqs. 7
/// and 28), which `Closure = as published` chooses. The corners of a fracture cell have its
/// pressure (the mean, where several meet), and a bond pushes its ends apart by that at them,
///
///   f_i = - lambda c beta V^2 gamma (p_i + p_j)/2 e,
///
/// if it holds (lambda). So broken bonds carry no pressure, all forces act within one side of the
/// crack, and nothing pushes its faces apart.
///
/// @param stretch_of_pressure gamma, the stretch of a bond in free rock under unit pressure [1/Pa];
/// (1+nu)(1-2nu)/E in plane strain, of which Eq. 9b prints the inverse
/// @return for each cell the forces of unit pressure in it over its area, see Segment::load
template <int dim>
std::vector<LinearFunctional>
published_loads(const Zone<dim> &zone,
                const BondSet<dim> &bonds,
                const std::vector<BondCoefficients<dim>> &coefficients,
                double stretch_of_pressure,
                const std::vector<FractureCell<dim>> &cells);
} // namespace stockwork::peridynamics
