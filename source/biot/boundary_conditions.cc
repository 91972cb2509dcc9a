#include "biot/boundary_conditions.h"

#include "biot/normal_axis.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <deal.II/base/function_parser.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace stockwork
{
using namespace dealii;

namespace
{
const std::array<std::string, 3> axis_names = {{"x", "y", "z"}};

/// `left: 0; top: -1 MPa` as pairs of side and value.
std::vector<std::pair<std::string, std::string>> split_by_side(const std::string &entry,
                                                               const std::string &text)
{
  std::vector<std::pair<std::string, std::string>> result;
  for (const std::string &part : Utilities::split_string_list(text, ';'))
  {
    if (part.empty())
      continue;
    const auto colon = part.find(':');
    if (colon == std::string::npos)
      throw EntryError("Boundary conditions/" + entry, part, "'side: value', e.g. 'top: 1 MPa'");
    result.emplace_back(Utilities::trim(part.substr(0, colon)),
                        Utilities::trim(part.substr(colon + 1)));
  }
  return result;
}


template <int dim>
PrescribedValue<dim>
parse_value(const std::string &entry, const std::string &text, const Dimension &dimension)
{
  try
  {
    const double constant = parse_quantity(text, dimension);
    if (!std::isfinite(constant))
      throw EntryError("Boundary conditions/" + entry, text, "a finite value");
    return {[constant](const Point<dim> &, double) { return constant; }, true};
  }
  catch (const EntryError &)
  {
    throw;
  }
  catch (const InputError &quantity_error)
  {
    // Not a plain quantity, so a function of place and time in SI units.
    try
    {
      auto function = std::make_shared<FunctionParser<dim>>(1);
      function->initialize(FunctionParser<dim>::default_variable_names() + ",t", text,
                           {{"pi", numbers::PI}}, true);
      function->value(Point<dim>());
      return {[function](const Point<dim> &point, const double time)
              {
                function->set_time(time);
                return function->value(point);
              },
              false};
    }
    catch (...)
    {
      throw EntryError("Boundary conditions/" + entry, text,
                       std::string("a quantity (") + quantity_error.what() +
                         ") or a function of x, y, " + (dim == 3 ? "z, " : "") + "t in SI units");
    }
  }
}


/// The one component that PrescribedValue gives, as the vector-valued function deal.II wants.
template <int dim>
class ComponentFunction : public Function<dim>
{
public:
  ComponentFunction(const PrescribedValue<dim> &prescribed,
                    const double time,
                    const unsigned int n_components)
    : Function<dim>(n_components, time)
    , prescribed(prescribed)
  {
  }

  double value(const Point<dim> &point, const unsigned int) const override
  {
    return prescribed.value(point, this->get_time());
  }

private:
  const PrescribedValue<dim> &prescribed;
};
} // namespace


template <int dim>
void BoundaryConditions<dim>::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Boundary conditions");
  prm.declare_entry("Roller", "", Patterns::Anything(),
                    "Sides, separated by commas, that may slide but not move along their normal. "
                    "A plane of symmetry is the same thing.");
  prm.declare_entry("Fixed", "", Patterns::Anything(), "Sides that do not move at all.");
  for (unsigned int d = 0; d < 3; ++d)
    prm.declare_entry(
      "Displacement " + axis_names[d], "", Patterns::Anything(),
      "'side: value' pairs, separated by semicolons; the value is a quantity [m], a "
      "function of x, y, z, t in SI units, or 'reference' for the value of the "
      "reference solution.");
  prm.declare_entry("Drained", "", Patterns::Anything(),
                    "Sides where the pore pressure keeps its in-situ value.");
  prm.declare_entry("Pore pressure", "", Patterns::Anything(),
                    "'side: value' pairs; the pore pressure over its in-situ value [Pa].");
  prm.declare_entry("Flux", "", Patterns::Anything(),
                    "'side: value' pairs; fluid entering the rock per area [m/s].");
  prm.declare_entry(
    "Normal traction", "", Patterns::Anything(),
    "'side: value' pairs; tension positive, increment over the in-situ stress [Pa].");
  for (unsigned int d = 0; d < 3; ++d)
    prm.declare_entry("Traction " + axis_names[d], "", Patterns::Anything(),
                      "'side: value' pairs; component of the traction, increment over the in-situ "
                      "stress [Pa].");
  prm.declare_entry("Controlled load", "", Patterns::Anything(),
                    "A side that the pressure acts on, the same all over it, that moves two other "
                    "sides apart as 'Controlled opening' says. What snaps back under a given "
                    "displacement can be followed so.");
  prm.declare_entry("Controlled opening", "", Patterns::Anything(),
                    "'side, side: value': by how much their distance has grown, in the mean [m], a "
                    "function of t in SI units; for 'Controlled load'.");
  prm.leave_subsection();
}


template <int dim>
void BoundaryConditions<dim>::parse_parameters(
  ParameterHandler &prm, const std::function<types::boundary_id(const std::string &)> &side_of)
{
  std::string entry_in_hand; // whose sides are being looked up
  const auto side = [&](const std::string &name)
  {
    try
    {
      const types::boundary_id id = side_of(name);
      mentions.push_back({id, entry_in_hand, name});
      return id;
    }
    catch (const InputError &error)
    {
      throw EntryError("Boundary conditions/" + entry_in_hand, name,
                       std::string("a side of the domain: ") + error.what());
    }
  };
  const auto get = [&](const std::string &entry)
  {
    entry_in_hand = entry;
    return prm.get(entry);
  };
  const PrescribedValue<dim> zero = {[](const Point<dim> &, double) { return 0.; }, true};
  prm.enter_subsection("Boundary conditions");
  for (const std::string &name : Utilities::split_string_list(get("Roller")))
    dirichlet.push_back({side(name), normal_component, zero, false, "Roller", name, true});
  for (const std::string &name : Utilities::split_string_list(get("Fixed")))
    for (unsigned int d = 0; d < dim; ++d)
      dirichlet.push_back({side(name), d, zero, false, "Fixed", name, true});
  for (const std::string &name : Utilities::split_string_list(get("Drained")))
    dirichlet.push_back({side(name), dim, zero, false, "Drained", name, true});

  const auto add_dirichlet =
    [&](const std::string &entry, const unsigned int component, const Dimension &dimension)
  {
    for (const auto &[name, value] : split_by_side(entry, get(entry)))
    {
      Dirichlet condition{side(name), component, zero, false, entry, name};
      if (value == "reference")
      {
        condition.from_reference = true;
        reference_entry = "Boundary conditions/" + entry;
      }
      else
        condition.prescribed = parse_value<dim>(entry, value, dimension);
      condition.is_zero = !condition.from_reference && condition.prescribed.constant_in_time &&
                          condition.prescribed.value(Point<dim>(), 0.) == 0.;
      dirichlet.push_back(condition);
    }
  };
  for (unsigned int d = 0; d < dim; ++d)
    add_dirichlet("Displacement " + axis_names[d], d, dimension::length);
  add_dirichlet("Pore pressure", dim, dimension::pressure);
  if (dim == 2)
    for (const char *entry : {"Displacement z", "Traction z"})
      if (!prm.get(entry).empty())
        throw EntryError(std::string("Boundary conditions/") + entry, prm.get(entry),
                         "nothing in 2-D");

  for (const auto &[name, value] : split_by_side("Flux", get("Flux")))
    prescribed_loads.flux[side(name)] = parse_value<dim>("Flux", value, dimension::velocity);
  for (const auto &[name, value] : split_by_side("Normal traction", get("Normal traction")))
    prescribed_loads.normal_traction[side(name)] =
      parse_value<dim>("Normal traction", value, dimension::pressure);
  for (unsigned int d = 0; d < dim; ++d)
  {
    const std::string entry = "Traction " + axis_names[d];
    for (const auto &[name, value] : split_by_side(entry, get(entry)))
    {
      auto [position, is_new] = prescribed_loads.traction.try_emplace(side(name));
      if (is_new)
        position->second.fill(zero);
      position->second[d] = parse_value<dim>(entry, value, dimension::pressure);
    }
  }
  const std::string loaded = get("Controlled load"), opening = prm.get("Controlled opening");
  if (loaded.empty() != opening.empty())
    throw EntryError(
      "Boundary conditions/" +
        std::string(loaded.empty() ? "Controlled load" : "Controlled opening"),
      "", "a value, for the other of 'Controlled load' and 'Controlled opening' has one");
  if (!loaded.empty())
  {
    ControlledLoad<dim> load;
    load.loaded = side(loaded);
    get("Controlled opening");
    const auto pairs = split_by_side("Controlled opening", opening);
    const auto names = Utilities::split_string_list(pairs.front().first);
    if (pairs.size() != 1 || names.size() != 2 || names[0] == names[1])
      throw EntryError("Boundary conditions/Controlled opening", opening,
                       "'side, side: value' with two sides, once");
    load.from = side(names[0]);
    load.to = side(names[1]);
    load.opening = parse_value<dim>("Controlled opening", pairs.front().second, dimension::length);
    const Point<dim> elsewhere = 1.23 * Point<dim>::unit_vector(0) + Point<dim>::unit_vector(1);
    for (const double time : {0., 0.77})
      if (load.opening.value(Point<dim>(), time) != load.opening.value(elsewhere, time))
        throw EntryError("Boundary conditions/Controlled opening", opening,
                         "a function of t alone");
    controlled = load;
  }
  rollers = prm.get("Roller");
  refuse_contradictions(prm);
  prm.leave_subsection();
}


template <int dim>
bool BoundaryConditions<dim>::is_roller(const types::boundary_id side) const
{
  return std::any_of(dirichlet.begin(), dirichlet.end(),
                     [side](const Dirichlet &condition) {
                       return condition.side == side &&
                              (condition.entry == "Roller" || condition.entry == "Fixed");
                     });
}


template <int dim>
bool BoundaryConditions<dim>::moves(const types::boundary_id side) const
{
  return std::any_of(dirichlet.begin(), dirichlet.end(),
                     [side](const Dirichlet &condition) {
                       return condition.side == side && condition.component != dim &&
                              !condition.is_zero;
                     });
}


template <int dim>
bool BoundaryConditions<dim>::is_plane_of_symmetry(const types::boundary_id side,
                                                   const unsigned int coordinate) const
{
  bool is_held = false;
  for (const Dirichlet &condition : dirichlet)
    if (condition.side == side)
    {
      if (condition.component != normal_component && condition.component != coordinate)
        return false;
      is_held = is_held || condition.entry == "Roller" || condition.is_zero;
    }
  return is_held;
}


template <int dim>
void BoundaryConditions<dim>::refuse_contradictions(ParameterHandler &prm) const
{
  const auto refuse = [&prm](const std::string &entry, const std::string &why)
  { throw EntryError("Boundary conditions/" + entry, prm.get(entry), why); };
  for (unsigned int i = 0; i < dirichlet.size(); ++i)
    for (unsigned int j = 0; j < i; ++j)
      if (const Dirichlet &a = dirichlet[i], &b = dirichlet[j];
          a.side == b.side && a.component == b.component && !(a.is_zero && b.is_zero))
        refuse(a.entry, "one condition for each component of a side; '" + a.side_name +
                          "' has one by 'Boundary conditions/" + b.entry + "' already");
  for (const Dirichlet &condition : dirichlet)
  {
    const std::string also = "other sides than those of 'Boundary conditions/" + condition.entry +
                             "', where '" + condition.side_name + "' ";
    if (condition.component == dim && prescribed_loads.flux.count(condition.side) > 0)
      refuse("Flux", also + "is given a pressure");
    if (condition.component != dim && controlled && controlled->loaded == condition.side)
      refuse("Controlled load", also + "has a given displacement");
    // The axis of a roller is known with the mesh only; its normal traction is another name for it.
    if ((condition.component == normal_component || condition.entry == "Fixed") &&
        prescribed_loads.normal_traction.count(condition.side) > 0)
      refuse("Normal traction", also + "does not move along its normal");
    if (condition.component < dim)
    {
      const std::string entry = "Traction " + axis_names[condition.component];
      for (const auto &[name, value] : split_by_side(entry, prm.get(entry)))
        if (name == condition.side_name)
          refuse(entry, also + "has a given displacement");
    }
  }
}


template <int dim>
void BoundaryConditions<dim>::set_reference(std::shared_ptr<Function<dim>> solution)
{
  reference = std::move(solution);
}


template <int dim>
double BoundaryConditions<dim>::maximum_displacement(const double time) const
{
  double greatest = 0.;
  for (const Dirichlet &condition : dirichlet)
    if (condition.component != dim && !condition.from_reference)
      greatest = std::max(greatest, std::abs(condition.prescribed.value(Point<dim>(), time)));
  return greatest;
}


template <int dim>
bool BoundaryConditions<dim>::mentions_pore_pressure() const
{
  for (const Dirichlet &condition : dirichlet)
    if (condition.component == dim)
      return true;
  return !prescribed_loads.flux.empty();
}


template <int dim>
bool BoundaryConditions<dim>::seal(const std::vector<types::boundary_id> &sides) const
{
  for (const types::boundary_id side : sides)
  {
    std::set<unsigned int> components;
    for (const Dirichlet &condition : dirichlet)
      if (condition.side == side)
        components.insert(condition.component);
    const bool drained = components.erase(dim) > 0;
    if (drained || (components.count(normal_component) == 0 && components.size() < dim))
      return false;
  }
  return true;
}


template <int dim>
bool BoundaryConditions<dim>::constant_in_time() const
{
  for (const Dirichlet &condition : dirichlet)
    if (condition.from_reference || !condition.prescribed.constant_in_time)
      return false;
  return true;
}


template <int dim>
void BoundaryConditions<dim>::constrain(const double time,
                                        const Mapping<dim> &mapping,
                                        const DoFHandler<dim> &dof_handler,
                                        AffineConstraints<double> &values,
                                        AffineConstraints<double> &increment) const
{
  IndexSet relevant;
  DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  values.reinit(relevant);
  DoFTools::make_hanging_node_constraints(dof_handler, values);

  const unsigned int n_components = dof_handler.get_fe().n_components();
  for (const Dirichlet &condition : dirichlet)
  {
    const unsigned int component = condition.component == normal_component
                                     ? normal_axis(dof_handler.get_triangulation(), condition.side)
                                     : condition.component;
    if (component >= n_components)
      continue; // a pressure condition in dry rock
    ComponentMask mask(n_components, false);
    mask.set(component, true);
    if (condition.from_reference)
    {
      reference->set_time(time);
      VectorTools::interpolate_boundary_values(mapping, dof_handler, condition.side, *reference,
                                               values, mask);
    }
    else
      VectorTools::interpolate_boundary_values(
        mapping, dof_handler, condition.side,
        ComponentFunction<dim>(condition.prescribed, time, n_components), values, mask);
  }
  values.close();

  increment.reinit(relevant);
  increment.merge(values);
  for (const auto &line : values.get_lines())
    if (increment.is_constrained(line.index))
      increment.set_inhomogeneity(line.index, 0.);
  increment.close();
}


template class BoundaryConditions<2>;
template class BoundaryConditions<3>;
} // namespace stockwork
