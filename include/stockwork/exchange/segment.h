#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <boost/serialization/vector.hpp>

#include "stockwork/exchange/state.h"

#include <cstdint>
#include <vector>

namespace stockwork
{
/// A linear functional of the unknowns, w = sum_j coefficient_j x_j + constant.
struct LinearFunctional
{
  std::vector<dealii::types::global_dof_index> bulk;
  std::vector<double> bulk_coefficients;
  std::vector<unsigned int> extra;
  std::vector<double> extra_coefficients;
  double constant = 0.;
};

/// On the rank that knows the functional, which has its unknowns as well.
inline double value(const LinearFunctional &functional, const Unknowns &unknowns)
{
  double sum = functional.constant;
  for (unsigned int i = 0; i < functional.bulk.size(); ++i)
    sum += functional.bulk_coefficients[i] * unknowns.bulk(functional.bulk[i]);
  for (unsigned int i = 0; i < functional.extra.size(); ++i)
    sum += functional.extra_coefficients[i] * unknowns.extra[functional.extra[i]];
  return sum;
}

/// A piece of a fracture, as the fluid sees it: a place, an area, a normal, neighbours, and the
/// linear functional of the unknowns that opens it. The same functional gives the volume A w and,
/// transposed, the load A p_f on the rock, so work and volume are conserved by construction. A
/// model whose fluid loads the rock in another way adds the difference itself
/// (FractureModel::assemble(), State::segment_unknown).
///
/// A segment wider than a cell may reach over several ranks: each of them then lists it, the same
/// but for `opening` and `pore_pressure`, of which it has the part of its own cells: parts add up.
/// (It may have neither an `opening_by_pressure` nor a pore pressure among the unknowns then.)
template <int dim>
struct Segment
{
  struct Neighbour
  {
    std::uint64_t key; ///< the neighbour's key
    double distance;   ///< from this segment's centre to the shared edge [m]
    /// Length of the shared edge, as this segment sees it; the flow takes the mean of both [m]. 1
    /// in 2-D.
    double width;

    template <class Archive>
    void serialize(Archive &ar, const unsigned int)
    {
      ar &key &distance &width;
    }
  };

  std::uint64_t key = 0; ///< the same on every rank, on every mesh, after a restart
  dealii::Point<dim> centre;
  dealii::Tensor<1, dim> normal; ///< unit, from the minus to the plus side
  double area = 0.;              ///< [m^2]; [m] per unit thickness in 2-D
  std::vector<Neighbour> neighbours;
  bool at_tip = false; ///< the fracture ends at the far side of this segment, within rock

  /// Mean aperture [m]. Known on the rank that owns the host cell only.
  LinearFunctional opening;

  /// Where a segment that appears within a step has room that was part of another one's opening at
  /// the end of the last step, as a process zone's is part of the last segment behind it: the key
  /// of that one, which hands over what `room_before` says of the states before; 0: of none.
  std::uint64_t part_of = 0;

  /// Mean aperture of that room [m]. Same rank as the opening; nothing without `part_of`.
  LinearFunctional room_before;

  /// Share of the opening that had been room in the rock's pores, with fluid in it, before there
  /// was a segment: Biot's coefficient where the opening is strain of the rock's own elements (see
  /// CellRole::fracture_normal), zero where it is a jump.
  double share_of_pores = 0.;

  /// Share of the opening that the model takes from the balance of the pores around: Biot's
  /// coefficient, where the opening is strain of the rock's own elements, too, which make room in
  /// pores of it; zero where it is none, or where they do not (CellRole::fracture_normal). The
  /// pores hold less by that than the elements say.
  double taken_from_pores = 0.;

  /// What the segment's own fluid pressure adds to the opening [m/Pa], where a crack in a cell is a
  /// spring between its faces. Same rank.
  double opening_by_pressure = 0.;

  /// Where the flow is solved with apertures that are held and the pores of damaged rock are to
  /// take up what is injected: the volume per area that they do with pressure [m/Pa]. It is no part
  /// of the opening, and nothing comes back from it. Same rank.
  double damaged_storage = 0.;

  /// Pore pressure of the rock at the segment [Pa], the mean of both faces, for leak-off. Where the
  /// rock has no pore pressure unknowns: a constant, the in-situ pore pressure. Same rank as above.
  LinearFunctional pore_pressure;

  /// Region of the rock around it.
  dealii::types::material_id region = 0;

  /// How far from the segment, along its normal, the nodes are whose pressures make up
  /// `pore_pressure`, their mean with the same weights [m]. The pore pressure has a kink at a
  /// leaking fracture; elements that are smooth there see the pressure at this distance from it.
  /// Zero: the pressure at the segment itself.
  double pore_distance = 0.;

  /// The pressure is that of `pore_pressure`, whatever flows from one to the other: the elements of
  /// the pore pressure carry the fluid of the fracture, too, and the segment has no neighbours.
  bool has_pressure_of_pores = false;

  /// Aperture from which on the faces are bare and leak in full; below, bridges of rock still hold
  /// them together [m]. The minimum aperture of the flow if that is larger. For Carter's law; into
  /// pores, only where the opening takes its room from them (`taken_from_pores`), elsewhere all of
  /// a process zone leaks in full.
  double bare_aperture = 0.;

  /// Of proppant between the faces, beside what the opening conducts: permeability times thickness
  /// [m^3]. The opening is then what is left beside the proppant.
  double propped_conductivity = 0.;
};
} // namespace stockwork
