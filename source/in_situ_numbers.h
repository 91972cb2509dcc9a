#pragma once

#include "mesh_sizes.h"
#include "scene_numbers.h"

#include <vector>

namespace stockwork
{
/// The greatest compression in situ, as people give it, and so that components in a wrong order are
/// seen.
void add_principal_stresses(const Case<2> &the_case, std::vector<SceneNumber> &numbers);

/// The in-situ pore pressure beside the stress that bears it, in the middle of the domain.
template <int dim>
void add_pore_pressure(const Case<dim> &the_case, std::vector<SceneNumber> &numbers);

/// Where the deck gives the pressure in cracks, or in wells that feed them: beside the stress
/// across the cracks, and beside what lets them grow.
template <int dim>
void add_given_pressure(const Case<dim> &the_case,
                        const MeshSizes<dim> &mesh,
                        std::vector<SceneNumber> &numbers);

/// What would slide an open crack in situ, and what friction it would take to hold it.
template <int dim>
void add_shear_along_cracks(const Case<dim> &the_case, std::vector<SceneNumber> &numbers);
} // namespace stockwork
