#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace stockwork
{
/// Rock that is moved by explicit steps, all of it a model's own: no matrix is formed, and what
/// breaks does so from one step to the next. Displacements and forces are vectors of the bulk's
/// unknowns, of which a rank sees its own and those that it has asked for.
class ExplicitRock
{
public:
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  virtual ~ExplicitRock() = default;

  /// The unknowns that the forces on this rank's unknowns depend on.
  virtual dealii::IndexSet seen() const = 0;

  /// All vectors from now on have the layout of @p vector.
  virtual void set_layout(const Vector &vector) = 0;

  /// Of each own unknown, the sum over its row of the stiffness, of absolute values [N/m]. Divided
  /// by the mass it bounds the square of the greatest frequency; what breaks lowers it.
  virtual void add_row_sums(Vector &sums) const = 0;

  /// The force that the rock exerts on each own unknown [N].
  /// @param displacement with current ghost values
  /// @param breaks let first break what this displacement breaks
  virtual void forces(const Vector &displacement, bool breaks, Vector &force) = 0;

  /// Of what forces() adds up, the number on this rank, bonds seen from both of their ends: for the
  /// estimate before a run.
  virtual double n_terms() const = 0;

  /// By what acts inside of the rock, such as fluid of a given pressure in its cracks: on this
  /// rank since the start, and what it took to get there from nothing [J; J/m in 2-D].
  virtual double work() const = 0;

  /// Own unknowns, by local number, that hardly anything holds any more.
  virtual std::vector<unsigned int> detached() const = 0;
};
} // namespace stockwork
