#pragma once

#include "rock/mohr_coulomb/strength.h"

#include <string>

namespace stockwork::reference
{
/// For solutions of rock that is perfectly plastic up to its apex.
/// @param name of the reference, for the message
/// @throws EntryError where the rock has a tension cut-off, hardens or softens
void require_perfectly_plastic(const mohr_coulomb::Strength &strength, const std::string &name);
} // namespace stockwork::reference
