#include "rock/wave_speeds.h"

#include "stockwork/rock/linear_stiffness.h"

#include <algorithm>
#include <cmath>

namespace stockwork
{
namespace
{
constexpr double density_of_common_rock = 2500.; // kg/m^3

double density_of(const RockProperties &rock)
{
  return rock.density > 0. ? rock.density : density_of_common_rock;
}
} // namespace


double rayleigh_speed(const RockProperties &rock)
{
  const double shear_speed = std::sqrt(LinearStiffness<2>(rock).shear_modulus() / density_of(rock));
  // From 0 to 0.5 it changes the speed by a tenth: a common one will do in anisotropic rock.
  const double ratio = rock.stiffness ? 0.25 : rock.poisson_ratio;
  return shear_speed * (0.87 + 1.12 * ratio) / (1. + ratio);
}


double fastest_wave_speed(const RockProperties &rock, const bool has_pore_pressure)
{
  const LinearStiffness<2> stiffness(rock);
  double modulus = stiffness.bulk_modulus() + stiffness.shear_modulus();
  if (rock.stiffness)
    for (unsigned int d = 0; d < 3; ++d)
      modulus = std::max(modulus, (*rock.stiffness)[d][d][d][d]);
  if (has_pore_pressure && rock.inverse_biot_modulus > 0.)
    modulus += rock.biot_coefficient * rock.biot_coefficient / rock.inverse_biot_modulus;
  return std::sqrt(modulus / density_of(rock));
}
} // namespace stockwork
