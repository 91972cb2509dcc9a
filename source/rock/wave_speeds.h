#pragma once

#include "stockwork/rock/rock.h"

namespace stockwork
{
/// From which on inertia matters to a fracture: of its tips, over that of Rayleigh waves.
constexpr double speed_of_fast_tips = 0.1;

/// To 1 %: Viktorov's fit to the shear wave speed [m/s]. Where the deck gives no density, of rock
/// as heavy as most.
double rayleigh_speed(const RockProperties &rock);

/// Of compression, along the stiffest axis of the run [m/s]. Density as above.
/// @param has_pore_pressure the rock's pores keep their fluid: its undrained stiffness counts
double fastest_wave_speed(const RockProperties &rock, bool has_pore_pressure);
} // namespace stockwork
