#include "idle_entries.h"

#include "base/parameter_tree.h"
#include "stockwork/base/quantity.h"

#include <algorithm>
#include <regex>

namespace stockwork
{
using dealii::ParameterHandler;

namespace
{
/// Entries that only act together with something else.
struct IdleGroup
{
  bool is_idle;
  std::string why;
  std::vector<std::string> entries;
};


/// The entry of the whole rock that one of a region stands in for; any other as it is.
std::string everywhere(const std::string &path)
{
  static const std::regex region("^Rock/Region \\d+/");
  return std::regex_replace(path, region, "Rock/");
}


template <int dim>
std::vector<IdleGroup> groups_of(const std::vector<DeclaredEntry> &declared,
                                 const Case<dim> &the_case)
{
  const auto given = [&](const std::string &path)
  {
    for (const DeclaredEntry &entry : declared)
      if (entry.path() == path)
        return entry.value;
    return std::string();
  };
  const auto is_default = [&](const std::string &path)
  {
    return std::any_of(declared.begin(), declared.end(),
                       [&](const DeclaredEntry &entry)
                       { return entry.path() == path && entry.value == entry.default_value; });
  };
  const bool somewhere_random = std::any_of(
    declared.begin(), declared.end(),
    [](const DeclaredEntry &entry)
    { return !entry.value.empty() && everywhere(entry.path()) == "Rock/Random field/Properties"; });
  const bool has_pores = the_case.elements.has_pore_pressure;
  const bool has_inertia = the_case.scheme.kind() == TimeScheme::Kind::newmark;
  const bool a_crack_holds = std::any_of(
    the_case.scene.cracks.begin(), the_case.scene.cracks.end(),
    [](const InitialCrack<dim> &crack) { return crack.kind == InitialCrack<dim>::Kind::cohesive; });
  using Solver = LinearSolverParameters::Type;
  const Solver solver = the_case.linear_solver.type;
  const bool makes_factors = solver == Solver::direct || solver == Solver::bordered ||
                             (solver == Solver::automatic && dim == 2);
  const bool is_split =
    given("Coupling/Scheme") != "monolithic"; // its passes are an iteration, too
  std::vector<IdleGroup> groups = {
    {!has_pores && the_case.network.leak_off_law() == LeakOff::none,
     "no pore pressure is solved for ('Rock/Bulk model = elastic', or nothing that moves fluid "
     "through the pores)",
     {"Rock/Permeability", "Rock/Biot coefficient", "Rock/Biot modulus", "Rock/Porosity",
      "Rock/Solid bulk modulus"}},
    {has_pores && !given("Rock/Biot modulus").empty() && !given("Rock/Biot coefficient").empty(),
     "'Rock/Biot modulus' and 'Rock/Biot coefficient' are given, which it would make up",
     {"Rock/Solid bulk modulus"}},
    {given("Mesh/Shape") != "gmsh file",
     "'Mesh/Shape' is not 'gmsh file'",
     {"Mesh/Gmsh/File", "Mesh/Gmsh/Scale"}},
    {dim == 2, "the case has two dimensions", {"Mesh/Box/Z spacing"}},
    {!has_inertia,
     "there is no inertia",
     {"Time/Newmark beta", "Time/Newmark gamma", "Time/Theta", "Time/Waves resolved above"}},
    {has_inertia && (the_case.scheme.is_explicit() || !the_case.model->requirements().may_grow ||
                     !the_case.model->requirements().has_fracture),
     "no fracture grows in steps of Newmark's scheme",
     {"Time/Waves resolved above"}},
    // The weight that a gradient of the vertical stress should be is looked up in the density.
    {!has_inertia && is_default("In situ/Stress gradient"),
     "there is no inertia, and only estimates look at it",
     {"Rock/Density"}},
    {!the_case.scene.cracks.empty() && !the_case.model->requirements().may_grow && !a_crack_holds,
     "no crack grows, and none holds together",
     {"Rock/Tensile strength"}},
    {has_inertia && !has_pores, "no pore pressure is solved for", {"Time/Theta"}},
    {the_case.scheme.is_explicit(),
     "'Time/Scheme' is 'explicit'",
     {"Time/Newmark beta", "Time/Minimum step", "Nonlinear solver/Tolerance",
      "Nonlinear solver/Maximum iterations", "Linear solver/Type", "Linear solver/Tolerance",
      "Fracture/peridynamics/Bonds per pass", "Fracture/peridynamics/Most advances per step",
      "Fracture/peridynamics/Critical stretch", "Fluid/Viscosity", "Fluid/Bulk modulus"}},
    {makes_factors && !is_split,
     "the linear systems of this case are solved by factors, not by iteration",
     {"Linear solver/Maximum iterations", "Linear solver/Restart"}},
    {makes_factors,
     "the linear systems of this case are solved by factors, whatever their size",
     {"Linear solver/Direct below"}},
    {!somewhere_random,
     "no property is random ('Rock/Random field/Properties')",
     {"Rock/Random field/Weibull modulus", "Rock/Random field/Lattice spacing",
      "Rock/Random field/Correlation length", "Rock/Random field/Seed",
      "Rock/Random field/Independent properties"}},
    {!is_split,
     "rock and fluid are solved together ('Coupling/Scheme = monolithic')",
     {"Coupling/Stabilisation factor", "Coupling/Maximum passes", "Coupling/Acceleration",
      "Coupling/Force"}}};
  const std::string model = given("Fracture/Model");
  IdleGroup of_others{true, "'Fracture/Model' is '" + model + "'", {}};
  for (const DeclaredEntry &entry : declared)
    if (entry.section.rfind("Fracture/", 0) == 0 && entry.section != "Fracture/" + model)
      of_others.entries.push_back(entry.path());
  groups.push_back(of_others);
  const bool goes_straight = given("Fracture/" + model + "/Straight growth") == "true";
  const auto of_model = [&](std::vector<std::string> names)
  {
    for (std::string &name : names)
      name.insert(0, "Fracture/" + model + "/");
    return names;
  };
  if (model == "damage" || model == "cohesive_xfem")
  {
    groups.push_back({!the_case.model->requirements().may_grow, "no crack grows",
                      of_model({"Growth threshold", "Averaging radius", "Direction radius",
                                "Most advances per step", "Straight growth"})});
    groups.push_back({the_case.model->requirements().may_grow && goes_straight,
                      "cracks go straight on ('Straight growth = true')",
                      of_model({"Direction radius"})});
  }
  const std::string reference = given("Verification/Reference");
  groups.push_back({reference == "none",
                    "there is no reference ('Verification/Reference')",
                    {"Verification/Wrong factors", "Verification/Compare"}});
  groups.push_back(
    {is_default("In situ/Stress gradient") && is_default("In situ/Pore pressure gradient"),
     "stress and pore pressure are the same at any depth",
     {"In situ/Datum"}});
  // Each is read by one reference.
  const std::pair<std::string, std::string> readers[] = {{"Load", "mandel"},
                                                         {"Footing width", "footing"},
                                                         {"Fracture height", "pkn"},
                                                         {"Elastic share", "double cantilever"},
                                                         {"Rise time", "wave"}};
  for (const auto &[entry, reader] : readers)
    groups.push_back({reference.find(reader) == std::string::npos,
                      "'Verification/Reference' is '" + reference + "'",
                      {"Verification/" + entry}});
  return groups;
}
} // namespace


template <int dim>
std::vector<std::string> idle_entries(ParameterHandler &prm, const Case<dim> &the_case)
{
  std::vector<std::string> warnings;
  if (prm.get("Physics") == "auto")
    return warnings;
  const std::vector<DeclaredEntry> declared = declared_entries(prm);
  for (const IdleGroup &group : groups_of(declared, the_case))
  {
    std::string found;
    for (const DeclaredEntry &entry : declared)
      if (group.is_idle && entry.value != entry.default_value &&
          std::find(group.entries.begin(), group.entries.end(), everywhere(entry.path())) !=
            group.entries.end())
        found += (found.empty() ? "'" : ", '") + entry.path() + " = " + entry.value + "'";
    if (!found.empty())
      warnings.push_back("Without effect: " + found + ", for " + group.why + ".");
  }
  return warnings;
}


template std::vector<std::string> idle_entries<2>(ParameterHandler &, const Case<2> &);
template std::vector<std::string> idle_entries<3>(ParameterHandler &, const Case<3> &);
} // namespace stockwork
