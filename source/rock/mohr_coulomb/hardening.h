#pragma once

#include "rock/mohr_coulomb/principal_return.h"

namespace stockwork::mohr_coulomb
{
/// Back to the surface of rock whose cohesion changes while it flows, by backward Euler: the
/// cohesion is the one at the end of the step. With e(c) the plastic strain of the step that the
/// perfectly plastic return gives with a cohesion c, the growth k of the equivalent plastic strain
/// k_0 is the root of
///
///   F(k) = sqrt(2/3) |e(c(k_0 + k))| - k
///
/// As long as the same planes are active, e is linear in c. Below the limit of hardening_limit() F
/// falls everywhere, and the root is the only one.
/// @param trial principal values, the greatest first, outside of the surface [Pa]
/// @param before the equivalent plastic strain k_0
PrincipalReturn hardening_return(const PrincipalVector &trial,
                                 const PrincipalMatrix &elastic,
                                 const Strength &strength,
                                 double before);

/// The size of the modulus at and beyond which the hardening (@p sense = 1) or softening (-1) of a
/// point has no single answer: with v = C^-1 d(stress)/d(c), F falls for |H| below the least
/// 1/(sqrt(2/3) v . n) of all directions n of flow (-v for hardening). Softening rock then snaps
/// back: one strain has several stresses [Pa]. Infinite: no limit.
double hardening_limit(const PrincipalMatrix &elastic, const Strength &strength, int sense);
} // namespace stockwork::mohr_coulomb
