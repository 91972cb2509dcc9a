// A circular hydraulic fracture driven from its middle at a constant rate, or half or a quarter of
// it beside planes of symmetry.
#include "verification/analytical/hydraulic_fracture.h"

#include "stockwork/base/error.h"

#include "verification/reference/problems.h"

namespace stockwork::reference
{
using namespace dealii;

namespace
{
class RadialReference : public ReferenceSolution<3>
{
public:
  RadialReference(const analytical::HydraulicFractureParameters &parameters,
                  const double last_time,
                  const double share)
    : fracture(parameters, last_time)
    , leaks(parameters.leak_off_coefficient > 0.)
    , share(share)
  {
  }

  std::string name() const override
  {
    return "Radial fracture (Savitski & Detournay 2002, any toughness)";
  }

  double valid_until() const override
  {
    return fracture.valid_until();
  }

  /// The length of a fracture in space is its area.
  std::map<std::string, double> values(const double time) const override
  {
    const double radius = fracture.half_length(time);
    std::map<std::string, double> result = {
      {"equivalent_length", share * numbers::PI * radius * radius},
      {"inlet_aperture", fracture.inlet_opening(time)},
      {"fracture_volume", share * fracture.fracture_volume(time)}};
    if (leaks)
      result["leaked_volume"] = share * fracture.leaked_volume(time);
    return result;
  }

private:
  analytical::HydraulicFracture fracture;
  bool leaks;
  double share;
};
} // namespace


Made<3> make_radial(const ParameterHandler &, const ReferenceInput<3> &input)
{
  const double share = share_of_disc(input);
  const RockProperties &rock = input.rock.main();
  if (!(input.injection_rate > 0.))
    throw InputError(
      "The reference solution of the radial fracture needs a well with a positive rate.");
  if (!(rock.energy_release_rate > 0.))
    throw InputError(
      "The reference solution of the radial fracture needs 'Rock/Fracture toughness' or "
      "'Rock/Critical energy release rate'.");
  if (input.n_wells > 1 || !input.rate_is_constant || input.layered || input.has_stress_gradient)
    throw InputError("The reference solution of the radial fracture is for one well of constant "
                     "rate, rock without regions and in-situ stress without a gradient.");
  if (input.leaks && !(input.carter_coefficient > 0.))
    throw InputError("The reference solution of the radial fracture knows Carter leak-off only.");
  analytical::HydraulicFractureParameters parameters;
  parameters.fracture = {rock.young_modulus, rock.poisson_ratio, input.rock.fluid().viscosity,
                         rock.toughness(), input.injection_rate};
  parameters.leak_off_coefficient = input.carter_coefficient;
  parameters.shape = analytical::CrackShape::penny;
  return std::make_unique<RadialReference>(parameters, input.end_time, share);
}
} // namespace stockwork::reference
