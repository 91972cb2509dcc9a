#pragma once

#include <deal.II/base/parameter_handler.h>

#include "stockwork/exchange/scene.h"

#include "biot/boundary_conditions.h"
#include "flow/network.h"

#include <string>
#include <vector>

namespace stockwork
{
/// An entry that the deck leaves empty, and what the scene's own numbers make of it.
struct ChosenValue
{
  std::string entry; ///< with its sections
  std::string value; ///< with its unit
  std::string why;
};

/// How large the pressures and apertures of a fracture are that sets out from the first crack of a
/// scene. No limit or tolerance of the program has a dimension of its own: it is a share of these,
/// so that a block of 20 cm and a field of 2 km run alike. They do not depend on the end time,
/// which a restart may change.
struct Scales
{
  double length; ///< half length or radius of the first crack; without one, size of the domain [m]
  double pressure;    ///< net of what closes the crack [Pa]
  std::string source; ///< where the pressure comes from
  double aperture;    ///< of the crack under this pressure, 4 p a/E' [m]
};

/// Compression by the in-situ stress across a crack, or across the middle one of its pieces [Pa].
double closing_stress(const Scene<2> &scene, const InitialCrack<2> &crack);
double closing_stress(const Scene<3> &scene, const InitialCrack<3> &crack);

/// Its shear along the same piece [Pa]. A crack that has any will turn.
double shear_stress(const Scene<2> &scene, const InitialCrack<2> &crack);
double shear_stress(const Scene<3> &scene, const InitialCrack<3> &crack);

/// The pressure is the greatest of what toughness and viscosity take at this length (the scaling of
/// Adachi & Detournay 2002, and for a radial fracture of Savitski & Detournay 2002), of given
/// pressures over the closing stress, and of the loads on the boundary.
template <int dim>
Scales scales_of(const Scene<dim> &scene,
                 const Network<dim> &network,
                 const BoundaryConditions<dim> &boundary_conditions);

/// Fill the entries of the flow in fractures that the deck leaves empty.
std::vector<ChosenValue> fill_in_flow(dealii::ParameterHandler &prm, const Scales &scales);
} // namespace stockwork
