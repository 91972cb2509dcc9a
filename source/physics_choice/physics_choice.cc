#include "physics_choice/physics_choice.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "physics_choice/decisions.h"
#include "scene_estimates.h"

#include <deal.II/base/utilities.h>

#include <iomanip>
#include <sstream>

namespace stockwork
{
using namespace dealii;

PhysicsDecision kept(const std::string &name, const std::string &why)
{
  PhysicsDecision decision;
  decision.name = name;
  decision.why = why;
  return decision;
}


std::string with_digits(const double value, const int digits)
{
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}


std::string as_percentage(const double share)
{
  return with_digits(100. * share, share < 0.1 ? 2 : 3) + " %";
}


namespace
{
/// In the section of an entry, with its name in there.
void at_entry(ParameterHandler &prm,
              const std::string &path,
              const std::function<void(const std::string &)> &act)
{
  std::vector<std::string> parts = Utilities::split_string_list(path, '/');
  const std::string name = parts.back();
  parts.pop_back();
  for (const std::string &part : parts)
    prm.enter_subsection(part);
  act(name);
  for (unsigned int i = 0; i < parts.size(); ++i)
    prm.leave_subsection();
}
} // namespace


void set_entries(ParameterHandler &prm, const Settings &settings)
{
  for (const auto &setting : settings)
    at_entry(prm, setting.first, [&](const std::string &name) { prm.set(name, setting.second); });
}


namespace
{
/// What is there now.
Settings as_they_are(ParameterHandler &prm, Settings settings)
{
  for (auto &setting : settings)
    at_entry(prm, setting.first, [&](const std::string &name) { setting.second = prm.get(name); });
  return settings;
}


/// The case of a deck with some entries set.
template <int dim>
std::shared_ptr<const Case<dim>>
case_with(const Deck &deck, const PlugIns &plug_ins, const Settings &settings)
{
  ParameterHandler prm;
  declare_all_parameters(prm, plug_ins);
  deck.parse_into(prm);
  set_entries(prm, settings);
  return std::make_shared<const Case<dim>>(deck, prm, plug_ins);
}


template <int dim>
bool has_inertia(const Case<dim> &the_case)
{
  return the_case.scheme.kind() == TimeScheme::Kind::newmark;
}
} // namespace


template <int dim>
std::vector<PhysicsDecision>
leave_out_physics(const Deck &deck,
                  ParameterHandler &prm,
                  const PlugIns &plug_ins,
                  const std::function<double(const Settings &)> &strength_with)
{
  const double accuracy = get_quantity(prm, "Accuracy", dimension::number);
  std::shared_ptr<const Case<dim>> the_case = case_with<dim>(deck, plug_ins, {});
  std::vector<PhysicsDecision> decisions;
  Settings settings;
  double error = 0.;
  const auto take = [&](PhysicsDecision decision)
  {
    if (decision.left_out && !(error + decision.error <= accuracy))
    {
      decision.left_out = false;
      decision.why += (error > 0. ? ": with what is left out already, " : ": ") +
                      as_percentage(error + decision.error) + " is more than 'Accuracy'";
    }
    if (decision.left_out)
      try
      {
        Settings all = settings;
        all.insert(all.end(), decision.settings.begin(), decision.settings.end());
        the_case = case_with<dim>(deck, plug_ins, all);
        settings = all;
        error += decision.error;
      }
      catch (const InputError &refusal)
      {
        decision.left_out = false;
        decision.why +=
          "; but without it the deck would be refused: " + std::string(refusal.what());
      }
    decisions.push_back(decision);
  };
  // In this order, for what is left out decides what the next may be.
  if (has_inertia(*the_case))
    take(decide_inertia(*the_case));
  if (the_case->laws.may_yield())
    take(decide_plasticity(the_case, prm));
  if (the_case->elements.has_pore_pressure)
    take(decide_pores(*the_case, deck, [&]() { return strength_with(settings); }));
  if constexpr (dim == 2)
    if (is_cracked(*the_case) && is_driven_on(*the_case))
      take(decide_lubrication(*the_case));
  for (PhysicsDecision &decision : decisions)
    if (decision.left_out)
      decision.replaced = as_they_are(prm, decision.settings);
  set_entries(prm, settings);
  return decisions;
}


template std::vector<PhysicsDecision>
leave_out_physics<2>(const Deck &,
                     ParameterHandler &,
                     const PlugIns &,
                     const std::function<double(const Settings &)> &);
template std::vector<PhysicsDecision>
leave_out_physics<3>(const Deck &,
                     ParameterHandler &,
                     const PlugIns &,
                     const std::function<double(const Settings &)> &);
} // namespace stockwork
