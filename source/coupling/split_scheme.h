#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include "stockwork/rock/rock.h"

#include "coupling/split_block.h"

#include <functional>
#include <string>

namespace stockwork
{
/// Subsection "Coupling": whether rock and fluid are solved together or by turns.
struct CouplingParameters
{
  enum class Scheme
  {
    monolithic,
    fixed_stress, ///< flow first, at constant volumetric stress
    undrained,    ///< mechanics first, at constant fluid content
    drained,      ///< mechanics first, at constant pressure
    fixed_strain, ///< flow first, at constant strain
    as_published  ///< one pass of fixed stress over all the time since the start, see SplitScheme
  };

  enum class Acceleration
  {
    automatic, ///< GMRES where a fracture is full of fluid
    none,
    gmres
  };

  Scheme scheme = Scheme::monolithic;
  std::string name = "monolithic";
  double stabilisation = 1.;
  unsigned int maximum_passes = 500;
  Acceleration acceleration = Acceleration::automatic;
  bool force = false;
  double full_rate_time = 0.; ///< T_0 of `as published` [s]
  bool damaged_pores = true;  ///< its storage; else the rock's compliance around the crack

  static void declare_parameters(dealii::ParameterHandler &prm);

  void parse_parameters(dealii::ParameterHandler &prm);

  /// Every step starts at the start of the run, and is one pass.
  bool restarts() const
  {
    return scheme == Scheme::as_published;
  }

  /// Flow is given what the rock would yield by.
  bool adds_compliance() const
  {
    return scheme == Scheme::fixed_stress || (scheme == Scheme::as_published && !damaged_pores);
  }

  /// Throws InputError for a scheme that cannot converge in this rock, unless it is forced: drained
  /// and fixed-strain splits need alpha^2 M / K < 1 (Kim, Tchelepi & Juanes 2011), the undrained
  /// split a fluid or grains that can be compressed. With a fracture none of the three can do: what
  /// is injected has no place in an opening that is held.
  /// @param has_fracture may come to be or to open; bonds without one are rock
  /// @param has_wells inject into fractures
  void check(const RockProperties &rock,
             bool has_pore_pressure,
             bool has_fracture,
             bool has_wells) const;
};


/// Solves [K B; B^T -C] [u; p] = [f; g] (signs of Sink) by turns in u and p, a stationary iteration
/// that ends at the solution of the coupled system:
///
///   fixed stress:   -(C + L) p' = g - B^T u - L p,   K u' = f - B p'
///                   with L = b int alpha^2/K_dr p q
///   undrained:      (K + U) u' = f - B p + U u,   -C p' = g - B^T u'
///                   with U = int alpha^2 M div u div v
///   drained:        as undrained with U = 0
///   fixed strain:   as fixed stress with L = 0
///
/// (Kim, Tchelepi & Juanes 2011, Comput. Methods Appl. Mech. Engrg. 200; b is the stabilisation
/// factor.) The blocks are solved by linear solvers of their own, which keep their factors.
///
/// With a fracture, u are all unknowns that move, p the pressures in pores and fractures. A segment
/// is given as L what it would open by if the pressure grew by one in all of them,
///
///   L_i = b |sum_j S_ij|,   S = B^T K^-1 B between segments,
///
/// one solve for the rock. Where pressure anywhere opens the fracture everywhere (S_ij >= 0), with
/// b = 1, L - S is the Laplacian of a graph and not negative; with pores, too, both L together are
/// at least half of both compliances together. So with symmetric K and C the passes converge for
/// b >= 1. Nothing is proven where fractures side by side close one another (S_ij < 0), for the
/// rows of bonds and the flow's dependence on the aperture, which are not symmetric, and where
/// bonds or seams soften. After Girault, Kumar & Wheeler 2016 (Comput. Geosci. 20), whose constant
/// for the fracture must be guessed.
///
/// Where little fluid gets through, as near a tip, what is not uniform is found slowly. FGMRES with
/// a pass as preconditioner finds it (Castelletto, White & Tchelepi 2015, Int. J. Numer. Anal.
/// Methods Geomech. 39).
///
/// As published (Zhang et al. 2022): one pass and no more, whatever residual it leaves. Pores have
/// the storage of constant stress, as with fixed stress, which is the paper's phi C (Eq. 33).
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

  bool wants_hierarchy(const dealii::types::global_dof_index n_dofs) const override
  {
    return mechanics.wants_hierarchy(n_dofs);
  }

  /// Throws SolveError when the passes diverge or do not end.
  LinearReport solve(const LinearSystem &system,
                     const SystemStamps &stamps,
                     double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra) override;

private:
  /// Take the matrices of both halves and add what the scheme adds. Returns the seconds of factors.
  double update_blocks(const SystemOperator &whole, const SystemStamps &stamps);

  /// Add L of the segments.
  double stabilise_fracture(const SystemOperator &whole);

  /// z = P^-1 r: what a pass makes of a residual. Returns the seconds of factors.
  double
  pass(const SystemOperator &whole, double block_tolerance, SystemVector &z, const SystemVector &r);

  /// Pass after pass.
  void iterate(const SystemOperator &whole, double tolerance, SystemVector &x, LinearReport &);

  CouplingParameters parameters;
  bool has_pore_pressure;
  UndrainedTerm undrained_term;
  MPI_Comm communicator;
  SplitBlock mechanics, flow;
  unsigned int restart;
};
} // namespace stockwork
