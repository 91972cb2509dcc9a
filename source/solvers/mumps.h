#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace stockwork
{
/// A sparse direct factor: MUMPS (Amestoy et al., SIAM J. Matrix Anal. 23, 2001;
/// http://mumps-solver.org) with the matrix given as triplets spread over the ranks. All calls are
/// collective.
class Mumps
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
  ~Mumps();
  Mumps(const Mumps &) = delete;
  Mumps &operator=(const Mumps &) = delete;

  /// Take a new pattern for n unknowns and order it. Keeps the row and column indices.
  void analyse(int n, std::vector<int> rows, std::vector<int> columns);

  /// Factorise, the values in the order of the indices given to analyse(). Throws SolveError when
  /// the matrix is singular or memory is short.
  void factorise(std::vector<double> &values);

  /// Solve for n_right_hand_sides at once; `x` holds them one after another on rank 0 and is
  /// overwritten with the solutions. Not looked at on other ranks.
  void solve(std::vector<double> &x, int n_right_hand_sides = 1);

  /// A few sparse right-hand sides, column by column as in a compressed column matrix (indices
  /// from one), given on rank 0; the solutions are dense, on rank 0.
  void solve_sparse(std::vector<int> &column_starts,
                    std::vector<int> &rows,
                    std::vector<double> &values,
                    std::vector<double> &x);

  int size() const;

  /// Memory of the factor on this rank [MB].
  double memory() const;

private:
  struct Instance;
  std::unique_ptr<Instance> instance;
};
} // namespace stockwork
