#pragma once

#include "verification/analytical/poroelastic_medium.h"

namespace stockwork::analytical
{
/// Consolidation of a column, z = 0 at the drained, loaded top and z = length at the fixed,
/// impermeable base (Terzaghi 1923; Biot 1941). The column either cannot expand sideways
/// (uniaxial strain) or is a rod with free sides whose compressibility is 1/E, the
/// one-dimensional problem of Sun et al., section 4.1, whose equations 36 to 38 are corrected here:
///   (1/a) u_z = alpha p - P,   (1/M + alpha^2 a) p_t = (k/mu) p_zz.
struct ColumnParameters
{
  enum class Kind
  {
    rod,            ///< a = 1/E
    uniaxial_strain ///< a = 1/(lambda + 2 G)
  };

  Kind kind;
  PoroelasticMedium medium;
  double length; ///< m
  double load;   ///< compression P on the top from t = 0 on, Pa
};

/// Excess pore pressure p (compression positive) and displacement u (downward positive) of the
/// column. With zero permeability the column stays in its undrained state for ever.
class Column
{
public:
  explicit Column(const ColumnParameters &);

  /// Pa, at depth z (m) and time t (s); t <= 0 gives the undrained state.
  double pressure(double z, double t) const;

  /// m, at depth z and time t.
  double displacement(double z, double t) const;

  double base_pressure(double t) const;
  double top_displacement(double t) const;

  double undrained_pressure() const;
  double undrained_top_displacement() const;
  double drained_top_displacement() const;

  /// c = k / (mu (1/M + alpha^2 a)), m^2/s.
  double diffusivity() const;

private:
  double dimensionless_pressure(double depth, double time) const;
  double dimensionless_pressure_below(double depth, double time) const;

  double length;
  double load;
  double biot_coefficient;
  double compressibility; // a, 1/Pa
  double p0;              // undrained pressure, Pa
  double c;               // diffusivity, m^2/s
};
} // namespace stockwork::analytical
