#pragma once

#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/mesh/mesh_view.h"

#include "biot/point_history.h"
#include "exchange/cell_evaluator.h"
#include "rock/laws.h"

#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace stockwork
{
/// The cells in which the rock has left its linear range, and its history there.
///
/// BulkAssembly treats all rock as linear and keeps its matrix. This adds what the laws of the rock
/// say beyond that, in the cells where they do:
///
///   R_u(v) += int (sigma - sigma_linear) : eps(v)
///   R_p(q) -= int q [ (zeta - zeta_linear) - the same at the last accepted step ]
///              + dt_eff grad q . (k - k_linear)/mu grad p ]
///
/// with the derivative of both, p being over in situ, where fluid is at rest. A cell takes part
/// while it has a history or a point of it has used up its linear range. The law is that of the
/// rock or, in cells where a fracture model has put its own in that place, that one.
template <int dim>
class NonlinearRock
{
public:
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;
  using Role = std::function<CellRole<dim>(const CellIterator &)>;

  /// @param law_of_model see Requirements::law
  NonlinearRock(const RockLaws &laws,
                const Scene<dim> &scene,
                const Role &role,
                const RockLaw *law_of_model);

  /// The mesh is new; the history has moved along with it, or is none yet.
  void setup(const MeshView<dim> &mesh_view);

  /// The roles of cells are new: cracks may cut others, or the same in another way.
  void topology_changed();

  /// Where the in-situ state uses up the most of the linear range, of the owned cells.
  struct InSituShare
  {
    double used = 0.;
    dealii::Point<dim> place;
    dealii::types::material_id region = 0; ///< of the rock, there
  };
  InSituShare in_situ_share();

  /// Find the owned cells that take part in a state. Returns how many.
  unsigned int find_active(const State &state);

  /// Add residual and derivative of the cells that were found in this state.
  void assemble(const StepContext &context, const State &state, Sink &sink);

  /// The step is accepted: what the converged state says becomes history.
  void commit(const StepContext &context, const State &state);

  /// Whether the derivative that those cells add is symmetric.
  bool is_symmetric() const;

  struct Totals
  {
    double content_change = 0.;    ///< fluid beyond linear rock's, gained in the step [m^3 (/m)]
    double content = 0.;           ///< the same since in situ
    double outflow = 0.;           ///< of it, where the pore pressure is prescribed
    double yielded_volume = 0.;    ///< of points with a history [m^3 (/m)]
    double maximum_used = 0.;      ///< of the linear range, by points without
    double dissipated_energy = 0.; ///< in the rock, by the law [J (/m)]
    double work_not_stored = 0.;   ///< the same as the trapezoidal rule has it [J (/m)]

    std::set<std::string> remarks; ///< of laws on points

    // What the audit of energy, done as in linear rock, does not see [J (/m)].
    double stored_energy_beyond = 0.;
    double held_work_beyond = 0.;  ///< in the step, at prescribed displacements
    double held_force_beyond = 0.; ///< times displacement, at its end
  };

  /// Of the owned cells; after commit(), the change is that of the step before it.
  const Totals &totals() const
  {
    return last_totals;
  }

  /// The state of the rock at a place in a cell, with the nearest history.
  struct Answer
  {
    dealii::SymmetricTensor<2, 3> stress; ///< total, over in situ
    std::vector<double> history;
    double dissipated_energy = 0.;                             ///< [J/m^3]
    std::optional<dealii::SymmetricTensor<2, 3>> permeability; ///< where it hangs on the state
  };
  bool answers(const CellIterator &cell) const
  {
    return !law(cell).is_linear();
  }

  /// The law in a cell.
  const RockLaw &law(const CellIterator &cell) const
  {
    const RockLaw *const here = law_of_model != nullptr ? role(cell).law : nullptr;
    return here != nullptr ? *here : laws(cell->material_id());
  }

  /// The rock's own, and one of the fracture model's, if it has any.
  std::vector<const RockLaw *> all_laws() const;

  /// Whether any law remembers anything, so that rock may yield.
  bool remembers() const
  {
    return points->n_values() > n_core;
  }
  Answer at(const CellIterator &cell,
            const dealii::Point<dim> &unit_point,
            const dealii::Point<dim> &point,
            const dealii::SymmetricTensor<2, dim> &strain,
            double pressure,
            const State &state) const;

  /// For whoever moves the mesh or saves the run.
  PointHistory<dim> &history()
  {
    return *points;
  }
  const RockLaws &laws;

private:
  /// Numbers of the core at the start of a point's history, before the law's own.
  enum CoreNumber : unsigned int
  {
    content_beyond, ///< fluid content beyond linear rock's
    dissipated,     ///< energy [J/m^3]
    not_stored,     ///< work of stress and pressure, by the trapezoidal rule [J/m^3]
    n_core
  };

  /// States at the points of the cell that the evaluator is at.
  void states_at(const CellIterator &cell, const State &state, const Unknowns &unknowns);

  /// What is committed at the points of the cell.
  void find_history(const CellIterator &cell);

  /// For each owned cell that takes part in a state, with its states and history at hand. Cells
  /// that cannot have come to the end of their linear range since they were looked at are passed
  /// over.
  template <class Use>
  void visit(const State &state, const Use &use);

  /// List the owned cells that have such rock.
  void find_watched();

  /// Look at all cells: how far is each from the end of its linear range?
  void look_around(const State &state, const Unknowns &unknowns);

  /// What a cell must not exceed to be passed over: slope times the greatest change of a
  /// displacement plus sqrt(3) times that of a pressure, against the margin of its stress.
  struct Watched
  {
    CellIterator cell;
    double slope, margin;
  };

  /// The cell at hand: its history, its share in the totals.
  void commit_cell(const CellIterator &cell, const StepContext &context, const State &state);

  /// Of a cell whose answers at the start and the end of the step are known.
  void add_energies(const std::vector<dealii::SymmetricTensor<2, 3>> &stress_before,
                    const std::vector<dealii::SymmetricTensor<2, 3>> &stress_now,
                    const State &state);

  /// Residual and derivative of the cell that the evaluator is at, whose states are at hand.
  void add_cell(const CellIterator &cell, const StepContext &, const State &, LocalSystem &local);
  void add_stress_and_content(const RockProperties &, unsigned int q, LocalSystem &local) const;
  void add_fracture_pressure(unsigned int q, unsigned int column, LocalSystem &local) const;
  void
  add_flow(const RockProperties &, const StepContext &, unsigned int q, LocalSystem &local) const;

  /// Index in a local system of a function of the displacement.
  unsigned int place(unsigned int function) const;

  /// (k - k_linear)/mu at a point of the cell at hand.
  dealii::SymmetricTensor<2, dim> mobility_beyond(const RockProperties &, unsigned int q) const;

  const Scene<dim> &scene;
  const Role role;
  const RockLaw *const law_of_model;
  std::unique_ptr<const MeshView<dim>> mesh_view;
  std::unique_ptr<PointHistory<dim>> points;
  std::unique_ptr<CellEvaluator<dim>> evaluator;

  std::vector<Watched> watched;                         ///< owned cells of such rock
  dealii::TrilinosWrappers::MPI::BlockVector looked_at; ///< the bulk's unknowns then
  bool has_looked = false;

  std::vector<CellIterator> active; ///< as find_active() has found them
  Totals last_totals;

  // Of the cell at hand.
  std::vector<dealii::SymmetricTensor<2, dim>> strains;
  std::vector<double> pressures;
  std::vector<dealii::Tensor<1, dim>> pressure_gradients;
  std::vector<const double *> committed; ///< null: none
  std::vector<RockState> states;
  std::vector<RockResponse> responses;
};
} // namespace stockwork
