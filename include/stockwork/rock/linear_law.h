#pragma once

#include "stockwork/rock/law.h"
#include "stockwork/rock/linear_stiffness.h"

#include <limits>

namespace stockwork
{
/// What rock in its linear range answers.
inline RockResponse linear_response(const RockProperties &rock, const RockState &state)
{
  const auto identity = dealii::unit_symmetric_tensor<3>();
  const LinearStiffness<3> hooke(rock);
  const auto stress = hooke.stress(state.strain);
  RockResponse response;
  response.stress_by_strain = hooke.tensor();
  response.stress_by_pressure = -rock.biot_coefficient * identity;
  response.content_by_strain = rock.biot_coefficient * identity;
  response.content_by_pressure = rock.inverse_biot_modulus;
  response.stress = stress + state.pressure * response.stress_by_pressure;
  response.content =
    rock.biot_coefficient * trace(state.strain) + rock.inverse_biot_modulus * state.pressure;
  response.energy = 0.5 * (stress * state.strain) +
                    0.5 * rock.inverse_biot_modulus * state.pressure * state.pressure +
                    state.in_situ_stress * state.strain + state.in_situ_pressure * response.content;
  return response;
}


/// A rock that is linear whatever happens: the elements know it by its constants. It is asked only
/// by a law that has it inside.
class LinearRockLaw : public RockLaw
{
public:
  explicit LinearRockLaw(const RockProperties &properties)
    : properties(properties)
  {
  }

  bool is_linear() const override
  {
    return true;
  }

  void evaluate(dealii::ArrayView<const RockState> states,
                dealii::ArrayView<RockResponse> responses) const override
  {
    for (unsigned int q = 0; q < states.size(); ++q)
    {
      double *const history = responses[q].history;
      responses[q] = linear_response(properties, states[q]);
      responses[q].history = history;
    }
  }

  double used(const RockState &) const override
  {
    return 0.;
  }

  double margin(const RockState &) const override
  {
    return std::numeric_limits<double>::infinity();
  }

private:
  const RockProperties properties;
};
} // namespace stockwork
