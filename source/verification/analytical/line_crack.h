#pragma once

#include <array>

namespace stockwork::analytical
{
/// Stress intensity factors at a crack tip, Pa sqrt(m).
struct StressIntensity
{
  double mode_I;
  double mode_II;

  /// Direction of the largest hoop stress (Erdogan & Sih 1963), rad, counter-clockwise from the
  /// crack's own direction at the tip it points to.
  double kink_angle() const;

  /// Energy release rate in plane strain, J/m^2; plane_strain_modulus is E/(1 - nu^2).
  double energy_release_rate(double plane_strain_modulus) const;
};


/// Normal and shear stress on a plane that makes `angle` (rad) with the x axis, Pa.
struct PlaneTraction
{
  double normal; ///< tension positive
  double shear;  ///< t . sigma . n with t along the plane, n to its left
};

PlaneTraction traction_on_plane(double stress_xx, double stress_yy, double stress_xy, double angle);


/// A straight crack in an infinite plane-strain body under uniform load on its faces (Sneddon &
/// Elliott 1946; Westergaard 1939). With far-field stress, net_pressure is the fluid pressure plus
/// the normal stress on the crack's plane and shear the shear stress there (superposition), and
/// the displacement is measured from the loaded but uncracked body.
struct LineCrackParameters
{
  double youngs_modulus; ///< Pa
  double poisson_ratio;
  double half_length;   ///< a, m
  double net_pressure;  ///< Pa; negative values give overlapping faces
  double shear = 0.;    ///< Pa
  double angle = 0.;    ///< of the crack to the x axis, rad
  double centre_x = 0.; ///< m
  double centre_y = 0.; ///< m
};

class LineCrack
{
public:
  explicit LineCrack(const LineCrackParameters &);

  /// Full opening at the distance s (m, |s| <= a) from the centre, m.
  double opening(double s) const;

  /// Tangential jump, upper minus lower face, m.
  double slip(double s) const;

  /// Area of the open crack, m^2 per unit thickness.
  double volume() const;

  /// The same at both tips.
  StressIntensity stress_intensity() const;

  double energy_release_rate() const;

  /// Displacement (u_x, u_y) at a point of the body, m; zero at infinity.
  std::array<double, 2> displacement(double x, double y) const;

private:
  LineCrackParameters parameters;
  double modulus; // E', Pa
};


/// A penny-shaped crack under uniform pressure in an infinite body (Sneddon 1946).
struct PennyCrackParameters
{
  double youngs_modulus; ///< Pa
  double poisson_ratio;
  double radius;       ///< R, m
  double net_pressure; ///< Pa
};

class PennyCrack
{
public:
  explicit PennyCrack(const PennyCrackParameters &);

  /// Full opening at the distance r from the centre, m.
  double opening(double r) const;

  /// m^3.
  double volume() const;

  /// Pa sqrt(m), all along the front.
  double stress_intensity() const;

  double energy_release_rate() const;

  /// Displacement (u_r, u_z) at the distance r from the axis and z from the plane of the crack, m;
  /// zero at infinity.
  std::array<double, 2> displacement(double r, double z) const;

private:
  PennyCrackParameters parameters;
  double modulus; // E', Pa
};
} // namespace stockwork::analytical
