#include "rock/mohr_coulomb/principal_return.h"

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stockwork::mohr_coulomb
{
using namespace dealii;

namespace
{
using Vector = PrincipalVector;
using Matrix = PrincipalMatrix;

/// One plane of the surface: a . s = c k, with the flow along g.
struct Plane
{
  Vector a, g;
  double k = 0.;
};

/// Planes that can be active while the trial stress is sorted: those on which s_i is the greatest
/// and s_j the smallest principal stress, and those on which s_i is cut off.
enum PlaneName
{
  shear_13,
  shear_23,
  shear_12,
  cut_1,
  cut_2,
  cut_3,
  n_planes
};

using Planes = std::array<Plane, n_planes>;

/// Planes that may be active together.
struct ActiveSet
{
  Place place;
  unsigned int n;
  std::array<PlaneName, 3> names;
};

/// The greater parts of the surface first. Where four planes meet, any flow is one along three.
constexpr std::array<ActiveSet, 10> active_sets{
  {{Place::face, 1, {{shear_13}}},
   {Place::compression_edge, 2, {{shear_13, shear_23}}},
   {Place::extension_edge, 2, {{shear_13, shear_12}}},
   {Place::cut_off, 1, {{cut_1}}},
   {Place::cut_off_face, 2, {{cut_1, shear_13}}},
   {Place::cut_off_edge, 2, {{cut_1, cut_2}}},
   {Place::cut_off_extension, 3, {{cut_1, shear_13, shear_12}}},
   {Place::cut_off_compression, 3, {{cut_1, cut_2, shear_13}}},
   {Place::cut_off_compression, 3, {{cut_2, shear_13, shear_23}}},
   {Place::cut_off_corner, 3, {{cut_1, cut_2, cut_3}}}}};


/// How many of them there are: without cut-off the first three.
unsigned int n_active_sets(const Strength &strength)
{
  return strength.has_cut_off() ? active_sets.size() : 3;
}


Planes planes_of(const Strength &strength)
{
  const double friction = std::sin(strength.friction_angle),
               dilation = std::sin(strength.dilation_angle),
               k = 2. * std::cos(strength.friction_angle);
  const auto shear_plane = [&](const unsigned int i, const unsigned int j)
  {
    Plane plane;
    plane.a[i] = 1. + friction;
    plane.a[j] = -1. + friction;
    plane.g[i] = 1. + dilation;
    plane.g[j] = -1. + dilation;
    plane.k = k;
    return plane;
  };
  Planes planes;
  planes[shear_13] = shear_plane(0, 2);
  planes[shear_23] = shear_plane(1, 2);
  planes[shear_12] = shear_plane(0, 1);
  if (strength.has_cut_off())
    for (unsigned int i = 0; i < 3; ++i)
    {
      planes[cut_1 + i].a[i] = planes[cut_1 + i].g[i] = 1.;
      planes[cut_1 + i].k = strength.tension_cut_off / strength.cohesion;
    }
  return planes;
}


/// c cot(phi) for c = 1.
double apex_of(const Strength &strength)
{
  return 1. / std::tan(strength.friction_angle);
}


/// To where the planes of a set meet.
/// @param backwards gets by how much flow along one of them would have to go backwards [Pa]
PrincipalReturn to_planes(const Vector &trial,
                          const Matrix &elastic,
                          const Planes &planes,
                          const ActiveSet &set,
                          const double cohesion,
                          double &backwards)
{
  // Multipliers from (a_i . D g_j) m_j = a_i . trial - c k_i; rows of ones fill it up to three.
  Matrix stiffness = unit_symmetric_tensor<3>();
  Vector outside, slopes;
  std::array<Vector, 3> steps, drops;
  for (unsigned int i = 0; i < set.n; ++i)
  {
    const Plane &plane = planes[set.names[i]];
    steps[i] = elastic * plane.g;
    drops[i] = elastic * plane.a;
    outside[i] = plane.a * trial - cohesion * plane.k;
    slopes[i] = plane.k;
    for (unsigned int j = 0; j < set.n; ++j)
      stiffness[i][j] = drops[i] * planes[set.names[j]].g;
  }
  const Matrix compliance = invert(stiffness);
  const Vector multipliers = compliance * outside, by_cohesion = compliance * slopes;
  PrincipalReturn result{trial, elastic, Vector(), Vector(), set.place};
  backwards = 0.;
  for (unsigned int i = 0; i < set.n; ++i)
  {
    backwards = std::max(backwards, -multipliers[i] * steps[i].norm());
    result.stress -= multipliers[i] * steps[i];
    result.flow += multipliers[i] * planes[set.names[i]].g;
    result.by_cohesion += by_cohesion[i] * steps[i];
    for (unsigned int j = 0; j < set.n; ++j)
      result.tangent -= compliance[i][j] * outer_product(steps[i], drops[j]);
  }
  if (set.n == 3)
    result.tangent = Matrix(); // a point
  return result;
}
} // namespace


PrincipalMatrix principal_stiffness(const double lame_lambda, const double shear_modulus)
{
  Matrix elastic;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      elastic[i][j] = lame_lambda + (i == j ? 2. * shear_modulus : 0.);
  return elastic;
}


double
yield_function(const PrincipalVector &stress, const Strength &strength, const double cohesion)
{
  const double greatest = std::max({stress[0], stress[1], stress[2]}),
               smallest = std::min({stress[0], stress[1], stress[2]});
  return (greatest - smallest) + (greatest + smallest) * std::sin(strength.friction_angle) -
         2. * cohesion * std::cos(strength.friction_angle);
}


double excess(const PrincipalVector &stress, const Strength &strength, const double cohesion)
{
  const double f = yield_function(stress, strength, cohesion);
  if (!strength.has_cut_off())
    return f;
  return std::max(f, std::max({stress[0], stress[1], stress[2]}) -
                       strength.tension_cut_off * (cohesion / strength.cohesion));
}


PrincipalReturn principal_return(const PrincipalVector &trial,
                                 const PrincipalMatrix &elastic,
                                 const Strength &strength,
                                 const double cohesion)
{
  const Planes planes = planes_of(strength);
  // What rounding takes: a stress that is on an edge already must stay there.
  const double slack = 1e-12 * (cohesion * planes[shear_13].k + trial.norm());
  PrincipalReturn best;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned int i = 0; i < n_active_sets(strength); ++i)
  {
    double backwards;
    const PrincipalReturn result =
      to_planes(trial, elastic, planes, active_sets[i], cohesion, backwards);
    const double fault = std::max(backwards, excess(result.stress, strength, cohesion));
    if (fault <= slack)
      return result;
    if (fault < least)
    {
      least = fault;
      best = result;
    }
  }
  if (strength.has_cut_off() || strength.friction_angle == 0.)
    return best; // there is no apex: on the border between two sets, to rounding
  const double apex = apex_of(strength);
  const Vector along({apex, apex, apex});
  return {cohesion * along, Matrix(), along, invert(elastic) * (trial - cohesion * along),
          Place::apex};
}


std::vector<FlowCone> flow_cones(const PrincipalMatrix &elastic, const Strength &strength)
{
  const Planes planes = planes_of(strength);
  std::vector<FlowCone> cones;
  for (unsigned int i = 0; i < n_active_sets(strength); ++i)
  {
    const ActiveSet &set = active_sets[i];
    double backwards;
    FlowCone cone;
    cone.by_cohesion = to_planes(Vector(), elastic, planes, set, 1., backwards).by_cohesion;
    for (unsigned int j = 0; j < set.n; ++j)
      cone.flows.push_back(planes[set.names[j]].g);
    cones.push_back(cone);
  }
  // The apex, where all six shear planes meet: of its flows only the one that all of them share
  // matters, for the stress changes along it.
  if (!strength.has_cut_off() && strength.friction_angle > 0.)
  {
    const Vector along({1., 1., 1.});
    cones.push_back({{along}, apex_of(strength) * along});
  }
  return cones;
}
} // namespace stockwork::mohr_coulomb
