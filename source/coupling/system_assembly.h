#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_block_sparse_matrix.h>

#include "stockwork/base/run_context.h"
#include "stockwork/fracture/model.h"

#include "biot/bulk_assembly.h"
#include "biot/nonlinear_rock.h"
#include "biot/opening_control.h"
#include "coupling/residual_norms.h"
#include "coupling/unknown_numbering.h"
#include "flow/network.h"
#include "solvers/linear_system.h"

#include <memory>
#include <optional>
#include <vector>

namespace stockwork
{
/// Residual and matrix of all unknowns: of the bulk, of the fracture model, and of the fluid in
/// fractures.
///
/// The bulk is linear but for cells whose rock has left its linear range. Its matrix is kept from
/// one iteration, and where possible one step, to the next, and its residual is updated instead of
/// assembled again; only the terms of the fracture and of those cells are assembled in every
/// iteration. What is kept is assembled anew when somebody says that it has changed:
/// mesh_changed(), topology_changed(), begin_step(); and of the terms that a model keeps in the
/// matrix, the rows that it names.
template <int dim>
class SystemAssembly
{
public:
  using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;

  SystemAssembly(RunContext &run,
                 const UnknownNumbering<dim> &unknowns,
                 const Scene<dim> &scene,
                 const RockLaws &laws,
                 const Loads<dim> &loads,
                 const FractureModel<dim> &model,
                 const Network<dim> &network);

  /// The unknowns of the bulk are numbered anew.
  void mesh_changed();

  /// The extra unknowns are.
  void topology_changed();

  /// A step, or another attempt at it.
  void begin_step(const StepContext &context);

  /// The part that is linear in the unknowns: with the solve's first state.
  void assemble_linear(const StepContext &context, const State &state);

  /// The rest, and the sum of both.
  void assemble_nonlinear(const StepContext &context, const State &state);

  /// The residual of the bulk in a state in which no unknown but the prescribed ones has moved: it
  /// takes no matrix, and none is formed.
  const BlockVector &residual_at_rest(const StepContext &context, const State &state);

  /// The linear part of the residual, where the unknowns have moved by a step times an increment.
  void update_linear(double step, const BlockVector &dx_bulk, const std::vector<double> &dx_extra);

  /// The linear part of the residual of the extra rows, summed over the ranks.
  std::vector<double> &linear_residual_of_extra()
  {
    return linear_residual_extra;
  }

  /// Put a share of linear rock into the matrix of rock that has left its linear range.
  void stiffen_rock(const double share)
  {
    rock_change *= 1. - share;
  }

  /// What that changes by with the extra unknowns while the bulk stays as it is. Collective.
  std::vector<double> linear_change_by_extra(const std::vector<double> &dx_extra);

  /// The kept matrix has terms of the last iteration in it, and they are not linear.
  bool bulk_is_touched() const
  {
    return bulk_was_touched;
  }

  /// The terms that are assembled in every iteration have derivatives by the bulk, or in its rows.
  bool fracture_sees_bulk() const
  {
    return sees_bulk;
  }

  /// Whether the model does on any rank, see FractureModel. Collective.
  bool uses_secants() const
  {
    return dealii::Utilities::MPI::logical_or(model.uses_secants(), run.communicator);
  }

  /// Whether one iteration solves it.
  bool is_linear() const
  {
    return !nonlinear && unknowns.n_extra() == 0 && !bulk_was_touched;
  }

  ResidualNorms residual_norms() const;

  /// Bounds of what rounding leaves of the residuals of the bulk and of the fluid in the fracture:
  /// a solve that starts in equilibrium gets no further.
  ResidualNorms
  rounding_errors(const BlockVector &values, const StepContext &context, const State &state);

  /// Content of fluid that the pores have gained since the references, and what has left through
  /// the boundary, in the step; and what they hold over what they held in situ [m^3 (/m)].
  struct PoreFluid
  {
    double stored = 0.;
    double outflow = 0.;
    double through = 0.; ///< through the boundary, out and in
    double volume = 0.;
  };
  PoreFluid pore_fluid(const StepContext &context, const State &state) const;

  /// A solver may use it as working space.
  LinearSystem &linear_system()
  {
    return system;
  }
  const LinearSystem &linear_system() const
  {
    return system;
  }

  const SystemStamps &stamps() const
  {
    return changes;
  }

  /// Rock that may leave its linear range; null: there is none.
  NonlinearRock<dim> *nonlinear_rock() const
  {
    return nonlinear.get();
  }

  const BulkAssembly<dim> &bulk_assembly() const
  {
    return *bulk;
  }

  /// A load that an opening controls; null: there is none.
  const OpeningControl<dim> *opening_control() const
  {
    return control.get();
  }

  unsigned int index_of_control() const
  {
    return unknowns.n_mechanical_extra() - 1;
  }

private:
  /// Room for the matrix of the bulk on this mesh. Collective.
  void make_bulk_matrix();
  void assemble_bulk_matrix(const StepContext &context);

  /// The rows of the bulk where the model's kept terms are not those in the matrix; nothing: any
  /// may be another, or has changed for other reasons. Collective.
  std::optional<dealii::IndexSet> changed_rows(const StepContext &context) const;

  bool kept_terms_changed() const
  {
    return kept != nullptr && kept->version() != kept_version;
  }

  /// Add what rock beyond its linear range does.
  void assemble_rock(const StepContext &context, const State &state);

  bool has_pores() const
  {
    return unknowns.elements.has_pore_pressure;
  }

  RunContext &run;
  const UnknownNumbering<dim> &unknowns;
  const Scene<dim> &scene;
  const Loads<dim> &loads;
  const FractureModel<dim> &model;
  const Network<dim> &network;
  const KeptTerms *kept; ///< of the model, or null

  std::unique_ptr<BulkAssembly<dim>> bulk;
  std::unique_ptr<NonlinearRock<dim>> nonlinear; ///< null: the rock is linear whatever happens
  std::unique_ptr<OpeningControl<dim>> control;  ///< null: no load is controlled
  dealii::TrilinosWrappers::BlockSparseMatrix rock_change; ///< see LinearSystem
  bool has_rock_change = false;                            ///< memory, that is

  LinearSystem system;
  SystemStamps changes;
  dealii::FullMatrix<double> matrix_norms; ///< l1 norms of the bulk's blocks,
  unsigned int stamp_of_norms = 0;         ///< formed when its values had this stamp

  // The part of the system that is linear in the unknowns, kept through the iteration.
  BlockVector linear_residual_bulk;
  std::vector<double> linear_residual_extra;
  Triplets linear_extra_extra;                    ///< this rank's
  std::optional<Triplets> all_linear_extra_extra; ///< all ranks', once they have been asked for
  std::size_t n_linear_bulk_extra = 0, n_linear_extra_bulk = 0;

  bool has_bulk_matrix = false; ///< on this mesh; explicit steps need none

  // What of the kept matrix is not what it should be.
  bool matrix_is_current = false; ///< on this mesh
  bool coefficients_are_current = false;
  bool bulk_was_touched = false;

  bool sees_bulk = false;
  unsigned int kept_version = 0; ///< of the model's terms in the kept matrix
  StepContext matrix_context;
};
} // namespace stockwork
