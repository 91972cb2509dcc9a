#pragma once

#include <deal.II/base/parameter_handler.h>

#include "stockwork/exchange/scene.h"

namespace stockwork
{
/// Subsection "Cracks": notches and natural fractures, the same for every fracture model.
void declare_initial_cracks(dealii::ParameterHandler &prm);

/// The fluid pressure in all cracks if the deck gives it, else NaN [Pa].
double given_crack_pressure(dealii::ParameterHandler &prm);

/// Throws InputError for a crack that is malformed or leaves the box from lower to upper.
template <int dim>
std::vector<InitialCrack<dim>> parse_initial_cracks(dealii::ParameterHandler &prm,
                                                    const dealii::Point<dim> &lower,
                                                    const dealii::Point<dim> &upper);
} // namespace stockwork
