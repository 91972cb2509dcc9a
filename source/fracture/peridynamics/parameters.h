#pragma once

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/parameter_handler.h>

#include "fracture/peridynamics/stencil.h"
#include "stockwork/exchange/scene.h"

#include <map>
#include <string>
#include <vector>

namespace stockwork::peridynamics
{
/// Settings of subsection Fracture/peridynamics. Moduli and toughness belong to the rock.
template <int dim>
struct Parameters
{
  unsigned int horizon;                        ///< m, in lattice spacings
  bool state_based;                            ///< bonds are, and Poisson's ratio is free
  VolumeRule volumes;                          ///< of the cells that the horizon cuts
  double margin;                               ///< of the zone around the initial cracks, in cells
  std::vector<dealii::BoundingBox<dim>> boxes; ///< more of the zone
  std::vector<dealii::BoundingBox<dim>> unbreakable; ///< where no bond breaks
  double cell_size;         ///< wanted in the zone [m]; zero: as the mesh is
  unsigned int zone_growth; ///< in cells, at once; zero: the zone stays
  double cell_growth;       ///< size over distance outside the zone
  double stretch_factor;    ///< of the critical stretch; NaN: the lattice's own
  double softening;         ///< last over first stretch of a bond that softens; 1: brittle
  bool surface_correction;
  bool effective_stretch; ///< bonds break by effective stress
  bool in_bonds;          ///< the pressure is part of the law of bonds
  bool as_published;      ///< the pressure's load on bonds, as printed
  bool tensor_fluid;      ///< the elements of the pore pressure carry the fluid of the fracture
  double minimum_aperture = 0.; ///< 'Fracture flow/Minimum aperture' [m], where they do
  double friction = 0.;         ///< coefficient, of faces that touch
  double cohesive_energy = 1.;  ///< of bonds across cohesive cracks, over that of the rock
  bool explicit_steps;          ///< 'Time/Scheme = explicit'
  bool has_inertia;             ///< 'Time/Inertia = on'
  bool free_boundaries;         ///< the zone may reach to the boundary of the domain, which is dry
  bool growth;
  bool tracked;                               ///< bonds soften across the ways of cracks only
  std::map<std::string, std::string> reasons; ///< why what is 'auto' is what it is, by entry
  enum class Bonds
  {
    none,
    broken,
    all
  } written; ///< to the output files
  unsigned int bonds_per_pass;
  unsigned int most_advances; ///< cells per tip and step

  static void declare(dealii::ParameterHandler &prm);

  /// Called inside the subsection. What is 'auto' there becomes what it comes to.
  /// @throws InputError
  static Parameters parse(dealii::ParameterHandler &prm, const Scene<dim> &scene);
};
} // namespace stockwork::peridynamics
