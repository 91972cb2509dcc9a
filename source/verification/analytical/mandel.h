#pragma once

#include "verification/analytical/poroelastic_medium.h"

#include <vector>

namespace stockwork::analytical
{
/// Mandel's problem (Mandel 1953; Cheng & Detournay 1988, Int. J. Numer. Anal. Methods Geomech.
/// 12): a plane-strain block |x| <= half_width, |y| <= half_height between two rigid, frictionless,
/// impermeable plates, squeezed from t = 0 on; its sides x = +-half_width are free and drained.
struct MandelParameters
{
  PoroelasticMedium medium;
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
  double displacement_scale = 0.; // F/G, m
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
  std::vector<double> roots; // of tan(x)/x = (1 - nu)/(nu_u - nu)
};
} // namespace stockwork::analytical
