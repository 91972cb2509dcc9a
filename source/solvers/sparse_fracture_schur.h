#pragma once

#include "solvers/mumps.h"
#include "solvers/stiffness_patches.h"

#include <memory>

namespace stockwork
{
/// The Schur complement of many extra unknowns, S = D - C K^-1 B, approximated by a sparse matrix
/// (StiffnessPatches) and factorised on all ranks together: jumps, pressures, drops and wells in
/// one, so that nothing has to be said about their couplings. A preconditioner: see BlockAmgSolver.
class SparseFractureSchur
{
public:
  explicit SparseFractureSchur(MPI_Comm communicator);

  /// K is another one.
  void forget();

  /// Factorise what belongs to the borders and the corner of a system; what has not changed is
  /// kept. Throws SolveError when the matrix is singular. Collective.
  void update(const SystemOperator &op, const Epetra_CrsMatrix &K);

  /// x <- S^-1 x, in the layout of the system of the last update. Collective.
  void solve(std::vector<double> &x) const;

private:
  /// Order, if needed, and factorise.
  void factorise(const SystemOperator &op, bool new_pattern);

  MPI_Comm communicator;
  StiffnessPatches patches;
  StiffnessPatches::Product product; ///< C K^-1 B
  std::unique_ptr<Mumps> factor;
  ExtraLayout layout;
  std::vector<double> scaling;

  /// Hashes of this rank's entries for which `product` was found, the matrix ordered, factorised.
  std::uint64_t border_seen = 0, pattern_seen = 0, values_seen = 0;
};
} // namespace stockwork
