#pragma once

#include "stockwork/biot/rock.h"
#include "stockwork/fracture/cell_role.h"
#include "stockwork/fracture/collectives.h"
#include "stockwork/fracture/state.h"
#include "stockwork/mesh/discretization.h"

#include <functional>

namespace stockwork
{
/// Work and energy of elastic rock that prescribed displacements load, per metre of thickness in
/// 2-D. With the energies of the fracture model: work = stored + dissipated, at every time.
struct MechanicalEnergy
{
  double stored = 0.; ///< strain energy of the rock [J]
  double work = 0.; ///< of the reactions since the last accepted step, by the trapezoidal rule [J]

  /// Work per displacement if all prescribed displacements grew in proportion, over the greatest of
  /// them [N]: the force of a testing machine.
  double load = 0.;
};

/// Collective.
template <int dim>
MechanicalEnergy mechanical_energy(
  const Discretization<dim> &discretization,
  const Rock &rock,
  const std::function<CellRole<dim>(const typename dealii::DoFHandler<dim>::active_cell_iterator &)>
    &role,
  const State &state,
  const Collectives &collectives);
} // namespace stockwork
