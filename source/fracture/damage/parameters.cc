#include "fracture/damage/parameters.h"

#include "discontinuity/contact.h"
#include "flow/permeability_tensor.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork::damage
{
void Parameters::declare(dealii::ParameterHandler &prm)
{
  const auto number = [&](const char *name, const char *value, const Range &range, const char *text)
  { prm.declare_entry(name, value, Quantity(dimension::number, range), text); };
  // In kgd/toughness, coarse, seven steps were rejected by 4 s with 1e-3, and the run failed with
  // 1e-4.
  number("Elastic share", "0.01", Range{1e-3, 1., false, true},
         "Opening at which the strength is reached, as a share of the opening at which no traction "
         "is left. Steps are dearer the smaller it is.");
  number("Growth threshold", "0.7", Range{0., 1., true, false},
         "A cell ahead of the crack is given one when the averaged stress plus the fluid's "
         "pressure reaches this share of the strength. It still holds until its own traction "
         "reaches the strength.");
  number("Averaging radius", "1.5", Range::closed(1., 6.),
         "Radius, in cells, over which that stress is averaged.");
  number("Direction radius", "5", Range::closed(1., 20.),
         "Radius, in cells, of the stress across which a crack runs. That of one cell would draw "
         "it to the lines of the mesh.");
  prm.declare_entry("Most advances per step", "4", dealii::Patterns::Integer(1),
                    "Cells by which a crack may advance within a time step.");
  number("Front share per step", "0", Range::closed(0., 1.),
         "Share of the cells at the front, of those at half of their threshold or beyond, that may "
         "crack in a step without making the next one shorter. 0: none. A front of many cells, in "
         "three dimensions, has some that crack in nearly every step; 0.5 takes fewer steps, at a "
         "cost in accuracy.");
  prm.declare_entry(
    "Cell size", "0", Quantity(dimension::length, Range::non_negative()),
    "Wanted size of the cells along the crack and ahead of it [m]; zero: that of the given mesh.");
  prm.declare_entry("Rings ahead", "6", dealii::Patterns::Integer(1),
                    "Cells of this size kept ready around the crack's front.");
  prm.declare_entry("Jump", "auto", dealii::Patterns::Selection("auto|constant|linear"),
                    "How the opening varies in a cell. A constant one resists where the opening "
                    "changes along the crack, and fails where the rock beside it bends: a beam, a "
                    "shallow crack. auto: linear in two, constant in three dimensions, where it "
                    "costs two more unknowns in each cell.");
  declare_friction(prm);
  permeability_tensor::declare_parameters(prm);
  number("Least integrity", "0.01", Range{0., 1., true, false},
         "Of 1 - D, by which 'Coupling/Scheme = as published' divides the rock's storage.");
  prm.declare_entry("Straight growth", "false", dealii::Patterns::Bool(),
                    "Cracks go straight on when the stress across their plane is enough, whatever "
                    "the stress along it: for a weak seam, or the joint of two beams.");
  prm.declare_entry("Growth", "true", dealii::Patterns::Bool(), "Whether cracks may grow.");
}


Parameters Parameters::parse(dealii::ParameterHandler &prm, const unsigned int dim)
{
  Parameters p;
  p.elastic_share = get_quantity(prm, "Elastic share", dimension::number);
  p.growth_threshold = get_quantity(prm, "Growth threshold", dimension::number);
  p.averaging_radius = get_quantity(prm, "Averaging radius", dimension::number);
  p.direction_radius = get_quantity(prm, "Direction radius", dimension::number);
  p.most_advances = prm.get_integer("Most advances per step");
  p.front_share = get_quantity(prm, "Front share per step", dimension::number);
  p.cell_size = get_quantity(prm, "Cell size", dimension::length);
  p.least_integrity = get_quantity(prm, "Least integrity", dimension::number);
  p.rings_ahead = prm.get_integer("Rings ahead");
  p.friction = get_quantity(prm, "Friction coefficient", dimension::number);
  p.straight = prm.get_bool("Straight growth");
  p.growth = prm.get_bool("Growth");
  p.linear_jumps = prm.get("Jump") == "linear" || (prm.get("Jump") == "auto" && dim == 2);
  if (p.front_share > 0. && !p.growth)
    throw EntryError("Fracture/damage/Front share per step", prm.get("Front share per step"),
                     "0 with 'Fracture/damage/Growth = false': no front advances");
  p.tensor_fluid = permeability_tensor::is_chosen(prm);
  prm.leave_subsection();
  prm.leave_subsection();
  prm.enter_subsection("Coupling");
  const bool divides_storage =
    prm.get("Scheme") == "as published" && prm.get("Storage") == "1/(1-D)";
  prm.leave_subsection();
  prm.enter_subsection("Fracture");
  prm.enter_subsection("damage");
  if (p.least_integrity != 0.01 && !divides_storage)
    throw EntryError(
      "Fracture/damage/Least integrity", prm.get("Least integrity"),
      "0.01 without 'Coupling/Scheme = as published' and 'Storage = 1/(1-D)': it has "
      "no meaning there");
  if (p.tensor_fluid)
  {
    prm.leave_subsection();
    prm.leave_subsection();
    p.minimum_aperture = permeability_tensor::parse_fracture_flow(prm, "Fracture/damage/Fluid");
    prm.enter_subsection("Fracture");
    prm.enter_subsection("damage");
  }
  return p;
}
} // namespace stockwork::damage
