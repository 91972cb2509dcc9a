#include "model_choice/scene_kind.h"

#include "scales.h"
#include "scene_estimates.h"
#include "verification/analytical/radial.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
SceneKind nobodys(const std::string &why)
{
  return {{}, why};
}


/// Distance to the walls, in final half lengths, from which on they cost less than 1 %; beside a
/// disc, whose stress falls with the cube of the distance, sooner.
template <int dim>
constexpr double far_walls = dim == 2 ? 10. : 5.;

/// Dimensionless toughness below which viscosity, and above which toughness dominates: the answer
/// hangs no more on the other.
constexpr double viscous = 1., tough = 4.;

/// A minimum aperture of a twentieth of what the fracture opens by at its inlet changes no error of
/// a chart (kgd/toughness: a tenth, kgd/viscosity: a fortieth); a quarter changes the length by 25
/// %.
constexpr double greatest_minimum_aperture = 0.05;

/// Estimates of the dimensionless toughness and of the share leaked may be off by this share.
constexpr double margin = 0.15;

/// What no chart has.
template <int dim>
std::string beyond_charts(const Case<dim> &the_case)
{
  const auto &cracks = the_case.scene.cracks;
  if (cracks.size() != 1)
    return cracks.empty() ? "there is no crack" : "there are several cracks";
  if (cracks[0].kind != InitialCrack<dim>::Kind::open)
    return "the crack is not an open one";
  if (dim == 2 && cracks[0].points.size() != 2)
    return "the crack is not straight";
  if (the_case.laws.all().size() > 1 || the_case.rock.is_random())
    return "the rock is not the same everywhere";
  if (!the_case.laws.are_linear() || the_case.rock.main().stiffness)
    return "the rock is not linear and isotropic";
  if (the_case.scheme.kind() == TimeScheme::Kind::newmark)
    return "inertia is on";
  if (the_case.network.n_wells() > 1)
    return "there are several wells";
  if (!(the_case.rock.main().energy_release_rate > 0.))
    return "the rock has no toughness";
  if (the_case.rock.main().poisson_ratio > 0.4)
    return "Poisson's ratio is above 0.4, where cells begin to lock";
  if (!the_case.walls_follow_reference)
  {
    // Charts are of cracks in a wide body that nothing but the stress in situ loads.
    if (!the_case.boundary_conditions.loads().empty() ||
        the_case.boundary_conditions.maximum_displacement(the_case.control.end_time) != 0.)
      return "there are loads on the boundary";
    if (begins_on_an_edge(the_case))
      return "the crack begins on a side that is no plane of symmetry";
    const double reach = half_length_at_end(the_case);
    if (std::isnan(reach))
      return "nothing tells how long the fracture will be";
    if (!(distance_to_walls(the_case) >= far_walls<dim> * reach))
      return "the walls are nearer than " + std::to_string(int(far_walls<dim>)) +
             " times the length at the end";
  }
  return "";
}


/// A crack under a given pressure, which must not grow.
template <int dim>
SceneKind kind_of_static(const Charts &charts, const Case<dim> &the_case, const bool turned)
{
  if (the_case.elements.has_pore_pressure)
    return nobodys(
      "there is no chart for cracks under a given pressure in rock with pore pressure");
  const InitialCrack<dim> &crack = the_case.scene.cracks[0];
  const double net = the_case.scene.crack_pressure - closing_stress(the_case.scene, crack);
  const double half = half_length_at_end(the_case);
  const double intensity =
    dim == 2 ? net * std::sqrt(numbers::PI * half) : 2. * net * std::sqrt(half / numbers::PI);
  if (!(intensity < the_case.rock.main().toughness()))
    return nobodys("the given pressure lets the crack grow");
  if (dim == 3 && turned)
    return nobodys("the disc is turned out of the mesh's directions");
  return {charts.groups(dim == 3 ? "static, disc"
                        : turned ? "static, turned"
                                 : "static"),
          "a crack under a given pressure that does not grow"};
}


/// Groups of a kind that hold for a scene of this toughness: the one that has it, or those on both
/// sides. Empty: nobody has been there.
std::vector<Charts::Group> around(const std::vector<Charts::Group> &groups, const double toughness)
{
  const Charts::Group *below = nullptr, *above = nullptr;
  for (const Charts::Group &group : groups)
  {
    if (toughness >= group.least / (1. + margin) && toughness <= group.most * (1. + margin))
      return {group};
    if (group.most < toughness)
      below = &group;
    else if (above == nullptr)
      above = &group;
  }
  if (below != nullptr && above != nullptr)
    return {*below, *above};
  if (below != nullptr && below->most >= tough)
    return {*below};
  if (above != nullptr && above->least <= viscous)
    return {*above};
  return {};
}


/// "K_m = 2 to 2.2, 7"
std::string values_of(const std::vector<Charts::Group> &groups)
{
  std::ostringstream text;
  text << std::setprecision(2) << "K_m = ";
  for (const Charts::Group &group : groups)
  {
    text << (&group == &groups.front() ? "" : ", ") << group.least;
    if (group.most > group.least)
      text << " to " << group.most;
  }
  return text.str();
}


/// Of the shapes that grow. Where fluid leaks into the rock, a deck that loses no less has to
/// promise as well.
SceneKind kind_of_growing(const Charts &charts,
                          const std::string &kind,
                          const std::string &leaking,
                          const double toughness,
                          const double leaked)
{
  std::ostringstream why;
  why << std::setprecision(2) << "K_m = " << toughness;
  const std::vector<Charts::Group> groups = charts.groups(kind);
  if (groups.empty())
    return nobodys("there is no chart of '" + kind + "'");
  SceneKind scene{around(groups, toughness), ""};
  if (scene.groups.empty())
    return nobodys(why.str() + ", and charts of '" + kind + "' have " + values_of(groups));
  if (!leaking.empty())
  {
    why << ", " << 100. * leaked << " % of the fluid leaks off";
    double most = 0.;
    const std::vector<Charts::Group> all = charts.groups(leaking);
    for (const Charts::Group &group : all)
    {
      most = std::max(most, group.leaked);
      if (leaked <= group.leaked * (1. + margin))
        scene.groups.push_back(group);
    }
    if (leaked > most * (1. + margin))
    {
      std::ostringstream charted;
      charted << std::setprecision(2) << ", and charts of '" << leaking << "' have up to "
              << 100. * most << " %";
      return nobodys(why.str() + charted.str());
    }
  }
  scene.why = why.str();
  return scene;
}


/// What no chart of a fracture that grows has.
template <int dim>
std::string beyond_growing(const Case<dim> &the_case)
{
  const Pumping pumping = first_pumping(the_case);
  if (!(pumping.rate > 0.) || pumping.is_shut_in || the_case.network.maximum_pressure())
    return "no well pumps at a given rate until the end";
  if (!wells_are_constant(the_case))
    return "the well's rate changes in time";
  if (the_case.network.has_borehole_volume())
    return "the well has a 'Borehole volume'";
  if (the_case.network.may_cavitate())
    return "the fluid may cavitate ('Fracture flow/Vapour pressure')";
  if (half_length_at_start(the_case) > 0.5 * half_length_at_end(the_case))
    return "the crack is more than half as long as its fracture would be at the end";
  if (!std::isnan(the_case.rock.main().tensile_strength))
    return "the deck gives a tensile strength, and charts are of those that models take for their "
           "cells";
  return "";
}


SceneKind kind_of_growing(const Charts &charts, const Case<2> &the_case, const bool turned)
{
  const Pumping pumping = first_pumping(the_case);
  const InitialCrack<2> &crack = the_case.scene.cracks[0];
  const Tensor<1, 2> along = (crack.points[1] - crack.points[0]) / crack.size();
  const Tensor<1, 2> across = Point<2>(-along[1], along[0]);
  const auto stress = the_case.scene.in_situ_stress(crack.points[0]);
  if (shear_stress(the_case.scene, crack) > 1e-6 * stress.norm())
    return nobodys("the stress in situ shears the crack, which will turn");
  if (across * (stress * across) < along * (stress * along) - 1e-6 * stress.norm())
    return nobodys("the stress in situ is greatest across the crack, which will turn");
  const LeakOff law = the_case.network.leak_off_law();
  const bool is_porous = the_case.elements.has_pore_pressure;
  if (law != LeakOff::none && law != LeakOff::carter && law != LeakOff::resolved)
    return nobodys("there is no chart for this law of leak-off");
  if (is_porous && law != LeakOff::resolved)
    return nobodys("there is no chart for rock with pore pressure whose leak-off is not resolved");
  if (turned && law != LeakOff::none)
    return nobodys("there is no chart for leak-off at an angle to the mesh");
  const analytical::KgdParameters parameters = plane_fracture(the_case, pumping);
  const analytical::Kgd kgd(parameters);
  const double opening = kgd.inlet_opening(pumping.duration);
  if (the_case.network.smallest_hydraulic_aperture() > greatest_minimum_aperture * opening)
    return nobodys(
      "'Fracture flow/Minimum aperture' is more than a twentieth of what the fracture opens by, " +
      to_string(opening, dimension::length));
  if (kgd.inlet_pressure(pumping.duration) * the_case.rock.fluid().compressibility > 0.01)
    return nobodys("the net pressure compresses the fluid by more than 1 % ('Fluid/Bulk modulus')");
  if (parameters.dimensionless_toughness() < 1. && the_case.scheme.kind() != TimeScheme::Kind::bdf2)
    return nobodys("viscosity dominates, and charts of that are with 'Time/Scheme = BDF2'");
  return kind_of_growing(charts, turned ? "growing, turned" : "growing",
                         is_porous                ? "growing, porous"
                         : law == LeakOff::carter ? "growing, carter"
                                                  : "",
                         parameters.dimensionless_toughness(),
                         leaked_share(the_case, pumping).least);
}


SceneKind kind_of_growing(const Charts &charts, const Case<3> &the_case, const bool turned)
{
  const Pumping pumping = first_pumping(the_case);
  if (turned)
    return nobodys("the disc is turned out of the mesh's directions");
  if (the_case.elements.has_pore_pressure || the_case.network.leak_off_law() != LeakOff::none)
    return nobodys("there is no chart of discs that leak");
  const InitialCrack<3> &crack = the_case.scene.cracks[0];
  const SymmetricTensor<2, 3> stress = the_case.scene.in_situ_stress(crack.disc->centre);
  if (shear_stress(the_case.scene, crack) > 1e-6 * stress.norm())
    return nobodys("the stress in situ shears the crack, which will turn");
  if (-closing_stress(the_case.scene, crack) < eigenvalues(stress)[0] - 1e-6 * stress.norm())
    return nobodys("the stress in situ across the crack is not the least, and it will turn");
  return kind_of_growing(
    charts, "growing, disc", "",
    analytical::radial_toughness(radial_fracture(the_case, pumping), pumping.duration), 0.);
}
} // namespace


template <int dim>
SceneKind kind_of(const Charts &charts, const Case<dim> &the_case)
{
  if (const std::string why = beyond_charts(the_case); !why.empty())
    return nobodys(why);
  const InitialCrack<dim> &crack = the_case.scene.cracks[0];
  Tensor<1, dim> direction;
  if (crack.disc)
    direction = crack.disc->normal;
  else
    direction = (crack.points.back() - crack.points.front()) / crack.size();
  double greatest = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    greatest = std::max(greatest, std::abs(direction[d]));
  const bool turned = greatest < 1. - 1e-9;
  if (!std::isnan(the_case.scene.crack_pressure))
    return kind_of_static(charts, the_case, turned);
  if (const std::string why = beyond_growing(the_case); !why.empty())
    return nobodys(why);
  return kind_of_growing(charts, the_case, turned);
}


template SceneKind kind_of<2>(const Charts &, const Case<2> &);
template SceneKind kind_of<3>(const Charts &, const Case<3> &);
} // namespace stockwork
