#include "rock/mohr_coulomb/hardening.h"

#include <deal.II/base/symmetric_tensor.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stockwork::mohr_coulomb
{
using namespace dealii;

namespace
{
/// sqrt(2/3) |e|
double equivalent(const PrincipalVector &strain)
{
  return std::sqrt(2. / 3.) * strain.norm();
}


/// Its derivative; zero where it has none.
PrincipalVector equivalent_by(const PrincipalVector &strain)
{
  const double norm = strain.norm();
  return norm > 0. ? std::sqrt(2. / 3.) / norm * strain : PrincipalVector();
}


/// The greatest v . n of all directions n in the cone of some flows; 0 where none is positive. That
/// is the length of v's projection onto the cone, which lies inside of it or on one of its sides.
double maximum_along(const std::vector<PrincipalVector> &flows, const PrincipalVector &v)
{
  double greatest = 0.;
  for (unsigned int side = 1; side < (1u << flows.size()); ++side)
  {
    PrincipalMatrix products = unit_symmetric_tensor<3>();
    PrincipalVector along;
    for (unsigned int i = 0; i < flows.size(); ++i)
      if (side & (1u << i))
      {
        along[i] = flows[i] * v;
        for (unsigned int j = 0; j < flows.size(); ++j)
          if (side & (1u << j))
            products[i][j] = flows[i] * flows[j];
      }
    const PrincipalVector shares = invert(products) * along;
    PrincipalVector projection;
    for (unsigned int i = 0; i < flows.size(); ++i)
      projection += shares[i] * flows[i];
    const double least = std::min({shares[0], shares[1], shares[2]});
    if (least >= -1e-12 * shares.norm())
      greatest = std::max(greatest, projection.norm());
  }
  return greatest;
}
} // namespace


PrincipalReturn hardening_return(const PrincipalVector &trial,
                                 const PrincipalMatrix &elastic,
                                 const Strength &strength,
                                 const double before)
{
  const PrincipalMatrix compliance = invert(elastic);
  const auto after = [&](const double growth)
  {
    const double cohesion = strength.cohesion_after(before + growth);
    if (excess(trial, strength, cohesion) <= 0.) // the growth is too much
      return PrincipalReturn{trial, elastic, PrincipalVector(), PrincipalVector(), Place::elastic};
    return principal_return(trial, elastic, strength, cohesion);
  };
  const auto lack = [&](const double growth) { return equivalent(after(growth).flow) - growth; };

  // Where it flows at least as far as the final cohesion, that holds for the whole step.
  const double to_final = std::max(
    (strength.final_cohesion - strength.cohesion) / strength.hardening_modulus - before, 0.);
  if (to_final < std::numeric_limits<double>::infinity() && lack(to_final) >= 0.)
    return principal_return(trial, elastic, strength, strength.final_cohesion);

  double most = lack(0.);
  while (most < to_final && lack(most) > 0.)
    most *= 2.;
  most = std::min(most, to_final);
  if (!(most > 0.)) // rounding has put the stress outside
    return after(0.);
  // Nearly linear, with a kink where the growth is so great that nothing flows any more: rock that
  // hardens steeply has its root next to that.
  constexpr unsigned int bits = 52;
  boost::uintmax_t n_steps = 100;
  PrincipalReturn result =
    after(boost::math::tools::toms748_solve(
            lack, 0., most, boost::math::tools::eps_tolerance<double>(bits), n_steps)
            .first);
  // dF = 0: the plastic strain follows the strain, and the cohesion the plastic strain.
  const PrincipalVector direction = equivalent_by(result.flow),
                        growth = direction - direction * (compliance * result.tangent);
  const double resistance =
    strength.hardening_modulus * (direction * (compliance * result.by_cohesion));
  result.tangent +=
    strength.hardening_modulus / (1. + resistance) * outer_product(result.by_cohesion, growth);
  return result;
}


double hardening_limit(const PrincipalMatrix &elastic, const Strength &strength, const int sense)
{
  const PrincipalMatrix compliance = invert(elastic);
  double rate = 0.;
  for (const FlowCone &cone : flow_cones(elastic, strength))
    rate = std::max(rate, maximum_along(cone.flows, -sense * (compliance * cone.by_cohesion)));
  return 1. / (std::sqrt(2. / 3.) * rate);
}
} // namespace stockwork::mohr_coulomb
