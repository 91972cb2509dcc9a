#pragma once

#include "stockwork/exchange/collectives.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"
#include "stockwork/mesh/mesh_view.h"

#include "biot/boundary_conditions.h"

#include <vector>

namespace stockwork
{
/// A pressure on one side of the body that is such that two other sides move apart as given: the
/// indirect displacement control of de Borst (1987). A body that snaps back under any given force
/// or displacement of its loaded side can be followed so, if the opening grows all the time.
///
/// The unknown y is a length, the force E y on the side (per metre of thickness in 2-D; in 3-D
/// times the root of its area), and its equation a force as those of cracks are:
///
///   E ((mean of u.d on `to`) - (mean of u.d on `from`) - g(t)) = 0,
///
/// d the direction from the middle of `from` to that of `to`. Rows and columns are not transposes
/// of one another.
template <int dim>
class OpeningControl
{
public:
  /// Collective.
  OpeningControl(const ControlledLoad<dim> &load,
                 double young_modulus,
                 const MeshView<dim> &mesh_view,
                 const Collectives &collectives);

  static constexpr std::uint64_t key = ~std::uint64_t(0); ///< of its unknown

  /// @param index of its unknown
  void
  assemble(const StepContext &context, const State &state, unsigned int index, Sink &sink) const;

  /// What pushes the loaded side, compression positive [N].
  double force(const Unknowns &unknowns, const unsigned int index) const
  {
    return force_of_unknown * unknowns.extra[index];
  }

  /// How far the loaded side has gone in, in the mean [m]. Collective.
  double displacement(const Unknowns &unknowns, const Collectives &collectives) const;

private:
  /// Of a face: derivatives of what is applied to it and of the opening by its unknowns.
  struct Face
  {
    std::vector<dealii::types::global_dof_index> dofs;
    std::vector<double> inward;  ///< mean inward displacement of the loaded side
    std::vector<double> opening; ///< mean opening
    double share_of_opening = 0.;
  };

  const ControlledLoad<dim> &load;
  double modulus, force_of_unknown;
  std::vector<Face> faces;
};
} // namespace stockwork
