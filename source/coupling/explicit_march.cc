#include "coupling/explicit_march.h"

#include "base/ghost_values.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Of the longest step that is stable. The bound of the frequency is safe already.
constexpr double share_of_stable_step = 0.95;
/// More in a step of the run are a mistake in the deck: the run would say nothing for hours.
constexpr double most_parts = 1e7;
/// How far loads may be off a straight line within a step of the run, over the greatest.
constexpr double quick_load = 0.02;
/// Of the residual of the loads, in equilibrium.
constexpr double equilibrium_tolerance = 1e-8;
} // namespace


template <int dim>
ExplicitMarch<dim>::ExplicitMarch(RunContext &run,
                                  CoupledSystem<dim> &system,
                                  FractureModel<dim> &model,
                                  const double gamma)
  : run(run)
  , system(system)
  , model(model)
  , gamma(gamma)
{
}


template <int dim>
void ExplicitMarch<dim>::take(const BlockVector &from, Vector &to) const
{
  BlockVector owned = system.owned_vector();
  copy_owned(owned, from);
  const double *const values = owned.block(0).trilinos_vector()[0];
  std::copy(values, values + to.locally_owned_size(), to.begin());
}


template <int dim>
void ExplicitMarch<dim>::give_back(const Vector &from, BlockVector &to) const
{
  BlockVector owned = system.owned_vector();
  std::copy(from.begin(), from.begin() + from.locally_owned_size(),
            owned.block(0).trilinos_vector()[0]);
  system.update_ghosted(to, owned);
}


template <int dim>
void ExplicitMarch<dim>::find_masses()
{
  const MeshView<dim> mesh = system.mesh_view();
  const auto &element = mesh.dof_handler.get_fe();
  FEValues<dim> values(mesh.mapping, element, QGauss<dim>(element.degree + 1),
                       update_values | update_JxW_values);
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  mass = 0.;
  for (const auto &cell : mesh.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      const double density = system.density(cell);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
          mass(dofs[i]) += density * values.shape_value(i, q) * values.JxW(q);
    }
  mass.compress(VectorOperation::add);
}


template <int dim>
void ExplicitMarch<dim>::set_up()
{
  if (model.explicit_rock() == rock)
    return;
  rock = model.explicit_rock();
  const MeshView<dim> mesh = system.mesh_view();
  IndexSet seen = rock->seen();
  IndexSet of_cells;
  DoFTools::extract_locally_relevant_dofs(mesh.dof_handler, of_cells);
  seen.add_indices(of_cells);
  for (Vector *vector : {&mass, &u, &v, &a, &force})
    vector->reinit(mesh.dof_handler.locally_owned_dofs(), seen, run.communicator);
  rock->set_layout(u);
  work_in_rock = rock->work();
  find_masses();

  looked_at.reset();
  held.clear();
  for (const auto i : mesh.dof_handler.locally_owned_dofs())
    if (mesh.constraints.is_constrained(i))
      held.push_back(u.get_partitioner()->global_to_local(i));

  Vector sums(u);
  rock->add_row_sums(sums);
  double greatest = 0.;
  std::vector<bool> is_held(u.locally_owned_size(), false);
  for (const unsigned int i : held)
    is_held[i] = true;
  for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
    if (!is_held[i])
      greatest = std::max(greatest, sums.local_element(i) / mass.local_element(i));
  greatest = system.collectives().max(greatest);
  longest_step = share_of_stable_step * std::sqrt(2. / gamma / greatest);
  run.out << "Explicit steps of at most " << to_string(longest_step, dimension::time) << std::endl;
}


template <int dim>
unsigned int ExplicitMarch<dim>::n_parts(const double dt)
{
  set_up();
  const double n = std::max(1., std::ceil(dt / longest_step - 1e-9));
  if (!(n <= most_parts))
    throw EntryError("Time/Initial step", to_string(dt, dimension::time),
                     "at most " + to_string(most_parts * longest_step, dimension::time) +
                       ", ten million explicit steps of " +
                       to_string(longest_step, dimension::time) +
                       ", the longest that are stable with these cells");
  return static_cast<unsigned int>(n);
}


template <int dim>
void ExplicitMarch<dim>::look_at_boundary(const double time)
{
  if (looked_at && (*looked_at == time || system.boundary_is_constant()))
    return;
  looked_at = time;
  const BlockVector residual = system.residual_at_rest(time);
  BlockVector values = system.owned_vector();
  system.make_conforming(values);
  const double *const at_rest = residual.block(0).trilinos_vector()[0];
  loads.resize(u.locally_owned_size());
  for (unsigned int i = 0; i < loads.size(); ++i)
    loads[i] = -at_rest[i];
  prescribed.clear();
  for (const unsigned int i : held)
    prescribed.push_back(values.block(0).trilinos_vector()[0][i]);
  const auto is_number = [](const double x) { return std::isfinite(x); };
  const bool are_numbers = std::all_of(loads.begin(), loads.end(), is_number) &&
                           std::all_of(prescribed.begin(), prescribed.end(), is_number);
  if (system.collectives().max(are_numbers ? 0. : 1.) > 0.)
    throw SolveError("What 'Boundary conditions' says at t = " + to_string(time, dimension::time) +
                     " is not a number everywhere");
}


template <int dim>
void ExplicitMarch<dim>::look_within(const double time, const double dt)
{
  if (warned_of_quick_loads || system.boundary_is_constant())
    return look_at_boundary(time + dt);
  using Values = std::array<std::vector<double>, 2>;
  const auto look = [&](const double t)
  {
    look_at_boundary(t);
    return Values{{loads, prescribed}};
  };
  const Values before = look(time), between = look(time + 0.5 * dt), after = look(time + dt);
  for (unsigned int k = 0; k < before.size(); ++k)
  {
    double off = 0., greatest = 0.;
    for (unsigned int i = 0; i < before[k].size(); ++i)
    {
      off = std::max(off, std::abs(between[k][i] - 0.5 * (before[k][i] + after[k][i])));
      greatest = std::max(
        {greatest, std::abs(before[k][i]), std::abs(between[k][i]), std::abs(after[k][i])});
    }
    off = system.collectives().max(off);
    greatest = system.collectives().max(greatest);
    if (off <= quick_load * greatest)
      continue;
    warned_of_quick_loads = true;
    const std::string what = k == 0 ? "load" : "displacement";
    run.warn((k == 0 ? "Loads change" : "What moves the boundary changes") +
             std::string(" within a step of the run: in its middle one is ") +
             to_string(100. * off / greatest, dimension::number) + " % of the greatest " + what +
             " off the line from beginning to end, which explicit steps follow. Take shorter ones "
             "('Time/Initial step').");
  }
}


template <int dim>
void ExplicitMarch<dim>::find_equilibrium(const double time, Unknowns &unknowns)
{
  const auto scope = run.timers.scope("equilibrium");
  set_up();
  look_at_boundary(time);
  u = 0.;
  u.update_ghost_values();
  Vector loads_in_rock(u);
  rock->forces(u, false, loads_in_rock);
  u.zero_out_ghost_values();
  for (unsigned int k = 0; k < held.size(); ++k)
    u.local_element(held[k]) = prescribed[k];
  u.update_ghost_values();
  rock->forces(u, false, force);
  Vector right_side(u), change(u);
  right_side.zero_out_ghost_values();
  for (unsigned int i = 0; i < loads.size(); ++i)
    right_side.local_element(i) = force.local_element(i) + loads[i];
  for (const unsigned int i : held)
    right_side.local_element(i) = 0.;

  struct Stiffness
  {
    void vmult(Vector &result, const Vector &x) const
    {
      x.update_ghost_values();
      rock.forces(x, false, result);
      x.zero_out_ghost_values();
      for (unsigned int i = 0; i < result.locally_owned_size(); ++i)
        result.local_element(i) = loads_in_rock.local_element(i) - result.local_element(i);
      for (const unsigned int i : held)
        result.local_element(i) = 0.;
    }
    ExplicitRock &rock;
    const Vector &loads_in_rock;
    const std::vector<unsigned int> &held;
  };
  change = 0.;
  const double size = right_side.l2_norm();
  if (size > 0.)
  {
    SolverControl control(20 * static_cast<unsigned int>(std::pow(u.size(), 1. / dim)) + 1000,
                          equilibrium_tolerance * size);
    try
    {
      SolverCG<Vector>(control).solve(Stiffness{*rock, loads_in_rock, held}, change, right_side,
                                      PreconditionIdentity());
    }
    catch (const SolverControl::NoConvergence &)
    {
      throw SolveError("The rock finds no equilibrium under the loads at the start: is it held on "
                       "all sides that they push it to ('Boundary conditions')?");
    }
    run.out << "Equilibrium at the start: " << control.last_step() << " iterations" << std::endl;
  }
  u.zero_out_ghost_values();
  u += change;
  u.update_ghost_values();
  rock->forces(u, false, force);
  double stored = 0.;
  for (unsigned int i = 0; i < loads.size(); ++i)
    stored += 0.5 * u.local_element(i) * (loads_in_rock.local_element(i) - force.local_element(i));
  work_before = system.collectives().sum(stored);
  give_back(u, unknowns.bulk);
}


template <int dim>
void ExplicitMarch<dim>::refuse_loose_loads() const
{
  const auto is_moved = [&](const unsigned int i)
  {
    const auto found = std::lower_bound(held.begin(), held.end(), i);
    return found != held.end() && *found == i && prescribed[found - held.begin()] != 0.;
  };
  double loose = 0.;
  for (const unsigned int i : rock->detached())
    if (loads[i] != 0. || is_moved(i))
      loose = 1.;
  if (system.collectives().max(loose) > 0.)
    throw SolveError(
      "What is loaded has come off: a node on a side that is pulled or moved has lost "
      "nearly all of its bonds, and the load would move nothing but it. Let none break "
      "there ('Fracture/peridynamics/Unbreakable')");
}


template <int dim>
double ExplicitMarch<dim>::energy_of_motion(const double h) const
{
  double energy = 0.;
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
  {
    const double half = 0.5 * h * a.local_element(i);
    energy +=
      0.5 * mass.local_element(i) * (v.local_element(i) - half) * (v.local_element(i) + half);
  }
  return system.collectives().sum(energy);
}


template <int dim>
unsigned int ExplicitMarch<dim>::advance(const double time,
                                         const double dt,
                                         Unknowns &unknowns,
                                         BlockVector &velocity,
                                         BlockVector &acceleration)
{
  set_up();
  look_at_boundary(time); // as at the end of the last step, in most cases
  const std::vector<double> loads_before = loads;
  look_within(time, dt);
  u.zero_out_ghost_values();
  take(unknowns.bulk, u);
  take(velocity, v);
  // What is moved starts from where it is: a displacement that the deck has jump takes the step.
  std::vector<double> prescribed_before;
  for (const unsigned int i : held)
    prescribed_before.push_back(u.local_element(i));

  const auto scope = run.timers.scope("explicit steps");
  const unsigned int n_parts = this->n_parts(dt);
  const double h = dt / n_parts;
  const unsigned int n = u.locally_owned_size();
  u.update_ghost_values();
  rock->forces(u, false, force);
  for (unsigned int i = 0; i < n; ++i)
    a.local_element(i) = (force.local_element(i) + loads_before[i]) / mass.local_element(i);
  // Unknowns that are held follow the boundary, and no mass of theirs moves.
  for (const unsigned int i : held)
    v.local_element(i) = a.local_element(i) = 0.;
  // A jump of the loads, or another length of the parts, is another energy by this measure.
  // After a restart, there is none.
  const double jump = knows_energy ? energy_of_motion(h) - kinetic : 0.;
  knows_energy = true;
  double done = 0.;
  std::vector<double> held_force;
  for (const unsigned int i : held)
    held_force.push_back(force.local_element(i));
  std::vector<unsigned int> loaded; // few, in most cases
  for (unsigned int i = 0; i < n; ++i)
    if (loads_before[i] != 0. || loads[i] != 0.)
      loaded.push_back(i);
  // Sweeps over all unknowns wait for memory, so one ends a part and begins the next.
  double *const at = u.begin(), *const speed = v.begin(), *const rate = a.begin();
  const double *const pushed = force.begin(), *const masses = mass.begin();
  const auto change_in_part = [&](const unsigned int i)
  { return h * (speed[i] + 0.5 * h * rate[i]); };
  u.zero_out_ghost_values();
  for (unsigned int i = 0; i < n; ++i)
    at[i] += change_in_part(i);
  for (unsigned int part = 0; part < n_parts; ++part)
  {
    const double s = static_cast<double>(part) / n_parts,
                 t = static_cast<double>(part + 1) / n_parts;
    for (const unsigned int i : loaded)
      done += 0.5 * change_in_part(i) * ((2. - s - t) * loads_before[i] + (s + t) * loads[i]);
    for (unsigned int k = 0; k < held.size(); ++k)
      at[held[k]] = (1. - t) * prescribed_before[k] + t * prescribed[k];
    u.update_ghost_values();
    rock->forces(u, true, force);
    for (unsigned int k = 0; k < held.size(); ++k)
    {
      const double force_before = held_force[k];
      held_force[k] = force.local_element(held[k]);
      done -=
        0.5 * (force_before + held_force[k]) * (prescribed[k] - prescribed_before[k]) / n_parts;
    }
    for (const unsigned int i : loaded)
      force.local_element(i) += (1. - t) * loads_before[i] + t * loads[i];
    const double next = part + 1 < n_parts ? h : 0.;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double now = pushed[i] / masses[i];
      speed[i] += h * ((1. - gamma) * rate[i] + gamma * now);
      rate[i] = now;
      at[i] += next * (speed[i] + 0.5 * h * now);
    }
    for (const unsigned int i : held)
      speed[i] = rate[i] = 0.;
  }
  u.zero_out_ghost_values();
  kinetic = energy_of_motion(h);
  done += rock->work() - work_in_rock;
  work_in_rock = rock->work();
  work = system.collectives().sum(done) + jump + work_before;
  work_before = 0.;
  if (!std::isfinite(kinetic))
    throw SolveError("explicit steps have run out of bounds");
  refuse_loose_loads();
  give_back(u, unknowns.bulk);
  give_back(v, velocity);
  give_back(a, acceleration);
  return n_parts;
}


template class ExplicitMarch<2>;
template class ExplicitMarch<3>;
} // namespace stockwork
