#pragma once

#include "fracture/peridynamics/fracture_cells.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"

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
/// @return for each cell the forces of unit pressure in it over its area
template <int dim>
std::vector<LinearFunctional>
published_loads(const Zone<dim> &zone,
                const BondSet<dim> &bonds,
                const std::vector<BondCoefficients<dim>> &coefficients,
                double stretch_of_pressure,
                const std::vector<FractureCell<dim>> &cells);


/// A segment whose pressure loads the rock as published: the fluid network loads it by the
/// transpose of the segment's opening, and this adds the difference. The work p A dw of the fluid
/// does not equal that of these forces.
template <int dim>
class PublishedLoad
{
public:
  /// @param forces of unit pressure over the segment's area; none: no load at all
  PublishedLoad(const Segment<dim> &segment, const LinearFunctional &forces);

  void assemble(const State &state, Sink &sink) const;

private:
  std::uint64_t segment;
  LinearFunctional difference; ///< force per pressure
};
} // namespace stockwork::peridynamics
