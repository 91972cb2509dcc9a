#include "fracture/cohesive_xfem/parameters.h"

#include "stockwork/base/quantity.h"

#include "discontinuity/contact.h"

namespace stockwork::cohesive_xfem
{
void Parameters::declare(dealii::ParameterHandler &prm)
{
  const auto number = [&](const char *name, const char *value, const Range &range, const char *text)
  { prm.declare_entry(name, value, Quantity(dimension::number, range), text); };
  number("Shear strength ratio", "1", Range::positive(),
         "Shear strength over the rock's tensile strength.");
  number("Mixed-mode exponent", "2", Range::positive(),
         "Exponent of the fracture energy between opening and shear (Benzeggagh and Kenane).");
  // Of kgd/toughness, coarse, to 4 s no step was rejected down to 1e-5, four with 1e-6, ever more
  // below; a run with 1e-9 may end in a failed step.
  number("Elastic share", "0.01", Range{1e-6, 1., false, true},
         "Opening at which the strength is reached, as a share of the opening at which no traction "
         "is left. Results change by less than 1 % below 0.01, and are dearer the smaller it is.");
  number(
    "Growth threshold", "0.7", Range{0., 1., true, false},
    "A cell ahead of a tip is cut when the averaged stress reaches this share of the strength. "
    "The cut cell still holds until its own traction reaches the strength, so an early cut "
    "costs nothing, and a late one holds the crack back.");
  prm.declare_entry(
    "Growth criterion", "fluid pressure",
    dealii::Patterns::Selection("fluid pressure|as published"),
    "What is added to the averaged total stress before it is compared with the strength. "
    "fluid pressure: that of the fluid at the tip, which acts on the faces to come. as published: "
    "the rock's pore pressure (Wang 2016), so that the effective stress counts; fractures then "
    "need many times the right pressure.");
  number("Averaging radius", "1.5", Range::closed(1., 6.),
         "Radius, in cells, over which the stress ahead of a tip is averaged; never more than half "
         "the cohesive length if that is resolved.");
  number("Direction radius", "5", Range::closed(1., 20.),
         "Radius, in cells, of the stress that a tip turns to. The cells next to the tip alone "
         "would draw the crack to the nearest edge of the mesh.");
  prm.declare_entry("Most advances per step", "4", dealii::Patterns::Integer(1),
                    "Cells by which a tip may advance within a time step.");
  prm.declare_entry(
    "Cell size", "0", Quantity(dimension::length, Range::non_negative()),
    "Wanted size of the cells along the crack and ahead of its tips [m]; zero: that "
    "of the given mesh.");
  prm.declare_entry("Rings ahead", "8", dealii::Patterns::Integer(1),
                    "Cells of this size kept ready around a tip.");
  declare_friction(prm);
  prm.declare_entry(
    "Cohesive energy", "1", Quantity(dimension::number, Range::closed(1e-3, 1.)),
    "What cohesive cracks take to open, over the critical energy release rate of the rock: cement. "
    "Its strengths are the root of that, over the rock's, as with bonds.");
  prm.declare_entry("Straight growth", "false", dealii::Patterns::Bool(),
                    "Cracks go straight on when the stress across their direction is enough, "
                    "whatever the stress along it: for a weak seam, or the joint of two beams.");
  prm.declare_entry("Growth", "true", dealii::Patterns::Bool(), "Whether cracks may grow.");
}

Parameters Parameters::parse(dealii::ParameterHandler &prm)
{
  Parameters p;
  p.shear_strength_ratio = get_quantity(prm, "Shear strength ratio", dimension::number);
  p.mode_exponent = get_quantity(prm, "Mixed-mode exponent", dimension::number);
  p.elastic_share = get_quantity(prm, "Elastic share", dimension::number);
  p.growth_threshold = get_quantity(prm, "Growth threshold", dimension::number);
  p.as_published = prm.get("Growth criterion") == "as published";
  p.averaging_radius = get_quantity(prm, "Averaging radius", dimension::number);
  p.direction_radius = get_quantity(prm, "Direction radius", dimension::number);
  p.most_advances = prm.get_integer("Most advances per step");
  p.cell_size = get_quantity(prm, "Cell size", dimension::length);
  p.rings_ahead = prm.get_integer("Rings ahead");
  p.friction = get_quantity(prm, "Friction coefficient", dimension::number);
  p.cohesive_energy = get_quantity(prm, "Cohesive energy", dimension::number);
  p.straight = prm.get_bool("Straight growth");
  p.growth = prm.get_bool("Growth");
  return p;
}
} // namespace stockwork::cohesive_xfem
