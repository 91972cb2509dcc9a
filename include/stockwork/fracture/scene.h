#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include "stockwork/biot/rock.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace stockwork
{
/// A crack, notch or natural fracture that is there at the start. Geometry belongs to the case and
/// is the same for every fracture model.
template <int dim>
struct InitialCrack
{
  enum class Kind
  {
    open,    ///< no strength left
    cohesive ///< the rock's own strength, not yet damaged
  };

  std::vector<dealii::Point<dim>> points; ///< polyline in 2-D
  Kind kind = Kind::open;
  std::string entry; ///< of the deck, for messages: "Cracks/Open"
  std::string text;  ///< what the deck says there
};

/// What a fracture model may know of the case. Everything outlives the model.
template <int dim>
struct Scene
{
  const Rock &rock;
  std::vector<InitialCrack<dim>> cracks;
  bool has_pore_pressure;

  /// Total in-situ stress at a point, tension positive [Pa].
  std::function<dealii::SymmetricTensor<2, dim>(const dealii::Point<dim> &)> in_situ_stress;
  /// In-situ pore pressure at a point [Pa].
  std::function<double(const dealii::Point<dim> &)> in_situ_pore_pressure;

  /// Diameter of the domain [m], for tolerances.
  double domain_size;

  /// Fluid pressure in all cracks, where the case gives it [Pa]; zero in a dry case. NaN: the fluid
  /// network solves for it.
  double crack_pressure = std::numeric_limits<double>::quiet_NaN();
};
} // namespace stockwork
