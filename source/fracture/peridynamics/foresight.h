#pragma once

#include "fracture/peridynamics/lattice.h"

#include <string>
#include <vector>

namespace stockwork::peridynamics
{
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
