#pragma once

#include <deal.II/base/parameter_handler.h>

#include "plug_ins.h"
#include "stockwork/base/deck.h"
#include "stockwork/base/run_context.h"

#include <string>

namespace stockwork
{
struct SimulationOptions
{
  std::string deck; ///< its path, for people
  std::string output_directory;
  bool check_only = false;
  bool restart = false;
};

/// Runs the case that `prm` describes, from the mesh to summary.json.
/// Throws InputError before anything is computed, SolveError when no step succeeds any more.
template <int dim>
void simulate(RunContext &run,
              const Deck &deck,
              dealii::ParameterHandler &prm,
              const PlugIns &plug_ins,
              const SimulationOptions &options);
} // namespace stockwork
