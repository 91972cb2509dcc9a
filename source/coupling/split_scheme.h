#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include "stockwork/biot/rock.h"

#include "solvers/linear_solver.h"

#include <functional>
#include <memory>
#include <string>

namespace stockwork
{
/// Subsection "Coupling": whether rock and pore fluid are solved together or by turns.
struct CouplingParameters
{
  enum class Scheme
  {
    monolithic,
    fixed_stress, ///< flow first, at constant volumetric stress
    undrained,    ///< mechanics first, at constant fluid content
    drained,      ///< mechanics first, at constant pressure
    fixed_strain  ///< flow first, at constant strain
  };

  Scheme scheme = Scheme::monolithic;
  std::string name = "monolithic";
  double stabilisation = 1.;
  unsigned int maximum_passes = 500;
  bool force = false;

  static void declare_parameters(dealii::ParameterHandler &prm);

  void parse_parameters(dealii::ParameterHandler &prm);

  /// Throws InputError for a scheme that cannot converge in this rock, unless it is forced: drained
  /// and fixed-strain splits need alpha^2 M / K < 1 (Kim, Tchelepi & Juanes 2011), the undrained
  /// split a fluid or grains that can be compressed. Fractures are not split: their opening couples
  /// rock and fluid far more strongly than the pores do. Bonds without a fracture are.
  void check(const RockProperties &rock, bool has_pore_pressure, bool has_fracture) const;
};


/// Solves [K B; B^T -C] [u; p] = [f; g] (signs of Sink) by turns in u and p, a stationary iteration
/// that ends at the solution of the coupled system:
///
///   fixed stress:   -(C + L) p' = g - B^T u - L p,   K u' = f - B p',   L = b int alpha^2/K_dr p q
///   undrained:      (K + U) u' = f - B p + U u,      -C p' = g - B^T u',   U = int alpha^2 M div
///   div drained:        as undrained with U = 0;  fixed strain: as fixed stress with L = 0
///
/// (Kim, Tchelepi & Juanes 2011, Comput. Methods Appl. Mech. Engrg. 200; b is the stabilisation
/// factor.) The blocks are solved by linear solvers of their own, which keep their factors.
class SplitScheme : public LinearSolver
{
public:
  /// Adds U to a matrix with the pattern of K.
  using UndrainedTerm = std::function<void(dealii::TrilinosWrappers::SparseMatrix &)>;

  SplitScheme(const CouplingParameters &parameters,
              const LinearSolverParameters &solver_parameters,
              const BulkStructure &structure,
              MPI_Comm communicator,
              UndrainedTerm undrained_term);

  /// Throws SolveError when the passes diverge or do not end.
  LinearReport solve(const LinearSystem &system,
                     const SystemStamps &stamps,
                     double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra) override;

private:
  /// One block as a linear system of its own.
  struct Block
  {
    LinearSystem system;
    SystemStamps stamps;
    std::unique_ptr<LinearSolver> solver;

    /// x += A^-1 (-residual); returns the seconds that the factor took.
    double correct(const dealii::TrilinosWrappers::MPI::Vector &residual,
                   double tolerance,
                   dealii::TrilinosWrappers::MPI::Vector &x);
  };

  void update_blocks(const LinearSystem &system, const SystemStamps &stamps);

  CouplingParameters parameters;
  MPI_Comm communicator;
  UndrainedTerm undrained_term;
  Block mechanics, flow;
  SystemStamps seen;
  bool has_seen = false;
};
} // namespace stockwork
