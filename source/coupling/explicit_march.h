#pragma once

#include "coupling/coupled_system.h"
#include "coupling/time_scheme.h"

#include <optional>

namespace stockwork
{
/// Moves rock by explicit steps, Newmark's scheme with beta = 0 (Newmark 1959; with gamma = 1/2
/// that of central differences):
///
///   u_1 = u_0 + h v_0 + h^2/2 a_0 ,   M a_1 = f(u_1) + loads ,
///   v_1 = v_0 + h ((1-gamma) a_0 + gamma a_1)
///
/// with the mass M lumped at the nodes. Stable for h omega < sqrt(2/gamma) (Hughes 1987, sec. 9.1).
template <int dim>
class ExplicitMarch
{
public:
  ExplicitMarch(RunContext &run,
                CoupledSystem<dim> &system,
                FractureModel<dim> &model,
                double gamma);

  /// The run starts here, at rest.
  void begin()
  {
    knows_energy = true;
    work_in_rock = 0.; // what the rock's own loads have done is to be counted
  }

  /// The displacement at which the rock holds the loads of a time, and nothing breaks.
  /// @throws SolveError
  void find_equilibrium(double time, Unknowns &unknowns);

  /// Into how many a step of the run is divided. Collective.
  /// @throws EntryError where they are too many to be meant
  unsigned int n_parts(double dt);

  /// What a part of a step adds up, on all ranks. Collective.
  double n_terms()
  {
    set_up();
    return system.collectives().sum(rock->n_terms());
  }

  /// Go on by a step, in equal parts that are stable; loads and what moves the boundary change
  /// linearly meanwhile. Collective.
  /// @return how many parts
  unsigned int advance(double time,
                       double dt,
                       Unknowns &unknowns,
                       dealii::TrilinosWrappers::MPI::BlockVector &velocity,
                       dealii::TrilinosWrappers::MPI::BlockVector &acceleration);

  /// Of the motion, at the end of the last step [J; J/m in 2-D].
  double kinetic_energy() const
  {
    return kinetic;
  }

  /// Of loads, of what moves the boundary and of pressure in cracks, in the last step; in the first
  /// one also what it took to reach equilibrium, slowly, and of a jump of the loads [J; J/m].
  double work_of_step() const
  {
    return work;
  }

private:
  using Vector = ExplicitRock::Vector;
  using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;

  /// Layout, masses, and the longest step that is stable.
  void set_up();
  void find_masses();

  /// What the boundary prescribes at a time, and the loads then.
  void look_at_boundary(double time);

  /// Where loads, or what moves the boundary, are on no line within a step of the run, which they
  /// are taken to be. Leaves those of its end. Collective.
  void look_within(double time, double dt);

  /// @throws SolveError where a load acts on what the rock does not hold any more. Collective.
  void refuse_loose_loads() const;

  /// By the velocities half a part before and after, parts being @p h long: what the scheme
  /// conserves with the elastic energy, where gamma = 1/2. Collective.
  double energy_of_motion(double h) const;

  void take(const BlockVector &from, Vector &to) const;
  void give_back(const Vector &from, BlockVector &to) const;

  RunContext &run;
  CoupledSystem<dim> &system;
  FractureModel<dim> &model;
  const double gamma;

  ExplicitRock *rock = nullptr; ///< of the mesh that everything below belongs to
  double longest_step = 0.;     ///< [s]
  Vector mass, u, v, a, force;
  std::vector<unsigned int> held;  ///< own unknowns that are prescribed, by local number
  std::vector<double> prescribed;  ///< their values at the time looked at last
  std::vector<double> loads;       ///< of all own unknowns, likewise [N]
  std::optional<double> looked_at; ///< that time, since set_up() [s]
  double kinetic = 0., work = 0., work_before = 0.;
  double work_in_rock = 0.; ///< ExplicitRock::work() at the end of the last step, on this rank
  bool warned_of_quick_loads = false;
  bool knows_energy = false; ///< `kinetic` is that at the end of the last step
};
} // namespace stockwork
