#pragma once

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/block_sparsity_pattern.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include "stockwork/exchange/collectives.h"
#include "stockwork/fracture/model.h"
#include "stockwork/mesh/mesh_view.h"

#include "base/ghost_values.h"
#include "biot/boundary_conditions.h"
#include "biot/cell_matrices.h"
#include "coupling/extra_numbering.h"
#include "flow/network.h"

#include <vector>

namespace stockwork
{
/// How the displacement and the pore pressure are discretised.
struct ElementSettings
{
  unsigned int displacement_degree = 2;
  bool has_pore_pressure = false;
  PressureStabilisation stabilisation = PressureStabilisation::none;
  bool numbered_along_rows = false; ///< not cell by cell, for what sweeps rows of a lattice
};

/// All unknowns of the run: how they are numbered, which are constrained, and vectors of them.
template <int dim>
class UnknownNumbering
{
public:
  using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;

  UnknownNumbering(dealii::parallel::distributed::Triangulation<dim> &triangulation,
                   const dealii::Mapping<dim> &mapping,
                   const BoundaryConditions<dim> &boundary_conditions,
                   FractureModel<dim> &model,
                   Network<dim> &network,
                   const ElementSettings &elements);

  /// The mesh is new: number the unknowns of the bulk, constrain them, tell the model, and see what
  /// it couples across ranks.
  void number_bulk(double time);

  /// Essential conditions of this time.
  void constrain(double time);

  /// The fracture is new, or the other numbering is an earlier run's: number the extra unknowns.
  /// Values of the other numbering move along; new unknowns get initial ones.
  void adopt_extra(const ExtraNumbering &from, const std::vector<std::vector<double> *> &values);

  /// Fill in the couplings between unknowns of the bulk: those of a cell, and what the model keeps.
  /// @param pattern of the relevant unknowns
  void couple(dealii::BlockDynamicSparsityPattern &pattern) const;

  /// Zero vectors with ghost values / without.
  BlockVector ghosted_vector() const
  {
    return ghosted_zero;
  }
  BlockVector owned_vector() const
  {
    return owned_zero;
  }

  /// Ghosted = owned, of such vectors. Collective.
  void update_ghosted(BlockVector &ghosted, const BlockVector &owned) const
  {
    ghosts.update(ghosted, owned);
  }

  /// Let both satisfy constraints(): the constrained entries of `owned` are not looked at.
  /// Collective.
  void constrain(BlockVector &owned, BlockVector &ghosted) const;

  MeshView<dim> mesh_view() const
  {
    return {triangulation, handler, mapping, of_increments, elements.has_pore_pressure};
  }

  const dealii::DoFHandler<dim> &dof_handler() const
  {
    return handler;
  }

  /// With the values that are prescribed.
  const dealii::AffineConstraints<double> &constraints() const
  {
    return with_values;
  }

  /// With zero values.
  const dealii::AffineConstraints<double> &increment_constraints() const
  {
    return of_increments;
  }

  /// Unknowns of the bulk by block: this rank's, and all that it sees.
  const std::vector<dealii::IndexSet> &owned() const
  {
    return own;
  }
  const std::vector<dealii::IndexSet> &relevant() const
  {
    return seen;
  }

  const ExtraNumbering &extra() const
  {
    return extra_numbering;
  }

  unsigned int n_extra() const
  {
    return extra_numbering.size();
  }

  /// The first extra unknowns are the model's, then comes that of a controlled load; the rest
  /// belong to fluid.
  unsigned int n_mechanical_extra() const
  {
    return n_mechanical;
  }

  const std::optional<ControlledLoad<dim>> &controlled_load() const
  {
    return boundary_conditions.controlled_load();
  }

  /// Whether the essential conditions are the same at all times.
  bool boundary_is_constant() const
  {
    return boundary_conditions.constant_in_time();
  }

  dealii::types::global_dof_index n_bulk() const
  {
    return handler.n_dofs();
  }

  const Collectives communication;
  const dealii::Mapping<dim> &mapping;
  const ElementSettings elements;

private:
  dealii::parallel::distributed::Triangulation<dim> &triangulation;
  const BoundaryConditions<dim> &boundary_conditions;
  FractureModel<dim> &model;
  Network<dim> &network;

  dealii::FESystem<dim> fe;
  dealii::DoFHandler<dim> handler;
  dealii::AffineConstraints<double> with_values, of_increments;
  dealii::IndexSet visible; ///< unknowns of the bulk
  std::vector<dealii::IndexSet> own, seen;
  BlockVector owned_zero, ghosted_zero; ///< whose copies share their layout
  GhostValues ghosts;

  /// A constrained unknown of this rank, and where what it depends on is in a vector with ghost
  /// values.
  struct Line
  {
    dealii::types::global_dof_index index;
    unsigned int block;
    int place;
    std::vector<std::pair<int, double>> masters;
  };
  std::vector<Line> lines;
  bool masters_are_visible = false; ///< on all ranks

  void find_lines();

  ExtraNumbering extra_numbering;
  unsigned int n_mechanical = 0;
};
} // namespace stockwork
