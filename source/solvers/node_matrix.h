#pragma once

#include <memory>
#include <vector>

class Epetra_CrsMatrix;
class Epetra_Import;
class Epetra_Map;

namespace stockwork
{
/// A copy of a vector-valued matrix for smoothing: dense blocks of dim x dim, one per pair of
/// coupled nodes, in single precision. It is 2.4 times smaller than the original, and a product
/// with it, which does nothing but wait for memory, as much faster. Vectors stay in double
/// precision. Rows must hold the components of one node after another.
template <int dim>
class NodeMatrix
{
public:
  explicit NodeMatrix(const Epetra_CrsMatrix &);
  ~NodeMatrix();

  unsigned int n_nodes() const
  {
    return row_starts.size() - 1;
  }

  /// x += P_k(D^-1 A) D^-1 (b - A x), the Chebyshev polynomial of degree k = `degree` for the upper
  /// part of the spectrum, D the block diagonal. `zero_start`: x is zero, whatever it holds.
  void smooth(double *x, const double *b, unsigned int degree, bool zero_start) const;

  /// r = b - A x
  void residual(double *r, const double *b, const double *x) const;

  /// Largest eigenvalue of D^-1 A, estimated.
  double largest_eigenvalue() const
  {
    return eigenvalue;
  }

  double memory_consumption() const;

private:
  /// x with the entries of other ranks behind.
  const double *with_ghosts(const double *x) const;

  void estimate_eigenvalue();

  std::vector<std::size_t> row_starts; ///< of blocks
  std::vector<unsigned int> columns;   ///< nodes: owned, then ghosts
  std::vector<float> values;           ///< blocks, row by row
  std::vector<float> inverse_diagonal;
  double eigenvalue = 1.;

  std::unique_ptr<Epetra_Map> owned_map, ghosted_map;
  std::unique_ptr<Epetra_Import> import;
  mutable std::vector<double> ghosted, direction, defect;
};
} // namespace stockwork
