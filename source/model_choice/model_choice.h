#pragma once

#include "plug_ins.h"
#include "scales.h"

#include "stockwork/base/deck.h"
#include "stockwork/base/run_context.h"

#include <string>
#include <vector>

namespace stockwork
{
/// Whether a deck leaves the fracture model or the resolution to the program.
bool leaves_model_to_program(const Deck &deck);

/// 'Fracture/Model = auto', 'Resolution = auto': the cheapest model and cells for which the charts
/// promise 'Accuracy' in scenes of this kind. Each candidate is set up as by --check; what is
/// refused there is none.
/// @param overrides of the command line, with which the deck was read
/// @param continued output directory of the run that a restart goes on with, which keeps its
/// choice; empty: none
/// @param chosen gets what is chosen and why, with the second choice
/// @returns the deck with the choice
/// @throws EntryError where no chart covers the scene, or none promises the accuracy
Deck choose_model(RunContext &run,
                  const Deck &deck,
                  const std::vector<std::string> &overrides,
                  const PlugIns &plug_ins,
                  const std::string &continued,
                  std::vector<ChosenValue> &chosen);
} // namespace stockwork
