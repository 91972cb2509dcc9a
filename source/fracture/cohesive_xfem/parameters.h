#pragma once

#include <deal.II/base/parameter_handler.h>

namespace stockwork::cohesive_xfem
{
/// Settings of subsection Fracture/cohesive_xfem. Strength and energies belong to the rock.
struct Parameters
{
  double shear_strength_ratio; ///< S/T
  double mode_exponent;        ///< of Benzeggagh and Kenane
  double elastic_share;        ///< opening at the peak over critical opening
  double growth_threshold;     ///< stress at which a cell is cut, in strengths
  bool as_published;           ///< pore pressure is added to that stress, not the fluid's
  double averaging_radius;     ///< of the tip stress, in cells
  double direction_radius;     ///< of the stress that a tip turns to, in cells
  unsigned int most_advances;  ///< cells per tip and step
  double cell_size;            ///< wanted along the crack [m]; zero: as the mesh is
  unsigned int rings_ahead;    ///< cells of that size ahead of a tip
  double friction;             ///< coefficient, of faces that touch
  double cohesive_energy;      ///< of cohesive cracks of the deck, over that of the rock
  bool straight;
  bool growth;

  static void declare(dealii::ParameterHandler &prm);

  static Parameters parse(dealii::ParameterHandler &prm);
};
} // namespace stockwork::cohesive_xfem
