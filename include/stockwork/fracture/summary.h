#pragma once

#include <deal.II/base/point.h>

#include <optional>
#include <string>
#include <vector>

namespace stockwork
{
/// What every model reports after a step; the same columns for all, so that comparing models is a
/// join. Apertures, pressures and volumes come from the segments, not from here.
struct FractureSummary
{
  double length = 0.;        ///< of all cracks, from mouth to physical tip [m] ([m^2] in 3-D)
  double broken_length = 0.; ///< part without any strength left
  /// Of the elastic crack without a process zone that is the same from afar, where the model knows
  /// it; else taken to be half-way between the two [m].
  std::optional<double> equivalent_length;
  double dissipated_energy = 0.; ///< by the fracture process since the start [J/m]
  double stored_energy = 0.;     ///< in the fracture process zone, recovered on unloading [J/m]
  unsigned int n_tips = 0;
  std::optional<double> stress_intensity_I; ///< of the first crack's last tip [Pa m^1/2]
  std::optional<double> stress_intensity_II;
  std::optional<double> energy_release_rate; ///< of both, at that tip [J/m^2]
  /// A sentence on what the model costs where elements would do without a fracture; for the report
  /// at the end of a run. Empty: nothing worth a sentence.
  std::string cost;
};

/// Takes named fields for the output files.
template <int dim>
class FieldSink
{
public:
  virtual ~FieldSink() = default;

  /// One value per active cell, by active cell index; unowned entries are ignored.
  virtual void add_cell_field(const std::string &name, const std::vector<double> &values) = 0;

  /// A polyline piece of the fracture (2-D) with values at it.
  virtual void add_fracture_piece(const std::vector<dealii::Point<dim>> &corners,
                                  const std::vector<std::pair<std::string, double>> &values) = 0;

  /// A bond between two points with values at it, in a file of its own.
  virtual void add_bond(const dealii::Point<dim> &,
                        const dealii::Point<dim> &,
                        const std::vector<std::pair<std::string, double>> &)
  {
  }
};
} // namespace stockwork
