#pragma once

#include "coupling/stepper.h"

#include <mpi.h>

#include <string>

namespace stockwork
{
/// What a run will take, to within a factor of two or three.
struct CostEstimate
{
  double memory; ///< at its greatest, of all ranks [bytes]
  double start;  ///< time before the first step, and of the first factor, on one core [s]
  double step;   ///< time of one step, on one core [s]
};

/// The physics of a run that its steps are dear by.
struct CostlyPhysics
{
  bool fracture = false;
  bool pore_pressure = false;
  bool inertia = false;
  bool yields = false;                               ///< rock that may leave its linear range
  double time_of_step = 1., memory_per_unknown = 0.; ///< of the fracture model: Requirements
};

/// From runs of the shipped cases. A factor of the matrix grows with N log N in two dimensions; it
/// lasts as long as the rock and the coefficients of time stay as they are, in porous rock and with
/// inertia the step, which a fracture changes all the time. Where rock may yield, states are looked
/// at in each iteration, which is then one of all unknowns; rock without a fracture is loaded until
/// it does, and has a new factor in most of them. In three dimensions the
/// factor of elastic rock grows with N^(4/3), and larger systems, or others, are solved by
/// iteration.
CostEstimate estimate_cost(unsigned int dim,
                           double n_unknowns,
                           const CostlyPhysics &physics,
                           unsigned int n_ranks = 1);

/// What an explicit step of a run adds up.
struct ExplicitWork
{
  double parts; ///< of the step, each as long as is stable
  double terms; ///< of a part: bonds, from both of their ends
};

/// Of explicit steps, from runs of dry/*: no matrix is formed.
CostEstimate explicit_cost(const ExplicitWork &work,
                           double n_unknowns,
                           double memory_per_unknown,
                           unsigned int n_ranks = 1);

/// How many steps a run will take.
struct ExpectedSteps
{
  double number;
  bool at_most; ///< that many if none were longer than the first; nothing tells how long they grow
};

/// Of a run of this duration from now on [s].
/// @param dt of the next step [s]
/// @param cells that a wing of the fracture will grow by; NaN: not known
ExpectedSteps expected_steps(
  const StepControl &control, double duration, double dt, bool has_fracture, double cells);

/// The estimate in words.
std::string
in_words(const CostEstimate &cost, const ExpectedSteps &steps, unsigned int n_ranks = 1);

/// Of the machines that the ranks run on, or less where a limit is set (ulimit -v) [bytes].
/// Collective.
double physical_memory(MPI_Comm communicator);

/// Greatest so far, of this rank [bytes].
double resident_memory();

/// "3.2 GB", "20 min": two digits.
std::string in_bytes(double bytes);
std::string in_time(double seconds);
} // namespace stockwork
