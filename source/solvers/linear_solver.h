#pragma once

#include <deal.II/base/parameter_handler.h>

#include "solvers/linear_system.h"

#include <memory>
#include <optional>
#include <vector>

namespace stockwork
{
/// What a linear solve reports. Residuals are measured in the Euclidean norm after symmetric
/// diagonal scaling, |D (R + J dx)| / |D R| with D = |diag J|^(-1/2), so that momentum and mass
/// rows, ten decades apart in SI, count alike.
struct LinearReport
{
  unsigned int iterations = 0; ///< of the iterative solver or iterative refinement; passes
  bool converged = false;
  double relative_residual = 0.;
  bool factorised = false;   ///< a factor or preconditioner was built anew
  double setup_seconds = 0.; ///< wall time of that and what else was prepared

  /// Newton's method forgives an inexact direction.
  bool is_good_enough() const
  {
    return converged || relative_residual <= 1e-4;
  }
};

/// What decides between solvers.
struct BulkStructure
{
  unsigned int dim = 2;
  bool has_pore_pressure = false;
  bool yields = false; ///< so that the matrix changes with the load

  /// Whether one factor serves as long as the mesh does.
  bool keeps_its_factor() const
  {
    return !has_pore_pressure && !yields;
  }
};

/// Unknowns in three dimensions up to which a factor that lasts is cheaper than iteration by far:
/// one step of `radial/small` with 48126 takes 0.2 s with it and 5 s without; 4 GB at the upper
/// end.
constexpr unsigned int largest_lasting_factor = 200000;

/// Subsection "Linear solver".
struct LinearSolverParameters
{
  enum class Type
  {
    automatic,
    direct,
    bordered,
    iterative
  };
  Type type = Type::automatic;
  std::optional<unsigned int> direct_below; ///< the entry; none: auto
  unsigned int max_iterations = 200;
  unsigned int restart = 50;

  static void declare_parameters(dealii::ParameterHandler &);
  void parse_parameters(dealii::ParameterHandler &);

  /// Bulk unknowns in 3-D up to which "auto" makes a factor.
  unsigned int largest_factor(const BulkStructure &) const;
};

/// A linear system whose bulk has been eliminated, for Newton's method in the extra unknowns alone:
/// where the bulk is linear and in equilibrium it follows them, and nobody needs to see it before
/// they have converged.
///
///   [ A  B ]
///   [ C  D ],   S = D - C A^-1 B
///
/// Valid until the solver that made it is called again.
class CondensedSystem
{
public:
  virtual ~CondensedSystem() = default;

  /// S dx = -residual_extra. Of the system only that and `extra_extra` may be other than when it
  /// was condensed. Refined until the residual is `tolerance` of what it was, if it can be.
  /// @param reaction what the bulk, in equilibrium again, adds to the residual: -C A^-1 B dx
  /// @return the residual that is left, over what it was, scaled as in LinearReport
  /// @throws SolveError when S is singular
  virtual double solve(const LinearSystem &system,
                       double tolerance,
                       std::vector<double> &dx_extra,
                       std::vector<double> &reaction) = 0;

  /// dx_bulk = -A^-1 (residual_bulk + B dx_extra), with which the bulk is in equilibrium.
  virtual void recover_bulk(const LinearSystem &system,
                            const std::vector<double> &dx_extra,
                            dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk) = 0;
};

/// Solves the linear systems of one run, one after another, and keeps what stays valid.
class LinearSolver
{
public:
  virtual ~LinearSolver() = default;

  /// Whether solve() will look at the displacement hierarchy and the fixed-stress mass of a system
  /// with that many bulk unknowns (all ranks).
  virtual bool wants_hierarchy(dealii::types::global_dof_index /*n_dofs*/) const
  {
    return false;
  }

  /// Whether solve() takes LinearSystem::rock_change along; what it keeps stays linear rock's.
  virtual bool sees_rock_change(const LinearSystem & /*system*/, const SystemStamps &) const
  {
    return false;
  }

  /// dx with |R + J dx| <= tolerance |R| in the norm of LinearReport. What the stamps call
  /// unchanged may be reused; the residual is checked with the present matrix all the same.
  /// `dx_bulk` has the layout of residual_bulk. Throws SolveError when the matrix is singular.
  virtual LinearReport solve(const LinearSystem &system,
                             const SystemStamps &stamps,
                             double tolerance,
                             dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                             std::vector<double> &dx_extra) = 0;

  /// The system without its bulk. Null where the solver cannot do that, has no factor of the
  /// present bulk, or finds the residual of the bulk too large for solve() to neglect it.
  virtual std::unique_ptr<CondensedSystem>
  condense(const LinearSystem & /*system*/, const SystemStamps & /*stamps*/, double /*tolerance*/)
  {
    return nullptr;
  }

  /// Of one that chooses: what it has chosen, and for how many systems. Else empty.
  virtual std::string choices() const
  {
    return "";
  }
};

std::unique_ptr<LinearSolver>
make_linear_solver(const LinearSolverParameters &, const BulkStructure &, MPI_Comm);
} // namespace stockwork
