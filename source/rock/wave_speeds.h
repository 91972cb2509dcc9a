#pragma once

#include "stockwork/rock/rock.h"

namespace stockwork
{
/// To 1 %: Viktorov's fit to the shear wave speed [m/s]. Where the deck gives no density, of rock
/// as heavy as most.
double rayleigh_speed(const RockProperties &rock);

/// Of compression, in rock whose pores keep their fluid [m/s]. Density as above.
double fastest_wave_speed(const RockProperties &rock);
} // namespace stockwork
