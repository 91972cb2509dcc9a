#pragma once

#include "fracture/peridynamics/lattice.h"
#include "fracture/peridynamics/turns.h"

#include <array>
#include <utility>
#include <vector>

namespace stockwork::peridynamics
{
/// A bond that softens, or a broken one across a dry path in stress in situ. Its unknown is what
/// has become of its elongation without any force, D times the elongation [m].
struct SofteningBond
{
  BondView view;
  /// Greatest stretch so far, as of a bond of the lattice's stiffness.
  double committed = 0., trial = 0.;
  /// Stretch that is not elongation: in situ, and what fluid relieves. With the pressure in the
  /// bonds it is not kept, see Peridynamics::added_stretch().
  double offset = 0.;
};


/// The bonds between whole and broken, sorted by view, as they are in an attempt at a step and as
/// the last step has left them.
template <int dim>
class SofteningBonds
{
public:
  /// What is kept between steps, and in checkpoints.
  struct Committed
  {
    /// Greatest stretch and offset.
    std::vector<std::pair<BondPlaces<dim>, std::array<double, 2>>> bonds;
    double relaxation = 1.;
  };

  explicit SofteningBonds(const Lattice<dim> &lattice);

  std::size_t size() const
  {
    return bonds.size();
  }
  bool empty() const
  {
    return bonds.empty();
  }
  const SofteningBond &operator[](const unsigned int number) const
  {
    return bonds[number];
  }
  auto begin() const
  {
    return bonds.begin();
  }
  auto end() const
  {
    return bonds.end();
  }
  auto begin()
  {
    return bonds.begin();
  }
  auto end()
  {
    return bonds.end();
  }

  /// Of the bonds' own unknowns, each has one, D times its elongation; state-based ones have a
  /// second one each, after all of these: the elongation that stands for the force of the
  /// dilatations, as far as it is lost.
  unsigned int n_unknowns() const
  {
    return (lattice.parameters.state_based ? 2 : 1) * size();
  }
  unsigned int unknown_of_lost_force(const unsigned int number) const
  {
    return size() + number;
  }

  /// Null where a bond does not soften.
  const SofteningBond *find(unsigned int site, unsigned int bond) const;

  /// 0: whole, 1: broken.
  double damage(unsigned int site, unsigned int bond) const;

  /// With a stretch now [-].
  double maximum_stretch(const SofteningBond &bond, double stretch) const;

  /// How far bonds soften within a step, of what their stretch asks for. Where a crack jumps, no
  /// step is short enough; so an attempt after one that has not converged lets them soften by less,
  /// and the rest is left to the steps that follow.
  double relaxation() const
  {
    return relaxation_now;
  }

  /// Of Newton's method, see Turns.
  /// @param kappa greatest stretch
  /// @param softens the stretch is the greatest so far
  bool follows_tangent(unsigned int number, double kappa, bool softens) const;

  /// Whether any bond of this rank's rows was given the secant.
  bool uses_secants() const;

  /// Another solve, or other bonds.
  void forget_turns();

  /// @param attempt at the step, 0 for the first
  /// @param converged the last one has, and was rejected for another reason
  void begin_attempt(unsigned int attempt, bool converged);

  /// In place of those that there are, in any order.
  void replace(std::vector<SofteningBond> others);

  void commit();

  /// As they are committed.
  void restore();

  Committed committed;

private:
  const Lattice<dim> &lattice;
  std::vector<SofteningBond> bonds;
  double relaxation_now = 1.;
  mutable std::vector<Turns> turns; ///< of each; those of other ranks' rows are not asked
};
} // namespace stockwork::peridynamics
