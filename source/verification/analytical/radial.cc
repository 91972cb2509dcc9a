#include "verification/analytical/radial.h"

#include "verification/analytical/constants.h"

#include <cmath>

namespace stockwork::analytical
{
namespace
{
double scaled_toughness(const double toughness)
{
  return 4. * std::sqrt(2. / pi) * toughness;
}
} // namespace


double radial_toughness(const KgdParameters &parameters, const double t)
{
  return scaled_toughness(parameters.toughness) *
         std::pow(t * t /
                    (std::pow(12. * parameters.viscosity, 5) * std::pow(parameters.rate, 3) *
                     std::pow(parameters.plane_strain_modulus(), 13)),
                  1. / 18.);
}


double radial_radius(const KgdParameters &parameters, const double t)
{
  const double modulus = parameters.plane_strain_modulus(), rate = parameters.rate;
  const double by_viscosity =
    0.6976 *
    std::pow(modulus * std::pow(rate, 3) * std::pow(t, 4) / (12. * parameters.viscosity), 1. / 9.);
  if (!(parameters.toughness > 0.))
    return by_viscosity;
  const double by_toughness =
    0.8546 * std::pow(modulus * rate * t / scaled_toughness(parameters.toughness), 0.4);
  // Fitted: what is less than both and tends to each of them.
  return std::pow(std::pow(by_viscosity, -8) + std::pow(by_toughness, -8), -1. / 8.);
}
} // namespace stockwork::analytical
