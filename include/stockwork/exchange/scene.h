#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include "stockwork/rock/law.h"
#include "stockwork/rock/rock.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stockwork
{
/// Where a flat, round crack is.
template <int dim>
struct Disc
{
  dealii::Point<dim> centre;
  dealii::Tensor<1, dim> normal; ///< unit
  double radius;                 ///< [m]
};

/// What keeps the faces of a crack apart and lets fluid pass between them though they are pressed
/// together.
struct Proppant
{
  double aperture = 0.;     ///< the least that it leaves, where it is greatest [m]
  double conductivity = 0.; ///< permeability times thickness [m^3]
};

/// A crack, notch or natural fracture that is there at the start. Geometry belongs to the case and
/// is the same for every fracture model.
template <int dim>
struct InitialCrack
{
  enum class Kind
  {
    open,     ///< no strength left
    cohesive, ///< the rock's own strength, not yet damaged
    propped   ///< no strength left, and proppant between the faces
  };

  std::vector<dealii::Point<dim>> points; ///< corners of a polyline in 2-D
  Kind kind = Kind::open;
  std::string entry;             ///< of the deck, for messages: "Cracks/Open"
  std::string text;              ///< what the deck says there
  std::optional<Disc<dim>> disc; ///< in 3-D
  Proppant proppant = {};        ///< of a propped crack

  /// Of a point from the crack [m].
  double distance(const dealii::Point<dim> &point) const
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i + 1 < points.size(); ++i)
    {
      const auto along = points[i + 1] - points[i];
      const double length = along.norm_square();
      const double t = length > 0. ? std::clamp((point - points[i]) * along / length, 0., 1.) : 0.;
      nearest = std::min(nearest, point.distance(points[i] + t * along));
    }
    if (disc)
    {
      const double above = (point - disc->centre) * disc->normal;
      const double aside = (point - disc->centre - above * disc->normal).norm();
      nearest = std::min(nearest, std::hypot(above, std::max(0., aside - disc->radius)));
    }
    return nearest;
  }

  /// Length along it, or diameter [m].
  double size() const
  {
    double length = disc ? 2. * disc->radius : 0.;
    for (unsigned int i = 0; i + 1 < points.size(); ++i)
      length += points[i].distance(points[i + 1]);
    return length;
  }
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

  /// Fluid leaks from fractures by Carter's law, out of the model.
  bool leaks_by_carter = false;

  /// The greatest rate of the first well, of both wings [m^2/s; m^3/s in 3-D]; zero: none is given.
  double injection_rate = 0.;

  /// Total in-situ stress in three dimensions also where the case has two; what is not given across
  /// the plane is that of plane strain in this rock.
  std::function<dealii::SymmetricTensor<2, 3>(const dealii::Point<dim> &, const RockProperties &)>
    in_situ_tensor = {};

  /// Whether the deck moves a side of the domain. Empty: it moves none.
  std::function<bool(dealii::types::boundary_id side)> moves_side = {};

  /// The law of the rock in a region, to be put inside another.
  std::function<const RockLaw &(dealii::types::material_id)> rock_law = {};
};
} // namespace stockwork
