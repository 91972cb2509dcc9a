#pragma once

#include "verification/analytical/poroelastic_medium.h"

#include <vector>

namespace stockwork::analytical
{
/// Consolidation of a sphere (Cryer 1963) or of a long cylinder in plane strain (de Leeuw 1965):
/// from t = 0 on the total radial stress on the drained surface r = R is -load.
struct CryerParameters
{
  enum class Shape
  {
    sphere,
    cylinder
  };

  Shape shape;
  PoroelasticMedium medium;
  double radius; ///< R, m
  double load;   ///< Pa, compression positive
};


/// The fields at one time. Made by Cryer::at(), cheap to evaluate: one sine or Bessel function per
/// term that has not decayed.
class CryerAtTime
{
public:
  /// Excess pore pressure at the distance r from the centre or axis, Pa, compression positive.
  double pressure(double r) const;

  /// Radial displacement, m, outward positive.
  double displacement(double r) const;

private:
  friend class Cryer;

  struct Term
  {
    double root;       // x_n
    double amplitude;  // factor of phi(x_n r/R)/phi(x_n) - 1 in the pressure, Pa
    double reciprocal; // 1/phi(x_n)
  };

  CryerParameters::Shape shape = CryerParameters::Shape::sphere;
  double radius = 1.;
  double uniform_pressure = 0.; // Pa, the undrained state
  double uniform_strain = 0.;   // u_r/r without the terms
  double swelling = 0.;         // strain per pressure of the terms, 1/Pa
  double swelling_offset = 0.;  // of the mean pressure of a term
  std::vector<Term> terms;
};


/// Series over the roots x_n of m(x) = 1 + (N/G' - 1) N S / alpha^2, with N = lambda + 2G,
/// S the uniaxial storage, G' = 4G/3 (sphere) or G (cylinder), and m the mean over the body of
/// phi(x r/R)/phi(x), phi(x) = sin(x)/x or J_0(x) (from the Laplace transform, by residues). Up to
/// 2000 roots: exact to 1e-9 for c t / R^2 >= 1e-6; t <= 0 gives the undrained state.
class Cryer
{
public:
  explicit Cryer(const CryerParameters &);

  CryerAtTime at(double t) const;

  double undrained_pressure() const;
  double diffusivity() const;

private:
  double restraint() const; // G'

  CryerParameters parameters;
  std::vector<double> roots;
};
} // namespace stockwork::analytical
