#pragma once

#include "fracture/peridynamics/lattice.h"
#include "verification/analytical/kgd.h"

#include <optional>
#include <string>
#include <vector>

namespace stockwork::peridynamics
{
/// What the scene's greatest rate drives through its rock, as a plane fracture without walls; none
/// in three dimensions, without a crack or a rate.
template <int dim>
std::optional<analytical::KgdParameters> driven_fracture(const Scene<dim> &scene);

/// @throws InputError for entries of the deck that bonds would drop without a word
template <int dim>
void refuse_what_bonds_do_not_know(const Parameters<dim> &parameters, const Scene<dim> &scene);

/// @throws InputError where steps shall be explicit and cannot
template <int dim>
void refuse_explicit_steps(const Parameters<dim> &parameters, const Scene<dim> &scene);

/// What of the scene bonds of cells of this size [m] cannot carry, as sentences.
/// @param lattice with the law of such bonds
/// @throws InputError for what cannot come to an end
template <int dim>
std::vector<std::string> foresee(const Lattice<dim> &lattice, double spacing);
} // namespace stockwork::peridynamics
