#include "rock/mohr_coulomb/law.h"

#include "stockwork/base/quantity.h"

#include <cmath>
#include <limits>
#include <sstream>

namespace stockwork::mohr_coulomb
{
using namespace dealii;

namespace
{
/// Where in the history the equivalent plastic strain is, after the tensor.
constexpr unsigned int at_equivalent = 6;


SymmetricTensor<2, 3> plastic_strain(const RockState &state)
{
  SymmetricTensor<2, 3> strain;
  if (state.history != nullptr)
    for (unsigned int i = 0; i < 6; ++i)
      strain.access_raw_entry(i) = state.history[i];
  return strain;
}


const char *remark_on(const Return &back, const Strength &strength)
{
  if (back.by_decree)
    return "The rock has come to a tension beyond c cot phi, from which plastic flow with a "
           "dilation angle of 0 does not lead back: the stress was put to c cot phi in all "
           "directions, though that changes the volume. A dilation angle above 0, or a 'Tension "
           "cut-off', has no such states.";
  if (back.place != Place::elastic && strength.hardening_modulus < 0.)
    return "The rock has yielded and softens ('Hardening modulus' below 0): it goes on to yield "
           "in a band as wide as the cells, so what happens from there on depends on the mesh, "
           "and so does the energy that is dissipated. Compare meshes.";
  return nullptr;
}
} // namespace


MohrCoulomb::MohrCoulomb(const RockProperties &properties, const Strength &strength)
  : lambda(properties.lame_lambda())
  , mu(properties.shear_modulus())
  , alpha(properties.biot_coefficient)
  , inverse_biot_modulus(properties.inverse_biot_modulus)
  , strength(strength)
{
}


bool MohrCoulomb::is_symmetric() const
{
  // The flow changes the cohesion, which the stress does not do to the flow.
  return strength.dilation_angle == strength.friction_angle && strength.is_perfectly_plastic();
}


std::vector<HistoryField> MohrCoulomb::history() const
{
  return {{"plastic_strain", true}, {"equivalent_plastic_strain", false}};
}


SymmetricTensor<2, 3> MohrCoulomb::trial_stress(const RockState &state,
                                                const Tensor2 &elastic_strain) const
{
  const auto identity = unit_symmetric_tensor<3>();
  return state.in_situ_stress + 2. * mu * elastic_strain +
         (state.in_situ_pressure + lambda * trace(elastic_strain) + (1. - alpha) * state.pressure) *
           identity;
}


void MohrCoulomb::evaluate(const ArrayView<const RockState> states,
                           const ArrayView<RockResponse> responses) const
{
  const auto identity = unit_symmetric_tensor<3>();
  const double bulk = lambda + 2. / 3. * mu;
  for (unsigned int q = 0; q < states.size(); ++q)
  {
    const RockState &state = states[q];
    RockResponse &response = responses[q];
    const Tensor2 before = plastic_strain(state), trial_strain = state.strain - before,
                  trial = trial_stress(state, trial_strain);
    const double equivalent = state.history != nullptr ? state.history[at_equivalent] : 0.;
    const Return back = return_to_surface(trial, lambda, mu, strength, equivalent);

    // The plastic strain is what the return has taken from the stress, by the elastic compliance.
    const Tensor2 lost = trial - back.stress;
    const Tensor2 flow = deviator(lost) / (2. * mu) + trace(lost) / (9. * bulk) * identity;
    const Tensor2 plastic = before + flow, elastic = trial_strain - flow;

    response.stress =
      back.stress - state.in_situ_stress - (state.in_situ_pressure + state.pressure) * identity;
    response.content =
      alpha * trace(elastic) + trace(plastic) + inverse_biot_modulus * state.pressure;
    // Over in situ, which the elastic strain works against as well.
    response.energy =
      mu * (elastic * elastic) + 0.5 * lambda * trace(elastic) * trace(elastic) +
      0.5 * inverse_biot_modulus * state.pressure * state.pressure +
      state.in_situ_stress * elastic +
      state.in_situ_pressure * (alpha * trace(elastic) + inverse_biot_modulus * state.pressure);

    // Work of the total stress on the flow, and of the pressure on the pores that it opens, both at
    // the end of the step as the flow rule has it: never negative.
    response.dissipated = back.stress * flow;

    // A trial stress C : e + (1 - alpha) p 1: p acts as the strain (1 - alpha) p / (3 K) 1.
    response.stress_by_strain = back.tangent;
    response.stress_by_pressure = (1. - alpha) / (3. * bulk) * (back.tangent * identity) - identity;
    response.content_by_strain = identity - (1. - alpha) / (3. * bulk) * (identity * back.tangent);
    // d(tr e)/dp = tr(C^-1 d(stress)) - (1 - alpha)/K, with d(stress) = T (1 - alpha)/(3 K) 1.
    const double strain_by_pressure =
      (1. - alpha) / bulk * (identity * (back.tangent * identity) / (9. * bulk) - 1.);
    response.content_by_pressure = inverse_biot_modulus - (1. - alpha) * strain_by_pressure;

    response.remark = remark_on(back, strength);
    if (response.history != nullptr)
    {
      for (unsigned int i = 0; i < 6; ++i)
        response.history[i] = plastic.access_raw_entry(i);
      response.history[at_equivalent] = equivalent + std::sqrt(2. / 3. * (flow * flow));
    }
  }
}


double MohrCoulomb::used(const RockState &state) const
{
  return share_of_strength(trial_stress(state, state.strain), strength);
}


double MohrCoulomb::margin(const RockState &state) const
{
  return margin_to_yield(trial_stress(state, state.strain), strength);
}


std::string MohrCoulomb::describe() const
{
  constexpr double degree = numbers::PI / 180.;
  const auto angle = [](const double value)
  {
    std::ostringstream text;
    text << value / degree << " deg";
    return text.str();
  };
  std::string text = "cohesion " + to_string(strength.cohesion, dimension::stress) +
                     ", friction angle " + angle(strength.friction_angle) + ", dilation angle " +
                     angle(strength.dilation_angle);
  if (strength.has_cut_off())
    text += ", tension cut-off " + to_string(strength.tension_cut_off, dimension::stress);
  if (strength.is_perfectly_plastic())
    return text;
  text += ", hardening modulus " + to_string(strength.hardening_modulus, dimension::stress);
  if (strength.final_cohesion < std::numeric_limits<double>::infinity())
    text += ", final cohesion " + to_string(strength.final_cohesion, dimension::stress);
  if (strength.hardening_modulus < 0.)
    text += " (softens: a band that yields is as wide as the cells, so the answer depends on the "
            "mesh)";
  return text;
}
} // namespace stockwork::mohr_coulomb
