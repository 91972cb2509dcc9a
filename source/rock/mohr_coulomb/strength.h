#pragma once

#include <limits>

namespace stockwork::mohr_coulomb
{
/// Strength of a Mohr-Coulomb rock. With principal effective stresses s1 >= s2 >= s3, tension
/// positive, the rock yields where
///
///   f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) = 0
///
/// (Wang 2016, Eq. 8, on every plane; sigma_n positive in compression there), and flows along the
/// gradient of the same function with the dilation angle in place of phi. The paper calls its flow
/// associated and gives 27 and 8 degrees, so it is not. With a tension cut-off T it yields where
/// s1 = T as well, and flows along the gradient of s1 there.
///
/// The cohesion may change with the equivalent plastic strain, the sum of
/// sqrt(2/3 d(eps^p) : d(eps^p)) over the steps, from the cohesion to the final one, linearly. The
/// cut-off changes in proportion, so that all surfaces have one shape.
struct Strength
{
  double cohesion;       ///< c, of rock that has not yielded yet [Pa]
  double friction_angle; ///< phi [rad], from 0 to below pi/2
  double dilation_angle; ///< psi [rad], from 0 to phi

  /// T, of rock that has not yielded yet, below c cot(phi); infinite: none [Pa]
  double tension_cut_off = std::numeric_limits<double>::infinity();

  double hardening_modulus = 0.; ///< dc/d(equivalent plastic strain); below 0 it softens [Pa]

  /// Where hardening or softening ends; of no meaning where there is neither. Infinite: nowhere
  /// [Pa]
  double final_cohesion = std::numeric_limits<double>::infinity();

  bool has_cut_off() const
  {
    return tension_cut_off < std::numeric_limits<double>::infinity();
  }

  bool is_perfectly_plastic() const
  {
    return hardening_modulus == 0.;
  }

  /// c after an equivalent plastic strain [Pa].
  double cohesion_after(const double plastic_strain) const
  {
    const double linear = cohesion + hardening_modulus * plastic_strain;
    if (is_perfectly_plastic())
      return cohesion;
    return (hardening_modulus > 0.) == (linear > final_cohesion) ? final_cohesion : linear;
  }
};
} // namespace stockwork::mohr_coulomb
