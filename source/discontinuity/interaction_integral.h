#pragma once

#include "discontinuity/discontinuity.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/state.h"

namespace stockwork
{
/// Stress intensity factors of opening and shear [Pa m^1/2].
struct StressIntensity
{
  double opening = 0.;
  double shear = 0.;
  double energy_release_rate = 0.; ///< of both together [J/m^2]
};

/// Stress intensity at the end of a traction-free or fluid-loaded crack in elastic rock, by the
/// interaction integral (Yau, Wang and Corten 1980) over a disc of the given radius around the tip,
///
///   I = int (sigma_ij u^a_i,1 + sigma^a_ij u_i,1 - sigma_ik eps^a_ik delta_1j) q,j dA
///       + int q g . [[u^a]],1 ds,   K = sqrt(8/pi) I,
///
/// with the field u^a around a tip whose faces move apart by sqrt(r), a weight q that falls from
/// one to zero between a quarter of the radius and the radius, and the traction g = -(p_f +
/// sigma_0) n of the faces. The crack shall be nearly straight inside the disc, and the rock one
/// and the same: that at the tip. In anisotropic rock u^a is that rock's, and the energy release
/// rate is 1/2 K.M K (PlaneElasticity). Errors come from the tip: below 2 % where the crack is 50
/// cells long or longer. Collective.
template <int dim>
StressIntensity stress_intensity(const unsigned int crack,
                                 const CrackEnd end,
                                 const double radius,
                                 const MeshView<dim> &mesh_view,
                                 const Discontinuity<dim> &discontinuity,
                                 const Scene<dim> &scene,
                                 const State &state,
                                 const Collectives &collectives);
} // namespace stockwork
