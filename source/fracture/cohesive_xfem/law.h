#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace stockwork::cohesive_xfem
{
/// Separation of the two faces of a crack, or the traction between them: along the normal (positive
/// in opening, in tension) and along the crack.
struct NormalShear
{
  double normal = 0.;
  double shear = 0.;
};

/// Traction, its derivative by the separation, and the damage that belongs to them.
struct CohesiveResponse
{
  NormalShear traction;                         ///< [Pa]
  std::array<std::array<double, 2>, 2> tangent; ///< d(t_n, t_s)/d(d_n, d_s) [Pa/m]
  double damage;                                ///< trial value, never less than the given one
};

/// A bilinear cohesive law: traction rises with stiffness K to the strength, then falls linearly to
/// zero, dissipating G_c; unloading goes to the origin.
///
///   t_n = (1-D) K d_n;  t_s = (1-D) K d_s;
///   D = d_f (d - d_0) / (d (d_f - d_0)),  d = sqrt(<d_n>^2 + d_s^2)
///
/// Damage starts when (<t_n>/T)^2 + (t_s/S)^2 = 1. The dissipation in mixed mode is
/// G_c = G_I + (G_II - G_I) B^eta (Benzeggagh and Kenane 1996), where B is the share of shear in
/// the work done; as both modes have the same stiffness, B = d_s^2/d^2 (Camanho and Davila 2002).
/// Between broken faces the law has nothing to say: they touch by contact_law.h.
/// The history is the damage itself and not the largest separation, so damage never heals when the
/// mode changes.
struct CohesiveLaw
{
  double strength;       ///< T [Pa]
  double shear_strength; ///< S [Pa]
  double energy;         ///< G_I [J/m^2]
  double shear_energy;   ///< G_II [J/m^2]
  double exponent;       ///< eta
  double stiffness;      ///< K [Pa/m]

  /// Separation at which traction vanishes in pure opening, 2 G_I/T [m].
  double critical_opening() const
  {
    return 2. * energy / strength;
  }

  /// The law whose stiffness puts the peak at @p elastic_share of the critical opening.
  static CohesiveLaw with_elastic_share(const double strength,
                                        const double shear_strength,
                                        const double energy,
                                        const double shear_energy,
                                        const double exponent,
                                        const double elastic_share)
  {
    return {strength,     shear_strength, energy,
            shear_energy, exponent,       strength * strength / (elastic_share * 2. * energy)};
  }

  /// The law of rock with other strengths and energies, by these factors, and the peak at the same
  /// share of the critical opening.
  CohesiveLaw times(const double strengths, const double energies) const
  {
    return {strengths * strength,
            strengths * shear_strength,
            energies * energy,
            energies * shear_energy,
            exponent,
            stiffness * strengths * strengths / energies};
  }

  /// Dissipation of complete separation when the share @p mix of the work is shear [J/m^2].
  double fracture_energy(const double mix) const
  {
    return energy + (shear_energy - energy) * std::pow(mix, exponent);
  }

  CohesiveResponse evaluate(const NormalShear &separation, const double committed_damage) const;

  /// Energy dissipated until @p damage is reached in the mode of @p separation [J/m^2].
  double dissipation(const NormalShear &separation, const double damage) const;

private:
  /// Separation at the peak and at the end for a share of shear, and their derivatives by it.
  struct Range
  {
    double start, end, d_start, d_end;
  };

  Range range(const double mix) const
  {
    const double a = (1. - mix) / (strength * strength) + mix / (shear_strength * shear_strength);
    const double da = 1. / (shear_strength * shear_strength) - 1. / (strength * strength);
    const double start = 1. / (stiffness * std::sqrt(a));
    const double d_start = -0.5 * start * da / a;
    const double g = fracture_energy(mix);
    const double dg =
      (mix > 0. ? (shear_energy - energy) * exponent * std::pow(mix, exponent - 1.) : 0.);
    const double end = 2. * g / (stiffness * start);
    const double d_end = end * (dg / g - d_start / start);
    return {start, end, d_start, d_end};
  }
};

inline CohesiveResponse CohesiveLaw::evaluate(const NormalShear &separation,
                                              const double committed_damage) const
{
  const double n = std::max(separation.normal, 0.);
  const double s = separation.shear;
  const double d = std::hypot(n, s);
  const double K = stiffness;

  CohesiveResponse response;
  double damage = committed_damage;
  // Derivative of the damage by (d_n, d_s); zero unless it grows.
  double damage_n = 0., damage_s = 0.;
  if (d > 0. && damage < 1.)
  {
    const double mix = (s / d) * (s / d);
    const Range r = range(mix);
    if (d > r.start)
    {
      const double width = r.end - r.start;
      const double trial = std::min(1., r.end * (d - r.start) / (d * width));
      if (trial > damage)
      {
        damage = trial;
        if (trial < 1.)
        {
          // D = (r.end/width) (1 - r.start/d)
          const double q = 1. - r.start / d;
          const double d_ratio =
            (r.d_end * width - r.end * (r.d_end - r.d_start)) / (width * width);
          const double by_mix = d_ratio * q - r.end / width * r.d_start / d;
          const double by_d = r.end / width * r.start / (d * d);
          // mix = s^2/(n^2+s^2)
          const double mix_n = -2. * n * s * s / (d * d * d * d);
          const double mix_s = 2. * s * n * n / (d * d * d * d);
          damage_n = separation.normal > 0. ? by_d * n / d + by_mix * mix_n : 0.;
          damage_s = by_d * s / d + by_mix * mix_s;
        }
      }
    }
  }
  response.damage = damage;

  const double kept = 1. - damage;
  if (separation.normal > 0.)
  {
    response.traction.normal = kept * K * n;
    response.tangent[0][0] = kept * K - damage_n * K * n;
    response.tangent[0][1] = -damage_s * K * n;
  }
  else
  {
    response.traction.normal = kept * K * separation.normal;
    response.tangent[0][0] = kept * K;
    response.tangent[0][1] = separation.normal < 0. ? -damage_s * K * separation.normal : 0.;
  }
  response.traction.shear = kept * K * s;
  response.tangent[1][0] = -damage_n * K * s;
  response.tangent[1][1] = kept * K - damage_s * K * s;
  return response;
}

inline double CohesiveLaw::dissipation(const NormalShear &separation, const double damage) const
{
  const double n = std::max(separation.normal, 0.);
  const double d = std::hypot(n, separation.shear);
  const double mix = d > 0. ? (separation.shear / d) * (separation.shear / d) : 0.;
  const Range r = range(mix);
  // The area between the curve and the unloading line is G_c times the share (d - d_0)/(d_f - d_0)
  // of softening that is done, which follows from D.
  const double softened = damage * r.start / (r.end - damage * (r.end - r.start));
  return fracture_energy(mix) * softened;
}
} // namespace stockwork::cohesive_xfem
