#pragma once

#include <deal.II/base/index_set.h>

#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"

#include <functional>
#include <optional>
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

  /// A greater number whenever assemble() would add something else, or cells have other roles. The
  /// same on every rank.
  virtual unsigned int version() const = 0;

  /// The rows of the bulk that assemble() and the roles of cells do not leave as they were at an
  /// earlier version; each on one rank at least. Nothing, on every rank: any row may be another.
  virtual std::optional<std::vector<dealii::types::global_dof_index>>
  changed_rows(unsigned int /*since*/) const
  {
    return {};
  }

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

  /// Add the matrix, but for terms between pressures; residuals do not count.
  /// @param rows those that are wanted: what is added to others is dropped
  virtual void assemble(const StepContext &, const dealii::IndexSet &rows, Sink &) const = 0;
};
} // namespace stockwork
