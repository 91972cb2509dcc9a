#pragma once

#include "stockwork/rock/rock.h"

namespace stockwork::peridynamics
{
/// Rock for tests of the lattice: E = 10 GPa, G_c = 100 J/m^2.
inline RockProperties lattice_rock(const double poisson_ratio, const bool plane_stress = false)
{
  RockProperties rock;
  rock.young_modulus = 1e10;
  rock.poisson_ratio = poisson_ratio;
  rock.plane_stress = plane_stress;
  rock.energy_release_rate = 100.;
  return rock;
}
} // namespace stockwork::peridynamics
