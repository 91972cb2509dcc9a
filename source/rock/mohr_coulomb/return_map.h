#pragma once

#include <deal.II/base/symmetric_tensor.h>

#include "rock/mohr_coulomb/principal_return.h"

namespace stockwork::mohr_coulomb
{
struct Return
{
  dealii::SymmetricTensor<2, 3> stress;
  dealii::SymmetricTensor<4, 3> tangent; ///< d(stress)/d(strain), consistent with the return
  Place place = Place::elastic;

  /// The flow does not lead to the surface: psi = 0 and a mean stress beyond c cot(phi), without
  /// cut-off. The stress is put on the apex, which changes the volume though psi = 0 says that it
  /// does not.
  bool by_decree = false;
};

/// Elastically trial stress back to the surface by backward Euler: principal_return() or
/// hardening_return() in the principal axes of the trial stress, which are those of the stress. The
/// plastic strain is the elastic compliance times (trial - stress).
/// @param trial effective stress, tension positive [Pa]
/// @param lame_lambda, shear_modulus of the elastic rock [Pa]
/// @param plastic_strain equivalent, before the step
Return return_to_surface(const dealii::SymmetricTensor<2, 3> &trial,
                         double lame_lambda,
                         double shear_modulus,
                         const Strength &strength,
                         double plastic_strain = 0.);

/// The greatest value of f, sorted or not, over 2 c cos(phi), of rock that has not yielded yet:
/// below zero inside. The cut-off is not looked at.
double distance_to_yield(const dealii::SymmetricTensor<2, 3> &stress, const Strength &strength);

/// By how much the stress may change, in the Frobenius norm, before rock that has not yielded yet
/// does; zero or less where it yields [Pa].
double margin_to_yield(const dealii::SymmetricTensor<2, 3> &stress, const Strength &strength);

/// The radius of Mohr's circle over that at which it would touch the surface, its centre where it
/// is, of rock that has not yielded yet: 1 on the surface, 0 where the principal stresses are
/// equal.
double share_of_strength(const dealii::SymmetricTensor<2, 3> &stress, const Strength &strength);
} // namespace stockwork::mohr_coulomb
