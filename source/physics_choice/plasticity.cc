#include "physics_choice/decisions.h"

#include "base/parameter_tree.h"
#include "outcome_audit.h"
#include "physics_choice/loads.h"
#include "scales.h"
#include "scene_estimates.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Share of its strength that rock uses under a stress added to that in situ.
template <int dim>
double strength_used(const Case<dim> &the_case,
                     const types::material_id region,
                     const Point<dim> &place,
                     const SymmetricTensor<2, 3> &added)
{
  RockState state;
  state.in_situ_stress = the_case.scene.in_situ_tensor(place, the_case.rock(region)) + added;
  state.in_situ_pressure = the_case.scene.in_situ_pore_pressure(place);
  return the_case.laws(region).used(state);
}


/// The greatest stress that the loads on the boundary bring into rock without a hole [Pa].
template <int dim>
double stress_of_loads(const Case<dim> &the_case)
{
  double greatest = 0.;
  for (unsigned int i = 0; i <= 100; ++i)
  {
    std::vector<double> loads =
      loads_at(the_case, the_case.control.start_time + 0.01 * i * duration_of(the_case));
    loads[0] *= the_case.rock.main().plane_modulus() / smallest_extent(the_case);
    for (const double load : loads)
      greatest = std::max(greatest, std::abs(load));
  }
  return greatest;
}
} // namespace


template <int dim>
PhysicsDecision decide_plasticity(const std::shared_ptr<const Case<dim>> &asked_for,
                                  const ParameterHandler &prm)
{
  const Case<dim> &the_case = *asked_for;
  const std::string name = "plasticity";
  constexpr double concentration = 3., greatest_share = 0.5;
  const bool cracked = is_cracked(the_case);
  if (the_case.network.opens_into_rock())
    return kept(name, "a well opens into the rock, whose pore pressure nothing bounds beforehand");
  if (!the_case.boundary_conditions.entry_with_reference().empty())
    return kept(name, "the boundary follows a reference solution");
  if (cracked && !the_case.network.has_wells())
    return kept(name, "no well drives the cracks: nothing bounds the stress at their tips");
  if (cracked && (dim == 3 || !std::isnan(the_case.scene.crack_pressure)))
    return kept(name, "nothing bounds the stress at the tips of these cracks beforehand");

  const Scales scales = scales_of(the_case.scene, the_case.network, the_case.boundary_conditions);
  const double load = concentration * stress_of_loads(the_case);
  const Point<dim> middle =
    the_case.geometry.lower() + 0.5 * (the_case.geometry.upper() - the_case.geometry.lower());
  double used = 0.;
  for (const auto &[region, law] : the_case.laws.all())
  {
    if (law->n_history() == 0)
      continue;
    const RockProperties &rock = the_case.rock(region);
    if (cracked && std::isnan(rock.tensile_strength))
      return kept(name, "the deck gives no 'Rock/Tensile strength', which bounds the stress at the "
                        "tips");
    std::vector<Point<dim>> places{the_case.geometry.lower(), middle, the_case.geometry.upper()};
    for (const Point<dim> &place : places)
    {
      const auto principal = eigenvectors(the_case.scene.in_situ_tensor(place, rock));
      std::vector<double> added{load};
      if (cracked)
        added.push_back(concentration * scales.pressure);
      for (const auto &[value, axis] : principal)
      {
        const SymmetricTensor<2, 3> across = symmetrize(outer_product(axis, axis));
        for (const double stress : added)
          for (const double sign : {-1., 1.})
            used = std::max(used, strength_used(the_case, region, place, sign * stress * across));
      }
      // The process zone, into which the fluid comes or not.
      if (cracked)
      {
        const SymmetricTensor<2, 3> across =
          symmetrize(outer_product(principal[0].second, principal[0].second));
        const double effective = the_case.scene.in_situ_pore_pressure(place) + principal[0].first;
        for (const double relief : {0., effective})
          used = std::max(used, strength_used(the_case, region, place,
                                              (rock.tensile_strength - relief) * across));
      }
    }
  }
  std::ostringstream why;
  why << std::setprecision(2) << "stress in situ"
      << (cracked ? ", three times the net pressure and the tensile strength beside the tips" : "")
      << (load > 0. ? ", and three times the loads" : "") << " take " << used
      << " of the rock's strength; " << greatest_share << " at most are taken for safe";
  PhysicsDecision decision = kept(name, why.str());
  if (used > greatest_share)
    return decision;
  decision.left_out = true;
  decision.cost = &CostlyPhysics::yields;
  decision.error = 0.;
  for (const auto &[region, law] : the_case.laws.all())
    if (law->n_history() > 0)
    {
      const std::string section = region == 0 ? "Rock" : "Rock/Region " + std::to_string(region);
      decision.settings.emplace_back(section + "/Law", "elastic");
      // What is said of a law that no rock has is refused.
      for (const DeclaredEntry &entry : declared_entries(prm))
        if (entry.section == section + "/" + the_case.laws.name(region) &&
            entry.value != entry.default_value)
          decision.settings.emplace_back(entry.path(), entry.default_value);
    }
  decision.strength_used = [asked_for](const types::material_id region, const Point<3> &place,
                                       const SymmetricTensor<2, 3> &stress)
  {
    Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = place[d];
    return strength_used(*asked_for, region, point, stress);
  };
  decision.judge = [](const Outcome &outcome)
  {
    const double share = outcome.strength_used;
    return Assumption{"plasticity left out: greatest share of strength used", share, share < 1.,
                      share < 1. ? "the rock would have stayed linear (cells that no crack cuts)"
                                 : "the rock would have yielded: set Physics = as the deck says"};
  };
  return decision;
}


template PhysicsDecision decide_plasticity<2>(const std::shared_ptr<const Case<2>> &,
                                              const ParameterHandler &);
template PhysicsDecision decide_plasticity<3>(const std::shared_ptr<const Case<3>> &,
                                              const ParameterHandler &);
} // namespace stockwork
