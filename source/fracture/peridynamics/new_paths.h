#pragma once

#include "fracture/peridynamics/lattice.h"
#include "fracture/peridynamics/tracked_paths.h"
#include "stockwork/fracture/model.h"

#include <functional>
#include <string>
#include <vector>

namespace stockwork::peridynamics
{
/// `Tracking = path`: where bonds are stretched too far and no path is near, one begins.
template <int dim>
class NewPaths
{
public:
  /// The stress, with that in situ, in the mean over the sites no farther than @p reach from a
  /// place, weighted by where they are from there [Pa].
  using MeanStress = std::function<dealii::SymmetricTensor<2, dim>(
    const dealii::Point<dim> &place,
    double reach,
    const std::function<double(const dealii::Tensor<1, dim> &away)> &weight)>;

  explicit NewPaths(const Lattice<dim> &lattice);

  /// Find the sites that may have bonds so far from all paths that one may begin there.
  void look_beside(const TrackedPaths &paths);

  /// @throws InputError where the stress in situ alone stretches bonds too far, so that paths would
  /// begin all over the rock
  void refuse_in_situ_tension(const TrackedPaths &paths) const;

  /// Paths begin where bonds are stretched most, if that is too far.
  /// @param displacement of all sites [m]
  /// @param dilatation_forces of sites, if they are state-based, see Peridynamics
  /// @return why the run cannot go on; empty: it can
  std::string begin(const StepContext &context,
                    const std::vector<double> &displacement,
                    const std::vector<double> &dilatation_forces,
                    const MeanStress &mean_stress,
                    TrackedPaths &paths);

  /// What has been said of bonds that hold though they are stretched too far, and is said once.
  unsigned int told = 0;

  /// Sentences, since they were taken.
  std::vector<std::string> take_messages();

private:
  /// A bond that would soften if a path crossed it at right angles.
  struct Overstretched
  {
    double stretch; ///< over the one at which it softens, rounded
    unsigned int site, bond;
    dealii::Point<dim> middle;
  };

  /// Where a path begins, or would.
  struct Beginning
  {
    Overstretched bond; ///< with the place in its middle
    dealii::Tensor<1, dim> direction;
    dealii::SymmetricTensor<2, dim> stress; ///< in the mean around [Pa]
  };

  /// Bits of `told`: why bonds hold.
  static constexpr unsigned int held_at_side = 1, held_in_box = 2, held_at_rim = 4,
                                held_without_stress = 8;

  /// Those far from all paths, by site, and others that nearly would.
  std::vector<Overstretched> overstretched(const std::vector<double> &displacement,
                                           const std::vector<double> &dilatation_forces,
                                           const TrackedPaths &paths) const;

  /// Whether a point is in a cell of the zone, or of what may become one, or beyond all rock.
  bool is_in_zone(const dealii::Point<dim> &point) const;

  /// Whether others with the same middle would lead out of it.
  bool is_near_rim(const Overstretched &bond) const;

  /// At right angles to the greatest principal stress in the mean around.
  Beginning beginning_at(const Overstretched &bond, const MeanStress &mean_stress) const;

  /// Of its mean stress, what opens cracks [Pa].
  dealii::SymmetricTensor<2, dim> effective_stress(const Beginning &path) const;

  /// Whether the mean stress there is enough for what the bonds say.
  bool is_in_tension(const Beginning &path) const;

  /// Whether the place or the first pieces are in a box of 'Unbreakable'.
  bool begins_in_unbreakable(const Beginning &path) const;

  /// Where bonds are stretched most.
  /// @param reason see begin()
  /// @return places at which none begins, as the stress there is too small
  std::vector<dealii::Point<dim>> begin_worst(const std::vector<Overstretched> &all,
                                              const StepContext &context,
                                              const MeanStress &mean_stress,
                                              TrackedPaths &paths,
                                              std::string &reason);

  /// One of them.
  /// @return see begin()
  std::string begin_one(const Beginning &path, const StepContext &context, TrackedPaths &paths);

  /// Bonds are stretched too far at the rim of the zone.
  /// @return why the run cannot go on; empty: it can, and it is said
  std::string why_none_begins(const Beginning &path, const StepContext &context);

  /// Part of a sentence.
  std::string place_and_time(const dealii::Point<dim> &place, const StepContext &context) const;

  /// A sentence: what acts at a place where bonds are stretched too far, and what they hold.
  std::string stress_and_strength(const Beginning &path) const;

  const Lattice<dim> &lattice;
  std::vector<unsigned int> sites; ///< see look_beside()
  std::vector<std::string> messages;
};
} // namespace stockwork::peridynamics
