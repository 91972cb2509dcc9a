#pragma once

#include <deal.II/base/mpi.h>

#include <deal.II/lac/full_matrix.h>

#include <memory>
#include <random>
#include <sstream>

#include "case.h"
#include "coupling/mesh_adaptation.h"
#include "coupling/stepper.h"
#include "plug_ins.h"

namespace stockwork
{

/// A deck's coupled system of equations, for tests that look at residual and matrix. One rank.
template <int dim>
class ScenarioIn
{
public:
  using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;

  ScenarioIn(const std::string &file, const std::vector<std::string> &overrides)
    : deck(Deck::read(file, overrides))
    , the_case(make_case())
    , triangulation(run.communicator,
                    dealii::Triangulation<dim>::limit_level_difference_at_vertices,
                    dealii::parallel::distributed::Triangulation<dim>::no_automatic_repartitioning)
    , mapping(the_case->geometry.mapping())
    , system(run,
             triangulation,
             *mapping,
             the_case->scene,
             the_case->laws,
             the_case->boundary_conditions,
             *the_case->model,
             the_case->network,
             the_case->elements,
             prm)
    , adaptation(run, the_case->geometry, the_case->rock, triangulation, *the_case->model)
    , stepper(run,
              system,
              *the_case->model,
              the_case->network,
              the_case->rock,
              the_case->scheme,
              the_case->control)
  {
    the_case->geometry.create(triangulation);
    adaptation.refine_initial_mesh(the_case->elements.displacement_degree);
    system.setup_mesh(0.);
    stepper.committed.bulk = system.ghosted_vector();
    system.adopt_extra(ExtraNumbering(), {&stepper.committed.extra});
    the_case->scheme.initialise(stepper.committed);
    dt = the_case->control.initial_step;
  }

  FractureModel<dim> &model()
  {
    return *the_case->model;
  }

  Network<dim> &network()
  {
    return the_case->network;
  }

  /// One accepted step, of dt unless it is cut.
  void advance()
  {
    dt = stepper.advance(time, dt, ++step).next_dt;
    time = stepper.last_context().time;
    adaptation.adapt(system, stepper);
  }

  /// The next step begins: the iterate is the last accepted state.
  void begin_step()
  {
    context = the_case->scheme.context(time, dt, step + 1, 0);
    current = stepper.committed;
    the_case->scheme.references(context, stepper.committed, rate_reference, acceleration_reference);
    model().begin_step(context);
    network().begin_step(context);
  }

  State state() const
  {
    return system.state(current, stepper.committed, rate_reference, acceleration_reference);
  }

  /// Residual and matrix at the iterate.
  const LinearSystem &linearise()
  {
    return system.linearise(context, state());
  }

  unsigned int n_bulk() const
  {
    return system.bulk_dofs().n_dofs();
  }

  unsigned int n_unknowns() const
  {
    return system.n_unknowns();
  }

  /// At the iterate, with all its zeros. Bulk unknowns, then extra ones.
  dealii::FullMatrix<double> matrix()
  {
    const LinearSystem &linear = linearise();
    dealii::FullMatrix<double> result(n_unknowns(), n_unknowns());
    for (const auto &entry : linear.bulk)
      result(entry.row(), entry.column()) = entry.value();
    if (linear.rock_change != nullptr)
      for (const auto &entry : *linear.rock_change)
        result(entry.row(), entry.column()) += entry.value();
    const auto add =
      [&](const Triplets &triplets, const unsigned int row, const unsigned int column)
    {
      for (std::size_t k = 0; k < triplets.values.size(); ++k)
        result(row + triplets.rows[k], column + triplets.columns[k]) += triplets.values[k];
    };
    add(linear.bulk_extra, 0, n_bulk());
    add(linear.extra_bulk, n_bulk(), 0);
    add(linear.extra_extra, n_bulk(), n_bulk());
    return result;
  }

  /// Bulk unknowns, then extra ones.
  dealii::Vector<double> residual()
  {
    const LinearSystem &linear = linearise();
    dealii::Vector<double> result(n_unknowns());
    for (unsigned int i = 0; i < n_unknowns(); ++i)
      result(i) = i < n_bulk() ? linear.residual_bulk(i) : linear.residual_extra[i - n_bulk()];
    return result;
  }

  /// current := start + direction; of the bulk, increments obey hanging nodes and boundary
  /// conditions.
  void move(const Unknowns &start, const dealii::Vector<double> &direction)
  {
    auto bulk = system.owned_vector(), change = system.owned_vector();
    for (unsigned int i = 0; i < n_bulk(); ++i)
      change(i) = direction(i);
    change.compress(dealii::VectorOperation::insert);
    system.mesh_view().constraints.distribute(change);
    bulk = start.bulk;
    bulk += change;
    current.bulk = bulk;
    for (unsigned int i = n_bulk(); i < n_unknowns(); ++i)
      current.extra[i - n_bulk()] = start.extra[i - n_bulk()] + direction(i);
  }

  /// What an unknown belongs to: 0 displacement, 1 pore pressure, 2 the model, 3 the flow.
  unsigned int field(const unsigned int i) const
  {
    const unsigned int n_displacement = current.bulk.block(0).size();
    return i < n_displacement                                        ? 0
           : i < n_bulk()                                            ? 1
           : i < n_bulk() + the_case->model->extra_unknowns().size() ? 2
                                                                     : 3;
  }

  Deck deck;
  dealii::ParameterHandler prm;
  std::ostringstream log;
  RunContext run{MPI_COMM_WORLD, log};
  std::unique_ptr<Case<dim>> the_case;
  dealii::parallel::distributed::Triangulation<dim> triangulation;
  std::unique_ptr<dealii::Mapping<dim>> mapping;
  CoupledSystem<dim> system;
  MeshAdaptation<dim> adaptation;
  Stepper<dim> stepper;

  double time = 0., dt; ///< dt: proposed for the next step
  unsigned int step = 0;
  StepContext context;
  Unknowns current, rate_reference, acceleration_reference;

private:
  std::unique_ptr<Case<dim>> make_case()
  {
    PlugIns plug_ins = PlugIns::own();
    plug_ins.load(deck);
    declare_all_parameters(prm, plug_ins);
    deck.parse_into(prm);
    return std::make_unique<Case<dim>>(deck, prm, plug_ins);
  }
};

using Scenario = ScenarioIn<2>;
} // namespace stockwork
