#pragma once

#include "case.h"
#include "physics_choice/physics_decision.h"

#include "stockwork/base/deck.h"

#include <functional>
#include <memory>
#include <string>

namespace stockwork
{
/// A decision to keep something. The reason is for people.
PhysicsDecision kept(const std::string &name, const std::string &why);

std::string with_digits(double value, int digits);

/// "3.4 %"
std::string as_percentage(double share);

/// Loads that begin to grow, or a rate that begins, set the rock swinging by what they bring within
/// one period; of a fracture that runs, elasticity errs by the square of its speed over that of
/// waves (Freund 1990).
template <int dim>
PhysicsDecision decide_inertia(const Case<dim> &the_case);

/// Everywhere the stress in situ, that of the loads, three times as great beside holes and corners,
/// in any direction; beside the tips of cracks the tensile strength, and on their faces the
/// pressure that drives them.
template <int dim>
PhysicsDecision decide_plasticity(const std::shared_ptr<const Case<dim>> &asked_for,
                                  const dealii::ParameterHandler &prm);

/// Where the pore fluid hardly moves, rock is elastic with its undrained constants. In a rim
/// sqrt(c t) deep it does move, and there the rock is softer.
/// @param strength that the fracture model takes in the porous rock; asked for where the deck gives
/// none, for the undrained rock is stiffer, and the model would take another
template <int dim>
PhysicsDecision
decide_pores(const Case<dim> &the_case, const Deck &deck, const std::function<double()> &strength);

/// Pressure gradients along a fracture, which stay.
PhysicsDecision decide_lubrication(const Case<2> &the_case);
} // namespace stockwork
