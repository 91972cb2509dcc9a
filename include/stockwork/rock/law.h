#pragma once

#include <deal.II/base/array_view.h>
#include <deal.II/base/symmetric_tensor.h>

#include <limits>
#include <string>
#include <vector>

namespace stockwork
{
/// The state of the rock at a point. Tensors have three dimensions always: in plane strain the
/// strain zz is zero, the stress zz is not.
struct RockState
{
  dealii::SymmetricTensor<2, 3> strain;         ///< since in situ
  double pressure = 0.;                         ///< pore pressure over in situ [Pa]
  dealii::SymmetricTensor<2, 3> in_situ_stress; ///< total, tension positive [Pa]
  double in_situ_pressure = 0.;                 ///< [Pa]
  double fracture_pressure = 0.;   ///< of the fluid in CellRole::segment, if there is one [Pa]
  const double *history = nullptr; ///< committed, RockLaw::n_history() numbers
};

/// What the rock answers, and how that changes with strain and pressure.
struct RockResponse
{
  dealii::SymmetricTensor<2, 3> stress; ///< total, over in situ [Pa]
  double content = 0.;                  ///< fluid over in situ, per volume of rock
  double energy = 0.; ///< stored over in situ by the skeleton and the fluid in it [J/m^3]
  /// What the step from the committed history on has dissipated [J/m^3]. NaN, of a law that cannot
  /// say: the core takes the work of stress and pressure, by the trapezoidal rule, less what is
  /// stored.
  double dissipated = std::numeric_limits<double>::quiet_NaN();

  dealii::SymmetricTensor<4, 3> stress_by_strain;
  dealii::SymmetricTensor<2, 3> stress_by_pressure; ///< minus alpha times unity where isotropic
  dealii::SymmetricTensor<2, 3> content_by_strain;
  double content_by_pressure = 0.; ///< 1/M [1/Pa]

  // Where a fracture model has put its own law in place of the rock's: what the pressure in
  // CellRole::segment does beyond the load on that segment's opening.
  dealii::SymmetricTensor<2, 3> stress_by_fracture_pressure;
  double content_by_fracture_pressure = 0.;

  // Where RockLaw::changes_permeability().
  dealii::SymmetricTensor<2, 3> permeability;             ///< [m^2]
  dealii::SymmetricTensor<4, 3> permeability_by_strain;   ///< the strain is the second pair
  dealii::SymmetricTensor<2, 3> permeability_by_pressure; ///< [m^2/Pa]

  /// What the user must know of this answer, a sentence that lasts; null: nothing.
  const char *remark = nullptr;

  double *history = nullptr; ///< gets what becomes history when the step is accepted
};

/// One number, or the six of a symmetric tensor (xx, yy, zz, xy, xz, yz), of a law's history, for
/// the output of fields.
struct HistoryField
{
  std::string name; ///< as in the files: "plastic_strain"
  bool is_tensor = false;
};

/// How a rock deforms, stores fluid and lets it through. Made for one region of the rock, whose
/// constants hold in its linear range.
///
/// A law is a pure function of state and committed history, so it may be evaluated any number of
/// times; the core keeps the history and decides what becomes of it.
class RockLaw
{
public:
  virtual ~RockLaw() = default;

  /// Whether the rock is linear whatever happens; nothing else is asked of such a law.
  virtual bool is_linear() const
  {
    return false;
  }

  /// Whether stress_by_strain is symmetric, and stress_by_pressure minus content_by_strain.
  virtual bool is_symmetric() const
  {
    return true;
  }

  /// Whether the permeability hangs on the state, so that evaluate() gives it.
  virtual bool changes_permeability() const
  {
    return false;
  }

  /// The history of a point; it begins with zeros.
  virtual std::vector<HistoryField> history() const
  {
    return {};
  }

  unsigned int n_history() const
  {
    unsigned int n = 0;
    for (const HistoryField &field : history())
      n += field.is_tensor ? 6 : 1;
    return n;
  }

  /// For all points of a cell.
  virtual void evaluate(dealii::ArrayView<const RockState> states,
                        dealii::ArrayView<RockResponse> responses) const = 0;

  /// How much of the linear range a state without history has used up, for people: below 1,
  /// evaluate() gives what linear rock gives.
  virtual double used(const RockState &) const = 0;

  /// By how much stress plus pressure, as a tensor in the Frobenius norm, may change before that is
  /// no longer so [Pa]; zero or less where it is not so. A cautious answer costs time only.
  virtual double margin(const RockState &) const = 0;

  /// The strength in words, for the scene audit: "c = 3 MPa, phi = 27 deg".
  virtual std::string describe() const
  {
    return {};
  }
};
} // namespace stockwork
