#pragma once

namespace stockwork::analytical
{
/// An elastic bar or a layer that cannot expand sideways, z = 0 at the free top and z = length at
/// the fixed base, under a pressure on its top that acts from t = 0 on.
struct BarWaveParameters
{
  double modulus;        ///< E of a rod or lambda + 2 G of a layer, Pa
  double density;        ///< kg/m^3
  double length;         ///< m
  double load;           ///< Pa, compression positive
  double ramp_time = 0.; ///< the load grows as sin^2(pi t / (2 ramp_time)); 0 is a step; s
};


/// d'Alembert's solution: the load's wave and its reflections.
class BarWave
{
public:
  explicit BarWave(const BarWaveParameters &);

  /// Towards the base positive, m.
  double displacement(double z, double t) const;

  /// m/s.
  double velocity(double z, double t) const;

  /// Pa, tension positive.
  double stress(double z, double t) const;

  /// m/s.
  double wave_speed() const;

private:
  // The load's history and its integral, of unit height.
  double history(double t) const;
  double impulse(double t) const;

  // Sum over the arrivals at z: those that travel down plus `sign` times those that travel up.
  template <typename Signal>
  double arrivals(double z, double t, double sign, const Signal &signal) const;

  BarWaveParameters parameters;
};
} // namespace stockwork::analytical
