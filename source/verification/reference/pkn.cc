// A long fracture of constant height, one wing of it beside a plane of symmetry, or a half or a
// quarter of one; tight, or with Carter leak-off.
#include "verification/analytical/pkn.h"
#include "verification/analytical/pkn_carter.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "verification/reference/problems.h"

namespace stockwork::reference
{
using namespace dealii;

namespace
{
class PknReference : public ReferenceSolution<3>
{
public:
  /// @param share of both wings that is in the model
  PknReference(const analytical::PknParameters &parameters, const double share)
    : fracture(parameters)
    , height(parameters.height)
    , share(share)
  {
  }

  std::string name() const override
  {
    return "Fracture of constant height (Perkins & Kern 1961, Nordgren 1972, Kemp 1990)";
  }

  /// The length of a fracture in space is its area.
  std::map<std::string, double> values(const double time) const override
  {
    return {{"equivalent_length", 2. * share * height * fracture.length(time)},
            {"inlet_aperture", fracture.inlet_opening(time)},
            {"net_inlet_pressure", fracture.inlet_pressure(time)},
            {"fracture_volume", 2. * share * fracture.volume(time)}};
  }

private:
  analytical::Pkn fracture;
  double height, share;
};


class PknCarterReference : public ReferenceSolution<3>
{
public:
  /// @param share of both wings that is in the model
  PknCarterReference(const analytical::PknParameters &parameters,
                     const double leak_off_coefficient,
                     const double share)
    : fracture(parameters, leak_off_coefficient)
    , height(parameters.height)
    , share(share)
  {
  }

  std::string name() const override
  {
    return "Fracture of constant height with Carter leak-off (Nordgren 1972)";
  }

  std::map<std::string, double> values(const double time) const override
  {
    return {{"equivalent_length", 2. * share * height * fracture.length(time)},
            {"inlet_aperture", fracture.inlet_opening(time)},
            {"net_inlet_pressure", fracture.inlet_pressure(time)},
            {"fracture_volume", 2. * share * fracture.volume(time)},
            {"leaked_volume", 2. * share * fracture.leaked_volume(time)}};
  }

private:
  analytical::PknCarter fracture;
  double height, share;
};
} // namespace


Made<3> make_pkn(const ParameterHandler &prm, const ReferenceInput<3> &input)
{
  const auto height = get_optional_quantity(prm, "Fracture height", dimension::length);
  if (!height)
    throw EntryError(
      "Verification/Fracture height", "",
      "the height between the layers that hold the fracture, with 'Reference = pkn'");
  if (!(input.injection_rate > 0.) || input.n_wells > 1 || !input.rate_is_constant)
    throw InputError("The reference solution of a fracture of constant height is for one well of "
                     "constant, positive rate.");
  if (input.has_stress_gradient)
    throw InputError(
      "The reference solution of a fracture of constant height is for in-situ stress "
      "without a gradient.");
  if (input.leaks && !(input.carter_coefficient > 0.))
    throw InputError(
      "The reference solution of a fracture of constant height knows Carter leak-off only.");
  const RockProperties &rock = input.rock.main();
  const analytical::PknParameters parameters{rock.young_modulus, rock.poisson_ratio,
                                             input.rock.fluid().viscosity, *height,
                                             0.5 * input.injection_rate};
  if (input.carter_coefficient > 0.)
    return std::make_unique<PknCarterReference>(parameters, input.carter_coefficient,
                                                input.fraction_in_model);
  return std::make_unique<PknReference>(parameters, input.fraction_in_model);
}
} // namespace stockwork::reference
