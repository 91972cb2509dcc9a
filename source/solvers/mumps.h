#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "solvers/sparse_factor.h"

namespace stockwork
{
/// A sparse direct factor: MUMPS (Amestoy et al., SIAM J. Matrix Anal. 23, 2001;
/// http://mumps-solver.org) with the matrix given as triplets spread over the ranks. All calls are
/// collective.
class Mumps : public SparseFactor
{
public:
  enum class Kind
  {
    unsymmetric = 0,
    definite = 1, ///< symmetric positive definite, no pivoting
    symmetric = 2 ///< symmetric indefinite, LDL^T
  };

  /// This rank's entries; repeated entries, also on several ranks, add up. Indices count from one.
  /// Symmetric kinds take one triangle, either one.
  struct Entries
  {
    std::vector<int> rows;
    std::vector<int> columns;
    std::vector<double> values;
  };

  Mumps(MPI_Comm communicator, Kind kind);
  ~Mumps() override;
  Mumps(const Mumps &) = delete;
  Mumps &operator=(const Mumps &) = delete;

  void analyse(int n, std::vector<int> rows, std::vector<int> columns) override;
  void factorise(std::vector<double> &values) override;
  void solve(std::vector<double> &x, int n_right_hand_sides = 1) override;
  void solve_sparse(std::vector<int> &column_starts,
                    std::vector<int> &rows,
                    std::vector<double> &values,
                    std::vector<double> &x) override;
  int size() const override;

  /// Memory of the factor on this rank [MB].
  double memory() const;

private:
  struct Instance;
  std::unique_ptr<Instance> instance;
};
} // namespace stockwork
