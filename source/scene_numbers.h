#pragma once

#include "case.h"
#include "mesh_sizes.h"

#include <string>
#include <vector>

namespace stockwork
{
/// One number that says which physics a scene needs, and what follows from it.
struct SceneNumber
{
  std::string name;
  double value;
  std::string consequence;
  bool spoils = false; ///< the answer cannot be trusted: a warning of the run
};

/// The numbers of a case, computed before the first step. Lengths and speeds of a fracture that is
/// still to come are those of the plane-strain fracture when its pumping ends, with leak-off if
/// there is any (analytical/kgd.h, kgd_leak_off.h).
template <int dim>
std::vector<SceneNumber> scene_numbers(const Case<dim> &the_case, const MeshSizes<dim> &mesh);
} // namespace stockwork
