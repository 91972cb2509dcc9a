#include "rock/stress_dependent_permeability.h"

#include <cmath>

namespace stockwork
{
using namespace dealii;

StressDependentPermeability::StressDependentPermeability(std::unique_ptr<RockLaw> inside,
                                                         const RockProperties &properties)
  : inside(std::move(inside))
  , unstressed(properties.permeability_tensor<3>())
  , decay_stress(properties.permeability_decay_stress)
  , biot_coefficient(properties.biot_coefficient)
{
}


void StressDependentPermeability::evaluate(const ArrayView<const RockState> states,
                                           const ArrayView<RockResponse> responses) const
{
  const auto identity = unit_symmetric_tensor<3>();
  inside->evaluate(states, responses);
  for (unsigned int q = 0; q < states.size(); ++q)
  {
    const RockState &state = states[q];
    RockResponse &response = responses[q];
    const double effective = -trace(state.in_situ_stress + response.stress) / 3. -
                             biot_coefficient * (state.in_situ_pressure + state.pressure);
    response.permeability = std::exp(-effective / decay_stress) * unstressed;
    // Through -d(sigma'_m)/d(strain) = 1 : d(sigma)/d(strain) / 3, and likewise by the pressure.
    const SymmetricTensor<2, 3> slope = response.permeability / decay_stress;
    response.permeability_by_strain =
      outer_product(slope, SymmetricTensor<2, 3>(identity * response.stress_by_strain / 3.));
    response.permeability_by_pressure =
      (trace(response.stress_by_pressure) / 3. + biot_coefficient) * slope;
  }
}
} // namespace stockwork
