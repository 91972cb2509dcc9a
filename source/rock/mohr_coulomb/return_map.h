#pragma once

#include <deal.II/base/symmetric_tensor.h>

#include <array>

namespace stockwork::mohr_coulomb
{
/// Strength of a Mohr-Coulomb rock. With principal effective stresses s1 >= s2 >= s3, tension
/// positive, the rock yields where
///
///   f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) = 0
///
/// (Wang 2016, Eq. 8, on every plane; sigma_n positive in compression there), and flows along the
/// gradient of the same function with the dilation angle in place of phi. The paper calls its flow
/// associated and gives 27 and 8 degrees, so it is not.
struct Strength
{
  double cohesion;       ///< c [Pa]
  double friction_angle; ///< phi [rad], from 0 to below pi/2
  double dilation_angle; ///< psi [rad], from 0 to phi
};

/// Where on the surface the stress has come to lie.
enum class Place
{
  elastic,          ///< inside
  face,             ///< s1 > s2 > s3
  compression_edge, ///< s1 = s2: triaxial compression
  extension_edge,   ///< s2 = s3: triaxial extension
  apex              ///< s1 = s2 = s3 = c cot(phi)
};

struct Return
{
  dealii::SymmetricTensor<2, 3> stress;
  dealii::SymmetricTensor<4, 3> tangent; ///< d(stress)/d(strain), consistent with the return
  Place place = Place::elastic;

  /// The flow does not lead to the surface: psi = 0 and a mean stress beyond c cot(phi). The stress
  /// is put on the apex, which changes the volume though psi = 0 says that it does not.
  bool by_decree = false;
};

/// Elastically trial stress back to the surface by backward Euler, rock perfectly plastic. Each
/// face is a plane in the space of principal stresses, so the return is exact: to the face, else to
/// an edge, else to the apex (de Souza Neto, Peric & Owen 2008, section 8.2; Clausen, Damkilde &
/// Andersen 2006). The plastic strain is the elastic compliance times (trial - stress).
/// @param trial effective stress, tension positive [Pa]
/// @param lame_lambda, shear_modulus of the elastic rock [Pa]
Return return_to_surface(const dealii::SymmetricTensor<2, 3> &trial,
                         double lame_lambda,
                         double shear_modulus,
                         const Strength &strength);

/// The greatest value of f, sorted or not, over 2 c cos(phi): below zero inside the surface.
double distance_to_yield(const dealii::SymmetricTensor<2, 3> &stress, const Strength &strength);

/// The radius of Mohr's circle over that at which it would touch the surface, its centre where it
/// is: 1 on the surface, 0 where the principal stresses are equal.
double share_of_strength(const dealii::SymmetricTensor<2, 3> &stress, const Strength &strength);
} // namespace stockwork::mohr_coulomb
