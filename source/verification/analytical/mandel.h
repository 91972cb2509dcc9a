#pragma once

#include "verification/analytical/poroelastic_medium.h"

#include <vector>

namespace stockwork::analytical
{
/// Rock that is linear and symmetric about the axes of a block, in the plane x y that it stays in:
///
///   sigma_xx = c_xx e_xx + c_xy e_yy - alpha p,  sigma_yy = c_xy e_xx + c_yy e_yy - alpha p,
///   zeta = alpha (e_xx + e_yy) + p/M
struct BlockRock
{
  double c_xx, c_xy, c_yy;     ///< drained, Pa
  double biot_coefficient;     ///< alpha
  double inverse_biot_modulus; ///< 1/M in 1/Pa
  double mobility;             ///< k_xx / mu, m^2/(Pa s); 0 means undrained at all times

  /// Fluid taken up per pressure if e_yy is held and sigma_xx is zero, 1/Pa.
  double storage() const
  {
    return inverse_biot_modulus + biot_coefficient * biot_coefficient / c_xx;
  }

  /// zeta = storage() p + coupling() e_yy and sigma_yy = stiffness() e_yy - coupling() p where
  /// sigma_xx is zero.
  double coupling() const
  {
    return biot_coefficient * (1. - c_xy / c_xx);
  }
  double stiffness() const
  {
    return c_yy - c_xy * c_xy / c_xx;
  }
};

/// Isotropic, in plane strain.
BlockRock block_rock(const PoroelasticMedium &medium);


/// Mandel's problem (Mandel 1953; Cheng & Detournay 1988, Int. J. Numer. Anal. Methods Geomech.
/// 12): a plane-strain block |x| <= half_width, |y| <= half_height between two rigid, frictionless,
/// impermeable plates, squeezed from t = 0 on; its sides x = +-half_width are free and drained.
/// In rock with layers along or across the plates as Abousleiman et al. (1996, Geotechnique 46);
/// derived here: with zeta, sigma_yy of BlockRock, e_yy the same everywhere and a given mean of
/// sigma_yy, the flow along x is diffusion with a source that is uniform,
///
///   S p_t + A e_yy,t = (k/mu) p_xx,   B e_yy - A mean(p) = -F/a
///
/// with S, A, B the storage, coupling and stiffness of BlockRock.
struct MandelParameters
{
  BlockRock rock;
  double half_width;  ///< a, m
  double half_height; ///< b, m
  double force;       ///< F on the half width (2 F on the whole plate), N/m
};

/// The fields of Mandel's problem at one time. Made by Mandel::at(), cheap to evaluate: one sine
/// or cosine per term that has not decayed.
class MandelAtTime
{
public:
  /// Excess pore pressure, Pa, compression positive; |x| <= a.
  double pressure(double x) const;

  /// Displacement along x, m, outward positive.
  double displacement_x(double x) const;

  /// Displacement along y, m; linear in y and the same for every x.
  double displacement_y(double y) const;

  /// Total vertical stress, Pa, tension positive.
  double stress_yy(double x) const;

private:
  friend class Mandel;

  struct Term
  {
    double wave_number; // alpha_n / a, 1/m
    double cosine;      // cos(alpha_n)
    double even;        // sin(alpha_n) exp(-alpha_n^2 T) / (alpha_n - sin cos), with cos(x)
    double odd;         // cos(alpha_n) exp(-alpha_n^2 T) / (alpha_n - sin cos), with sin(x)
  };

  double pressure_scale = 0.;     // Pa
  double displacement_scale = 0.; // m
  double stress_scale = 0.;       // Pa
  double strain_x = 0.;           // the part of u_x that is linear in x, 1
  double strain_y = 0.;           // u_y / y
  double uniform_stress = 0.;     // Pa
  double uniform_pressure = 0.;   // Pa, the undrained state
  std::vector<Term> terms;
};

/// The series is summed with up to 2000 roots, which is exact to 1e-10 for c t / a^2 >= 1e-6;
/// t <= 0 (or no permeability) gives the undrained state.
class Mandel
{
public:
  explicit Mandel(const MandelParameters &);

  MandelAtTime at(double t) const;

  double undrained_pressure() const;
  double diffusivity() const;

private:
  MandelParameters parameters;
  double ratio = 0.;         // 1 + S B/A^2, which is (1 - nu)/(nu_u - nu) in isotropic rock
  std::vector<double> roots; // of tan(x)/x = ratio
};
} // namespace stockwork::analytical
