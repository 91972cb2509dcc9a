#include "rock/mohr_coulomb/return_map.h"

#include "rock/mohr_coulomb/hardening.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stockwork::mohr_coulomb
{
using namespace dealii;

namespace
{
PrincipalVector principal_values(const SymmetricTensor<2, 3> &stress)
{
  const auto s = eigenvalues(stress);
  return PrincipalVector({s[0], s[1], s[2]});
}
} // namespace


double distance_to_yield(const SymmetricTensor<2, 3> &stress, const Strength &strength)
{
  return yield_function(principal_values(stress), strength, strength.cohesion) /
         (2. * strength.cohesion * std::cos(strength.friction_angle));
}


double margin_to_yield(const SymmetricTensor<2, 3> &stress, const Strength &strength)
{
  // Principal stresses change by no more than the stress does (Hoffman & Wielandt 1953).
  const PrincipalVector s = principal_values(stress);
  const double sine = std::sin(strength.friction_angle);
  return std::min(-yield_function(s, strength, strength.cohesion) /
                    std::sqrt(2. + 2. * sine * sine),
                  strength.tension_cut_off - s[0]);
}


double share_of_strength(const SymmetricTensor<2, 3> &stress, const Strength &strength)
{
  const PrincipalVector s = principal_values(stress);
  const double yield = 2. * strength.cohesion * std::cos(strength.friction_angle),
               both = s[0] + s[2];
  // The diameter at which the circle would touch the straight line, or the cut-off.
  const double room = std::min(yield - both * std::sin(strength.friction_angle),
                               2. * strength.tension_cut_off - both);
  // Beyond the apex there is no circle that would touch.
  return room > 0. ? (s[0] - s[2]) / room
                   : 1. + std::max(0., excess(s, strength, strength.cohesion)) / yield;
}


Return return_to_surface(const SymmetricTensor<2, 3> &trial,
                         const double lame_lambda,
                         const double shear_modulus,
                         const Strength &strength,
                         const double plastic_strain)
{
  const auto identity = unit_symmetric_tensor<3>();
  Return result;
  const auto pairs = eigenvectors(trial, SymmetricTensorEigenvectorMethod::jacobi);
  PrincipalVector s;
  for (unsigned int i = 0; i < 3; ++i)
    s[i] = pairs[i].first;
  const double cohesion = strength.cohesion_after(plastic_strain);
  if (excess(s, strength, cohesion) <= 0.)
  {
    result.stress = trial;
    result.tangent =
      lame_lambda * outer_product(identity, identity) + 2. * shear_modulus * identity_tensor<3>();
    return result;
  }

  const PrincipalMatrix elastic = principal_stiffness(lame_lambda, shear_modulus);
  const PrincipalReturn principal = strength.is_perfectly_plastic()
                                      ? principal_return(s, elastic, strength, cohesion)
                                      : hardening_return(s, elastic, strength, plastic_strain);
  result.place = principal.place;
  result.by_decree = principal.place == Place::apex && strength.dilation_angle == 0.;

  // The return is an isotropic function of the strain, so its derivative turns with the principal
  // axes: their stresses move by the principal tangent, and a shear between two of them by the
  // ratio of the differences of stress and of elastic strain, or its limit where they are equal.
  const double scale = std::max(std::abs(s[0]), std::abs(s[2]));
  std::array<SymmetricTensor<2, 3>, 3> axes;
  for (unsigned int i = 0; i < 3; ++i)
  {
    axes[i] = symmetrize(outer_product(pairs[i].second, pairs[i].second));
    result.stress += principal.stress[i] * axes[i];
  }
  const PrincipalMatrix &t = principal.tangent;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      result.tangent += t[i][j] * outer_product(axes[i], axes[j]);
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = i + 1; j < 3; ++j)
    {
      const auto shear = symmetrize(outer_product(pairs[i].second, pairs[j].second));
      const double difference = s[i] - s[j];
      const double ratio =
        difference > 1e-8 * scale
          ? 2. * shear_modulus * (principal.stress[i] - principal.stress[j]) / difference
          : (t[i][i] - t[i][j] - t[j][i] + t[j][j]) / 2.;
      result.tangent += 2. * ratio * outer_product(shear, shear);
    }
  return result;
}
} // namespace stockwork::mohr_coulomb
