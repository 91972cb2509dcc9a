#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <complex>

namespace stockwork
{
/// Unit vector at an angle to the x axis [rad].
dealii::Tensor<1, 2> direction(double angle);

/// Plane elasticity of anisotropic rock by two complex variables (Lekhnitskii 1963), in the frame
/// of a crack: x along it, y to its left. With the compliances
///
///   eps_x = a11 s_x + a12 s_y + a16 s_xy,  eps_y = a12 s_x + a22 s_y + a26 s_xy,
///   2 eps_xy = a16 s_x + a26 s_y + a66 s_xy
///
/// mu_1 and mu_2 are the roots with a positive imaginary part of
///
///   a11 mu^4 - 2 a16 mu^3 + (2 a12 + a66) mu^2 - 2 a26 mu + a22 = 0,
///
/// z_k = x + mu_k y, and u = 2 Re(sum p_k phi_k(z_k)), v = 2 Re(sum q_k phi_k(z_k)).
struct PlaneElasticity
{
  using Complex = std::complex<double>;

  /// @param stiffness in the axes of the run, two-dimensional [Pa]
  /// @param along unit vector along the crack
  PlaneElasticity(const dealii::SymmetricTensor<4, 2> &stiffness,
                  const dealii::Tensor<1, 2> &along);

  std::array<Complex, 2> mu;
  std::array<Complex, 2> p; ///< a11 mu^2 + a12 - a16 mu [1/Pa]
  std::array<Complex, 2> q; ///< a12 mu + a22/mu - a26 [1/Pa]

  /// M of a crack along x: with K = (K_II, K_I), the energy release rate is 1/2 K.M K (Sih, Paris
  /// and Irwin 1965, Eqs 27 and 28), and the jump behind the tip 2 M K sqrt(2 r / pi) [1/Pa].
  /// 2/E' times unity in isotropic rock.
  dealii::SymmetricTensor<2, 2> crack_compliance;

  /// E' of this crack's opening: under uniform pressure p it opens by 4 p sqrt(a^2 - x^2) / E'
  /// [Pa].
  double plane_modulus() const
  {
    return 2. / crack_compliance[1][1];
  }

  /// Whether mu_1 = mu_2, as in isotropic rock: formulae with 1/(mu_1 - mu_2) then fail.
  bool is_degenerate() const
  {
    return std::abs(mu[0] - mu[1]) < 1e-4;
  }
};

/// The least E' of a crack in any direction of the plane [Pa].
double minimum_plane_modulus(const dealii::SymmetricTensor<4, 2> &stiffness);
} // namespace stockwork
