#pragma once

namespace stockwork::analytical
{
/// A hole in an infinite, perfectly plastic Mohr-Coulomb body, either long and round, in plane
/// strain, or a ball; the in-situ stress the same in all three directions, the pressure on the wall
/// lowered (convergence) or raised (expansion) from it steadily; small strain. Stresses and
/// pressures here are positive in compression.
///
/// With N = (1 + sin phi)/(1 - sin phi), Y = 2 c cos phi/(1 - sin phi), H = Y/(N - 1) and m = 1
/// hoop direction, or 2 of a ball, the plastic shell has s_theta = N s_r + Y and s_r + H ~
/// r^(m(N-1)) in convergence, s_r = N s_theta + Y and s_r + H ~ r^(m(1/N-1)) in expansion (of a
/// ball: Yu & Houlsby 1991, Geotechnique 41). Its displacement follows from the flow rule,
/// integrated inwards from the elastic rock (derived here; of a long hole the same as Salencon 1969
/// and Carter, Booker & Yeung 1986 in small strain). Around a ball both hoop stresses are equal,
/// and the rock flows alike along both. In convergence of a long hole the stress along it would
/// become the greatest compression next to the wall: there it is equal to s_theta, and the rock
/// flows along the hole as well, which the classical solutions leave out.
class MohrCoulombCavity
{
public:
  struct Parameters
  {
    double young_modulus, poisson_ratio;
    double cohesion, friction_angle, dilation_angle; ///< [Pa], [rad]
    double in_situ;                                  ///< effective compression [Pa]
    double radius;                                   ///< of the hole [m]
    unsigned int n_hoop = 1; ///< directions around the hole: 1, or 2 of a ball
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
  /// s_r at the end of the elastic rock.
  double at_outer() const;

  /// r^k (e_r + flow e_theta [+ flow e_z]), the elastic strains that the flow rule leaves, tension
  /// positive.
  double source(double r) const;

  const Parameters p;
  double N, Y, H;
  bool converges = true;
  double wall = 0.;
  double flow = 0.;  ///< plastic strain of the shell: e_r + flow (sum of the others) = 0
  double k = 0.;     ///< m flow: r^k u has the source as derivative
  double outer = 0.; ///< radius of the plastic shell [m]; that of the hole where there is none
  double edge = 0.;  ///< radius inside which both stresses across the radius are equal [m]
};
} // namespace stockwork::analytical
