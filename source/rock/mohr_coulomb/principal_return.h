#pragma once

#include <deal.II/base/tensor.h>

#include "rock/mohr_coulomb/strength.h"

#include <vector>

namespace stockwork::mohr_coulomb
{
using PrincipalVector = dealii::Tensor<1, 3>; ///< of principal values
using PrincipalMatrix = dealii::Tensor<2, 3>;

/// Where on the surface the stress has come to lie.
enum class Place
{
  elastic,             ///< inside
  face,                ///< s1 > s2 > s3
  compression_edge,    ///< s1 = s2: triaxial compression
  extension_edge,      ///< s2 = s3: triaxial extension
  apex,                ///< s1 = s2 = s3 = c cot(phi)
  cut_off,             ///< s1 = T
  cut_off_face,        ///< s1 = T, on a face
  cut_off_edge,        ///< s1 = s2 = T
  cut_off_extension,   ///< s1 = T, on an extension edge
  cut_off_compression, ///< s1 = s2 = T, on a compression edge
  cut_off_corner       ///< s1 = s2 = s3 = T
};

struct PrincipalReturn
{
  PrincipalVector stress;
  PrincipalMatrix tangent;     ///< d(stress)/d(strain), the cohesion as it is
  PrincipalVector by_cohesion; ///< d(stress)/d(cohesion), the strain as it is
  PrincipalVector flow;        ///< plastic strain of the step
  Place place;
};

/// d(principal stress)/d(principal strain) of elastic rock.
PrincipalMatrix principal_stiffness(double lame_lambda, double shear_modulus);

/// f of strength.h, of principal stresses in any order [Pa].
double yield_function(const PrincipalVector &stress, const Strength &strength, double cohesion);

/// The greater of f and s1 - T, of principal stresses in any order; below zero inside [Pa].
double excess(const PrincipalVector &stress, const Strength &strength, double cohesion);

/// Back to the surface of rock that is perfectly plastic with @p cohesion, by backward Euler. The
/// surface consists of planes, so this is exact: to a face, else to an edge, else to a corner (de
/// Souza Neto, Peric & Owen 2008, section 8.2; Clausen, Damkilde & Andersen 2006), namely to where
/// those planes meet along which the flow goes forwards.
/// @param trial principal values, the greatest first, outside of the surface [Pa]
PrincipalReturn principal_return(const PrincipalVector &trial,
                                 const PrincipalMatrix &elastic,
                                 const Strength &strength,
                                 double cohesion);

/// Of planes that are active together: the directions of flow, of which the plastic strain is a sum
/// with shares >= 0, and how the stress changes with the cohesion.
struct FlowCone
{
  std::vector<PrincipalVector> flows;
  PrincipalVector by_cohesion;
};

std::vector<FlowCone> flow_cones(const PrincipalMatrix &elastic, const Strength &strength);
} // namespace stockwork::mohr_coulomb
