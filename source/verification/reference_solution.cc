#include "verification/reference_solution.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "verification/reference/problems.h"

#include <deal.II/base/utilities.h>

namespace stockwork
{
using namespace dealii;

namespace
{
/// A reference solution: its name in the deck and who makes it, by dimension.
struct Entry
{
  const char *name;
  reference::Made<2> (*make_2d)(const ParameterHandler &, const ReferenceInput<2> &);
  reference::Made<3> (*make_3d)(const ParameterHandler &, const ReferenceInput<3> &);
  bool knows_anisotropic_rock = false;
  bool knows_wells_in_rock = false;
};

const Entry table[] = {
  {"column", reference::make_column<2>, reference::make_column<3>},
  {"mandel", reference::make_mandel, nullptr, true},
  {"cryer", nullptr, reference::make_cryer<3>},
  {"deleeuw", reference::make_cryer<2>, nullptr},
  {"borehole", reference::make_cavity<2>, nullptr},
  {"cavity", nullptr, reference::make_cavity<3>},
  {"footing", reference::make_footing, nullptr},
  {"bar wave", reference::make_bar_wave<2>, reference::make_bar_wave<3>},
  {"porous wave", reference::make_porous_wave<2>, reference::make_porous_wave<3>},
  {"line crack", reference::make_line_crack, nullptr, true},
  {"penny crack", nullptr, reference::make_penny_crack},
  {"crack in box", reference::make_crack_in_box, nullptr},
  {"parallel cracks", reference::make_parallel_cracks, nullptr},
  {"double cantilever", reference::make_double_cantilever, nullptr},
  {"three point bending", reference::make_three_point_bending, nullptr},
  {"kgd", reference::make_kgd, nullptr},
  {"kgd vertex", reference::make_kgd_vertex, nullptr},
  {"kgd carter", reference::make_kgd_carter, nullptr},
  {"kgd box", reference::make_kgd_box, nullptr},
  {"radial", nullptr, reference::make_radial},
  {"pkn", nullptr, reference::make_pkn},
  {"line source", reference::make_sources<2>, nullptr, false, true},
  {"point source", nullptr, reference::make_sources<3>, false, true},
};


template <int dim>
auto maker(const Entry &entry)
{
  if constexpr (dim == 2)
    return entry.make_2d;
  else
    return entry.make_3d;
}
} // namespace


void declare_reference_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Verification");
  std::string names = "none";
  for (const Entry &entry : table)
    names += std::string("|") + entry.name;
  prm.declare_entry(
    "Reference", "none", Patterns::Selection(names),
    "Analytical solution that the run is compared with. It takes its constants from "
    "the rest of the deck. column: along the last axis, loaded at the top. mandel: "
    "quarter x, y >= 0, moved at the top. cryer: octant of a ball, deleeuw: quarter of a "
    "disc, loaded and drained at the surface. borehole: quarter ring, cavity: octant of a shell, "
    "in Mohr-Coulomb rock, loaded at the wall. footing: limit load of a strip on rock that yields. "
    "bar wave, porous wave: along the last "
    "axis, loaded at the top. line crack, penny crack (3-D): in an infinite body; crack in "
    "box: with rollers all round. double cantilever: beams along x joined by a cohesive "
    "layer, a crack from the left, ends moved apart by equal displacements. three point bending: "
    "greatest load of a brittle beam "
    "along x with a notch from below, four times as long as deep, held at its ends. kgd: at the "
    "deck's own "
    "toughness and viscosity; "
    "kgd vertex: without viscosity; kgd carter: with Carter leak-off; kgd box: with "
    "the rollers of the domain all round. radial (3-D): circular, at the deck's own toughness and "
    "viscosity. pkn (3-D): between layers that hold it; both with the deck's Carter leak-off. "
    "line source, point source (3-D): wells into the rock, far from its sides.");
  prm.declare_entry("Wrong factors", "", Patterns::List(Patterns::Double()),
                    "For tests that a comparison can fail: the reference times each of these "
                    "numbers, separated by commas, is compared with as well (summary.json, "
                    "errors_against).");
  prm.declare_entry("Start from reference", "false", Patterns::Bool(),
                    "Take displacement and pore pressure at the start time from the reference.");
  prm.declare_entry("Compare", "every step", Patterns::Selection("every step|at the end"),
                    "When errors are formed. Their mean over time needs every step.");
  prm.declare_entry("Load", "", Quantity(dimension::force_per_length, Range::finite(), ""),
                    "mandel: force on the half width of the plate. Required there.");
  prm.declare_entry("Footing width", "", Quantity(dimension::length, Range::positive(), ""),
                    "footing: that part of the strip's width which is in the model. Required "
                    "there.");
  prm.declare_entry("Fracture height", "", Quantity(dimension::length, Range::positive(), ""),
                    "pkn: height between the layers that hold the fracture. Required there.");
  prm.declare_entry("Elastic share", "0.01", Quantity(dimension::number, Range::open(0., 1.)),
                    "double cantilever: opening of the layer at its strength over the opening "
                    "without traction; the fracture model's.");
  prm.declare_entry("Rise time", "", Quantity(dimension::time, Range::positive(), ""),
                    "bar wave, porous wave: duration of the rise of the load. Required there.");
  prm.leave_subsection();
}


bool starts_from_reference(ParameterHandler &prm)
{
  prm.enter_subsection("Verification");
  const bool result = prm.get_bool("Start from reference");
  prm.leave_subsection();
  return result;
}


template <int dim>
std::unique_ptr<ReferenceSolution<dim>> make_reference(ParameterHandler &prm,
                                                       const ReferenceInput<dim> &input)
{
  std::unique_ptr<ReferenceSolution<dim>> solution;
  prm.enter_subsection("Verification");
  const std::string name = prm.get("Reference");
  for (const Entry &entry : table)
    if (name == entry.name)
    {
      if (maker<dim>(entry) == nullptr)
        throw EntryError("Verification/Reference", name,
                         "a solution in " + std::to_string(dim) + "-D");
      const RockProperties &rock = input.rock.main();
      if (!entry.knows_anisotropic_rock && (rock.stiffness || !rock.has_isotropic_permeability()))
        throw EntryError(
          "Verification/Reference", name,
          "'none', 'mandel' or 'line crack' where stiffness or permeability is another across "
          "the layers: the solution is of isotropic rock");
      if (!entry.knows_wells_in_rock && !input.sources.empty())
        throw EntryError(
          "Verification/Reference", name,
          "'none', 'line source' or 'point source' where a well opens into the rock");
      try
      {
        solution = maker<dim>(entry)(prm, input);
      }
      catch (const EntryError &)
      {
        throw;
      }
      catch (const InputError &error)
      {
        throw EntryError("Verification/Reference", name,
                         std::string("a solution that fits the case. ") + error.what());
      }
      solution->wrong_factors =
        Utilities::string_to_double(Utilities::split_string_list(prm.get("Wrong factors")));
      solution->compares_every_step = prm.get("Compare") == "every step";
    }
  const bool starts = prm.get_bool("Start from reference");
  prm.leave_subsection();
  if (starts && (!solution || !solution->field()))
    throw EntryError("Verification/Start from reference", "true",
                     "false, because reference '" + name + "' gives no fields");
  return solution;
}


template std::unique_ptr<ReferenceSolution<2>> make_reference<2>(ParameterHandler &,
                                                                 const ReferenceInput<2> &);
template std::unique_ptr<ReferenceSolution<3>> make_reference<3>(ParameterHandler &,
                                                                 const ReferenceInput<3> &);
} // namespace stockwork
