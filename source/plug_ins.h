#pragma once

#include "stockwork/base/deck.h"
#include "stockwork/fracture/registry.h"
#include "stockwork/rock/registry.h"

namespace stockwork
{
/// What can be added to the program without a change to it.
struct PlugIns
{
  FractureModelRegistry fracture_models;
  RockLawRegistry rock_laws;

  /// All that the program brings itself.
  static PlugIns own();

  /// Load the shared libraries that the deck names and register what they bring. They stay loaded
  /// until the program ends.
  /// @throws EntryError for a file that is no plug-in
  void load(const Deck &deck);
};
} // namespace stockwork
