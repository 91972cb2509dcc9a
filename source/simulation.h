#pragma once

#include <deal.II/base/parameter_handler.h>

#include "plug_ins.h"
#include "scales.h"
#include "stockwork/base/deck.h"
#include "stockwork/base/run_context.h"

#include <string>
#include <vector>

namespace stockwork
{
struct SimulationOptions
{
  std::string deck; ///< its path, for people
  std::string output_directory;
  bool check_only = false;
  bool restart = false;
  std::vector<ChosenValue> chosen = {}; ///< in place of 'auto', before the case was made
};

/// Runs the case that `prm` describes, from the mesh to summary.json.
/// Throws InputError before anything is computed, SolveError when no step succeeds any more.
template <int dim>
void simulate(RunContext &run,
              const Deck &deck,
              dealii::ParameterHandler &prm,
              const PlugIns &plug_ins,
              const SimulationOptions &options);

/// What --check finds out about a deck, for who chooses between decks.
struct TriedDeck
{
  double cells;           ///< in half of its first fracture's length at the end (mesh_sizes.h)
  bool grows;             ///< a well drives it on
  double effect_of_walls; ///< on its stress intensity at the end, as a share; 0 where it counts for
                          ///< the reference
  std::vector<std::string> warnings; ///< why its answer could not be trusted; empty: it could
};

/// Sets up what --check sets up.
/// @throws InputError as simulate()
template <int dim>
TriedDeck
try_deck(RunContext &run, const Deck &deck, dealii::ParameterHandler &prm, const PlugIns &plug_ins);
} // namespace stockwork
