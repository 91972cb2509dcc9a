#pragma once

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
/// Stretches, over the one at which bonds soften, and damages that differ by less are equal: what
/// is symmetric breaks together, on any number of ranks.
constexpr double same_stretch = 1e-6;

/// A stretch or a damage, so that equal ones are the same number.
inline double rounded(const double stretch)
{
  return std::round(stretch / same_stretch) * same_stretch;
}

/// Bonds that soften before they break. Up to `first` a bond is elastic; from there its force falls
/// linearly to zero at `last`, and it unloads towards the origin. It dissipates what a brittle one
/// of critical stretch sqrt(first last) does. Strength and energy are then two numbers: a crack's
/// end is spread over more cells, so it moves smoothly instead of from cell to cell, and the
/// lattice does not trap it.
struct SofteningLaw
{
  /// Damage of the bonds across a cell from which on the fluid gets into it.
  static constexpr double wet_damage = 0.1;
  /// Of the bonds across a cohesive crack, at the start. With 'Softening = 4' they have lost a
  /// four-hundredth of their energy by it.
  static constexpr double damage_at_start = 0.01;

  double first = 0., last = 0.; ///< stretches

  bool brittle() const
  {
    return !(last > first);
  }

  /// Of a bond whose greatest stretch has been kappa; 0 is elastic, 1 is broken.
  double damage(const double kappa) const
  {
    return kappa >= last    ? 1.
           : kappa <= first ? 0.
                            : last / kappa * (kappa - first) / (last - first);
  }

  /// The stretch up to which damage comes.
  double stretch_of(const double damage) const
  {
    return last * first / (last - damage * (last - first));
  }

  /// Of damage times stretch by the stretch, where the stretch is the greatest so far.
  double slope(const double kappa) const
  {
    return kappa >= last ? 1. : kappa <= first ? 0. : last / (last - first);
  }

  /// Stretch at which fluid gets into a cell.
  double when_wet() const
  {
    return stretch_of(wet_damage);
  }

  /// Over that of a bond that broke at stretch one.
  double dissipated(const double kappa) const
  {
    return first * damage(kappa) * std::min(kappa, last);
  }

  /// Work of its force on what it has lost of its elongation, also that part of it which would come
  /// back if it were unloaded. In the same unit.
  double separation(const double kappa) const
  {
    const double left = kappa >= last ? 0. : std::clamp((last - kappa) / (last - first), 0., 1.);
    return first * last * (1. - left * left);
  }
};
} // namespace stockwork::peridynamics
