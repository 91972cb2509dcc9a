#include "rock/stress_dependent_permeability.h"

#include <algorithm>
#include <cmath>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Greatest k/k_0, in tension.
constexpr double maximum_share = 1e6;
} // namespace


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
    const double exponent = -effective / decay_stress, greatest = std::log(maximum_share);
    response.permeability = std::exp(std::min(exponent, greatest)) * unstressed;
    if (exponent > greatest)
    {
      response.permeability_by_strain = SymmetricTensor<4, 3>();
      response.permeability_by_pressure = SymmetricTensor<2, 3>();
      response.remark =
        "The effective stress of the rock has come to a tension in which its permeability would be "
        "more than a million times 'Rock/Permeability': there it is kept at that. Is the unit of "
        "'Rock/Permeability decay stress' right?";
      continue;
    }
    // Through -d(sigma'_m)/d(strain) = 1 : d(sigma)/d(strain) / 3, and likewise by the pressure.
    const SymmetricTensor<2, 3> slope = response.permeability / decay_stress;
    response.permeability_by_strain =
      outer_product(slope, SymmetricTensor<2, 3>(identity * response.stress_by_strain / 3.));
    response.permeability_by_pressure =
      (trace(response.stress_by_pressure) / 3. + biot_coefficient) * slope;
  }
}
} // namespace stockwork
