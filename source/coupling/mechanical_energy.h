#pragma once

#include "stockwork/exchange/collectives.h"
#include "stockwork/exchange/state.h"
#include "stockwork/fracture/model.h"
#include "stockwork/mesh/mesh_view.h"
#include "stockwork/rock/rock.h"

#include "biot/boundary_conditions.h"
#include "biot/nonlinear_rock.h"

namespace stockwork
{
/// Work and energy of dry rock that prescribed displacements load, or tractions and inertia,
/// per metre of thickness in 2-D. With the energies of the fracture model: work = stored + kinetic
/// + dissipated, at every time; Newmark's scheme with beta = 1/4 and gamma = 1/2 keeps that
/// balance.
struct MechanicalEnergy
{
  double stored =
    0.; ///< strain energy of the rock, nodes left out whose stiffness is a model's [J]
  double kinetic = 0.; ///< [J]

  /// Of reactions and tractions since the last accepted step, by the trapezoidal rule [J].
  double work = 0.;

  /// Work per displacement if all prescribed displacements grew in proportion, over the greatest of
  /// them [N]: the force of a testing machine.
  double load = 0.;
};

/// @param nonlinear rock that may leave its linear range, or null
///
/// Collective.
template <int dim>
MechanicalEnergy mechanical_energy(const MeshView<dim> &mesh_view,
                                   const Rock &rock,
                                   const NonlinearRock<dim> *nonlinear,
                                   const Loads<dim> &loads,
                                   const FractureModel<dim> &model,
                                   const StepContext &context,
                                   const State &state,
                                   const Collectives &collectives);
} // namespace stockwork
