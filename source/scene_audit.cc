#include "scene_audit.h"

#include "scene_estimates.h"
#include "scene_numbers.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace stockwork
{
namespace
{
/// How many times a run with what is left out would cost what it costs without, by decision;
/// later decisions were taken without what earlier ones left out.
template <int dim>
std::vector<double> savings(const Case<dim> &the_case, const double n_unknowns)
{
  std::vector<double> factors(the_case.decisions.size(), 1.);
  CostlyPhysics physics = costly_physics(the_case);
  double n = n_unknowns, cheaper = estimate_cost(dim, n, physics).step;
  for (unsigned int i = the_case.decisions.size(); i-- > 0;)
  {
    const PhysicsDecision &decision = the_case.decisions[i];
    if (!decision.left_out || decision.cost == nullptr)
      continue;
    physics.*decision.cost = true;
    if (decision.cost == &CostlyPhysics::pore_pressure)
      n *= 1. + 1. / (dim * std::pow(the_case.elements.displacement_degree, dim));
    const double dearer = estimate_cost(dim, n, physics).step;
    factors[i] = dearer / cheaper;
    cheaper = dearer;
  }
  return factors;
}


/// 'Physics = auto' item by item, with the entries that it has set.
template <int dim>
void print_decisions(RunContext &run, const Case<dim> &the_case, const double n_unknowns)
{
  const std::vector<double> factors = savings(the_case, n_unknowns);
  for (unsigned int i = 0; i < factors.size(); ++i)
  {
    const PhysicsDecision &decision = the_case.decisions[i];
    std::ostringstream line;
    line << std::setprecision(2) << "  Physics = auto: " << decision.name
         << (decision.left_out ? " left out" : " kept");
    if (decision.left_out)
    {
      line << ", which changes the answer by about " << 100. * decision.error
           << " % and makes a step ";
      if (factors[i] > 1.05)
        line << "about " << factors[i] << " times cheaper";
      else
        line << "hardly cheaper";
    }
    line << ": " << decision.why;
    for (const auto &[entry, value] :
         decision.left_out ? decision.settings : std::vector<std::pair<std::string, std::string>>())
      line << "; " << entry << " = " << (value.empty() ? "(empty)" : value);
    run.out << line.str() << '\n';
  }
}


/// A solver that is none for a scene of this size.
template <int dim>
void print_slow_solver(RunContext &run, const Case<dim> &the_case, const double n_unknowns)
{
  using Type = LinearSolverParameters::Type;
  const Type type = the_case.linear_solver.type;
  const CostlyPhysics physics = costly_physics(the_case);
  if (!physics.fracture || physics.pore_pressure || physics.inertia ||
      (type != Type::direct && type != Type::iterative) ||
      (dim == 3 && n_unknowns > the_case.linear_solver.largest_factor(
                                  {dim, physics.pore_pressure, physics.yields})))
    return;
  run.out
    << "  Linear solver/Type = " << (type == Type::direct ? "direct" : "iterative")
    << ": set 'auto'. 'bordered', which it takes for a fracture in a scene of this size, keeps "
       "the factor of the rock and is about ten times faster\n";
}
} // namespace


template <int dim>
void print_scene_audit(RunContext &run,
                       const Case<dim> &the_case,
                       const MeshSizes<dim> &mesh,
                       const double n_unknowns)
{
  run.out << "Scene audit\n";
  for (const SceneNumber &number : scene_numbers(the_case, mesh))
  {
    std::ostringstream line;
    line << "  " << std::left << std::setw(48) << number.name << std::setw(10)
         << std::setprecision(3) << number.value << "  " << number.consequence;
    run.out << line.str() << '\n';
    if (number.spoils)
    {
      std::ostringstream warning;
      warning << std::setprecision(3) << number.name << " = " << number.value << ": "
              << number.consequence << ".";
      run.warn(warning.str());
    }
  }
  for (const ChosenValue &chosen : the_case.chosen)
    run.out << "  " << chosen.entry << " = " << chosen.value << ": " << chosen.why << '\n';
  print_decisions(run, the_case, n_unknowns);
  print_slow_solver(run, the_case, n_unknowns);
  if (the_case.scheme.kind() != TimeScheme::Kind::newmark)
    run.out << "  left out: inertia (Time/Inertia = off)\n";
  if (!the_case.laws.may_yield())
    run.out << "  left out: plasticity (the rock is elastic)\n";
  if (!the_case.scene.cracks.empty() && !the_case.model->requirements().has_fracture)
    run.out << "  left out: the " << the_case.scene.cracks.size() << " crack(s) of the deck, and "
            << "what 'Fracture flow' and 'Cracks' say of them (the fracture model '"
            << the_case.model_name << "' has none)\n";
  run.out << std::flush;
}


template void print_scene_audit<2>(RunContext &, const Case<2> &, const MeshSizes<2> &, double);
template void print_scene_audit<3>(RunContext &, const Case<3> &, const MeshSizes<3> &, double);
} // namespace stockwork
