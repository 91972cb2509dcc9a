#pragma once

namespace stockwork::analytical
{
/// A double cantilever beam opened at its end: two arms (Bernoulli beams) that a crack of length
/// a0 separates and a layer of given fracture energy joins. Per unit thickness.
struct DoubleCantileverParameters
{
  double modulus;         ///< E in plane stress, E/(1 - nu^2) in plane strain, Pa
  double arm_height;      ///< h of one arm, m
  double crack_length;    ///< a0 before growth, from the load point, m
  double fracture_energy; ///< G_c, J/m^2
};


/// The opening is that of the load point (both arms), the force that on one arm, N/m.
class BrittleDoubleCantilever
{
public:
  explicit BrittleDoubleCantilever(const DoubleCantileverParameters &);

  /// Arms clamped at the tip; growth at G = G_c.
  double force(double opening) const;
  double crack_length(double opening) const;

  double opening_at_onset() const;
  double opening_at(double crack_length) const;

private:
  DoubleCantileverParameters parameters;
  double stiffness; // E I of one arm, N m
};


/// The same arms joined by a bilinear cohesive layer: traction rises with `initial_stiffness` to
/// `strength`, then falls to nothing at the opening 2 G_c / strength.
struct CohesiveDoubleCantileverParameters
{
  DoubleCantileverParameters beam;
  double strength;          ///< Pa
  double initial_stiffness; ///< Pa/m
};


/// Closed form in each zone (traction-free arm, softening layer, elastic layer without end),
/// joined at fronts found by bisection. Under opening control, for the branch on which the
/// opening grows monotonically.
class CohesiveDoubleCantilever
{
public:
  explicit CohesiveDoubleCantilever(const CohesiveDoubleCantileverParameters &);

  struct State
  {
    double opening;              ///< of the load point, m
    double force;                ///< N/m
    double traction_free_length; ///< from the load point, m
    double softening_length;     ///< m
  };

  State at(double opening) const;

private:
  // The arms' deflection is y + final_opening/2 at the rear of the softening layer; derivatives
  // are by the distance towards the load point.
  struct Section
  {
    double y, y1, y2, y3;
  };

  Section rear_of_softening(double softening_length, double slope_parameter) const;
  Section equilibrium(double traction_free_length, double softening_length) const;
  State state(double traction_free_length, double softening_length) const;
  double softening_length_in_growth(double traction_free_length) const;

  CohesiveDoubleCantileverParameters parameters;
  double stiffness;             // E I of one arm, N m
  double elastic_opening;       // at the strength, m
  double final_opening;         // without traction, m
  double elastic_wave_number;   // of the elastic layer, 1/m
  double softening_wave_number; // of the softening layer, 1/m
};
} // namespace stockwork::analytical
