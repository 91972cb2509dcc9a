#pragma once

#include <deal.II/base/parameter_handler.h>

namespace stockwork::damage
{
/// Settings of subsection Fracture/damage. Strength and energy belong to the rock.
struct Parameters
{
  double elastic_share;       ///< opening at the peak over critical opening
  double growth_threshold;    ///< stress at which a cell is cracked, in strengths
  double averaging_radius;    ///< of the stress ahead, in cells
  double direction_radius;    ///< of the stress that the crack turns to, in cells
  unsigned int most_advances; ///< cells by which the front may advance in a step
  double front_share;         ///< of cells at the front that may advance unheeded in a step
  double cell_size;           ///< wanted along the crack [m]; zero: as the mesh is
  unsigned int rings_ahead;   ///< cells of that size ahead of the front
  double friction;            ///< Coulomb's coefficient, of faces that touch
  double least_integrity;     ///< of 1 - D, in storage as published
  bool straight;              ///< cracks keep their normal
  bool growth;
  bool linear_jumps; ///< else constant in a cell
  bool tensor_fluid; ///< the elements of the pore pressure carry the fluid of the fracture
  double minimum_aperture = 0.; ///< 'Fracture flow/Minimum aperture' [m], where they do

  static void declare(dealii::ParameterHandler &prm);

  static Parameters parse(dealii::ParameterHandler &prm, unsigned int dim);
};
} // namespace stockwork::damage
