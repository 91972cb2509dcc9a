#pragma once

#include "solvers/linear_solver.h"
#include "solvers/mumps.h"
#include "solvers/system_operator.h"

namespace stockwork
{
/// All unknowns at once by one sparse factor. The ordering is kept while the pattern stands, the
/// factor while the values stand.
class DirectSolver : public LinearSolver
{
public:
  explicit DirectSolver(MPI_Comm communicator);

  LinearReport solve(const LinearSystem &system,
                     const SystemStamps &stamps,
                     double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra) override;

private:
  /// The extra blocks of the last factor, to see what has changed.
  struct Seen
  {
    SystemStamps stamps;
    std::vector<SystemOperator::Entry> bulk_extra, extra_bulk, extra_extra;
    unsigned int n_extra = 0;
    bool symmetric = true;
    bool definite = false;
  };

  bool same_pattern(const SystemOperator &, const SystemStamps &) const;
  bool same_values(const SystemOperator &, const SystemStamps &) const;
  void analyse(const SystemOperator &);
  void factorise(const SystemOperator &);

  MPI_Comm communicator;
  std::unique_ptr<Mumps> factor;
  bool has_factor = false;
  SystemVector factor_scaling;
  Seen seen;
};
} // namespace stockwork
