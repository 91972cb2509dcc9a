#include "fracture/peridynamics/parameters.h"

#include "base/parameter_tree.h"
#include "discontinuity/contact.h"
#include "exchange/flat_parts.h"
#include "flow/permeability_tensor.h"
#include "fracture/peridynamics/state_based.h"
#include "fracture/peridynamics/wording.h"
#include "mesh/box_list.h"
#include "mesh/interpret_entry.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stockwork::peridynamics
{
namespace Patterns = dealii::Patterns;

namespace
{
constexpr char default_zone_growth[] = "8", default_bonds_per_pass[] = "20";
constexpr double least_stretch_factor = 0.1, greatest_stretch_factor = 10.,
                 greatest_softening = 100.;
} // namespace

template <int dim>
void Parameters<dim>::declare(dealii::ParameterHandler &prm)
{
  prm.declare_entry("Horizon", "3", Patterns::Integer(2, 6),
                    "Radius of the neighbourhood that a node has bonds with, in cells.");
  prm.declare_entry("Bond law", "bond-based", Patterns::Selection("bond-based|state-based"),
                    "bond-based: springs, so that Poisson's ratio is 1/4 (1/3 in plane stress). "
                    "state-based: ordinary, linear; the force in a bond depends on the change of "
                    "volume at both its ends, too, which frees Poisson's ratio, couples nodes two "
                    "horizons apart and makes the solution dearer.");
  prm.declare_entry(
    "Bond volumes", "auto", Patterns::Selection("auto|exact|isotropic|full|ramp"),
    "How much of a cell counts as within the horizon. auto: isotropic with 'Tracking = path', and "
    "with explicit steps, or inertia and a given pressure by 'Closure = in bonds'; else exact. "
    "exact: its intersection with "
    "the disc (ball). isotropic: corrected, so that the lattice has no preferred "
    "direction in the small. full: all of it if its centre is inside. ramp: a "
    "share that falls linearly over the last cell; the least accurate.");
  prm.declare_entry(
    "Margin", "", Patterns::Anything(),
    "Cells around the initial cracks that are peridynamic, at least the horizon and "
    "one; empty: the horizon and two.");
  prm.declare_entry("Zone", "", Patterns::Anything(),
                    "Boxes that are peridynamic besides, where cracks shall grow: "
                    "'(0, -2 m) to (30 m, 2 m); …' [m].");
  prm.declare_entry("Unbreakable", "", Patterns::Anything(),
                    "Boxes none of whose nodes has a bond that breaks, such as beside grips, loads "
                    "and impacts, where bonds are stretched more than inside: "
                    "'(0, -8 mm) to (32 mm, -7 mm); …' [m].");
  prm.declare_entry(
    "Zone growth", default_zone_growth, Patterns::Integer(0),
    "Cells by which the zone is enlarged ahead of a fracture when less than the "
    "margin of it is left there; 0: the zone stays as it is, and a fracture that "
    "fluid drives to its rim ends the run. It grows only where 'Cell size' is given, "
    "which the new cells are "
    "refined to.");
  prm.declare_entry("Cell size", "0", Quantity(dimension::length, Range::non_negative()),
                    "Wanted size of the cells in the zone and for a horizon around it, which must "
                    "be squares (cubes) of one size [m]; zero: that of the given mesh.");
  prm.declare_entry("Cell growth", "0.3", Patterns::Double(0.),
                    "Where 'Cell size' is given, cells outside the zone may be larger than those "
                    "inside by this share of their distance from it. The elements there are "
                    "bilinear: coarse ones make the rock too stiff.");
  prm.declare_entry(
    "Critical stretch factor", "", Patterns::Anything(),
    "Of the stretch at which bonds break, over the one that follows from the rock's "
    "energy release rate when sums are integrals. Empty: the one with which a crack "
    "on the lattice grows at that rate: 0.986 for bonds that soften; for brittle ones 0.823 with a "
    "horizon of 3, 0.851 with 4, at a Poisson's ratio of 1/4, and more at a greater one.");
  prm.declare_entry("Softening", "4", Patterns::Double(1., greatest_softening),
                    "The stretch at which a bond is broken over the one at which it begins to "
                    "soften, with the same energy. 1: bonds are brittle, as in the paper, and a "
                    "fracture jumps from cell to cell. 3 or more: it grows smoothly, with a tip "
                    "that is spread over more cells. Nothing between.");
  prm.declare_entry(
    "Critical stretch", "reduced by fluid", Patterns::Selection("reduced by fluid|of dry rock"),
    "reduced by fluid: by the work that the fluid does on the opening which a cell has when it is "
    "wetted, of which the rock has nothing. of dry rock: not reduced; pressurised fractures are "
    "tougher then, by a share that falls with the root of the cells' size. Not with 'Closure = in "
    "bonds', where the pressure is part of what breaks a bond.");
  prm.declare_alias("Critical stretch", "Stretch", true);
  prm.declare_entry(
    "Surface correction", "auto", Patterns::Selection("auto|true|false"),
    "Nodes beside a crack have lost bonds that are no part of the crack's opening, "
    "which makes its faces too soft. With the correction, the bonds that are left "
    "are stiffer, in proportion; beside a fracture that grows, once what is missing is 3 % of what "
    "has been made up for. With 'Closure = in bonds' only those beside the "
    "initial cracks: faces of a fracture that grows are those of a crack without load in "
    "rock under a uniform stress, which do not feel what bonds are left. auto: true, but false "
    "with 'Bond law = state-based', that closure and a Poisson's ratio of up to 0.15: there "
    "initial cracks would open by 5 to 14 % too little.");
  prm.declare_entry(
    "Closure", "auto", Patterns::Selection("auto|conserving|in bonds|as published"),
    "What the pressure in a crack does to the rock. auto: in bonds where a path is tracked, and "
    "with inertia where a pressure is given, with a horizon of 3 or more; "
    "else conserving. conserving: it loads the faces, "
    "and does the work of their opening. in bonds: it is part of the law of bonds, as if rock "
    "under a uniform stress had cracks without load, less the uniform stress; then toughness does "
    "not depend on the direction, nor on the in-situ stress along the crack. as published: it "
    "lengthens unbroken bonds "
    "(Sun et al. 2021, Eqs. 7 and 28), which leaves the faces without a load and "
    "opens a crack to a tenth; for comparison. In porous rock with 'Fluid = permeability tensor' "
    "only, and with the balance of fluid that is printed: fracture cells conduct by w^2/12 over "
    "all "
    "of their height, store 1/K_f, and their change of volume does not count.");
  declare_friction(prm);
  prm.declare_entry(
    "Cohesive energy", "1", Patterns::Double(1e-3, 1.),
    "What cohesive cracks take to open, over the critical energy release rate of the "
    "rock: cement. Its strength is the root of that, over the rock's. Less than 1 with "
    "'Tracking = path'.");
  permeability_tensor::declare_parameters(prm);
  prm.declare_entry("Growth", "true", Patterns::Bool(), "Whether bonds may break.");
  prm.declare_entry(
    "Tracking", "auto", Patterns::Selection("auto|none|path"),
    "auto: path where fluid drives the fracture; where its pressure is given if a crack is oblique "
    "to the mesh, or the in-situ stress along it is not that across it, and with 'Closure = in "
    "bonds'; and only if it can be: in two dimensions, around "
    "cracks that the deck gives and fluid presses open, with bonds that soften, fluid in the "
    "segments, neither another closure nor inertia, Poisson's ratios not negative; "
    "else none. none: any bond softens that is stretched too far; where nothing guides it, the "
    "way of a fracture is the mesh's. path: only those that cross a path, which "
    "runs ahead of each tip, at right angles to the greatest principal stress, "
    "averaged there over some horizons. Where bonds two horizons from all paths are stretched "
    "too far another path begins, dry until a fracture joins it. The stress at which one does "
    "follows from the energy release rate, the stiffness and the horizon, as the root of one over "
    "the horizon, so it depends on the size of the cells; the log says it. None begins near "
    "the rim of the zone (the run ends, and says so), nor in 'Unbreakable'. In two "
    "dimensions, with 'Closure = in bonds'; not where fractures fork. Brittle bonds keep to it as "
    "well, at a net pressure that is 4 to 13 % low.");
  prm.declare_entry("Bonds per pass", default_bonds_per_pass, Patterns::Integer(1),
                    "Brittle bonds that break, the most stretched first, before the step is solved "
                    "again: with many, bonds may break that would hold once the others have. Bonds "
                    "that soften all follow their stretch at once.");
  prm.declare_entry("Most advances per step", "20", Patterns::Integer(1),
                    "Cells by which a tip may advance within a time step, else it is taken again "
                    "with half its length. Not more than twice: in viscous fluid a tip may jump, "
                    "however short the step is.");
  prm.declare_entry("Write bonds", "none", Patterns::Selection("none|broken|all"),
                    "Bonds in the output files (bonds.pvd), as lines with their state and their "
                    "stretch over the critical one. There are dozens to a cell.");
}


namespace
{
/// An entry of subsection Time.
std::string entry_of_time(dealii::ParameterHandler &prm, const std::string &entry)
{
  prm.leave_subsection();
  prm.leave_subsection();
  const std::string value = value_of(prm, {"Time"}, entry);
  prm.enter_subsection("Fracture");
  prm.enter_subsection("peridynamics");
  return value;
}


/// Why a fracture would not stay in the plane of its crack, or not feel the stress along it, if
/// bonds were left to themselves; empty: it lies along the mesh, in isotropic stress.
template <int dim>
std::string why_guided(const Scene<dim> &scene)
{
  constexpr double same = 1e-6;
  if constexpr (dim == 2)
    for (const InitialCrack<dim> &crack : scene.cracks)
      for (const auto &[middle, normal] : flat_parts(crack))
      {
        const dealii::SymmetricTensor<2, dim> stress = scene.in_situ_stress(middle);
        if (std::min(std::abs(normal[0]), std::abs(normal[1])) > same)
          return "the crack '" + crack.text +
                 "' is oblique to the mesh, into whose axes it would turn";
        if (dealii::deviator(stress).norm() > same * stress.norm())
          return "the in-situ stress along the crack '" + crack.text + "' is not that across it";
      }
  return "";
}


/// lambda/G, at a Poisson's ratio of 0.15, up to which state-based bonds with the pressure in their
/// law are closer without the surface correction (doc/laboratory/bonds_any_rock.md).
constexpr double hardly_soft = 0.4286;

/// See softens_by_equal_strain(), of all rock.
template <int dim>
bool may_be_in_bonds(const Rock &rock)
{
  for (unsigned int region = 0; region <= Rock::max_regions; ++region)
    if (!softens_by_equal_strain<dim>(rock(region)))
      return false;
  return true;
}


/// Whether the way of a fracture is tracked by default, and why.
template <int dim>
std::pair<bool, std::string> is_tracked_by_default(dealii::ParameterHandler &prm,
                                                   const Parameters<dim> &p,
                                                   const Scene<dim> &scene)
{
  if (dim == 3)
    return {false, "paths are those of two dimensions"};
  if (scene.cracks.empty())
    return {false, "the deck gives no crack"};
  if (scene.crack_pressure == 0.)
    return {false, "the cracks are dry"};
  if (p.softening == 1.)
    return {false, "bonds are brittle"};
  if (p.tensor_fluid)
    return {false, "the fluid is in the pores' elements"};
  if (!p.effective_stretch)
    return {false, "the critical stretch is that of dry rock"};
  if (!may_be_in_bonds<dim>(scene.rock))
    return {false, "a Poisson's ratio is negative"};
  if (entry_of_time(prm, "Inertia") == "on")
    return {false, "with inertia fractures may fork"};
  if (const std::string closure = prm.get("Closure"); closure != "auto" && closure != "in bonds")
    return {false, "the closure is another"};
  if (const std::string why = why_guided(scene); !why.empty())
    return {true, why};
  if (prm.get("Closure") == "in bonds")
    return {true, "the pressure is in the bonds"};
  if (std::isnan(scene.crack_pressure))
    return {true, "fluid drives the fracture, and on a path stress along it does not count"};
  return {false, "cracks whose pressure is given lie along the mesh, in isotropic stress"};
}


void refuse_quadratic_elements(dealii::ParameterHandler &prm)
{
  prm.enter_subsection("Discretisation");
  if (const std::string pair = prm.get("Elements"); pair.rfind("Q2", 0) == 0)
    throw EntryError("Discretisation/Elements", pair,
                     "Q1-Q1 stabilised or Q1-Q1, because the nodes of the fracture model are the "
                     "vertices of cells");
  prm.leave_subsection();
}
} // namespace


template <int dim>
Parameters<dim> Parameters<dim>::parse(dealii::ParameterHandler &prm, const Scene<dim> &scene)
{
  const auto number = [&](const char *entry, const double otherwise)
  {
    return interpret_entry(
      prm, "Fracture/peridynamics", entry, "a number, or nothing (an empty entry)",
      [&](const std::string &text)
      { return text.empty() ? otherwise : parse_finite_quantity(text, dimension::number); });
  };
  const auto bad = [&](const char *entry, const std::string &allowed)
  { return EntryError(std::string("Fracture/peridynamics/") + entry, prm.get(entry), allowed); };

  Parameters p;
  p.horizon = prm.get_integer("Horizon");
  p.state_based = prm.get("Bond law") == "state-based";
  p.margin = number("Margin", p.horizon + 2.);
  if (!(p.margin >= p.horizon + 1.))
    throw bad("Margin", "at least " + std::to_string(p.horizon + 1) +
                          " cells: every bond that a crack cuts joins two peridynamic nodes");
  const auto boxes = [&](const std::string &entry)
  {
    std::vector<dealii::BoundingBox<dim>> result;
    interpret_entry(
      prm, "Fracture/peridynamics", entry,
      std::string("a list of boxes, '") +
        (dim == 2 ? "(0, -2 m) to (30 m, 2 m)" : "(0, 0, -2 m) to (30 m, 30 m, 2 m)") + "'",
      [&](const std::string &text)
      {
        for (const auto &labelled : parse_boxes<dim>(text))
          result.push_back(labelled.box);
      });
    return result;
  };
  p.boxes = boxes("Zone");
  p.unbreakable = boxes("Unbreakable");
  p.cell_size = get_quantity(prm, "Cell size", dimension::length);
  p.zone_growth = p.cell_size > 0. ? prm.get_integer("Zone growth") : 0;
  p.cell_growth = prm.get_double("Cell growth");
  p.stretch_factor = number("Critical stretch factor", std::numeric_limits<double>::quiet_NaN());
  if (p.stretch_factor < least_stretch_factor || p.stretch_factor > greatest_stretch_factor)
    throw bad("Critical stretch factor",
              "a number from 0.1 to 10, or nothing (an empty entry): fractures take its square "
              "times the energy release rate");
  p.softening = prm.get_double("Softening");
  if (p.softening > 1. && p.softening < 3.)
    throw bad("Softening", "1, or a number from 3 to 100: between, fractures jump and soften");
  p.effective_stretch = prm.get("Critical stretch") == "reduced by fluid";
  p.tensor_fluid = permeability_tensor::is_chosen(prm);
  if (prm.get("Tracking") == "auto")
  {
    const auto [tracked, why] = is_tracked_by_default(prm, p, scene);
    prm.set("Tracking", tracked ? "path" : "none");
    p.reasons["Tracking"] = why;
  }
  p.tracked = prm.get("Tracking") == "path";
  p.explicit_steps = entry_of_time(prm, "Scheme") == "explicit";
  const bool explicit_fluid = p.explicit_steps && scene.crack_pressure != 0.;
  if (p.explicit_steps && p.tracked)
    throw bad("Tracking", "none with 'Time/Scheme = explicit'");
  if (p.tracked && scene.cracks.empty())
    throw bad("Tracking",
              "none without a crack in 'Cracks' (path, if a short one is given, far away)");
  p.has_inertia = entry_of_time(prm, "Inertia") == "on";
  // By implicit steps as by explicit ones.
  const bool moves_by_given_pressure =
    p.has_inertia && !p.tracked && !std::isnan(scene.crack_pressure) && scene.crack_pressure != 0.;
  if (prm.get("Closure") == "auto")
  {
    const bool given = explicit_fluid || (moves_by_given_pressure && !p.tensor_fluid &&
                                          p.horizon >= 3 && may_be_in_bonds<dim>(scene.rock));
    prm.set("Closure", p.tracked || given ? "in bonds" : "conserving");
    p.reasons["Closure"] = p.tracked ? "for a path"
                           : given   ? "where a pressure is given in cracks that may fork"
                                     : "where no path is tracked";
  }
  p.as_published = prm.get("Closure") == "as published";
  p.in_bonds = prm.get("Closure") == "in bonds";
  if (p.explicit_steps && p.in_bonds != explicit_fluid)
    throw bad("Closure", explicit_fluid ? "auto or in bonds with 'Time/Scheme = explicit'"
                                        : "auto or conserving where explicit steps move dry rock");
  if (p.in_bonds && !p.effective_stretch)
    throw bad("Critical stretch", "reduced by fluid with 'Closure = in bonds', where the pressure "
                                  "is part of what breaks a bond");
  if (prm.get("Surface correction") == "auto")
  {
    const RockProperties &rock = scene.rock.main();
    const bool needed = !(p.in_bonds && p.state_based && !rock.stiffness &&
                          rock.lame_lambda() <= hardly_soft * rock.shear_modulus());
    prm.set("Surface correction", needed ? "true" : "false");
    p.reasons["Surface correction"] =
      needed ? "faces would be too soft"
             : "at this Poisson's ratio cracks would open too little with it";
  }
  p.surface_correction = prm.get("Surface correction") == "true";
  if (p.explicit_steps)
    p.in_bonds = false; // their pressure is ExplicitBonds' affair, and has no unknowns
  if (prm.get("Bond volumes") == "auto")
  {
    const bool may_fork = p.explicit_steps || (p.in_bonds && moves_by_given_pressure);
    prm.set("Bond volumes", p.tracked || may_fork ? "isotropic" : "exact");
    p.reasons["Bond volumes"] = p.tracked  ? "a path may have any direction"
                                : may_fork ? "cracks and waves may have any direction"
                                           : "where no path is tracked";
  }
  const std::string volumes = prm.get("Bond volumes");
  p.volumes = volumes == "isotropic" ? VolumeRule::isotropic
              : volumes == "full"    ? VolumeRule::full
              : volumes == "ramp"    ? VolumeRule::ramp
                                     : VolumeRule::exact;
  if (p.tracked && (dim != 2 || !p.in_bonds))
    throw bad("Tracking", dim != 2 ? "none in three dimensions" : "none, or 'Closure = in bonds'");
  if (p.in_bonds && p.tensor_fluid)
    throw bad("Closure", "conserving with 'Fluid = permeability tensor'");
  // A step that does not converge where the fracture enters a cell is then tried with bonds that
  // soften by less.
  if (p.in_bonds && !p.tracked && p.horizon < 3)
    throw bad("Horizon", dim == 2
                           ? "3 and more with 'Closure = in bonds', or 2 with 'Tracking = path'"
                           : "3 and more with 'Closure = in bonds'");
  p.friction = get_quantity(prm, "Friction coefficient", dimension::number);
  if (p.friction > 0. && (dim != 2 || !p.in_bonds))
    throw bad("Friction coefficient", dim != 2           ? "0 in three dimensions"
                                      : p.explicit_steps ? "0 with 'Time/Scheme = explicit'"
                                                         : "0, or 'Closure = in bonds'");
  p.cohesive_energy = prm.get_double("Cohesive energy");
  if (p.cohesive_energy < 1. && !p.tracked)
    throw bad("Cohesive energy", "1, or 'Tracking = path'");
  if (p.cohesive_energy < 1. &&
      std::none_of(scene.cracks.begin(), scene.cracks.end(),
                   [](const InitialCrack<dim> &crack)
                   { return crack.kind == InitialCrack<dim>::Kind::cohesive; }))
    throw bad("Cohesive energy", "1 without a crack in 'Cracks/Cohesive'");
  p.free_boundaries = !p.state_based && (scene.crack_pressure == 0. || p.explicit_steps);
  p.growth = prm.get_bool("Growth");
  p.bonds_per_pass = prm.get_integer("Bonds per pass");
  if (p.softening > 1. && prm.get("Bonds per pass") != default_bonds_per_pass)
    throw bad("Bonds per pass", std::string(default_bonds_per_pass) +
                                  " where bonds soften, each by itself; other numbers with "
                                  "'Softening = 1'");
  if (p.cell_size == 0. && prm.get("Zone growth") != default_zone_growth &&
      prm.get("Zone growth") != "0")
    throw bad("Zone growth", std::string(default_zone_growth) +
                               ", or 0, without a 'Cell size' that new cells could be refined to");
  p.most_advances = prm.get_integer("Most advances per step");
  const std::string written = prm.get("Write bonds");
  p.written = written == "all" ? Bonds::all : written == "broken" ? Bonds::broken : Bonds::none;
  prm.leave_subsection();
  prm.leave_subsection();
  refuse_quadratic_elements(prm);
  if (p.tensor_fluid)
    p.minimum_aperture =
      permeability_tensor::parse_fracture_flow(prm, "Fracture/peridynamics/Fluid");
  prm.enter_subsection("Fracture");
  prm.enter_subsection("peridynamics");
  return p;
}

template struct Parameters<2>;
template struct Parameters<3>;
} // namespace stockwork::peridynamics
