#pragma once

#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"

#include <functional>
#include <vector>

namespace stockwork
{
/// What a fracture model adds to the matrix of the bulk for many solves at a time; it becomes part
/// of the matrix whose factor is kept.
class KeptTerms
{
public:
  using Coupling = std::function<void(const std::vector<dealii::types::global_dof_index> &)>;

  virtual ~KeptTerms() = default;

  /// Another number whenever assemble() would add something else.
  virtual unsigned int version() const = 0;

  /// Whether the bulk with these terms has a symmetric matrix.
  virtual bool is_symmetric() const
  {
    return true;
  }

  /// Call the function with groups of bulk dofs that assemble(), here or of the model, couples
  /// beyond those of a common cell.
  virtual void add_couplings(const Coupling &) const
  {
  }

  /// Add the matrix; residuals do not count.
  virtual void assemble(const StepContext &, Sink &) const = 0;
};
} // namespace stockwork
