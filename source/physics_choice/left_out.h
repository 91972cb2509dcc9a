#pragma once

#include "case.h"

#include "coupling/coupled_system.h"
#include "coupling/stepper.h"

namespace stockwork
{
/// What a state says of physics that 'Physics = auto' has left out.
struct LeftOut
{
  double kinetic_share = 0.; ///< energy of the rock's motion, over what it stores
  double strength_used = 0.; ///< greatest share of the strength; 0: none is left out
};

/// Of the last accepted step, at the centres of the cells that no crack cuts. Collective.
template <int dim>
LeftOut observe_left_out(const Case<dim> &the_case,
                         const CoupledSystem<dim> &system,
                         const Stepper<dim> &stepper);
} // namespace stockwork
