#pragma once

#include "stockwork/exchange/segment.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"

namespace stockwork::peridynamics
{
/// The faces of a segment with the pressure in the law of bonds. It has two unknowns of the model's
/// own: the aperture w, which is its opening; and what presses the faces apart, the net pressure
/// p_f - alpha dp_m, as a length y = gamma h (p_f - alpha dp_m), with the stretch gamma of free
/// rock under unit pressure and the spacing h. With the area A and the volume V that the bonds
/// across the fracture say,
///
///   A/(gamma h) (y - gamma h (p_f - alpha dp_m)) = 0,   1/(gamma h) (A w - V) = 0,
///
/// the forces of y on the ends of bonds are the transpose of what they add to V, and those of w on
/// the pores, which lose alpha A w of what the strain of the elements makes room for, are that of
/// what the pores take from y. The network adds the fluid's pressure, which loads the opening.
struct Faces
{
  unsigned int aperture = 0, push = 0; ///< numbers of w and y among the extra unknowns
  double area = 0.;                    ///< [m^2]
  double gamma = 0.;                   ///< [1/Pa]
  double spacing = 0.;                 ///< [m]

  /// V/gamma by the displacement of ends of broken bonds, and so their force by y/h [N].
  std::vector<dealii::types::global_dof_index> ends;
  std::vector<double> of_ends;
  std::vector<double> in_situ;             ///< force of the stress in situ on them [N]
  std::vector<unsigned int> bonds;         ///< that soften
  std::vector<double> of_bonds;            ///< V/gamma by their elongation without force [N]
  double by_stretch = 0.;                  ///< by y/h [N m]
  double constant = 0.;                    ///< [N m]
  const LinearFunctional *pores = nullptr; ///< pressure at the segment; null: there are none
  double biot_coefficient = 0.;

  void assemble(const State &state, Sink &sink) const;
};
} // namespace stockwork::peridynamics
