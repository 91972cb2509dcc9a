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

/// How many of the smallest cells that the case starts with make up the half length of its first
/// fracture at the end. Sets up what --check sets up.
/// @throws InputError as simulate()
template <int dim>
double cells_in_half_length(RunContext &run,
                            const Deck &deck,
                            dealii::ParameterHandler &prm,
                            const PlugIns &plug_ins);
} // namespace stockwork
