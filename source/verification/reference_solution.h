#pragma once

#include <deal.II/base/function.h>
#include <deal.II/base/parameter_handler.h>

#include "stockwork/exchange/scene.h"
#include "stockwork/rock/rock.h"

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stockwork
{
class RockLaw;

/// The analytical solution of a case, evaluated from the parsed deck.
template <int dim>
class ReferenceSolution
{
public:
  virtual ~ReferenceSolution() = default;

  /// For people: "Mandel (1953)".
  virtual std::string name() const = 0;

  /// Displacement and, if the rock has one, pore pressure over in situ in the last component, as a
  /// function of place and of its time; null where only scalars are known.
  virtual std::shared_ptr<dealii::Function<dim>> field() const
  {
    return {};
  }

  /// Where the course of the pore pressure is of interest (the Mandel-Cryer effect).
  virtual std::optional<dealii::Point<dim>> observation_point() const
  {
    return {};
  }

  /// Whether it holds where a law of the rock lets it yield.
  virtual bool is_of_yielding_rock() const
  {
    return false;
  }

  /// Where the displacement shall be observed (columns displacement_x, …).
  virtual std::optional<dealii::Point<dim>> place_of_displacement() const
  {
    return {};
  }

  /// Add what follows from the statistics of a step and this solution speaks of.
  virtual void add_derived(std::map<std::string, double> &) const
  {
  }

  /// The time after which there is nothing to compare with [s].
  virtual double valid_until() const
  {
    return std::numeric_limits<double>::infinity();
  }

  /// Whether there is something to compare with at a time.
  bool reaches(const double time) const
  {
    return time <= valid_until() * (1. + 1e-9);
  }

  /// Scalars at a time, by the names of the columns of the statistics.
  virtual std::map<std::string, double> values(double /*time*/) const
  {
    return {};
  }

  /// Factors that make wrong solutions of this one, which errors are formed against as well: so a
  /// test shows that its comparison can fail.
  std::vector<double> wrong_factors;

  /// Whether errors are formed after every step, and not at the end of the run only.
  bool compares_every_step = true;
};

/// A well that opens into the rock.
template <int dim>
struct ReferenceSource
{
  unsigned int number; ///< of the well, from 1
  std::vector<dealii::Point<dim>> points;
  double fraction;                              ///< "Fraction in model"
  double borehole_radius;                       ///< 0: not given [m]
  double minimum_pressure;                      ///< in the borehole; -infinity: no bound [Pa]
  std::vector<std::pair<double, double>> rates; ///< time and the rate from it on [s, m^3/s]
};

/// What a reference solution may take from the deck besides its own subsection.
template <int dim>
struct ReferenceInput
{
  const Rock &rock;
  dealii::Point<dim> lower, upper; ///< corners of the domain [m]
  bool has_pore_pressure = false;
  double start_time = 0., end_time = 0.; ///< [s]

  /// Corners of the cracks that are there at the start.
  std::vector<std::vector<dealii::Point<dim>>> cracks = {};

  /// The flat, round ones among them.
  std::vector<Disc<dim>> discs = {};

  /// Rate of the first well, of the whole fracture (both wings) [m^2/s], [m^3/s] in 3-D.
  double injection_rate = 0.;

  bool rate_is_constant = true; ///< from the start time on
  unsigned int n_wells = 1;
  double fraction_in_model = 1.; ///< of the first well

  /// Where the first well opens into fractures.
  std::vector<dealii::Point<dim>> perforations = {};

  /// Wells into the rock whose rate is given.
  std::vector<ReferenceSource<dim>> sources = {};

  bool leaks = false;               ///< by any law
  bool layered = false;             ///< the mesh has regions
  bool has_stress_gradient = false; ///< in situ

  /// Fluid pressure in the cracks net of the in-situ stress across the first; NaN where it is not
  /// given [Pa].
  double crack_pressure = std::numeric_limits<double>::quiet_NaN();

  /// In-situ shear stress along the first crack, t . sigma . n with n to the left of t [Pa].
  double crack_shear = 0.;

  /// C_L of one face [m/s^0.5]; zero without such leak-off.
  double carter_coefficient = 0.;

  /// Normal traction that the deck prescribes on a side, tension positive, at a time [Pa]; throws
  /// InputError for a side without one. Empty: not known.
  std::function<double(const std::string &side, double time)> normal_traction = {};

  /// The greatest displacement that the deck prescribes at a time [m]. Empty: not known.
  std::function<double(double time)> maximum_displacement = {};

  const RockLaw *law = nullptr;                      ///< of the rock at large
  dealii::SymmetricTensor<2, 3> in_situ_stress = {}; ///< at the centre of the domain, total [Pa]
  double in_situ_pressure = 0.;                      ///< there [Pa]
  double hole_radius = 0.;                           ///< of a ring; 0: no hole [m]

  /// Whether the deck makes a side a roller or plane of symmetry. Empty: not known.
  std::function<bool(const std::string &side)> is_roller = {};
};

/// Declares subsection Verification with the entries of all reference solutions.
void declare_reference_parameters(dealii::ParameterHandler &prm);

/// Whether the run starts from the reference solution's fields and not from zero.
bool starts_from_reference(dealii::ParameterHandler &prm);

/// The solution that the deck names, or null for `none`.
template <int dim>
std::unique_ptr<ReferenceSolution<dim>> make_reference(dealii::ParameterHandler &prm,
                                                       const ReferenceInput<dim> &input);
} // namespace stockwork
