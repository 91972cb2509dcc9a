#pragma once

#include <deal.II/base/parameter_handler.h>

#include "plug_ins.h"
#include "stockwork/base/deck.h"

#include "biot/boundary_conditions.h"
#include "biot/in_situ.h"
#include "coupling/coupled_system.h"
#include "coupling/stepper.h"
#include "coupling/time_scheme.h"
#include "flow/network.h"
#include "mesh/geometry.h"
#include "physics_choice/physics_decision.h"
#include "rock/laws.h"
#include "scales.h"
#include "solvers/linear_solver.h"
#include "verification/reference_solution.h"

#include <memory>
#include <string>

namespace stockwork
{
/// Declares every entry of a deck, those of all registered fracture models included.
void declare_all_parameters(dealii::ParameterHandler &prm, const PlugIns &plug_ins);

/// A deck turned into objects. Whatever can be wrong with a deck is found when this is made, before
/// anything is computed.
template <int dim>
struct Case
{
  /// Throws InputError.
  Case(const Deck &deck, dealii::ParameterHandler &prm, const PlugIns &plug_ins);

  std::string name, model_name;
  Geometry<dim> geometry;
  Rock rock;
  RockLaws laws;
  InSitu<dim> in_situ;
  BoundaryConditions<dim> boundary_conditions;
  Network<dim> network;
  Scene<dim> scene;
  std::unique_ptr<FractureModel<dim>> model;
  ElementSettings elements;
  StepControl control;
  TimeScheme scheme;
  LinearSolverParameters linear_solver;
  std::unique_ptr<ReferenceSolution<dim>> reference; ///< may be null

  /// What is accepted and yet unusual, for the user.
  std::vector<std::string> warnings;

  bool starts_from_reference;

  /// What the scene's scales give where the deck leaves an entry empty.
  std::vector<ChosenValue> chosen;

  /// Of 'Physics = auto'.
  std::vector<PhysicsDecision> decisions;

  /// The walls move as the reference says, so they are not felt.
  bool walls_follow_reference = false;

  /// Elastic rock that prescribed displacements load slowly, or, if it has no crack, tractions
  /// with inertia: what they do to it can be compared with where it has gone.
  bool audits_energy;
};
} // namespace stockwork
