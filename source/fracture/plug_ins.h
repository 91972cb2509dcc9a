#pragma once

#include "stockwork/base/deck.h"
#include "stockwork/fracture/registry.h"

namespace stockwork
{
/// Load the shared libraries that the deck names and register their models. They stay loaded until
/// the program ends.
/// @throws EntryError for a file that is no plug-in
void load_plug_ins(const Deck &deck, FractureModelRegistry &registry);
} // namespace stockwork
