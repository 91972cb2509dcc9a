#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "rock/mohr_coulomb/law.h"
#include "verification/reference/perfectly_plastic.h"
#include "verification/reference/problems.h"

#include <cmath>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
/// The greatest mean pressure under a strip on weightless rock without surcharge, c N_c with
///   N_q = exp(pi tan phi) tan^2(pi/4 + phi/2),  N_c = (N_q - 1) cot phi
/// (Prandtl 1921; N_c = 2 + pi for phi = 0). Exact where the flow is associated.
class Footing : public ReferenceSolution<2>
{
public:
  Footing(const mohr_coulomb::Strength &strength, const double width)
    : width(width)
  {
    const double phi = strength.friction_angle, tangent = std::tan(phi);
    const double n_q =
      std::exp(numbers::PI * tangent) * std::pow(std::tan(0.25 * numbers::PI + 0.5 * phi), 2);
    limit = strength.cohesion * (phi > 0. ? (n_q - 1.) / tangent : 2. + numbers::PI);
  }

  bool is_of_yielding_rock() const override
  {
    return true;
  }

  std::string name() const override
  {
    return "strip footing, Prandtl (1921)";
  }

  std::map<std::string, double> values(double) const override
  {
    return {{"limit_load", limit}};
  }

  void add_derived(std::map<std::string, double> &values) const override
  {
    values["limit_load"] = values["peak_load"] / width;
  }

private:
  double width, limit;
};
} // namespace


Made<2> make_footing(const ParameterHandler &prm, const ReferenceInput<2> &input)
{
  const auto *law = dynamic_cast<const mohr_coulomb::MohrCoulomb *>(input.law);
  if (law == nullptr)
    throw InputError("'footing' is on rock with 'Rock/Law = mohr coulomb'");
  require_perfectly_plastic(law->surface(), "footing");
  if (!law->is_symmetric())
    throw InputError("'footing' is on rock whose dilation angle is its friction angle: otherwise "
                     "the limit load is not unique");
  if (input.has_pore_pressure || input.layered || input.in_situ_stress.norm() > 0.)
    throw InputError("'footing' is on uniform, dry rock without in-situ stress");
  const auto width = get_optional_quantity(prm, "Footing width", dimension::length);
  if (!width)
    throw EntryError("Verification/Footing width", "",
                     "a length > 0 m: what the model holds of the strip's width");
  return std::make_unique<Footing>(law->surface(), *width);
}
} // namespace stockwork::reference
