#pragma once

#include <deal.II/base/types.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace stockwork
{
/// A dense local contribution to the residual R and its derivative J = dR/dx. Rows and columns
/// are first the bulk dofs, then the extra unknowns.
///
/// Sign and scaling, so that the coupled matrix is symmetric where the physics is:
/// - momentum rows: internal minus external virtual work, [N m / m] in 2-D;
/// - mass rows (pore pressure, fracture pressure): *minus* the mass balance (storage + outflow -
///   source) integrated over StepContext::effective_dt, [m^3 / m] in 2-D.
struct LocalSystem
{
  std::vector<dealii::types::global_dof_index> bulk;
  std::vector<unsigned int> extra;
  dealii::FullMatrix<double> matrix;
  dealii::Vector<double> residual;

  /// Size and zero matrix and residual for the index lists as they stand.
  void reinit()
  {
    const unsigned int n = bulk.size() + extra.size();
    if (matrix.m() != n)
    {
      matrix.reinit(n, n);
      residual.reinit(n);
    }
    else
    {
      matrix = 0.;
      residual = 0.;
    }
  }
};

/// Where local contributions go. Constraints (hanging nodes, boundary conditions) are resolved by
/// the sink. Contributions to rows of other ranks are allowed.
class Sink
{
public:
  virtual ~Sink() = default;

  virtual void add(const LocalSystem &) = 0;
};
} // namespace stockwork
