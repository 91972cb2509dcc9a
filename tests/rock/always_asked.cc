// A law of the rock from outside the tree: linear, and yet asked in every cell and iteration. With
// it a run must come to the same end as with the law 'elastic', which nobody asks.
#include <stockwork/rock/registry.h>

namespace
{
using namespace dealii;
using namespace stockwork;

class AlwaysAsked : public RockLaw
{
public:
  explicit AlwaysAsked(const RockProperties &rock)
    : rock(rock)
  {
  }

  std::vector<HistoryField> history() const override
  {
    return {{"times_committed"}};
  }

  void evaluate(ArrayView<const RockState> states, ArrayView<RockResponse> responses) const override
  {
    const auto identity = unit_symmetric_tensor<3>();
    for (unsigned int q = 0; q < states.size(); ++q)
    {
      const RockState &state = states[q];
      RockResponse &response = responses[q];
      response.stress_by_strain = rock.lame_lambda() * outer_product(identity, identity) +
                                  2. * rock.shear_modulus() * identity_tensor<3>();
      response.stress_by_pressure = -rock.biot_coefficient * identity;
      response.content_by_strain = rock.biot_coefficient * identity;
      response.content_by_pressure = rock.inverse_biot_modulus;
      response.stress =
        response.stress_by_strain * state.strain + state.pressure * response.stress_by_pressure;
      response.content =
        rock.biot_coefficient * trace(state.strain) + rock.inverse_biot_modulus * state.pressure;
      response.energy = 0.5 * (state.strain * (response.stress_by_strain * state.strain)) +
                        0.5 * rock.inverse_biot_modulus * state.pressure * state.pressure +
                        state.in_situ_stress * state.strain +
                        state.in_situ_pressure * response.content;
      if (response.history != nullptr)
        response.history[0] = 1. + (state.history != nullptr ? state.history[0] : 0.);
    }
  }

  double used(const RockState &) const override
  {
    return 0.5; // in situ it must not yield
  }

  double margin(const RockState &) const override
  {
    return -1.;
  }

private:
  RockProperties rock;
};
} // namespace


extern "C" void stockwork_register_rock_laws(RockLawRegistry &registry)
{
  RockLawEntry entry;
  entry.description = "Linear, the slow way.";
  entry.create = [](const ParameterHandler &, const std::string &, const RockProperties &rock)
  { return std::make_unique<AlwaysAsked>(rock); };
  registry.add("always asked", entry);
}
