#pragma once

#include "fracture/damage/crack_cell.h"
#include "stockwork/exchange/scene.h"

#include <string>
#include <vector>

namespace stockwork::damage
{
/// What is said of a crack of the deck that is not quite the cells it passes.
/// @param size of all of them together [m; m^2 in 3-D]
template <int dim>
std::vector<std::string> misfit_of_cells(const InitialCrack<dim> &crack,
                                         const std::vector<CrackCell<dim>> &passed,
                                         double size,
                                         bool pressure_is_given);

/// What is said before cracks of these cells grow: how far off that may be, for their directions
/// and shapes.
template <int dim>
std::vector<std::string> doubts_about_growth(const std::vector<CrackCell<dim>> &cells,
                                             const Scene<dim> &scene);
} // namespace stockwork::damage
