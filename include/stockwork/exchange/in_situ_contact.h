#pragma once

#include "stockwork/exchange/scene.h"

#include <algorithm>

namespace stockwork
{
/// Traction between the faces of a closed crack before anything happens: the stress in situ across
/// it beyond the pores' pressure, n.sigma_0 n + p_0, never positive [Pa]. Zero in rock without
/// pores, where a crack begins with fluid at the stress across it.
template <int dim>
double in_situ_contact(const Scene<dim> &scene,
                       const dealii::Point<dim> &centre,
                       const dealii::Tensor<1, dim> &normal)
{
  if (!scene.has_pore_pressure)
    return 0.;
  return std::min(0., normal * (scene.in_situ_stress(centre) * normal) +
                        scene.in_situ_pore_pressure(centre));
}
} // namespace stockwork
