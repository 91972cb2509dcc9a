#include "rock/mohr_coulomb/return_map.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stockwork::mohr_coulomb
{
using namespace dealii;

namespace
{
using Vector = Tensor<1, 3>; ///< of principal values, sorted by those of the trial stress
using Matrix = Tensor<2, 3>;

/// One plane of the surface: a . s = k, with the flow along g.
struct Plane
{
  Vector a, g;
};

/// The plane on which s[i] is the greatest and s[j] the smallest principal stress.
Plane plane(const unsigned int i, const unsigned int j, const Strength &strength)
{
  Plane result;
  result.a[i] = 1. + std::sin(strength.friction_angle);
  result.a[j] = -1. + std::sin(strength.friction_angle);
  result.g[i] = 1. + std::sin(strength.dilation_angle);
  result.g[j] = -1. + std::sin(strength.dilation_angle);
  return result;
}


double yield_stress(const Strength &strength)
{
  return 2. * strength.cohesion * std::cos(strength.friction_angle);
}


struct PrincipalReturn
{
  Vector stress;
  Matrix tangent; ///< d(principal stress)/d(principal strain)
  Place place;
};


/// Back to one plane.
PrincipalReturn to_face(const Vector &trial, const Matrix &elastic, const Plane &p, const double k)
{
  const Vector step = elastic * p.g, drop = elastic * p.a;
  const double stiffness = p.a * step, multiplier = (p.a * trial - k) / stiffness;
  return {trial - multiplier * step, elastic - outer_product(step, drop) / stiffness, Place::face};
}


/// Back to the edge of two planes, if that takes flow along both.
/// @param slack that rounding takes: a stress that is on the edge already must stay there [Pa]
std::optional<PrincipalReturn> to_edge(const Vector &trial,
                                       const Matrix &elastic,
                                       const std::array<Plane, 2> &planes,
                                       const double k,
                                       const double slack,
                                       const Place place)
{
  Tensor<2, 2> stiffness;
  Tensor<1, 2> excess;
  std::array<Vector, 2> steps, drops;
  for (unsigned int i = 0; i < 2; ++i)
  {
    steps[i] = elastic * planes[i].g;
    drops[i] = elastic * planes[i].a;
    excess[i] = planes[i].a * trial - k;
  }
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = 0; j < 2; ++j)
      stiffness[i][j] = planes[i].a * steps[j];
  const Tensor<2, 2> compliance = invert(stiffness);
  const Tensor<1, 2> multipliers = compliance * excess;
  for (unsigned int i = 0; i < 2; ++i)
    if (multipliers[i] * steps[i].norm() < -slack)
      return {};
  PrincipalReturn result{trial, elastic, place};
  for (unsigned int i = 0; i < 2; ++i)
  {
    result.stress -= multipliers[i] * steps[i];
    for (unsigned int j = 0; j < 2; ++j)
      result.tangent -= compliance[i][j] * outer_product(steps[i], drops[j]);
  }
  // Beyond the apex the planes meet the wrong way round.
  if (result.stress[0] < result.stress[2] - slack)
    return {};
  return result;
}


/// Sorted trial stresses that lie outside.
PrincipalReturn
principal_return(const Vector &trial, const Matrix &elastic, const Strength &strength)
{
  const double k = yield_stress(strength);
  const Plane main = plane(0, 2, strength);
  const PrincipalReturn face = to_face(trial, elastic, main, k);
  const Vector &s = face.stress;
  const double slack = 1e-12 * (k + trial.norm());
  if (s[0] >= s[1] - slack && s[1] >= s[2] - slack)
    return face;
  if (s[1] > s[0])
    if (const auto edge = to_edge(trial, elastic, {{main, plane(1, 2, strength)}}, k, slack,
                                  Place::compression_edge))
      return *edge;
  if (s[2] > s[1])
    if (const auto edge =
          to_edge(trial, elastic, {{main, plane(0, 1, strength)}}, k, slack, Place::extension_edge))
      return *edge;
  const double apex = strength.cohesion / std::tan(strength.friction_angle);
  return {Vector({apex, apex, apex}), Matrix(), Place::apex};
}


Matrix principal_stiffness(const double lame_lambda, const double shear_modulus)
{
  Matrix elastic;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      elastic[i][j] = lame_lambda + (i == j ? 2. * shear_modulus : 0.);
  return elastic;
}
} // namespace


double distance_to_yield(const SymmetricTensor<2, 3> &stress, const Strength &strength)
{
  const auto s = eigenvalues(stress);
  const double k = yield_stress(strength);
  return (plane(0, 2, strength).a * Vector({s[0], s[1], s[2]}) - k) / k;
}


double share_of_strength(const SymmetricTensor<2, 3> &stress, const Strength &strength)
{
  const auto s = eigenvalues(stress);
  const double room = yield_stress(strength) - (s[0] + s[2]) * std::sin(strength.friction_angle);
  // Beyond the apex there is no circle that would touch.
  return room > 0. ? (s[0] - s[2]) / room : 2. + distance_to_yield(stress, strength);
}


Return return_to_surface(const SymmetricTensor<2, 3> &trial,
                         const double lame_lambda,
                         const double shear_modulus,
                         const Strength &strength)
{
  const auto identity = unit_symmetric_tensor<3>();
  Return result;
  const auto pairs = eigenvectors(trial, SymmetricTensorEigenvectorMethod::jacobi);
  Vector s;
  for (unsigned int i = 0; i < 3; ++i)
    s[i] = pairs[i].first;
  if (plane(0, 2, strength).a * s <= yield_stress(strength))
  {
    result.stress = trial;
    result.tangent =
      lame_lambda * outer_product(identity, identity) + 2. * shear_modulus * identity_tensor<3>();
    return result;
  }

  const PrincipalReturn principal =
    principal_return(s, principal_stiffness(lame_lambda, shear_modulus), strength);
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
  const Matrix &t = principal.tangent;
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
