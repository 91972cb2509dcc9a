#pragma once

namespace stockwork::analytical
{
/// A circular hole in an infinite, perfectly plastic Mohr-Coulomb body in plane strain, the in-situ
/// stress the same in all three directions, the pressure on the wall lowered (convergence) or
/// raised (expansion) from it steadily; small strain. Stresses and pressures here are positive in
/// compression.
///
/// With N = (1 + sin phi)/(1 - sin phi), Y = 2 c cos phi/(1 - sin phi) and H = Y/(N - 1), the
/// plastic ring has s_theta = N s_r + Y and s_r + H ~ r^(N-1) in convergence, s_r = N s_theta + Y
/// and s_r + H ~ r^(1/N-1) in expansion. Its displacement follows from the flow rule, integrated
/// inwards from the elastic rock (derived here; the same as Salencon 1969 and Carter, Booker &
/// Yeung 1986 in small strain). In convergence the stress along the hole would become the greatest
/// compression next to the wall: there it is equal to s_theta, and the rock flows along the hole as
/// well, which the classical solutions leave out.
class MohrCoulombCavity
{
public:
  struct Parameters
  {
    double young_modulus, poisson_ratio;
    double cohesion, friction_angle, dilation_angle; ///< [Pa], [rad]
    double in_situ;                                  ///< effective compression [Pa]
    double radius;                                   ///< of the hole [m]
  };

  explicit MohrCoulombCavity(const Parameters &parameters);

  /// For an effective pressure on the wall, from 0.
  void set_wall_pressure(double pressure);

  double plastic_radius() const
  {
    return outer;
  }

  /// Outwards [m].
  double displacement(double r) const;

private:
  /// r^k (e_r + k e_theta [+ k e_z]), the elastic strains that the flow rule leaves, tension
  /// positive.
  double source(double r) const;

  const Parameters p;
  double N, Y, H;
  bool converges = true;
  double wall = 0.;
  double k = 0.;     ///< r^k u has the source as derivative
  double outer = 0.; ///< radius of the plastic ring [m]; that of the hole where there is none
  double edge = 0.;  ///< radius inside which s_z = s_theta [m]
};
} // namespace stockwork::analytical
