#pragma once

#include <mpi.h>

#include <memory>

#include "solvers/sparse_factor.h"

namespace stockwork
{
/// Cholesky's factor of a symmetric positive definite matrix on a few ranks, by substructures (e.g.
/// Smith, Bjorstad and Gropp, Domain Decomposition, 1996, ch. 4). Some unknowns are the interface
/// b; without them, the rest falls into the interiors i of the ranks, which are not coupled to one
/// another. The graph of the matrix is cut anew by METIS: between the ranks' parts of the mesh
/// there are many more unknowns where they meet along a fracture, in the finest cells. Each rank
/// factorises its interior with the interface ordered last,
///
///   [K_ii K_ib; K_bi K_bb] = L L^T,   K_bb - K_bi K_ii^-1 K_ib = L_bb L_bb^T,
///
/// by CHOLMOD, and on every rank the dense S = sum of the ranks' L_bb L_bb^T - (ranks - 1) K_bb is
/// factorised. A solve is a forward substitution on each rank, a sum over the ranks of vectors as
/// long as the interface, a dense solve, a backward substitution on each rank.
///
/// Each entry is given once, by any rank. All calls are collective.
class SubstructuredCholesky : public SparseFactor
{
public:
  explicit SubstructuredCholesky(MPI_Comm communicator);
  ~SubstructuredCholesky() override;

  /// Divide the unknowns for analyse(), and see whether the interface is so small that the dense
  /// work, which every rank repeats and which grows with the number of ranks, is little beside a
  /// rank's own.
  bool suits(int n, const std::vector<int> &rows, const std::vector<int> &columns);

  void analyse(int n, std::vector<int> rows, std::vector<int> columns) override;
  void factorise(std::vector<double> &values) override;
  void solve(std::vector<double> &x, int n_right_hand_sides = 1) override;
  void solve_sparse(std::vector<int> &column_starts,
                    std::vector<int> &rows,
                    std::vector<double> &values,
                    std::vector<double> &x) override;
  std::optional<std::vector<double>> products(const SparseVectors &left,
                                              const SparseVectors &right) override;
  int size() const override;

private:
  struct Instance;
  std::unique_ptr<Instance> instance;
};
} // namespace stockwork
