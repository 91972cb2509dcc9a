#pragma once

#include <deal.II/base/function.h>
#include <deal.II/base/parameter_handler.h>

#include "stockwork/biot/rock.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace stockwork
{
/// The analytical solution of a case, evaluated from the parsed deck.
template <int dim>
class ReferenceSolution
{
public:
  virtual ~ReferenceSolution() = default;

  /// For people: "Mandel (1953)".
  virtual std::string
  name() const = 0;

  /// Displacement and, in the last component of dim+1, pore pressure over in situ, as a function
  /// of place and of its time; null where only scalars are known.
  virtual std::shared_ptr<dealii::Function<dim>>
  field() const
  {
    return {};
  }

  /// Scalars at a time, by the names of the columns of the statistics.
  virtual std::map<std::string, double>
  values(double /*time*/) const
  {
    return {};
  }
};

/// What a reference solution may take from the deck besides its own subsection.
template <int dim>
struct ReferenceInput
{
  const Rock        &rock;
  dealii::Point<dim> lower, upper; ///< corners of the domain [m]

  /// Corners of the first crack; empty without a crack.
  std::vector<dealii::Point<dim>> crack = {};

  /// Rate of the first well, of the whole fracture (both wings) [m^2/s], [m^3/s] in 3-D.
  double injection_rate = 0.;
};

/// Declares subsection Verification with the entries of all reference solutions.
void
declare_reference_parameters(dealii::ParameterHandler &prm);

/// Whether the run starts from the reference solution's fields and not from zero.
bool
starts_from_reference(dealii::ParameterHandler &prm);

/// The solution that the deck names, or null for `none`. The factor of the deck (1, except where a
/// test wants a wrong reference) multiplies all of it.
template <int dim>
std::unique_ptr<ReferenceSolution<dim>>
make_reference(dealii::ParameterHandler &prm, const ReferenceInput<dim> &input);
} // namespace stockwork
