#pragma once

#include "cost_estimate.h"

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/types.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace stockwork
{
struct Assumption;
struct Outcome;

/// Entries of the deck, with their sections, and values.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Part of the physics that a deck asks for, and whether the scene needs it ('Physics = auto').
struct PhysicsDecision
{
  std::string name;      ///< "inertia"
  bool left_out = false; ///< else it is kept
  /// What the answer changes by without it, an estimate before the run; NaN: there is none.
  double error = std::numeric_limits<double>::quiet_NaN();
  std::string why; ///< for people

  /// What a step is dearer by with it (cost_estimate.h). Null: a run with it costs the same.
  bool CostlyPhysics::*cost = nullptr;

  Settings settings = {}; ///< that leave it out
  Settings replaced = {}; ///< what the deck says of these; empty where it is kept

  /// What the run has shown of the estimate; empty: nothing.
  std::function<Assumption(const Outcome &)> judge = {};

  /// Of plasticity that is left out: the share of its strength that rock of a region uses at a
  /// place under a stress over that in situ [Pa]; from 1 on it yields.
  std::function<double(dealii::types::material_id,
                       const dealii::Point<3> &place,
                       const dealii::SymmetricTensor<2, 3> &stress)>
    strength_used = {};
};
} // namespace stockwork
