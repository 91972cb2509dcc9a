#pragma once

#include <boost/serialization/library_version_type.hpp> // Boost 1.74 uses it in the next one and leaves it out
#include <boost/serialization/unordered_map.hpp>

#include "discontinuity/contact_law.h"
#include "discontinuity/discontinuity.h"
#include "discontinuity/sliding_secant.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"

#include <algorithm>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

namespace stockwork
{
/// "Friction coefficient" of a model's subsection.
void declare_friction(dealii::ParameterHandler &prm);

/// That faces have touched, and how they slide, for the user.
std::string faces_touch(double friction);

/// Keeps the faces of cracks from passing through one another, and lets them rub (contact_law.h).
///
/// Each span has one gap, its mean aperture, which is the fluid's as well: as many conditions as
/// there are independent jumps of displacement along the crack, so that the tractions do not
/// oscillate. A span that ends in its cell has no jumps of its own but those of the tip's
/// functions, which reach over half the crack; it shares the gap of the span before. The penalty is
/// so many times the stiffness of the rock over a cell, s E'/h: where a step adds S to the pressure
/// between faces, they overlap by h S/(s E') until the next, or until press().
template <int dim>
class FaceContact
{
public:
  /// @param friction coefficient
  /// @param stiffness s
  /// @param rock must outlive it
  FaceContact(const double friction,
              const double stiffness,
              const Rock &rock,
              const double domain_size)
    : friction(friction)
    , stiffness(stiffness)
    , rock(rock)
    , domain_size(domain_size)
  {
  }

  /// Proppant keeps faces this far apart [m], by crack and piece; null: nothing does.
  void keep_apart(std::function<double(unsigned int, unsigned int)> minimum_gap)
  {
    this->minimum_gap = std::move(minimum_gap);
  }

  bool has_friction() const
  {
    return friction > 0.;
  }

  /// What the faces of a piece exert on one another.
  /// @param broken see ContactLaw::evaluate
  ContactResponse<dim> traction(const Discontinuity<dim> &discontinuity,
                                unsigned int crack,
                                unsigned int piece,
                                const std::vector<double> &extra,
                                double broken = 1.) const;

  /// Add the tractions of a piece.
  void assemble(const Discontinuity<dim> &discontinuity,
                unsigned int crack,
                unsigned int piece,
                const std::vector<double> &extra,
                Sink &sink,
                double broken = 1.) const;

  /// Broken faces that have not moved yet carry what presses them in situ. If they had to overlap
  /// for it, fluid that cannot get out would bear the stress in their place, and they would slide.
  /// @param broken see ContactLaw::evaluate
  void start(const Scene<dim> &scene,
             const Discontinuity<dim> &discontinuity,
             const std::function<double(const CrackPiece<dim> &)> &broken);

  /// A step begins, perhaps anew.
  void begin_step()
  {
    carried = pressed;
    closing = touched;
    begin_solve();
  }

  /// Newton's method begins anew.
  void begin_solve()
  {
    sliding.clear();
  }

  /// Whether in the last assemble() any span of this rank was given any of its secant.
  bool uses_secants() const
  {
    return std::any_of(sliding.begin(), sliding.end(),
                       [](const auto &own) { return own.second.share() > 0.; });
  }

  /// Which faces press() looks at.
  enum class Press
  {
    all,
    parting ///< that carried something when the step began and are apart now
  };

  /// Where the faces of a piece press one another though they overlap, or are apart, by more than
  /// half a per cent of the greatest opening, and by more than a hundredth of what the penalty
  /// alone would leave: let them carry what presses them, for the step to be solved again.
  /// @param opening the greatest now [m]
  /// @param which others are left as they are
  /// @return whether they do
  bool press(const Discontinuity<dim> &discontinuity,
             unsigned int crack,
             unsigned int piece,
             const std::vector<double> &extra,
             double opening,
             double broken = 1.,
             Press which = Press::all);

  /// The step is accepted: its slip on a piece is what it was, and its pressure.
  void commit(const Discontinuity<dim> &discontinuity,
              unsigned int crack,
              unsigned int piece,
              const std::vector<double> &extra,
              double broken = 1.);

  /// Done against friction since the start [J/m].
  double work() const
  {
    return friction_work;
  }

  /// That broken faces have touched for the first time, and how they slide; else empty.
  std::vector<std::string> take_messages();

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &slips &pressed &friction_work &maximum_opening &touched &said;
  }

private:
  /// Pieces that share a gap, which opens by the jumps.
  struct Patch
  {
    unsigned int first = 0, last = 0; ///< pieces
    double length = 0.;               ///< [m]
    double minimum_gap = 0.;          ///< mean [m]
    std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> jumps;
  };
  Patch
  patch(const Discontinuity<dim> &discontinuity, unsigned int crack, unsigned int piece) const;

  dealii::Tensor<1, dim> slip(const CrackPiece<dim> &first_of_patch) const;
  double carried_by(const CrackPiece<dim> &first_of_patch) const;

  /// As Newton's method is to take it [Pa/m].
  dealii::Tensor<2, dim> tangent(const CrackPiece<dim> &first_of_patch,
                                 const ContactResponse<dim> &response) const;

  double friction, stiffness;
  const Rock &rock;
  double domain_size;
  std::function<double(unsigned int, unsigned int)> minimum_gap;

  // Committed, the same on all ranks.
  std::unordered_map<std::uint64_t, dealii::Tensor<1, dim>> slips; ///< by first piece's key [m]
  std::unordered_map<std::uint64_t, double> pressed; ///< likewise, where faces touch [Pa]
  double friction_work = 0.;
  double maximum_opening = 0.; ///< so far [m]
  bool touched = false, said = false;

  std::unordered_map<std::uint64_t, double> carried; ///< in this step: see press()
  bool closing = false; ///< broken faces had touched when the step began
  /// Of spans that slide or have slid in this solve, by first piece's key; this rank's only.
  mutable std::unordered_map<std::uint64_t, SlidingSecant> sliding;
};
} // namespace stockwork
