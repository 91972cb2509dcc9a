#pragma once

#include <algorithm>

namespace stockwork
{
/// Residuals by equation.
struct ResidualNorms
{
  double momentum = 0.;       ///< forces in the bulk [N (/m)]
  double mass = 0.;           ///< fluid in the pores [m^3 (/m)]
  double extra = 0.;          ///< the fracture model's own, such as forces on the faces
  double fracture_fluid = 0.; ///< [m^3 (/m)]

  void keep_maximum(const ResidualNorms &other)
  {
    momentum = std::max(momentum, other.momentum);
    mass = std::max(mass, other.mass);
    extra = std::max(extra, other.extra);
    fracture_fluid = std::max(fracture_fluid, other.fracture_fluid);
  }
};
} // namespace stockwork
