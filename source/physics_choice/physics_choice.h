#pragma once

#include "case.h"
#include "physics_choice/physics_decision.h"
#include "plug_ins.h"

#include "stockwork/base/deck.h"

#include <functional>
#include <vector>

namespace stockwork
{
/// 'Physics = auto': leave out what the deck asks for and the scene does not need, and say so.
///
/// Each decision has an estimate of what the answer changes by; what is left out must not change it
/// by more than 'Accuracy' in all. Where there is no estimate, or where the program refuses the
/// scene without it, the physics stays.
/// @param prm the deck; gets the entries that the decisions set
/// @param strength_with the tensile strength that the fracture model takes with some entries set
/// [Pa]; NaN: none
/// @throws InputError if the deck as it is cannot be used
template <int dim>
std::vector<PhysicsDecision>
leave_out_physics(const Deck &deck,
                  dealii::ParameterHandler &prm,
                  const PlugIns &plug_ins,
                  const std::function<double(const Settings &)> &strength_with);

void set_entries(dealii::ParameterHandler &prm, const Settings &settings);
} // namespace stockwork
