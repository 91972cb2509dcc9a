#include "in_situ_numbers.h"

#include "scene_estimates.h"

#include "stockwork/base/quantity.h"

#include "exchange/flat_parts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Stress in situ on a crack's plane somewhere.
struct OnPlane
{
  double across; ///< compression [Pa]
  double along;  ///< shear [Pa]
  double all;    ///< the norm of the stress there [Pa]
  double pores;  ///< pressure in them [Pa]
};

/// Of a flat part of a crack.
struct FlatPart
{
  OnPlane middle;
  std::vector<OnPlane> ends; ///< of a disc, places on its rim that lie in the domain
};

template <int dim>
std::vector<FlatPart> stress_on(const Case<dim> &the_case, const InitialCrack<dim> &crack)
{
  const auto on_plane = [&](const Point<dim> &place, const Tensor<1, dim> &normal)
  {
    const SymmetricTensor<2, dim> stress = the_case.scene.in_situ_stress(place);
    const Tensor<1, dim> traction = stress * normal;
    return OnPlane{-(traction * normal), (traction - (traction * normal) * normal).norm(),
                   stress.norm(), the_case.scene.in_situ_pore_pressure(place)};
  };
  const BoundingBox<dim> domain({the_case.geometry.lower(), the_case.geometry.upper()});
  std::vector<FlatPart> parts;
  for (const auto &[middle, normal] : flat_parts(crack))
  {
    parts.push_back({on_plane(middle, normal), {}});
    for (unsigned int d = 0; d < dim && crack.disc; ++d)
    {
      Tensor<1, dim> along;
      along[d] = 1.;
      along -= (along * normal) * normal;
      if (along.norm() < 1e-6) // across it
        continue;
      for (const double end : {-1., 1.})
        if (const Point<dim> rim = middle + end * crack.disc->radius / along.norm() * along;
            domain.point_inside(rim, 1e-8))
          parts.back().ends.push_back(on_plane(rim, normal));
    }
    for (const Point<dim> &corner : crack.points)
      if (const Tensor<1, dim> to = corner - middle;
          std::abs(to * normal) < 1e-8 * crack.size()) // one of its own
        parts.back().ends.push_back(on_plane(corner, normal));
  }
  return parts;
}

template <int dim>
void for_each_place(const Case<dim> &the_case,
                    const InitialCrack<dim> &crack,
                    const std::function<void(const OnPlane &)> &look_at)
{
  for (const FlatPart &part : stress_on(the_case, crack))
  {
    look_at(part.middle);
    for (const OnPlane &end : part.ends)
      look_at(end);
  }
}

/// The least that presses the faces of a crack together in situ [Pa]; infinity without a crack.
template <int dim>
double least_compression_across_cracks(const Case<dim> &the_case)
{
  double least = std::numeric_limits<double>::infinity();
  for (const InitialCrack<dim> &crack : the_case.scene.cracks)
    for_each_place<dim>(the_case, crack,
                        [&](const OnPlane &plane) { least = std::min(least, plane.across); });
  return least;
}
} // namespace


void add_principal_stresses(const Case<2> &the_case, std::vector<SceneNumber> &numbers)
{
  const Point<2> place =
    the_case.scene.cracks.empty() ? Point<2>() : the_case.scene.cracks[0].points.front();
  const SymmetricTensor<2, 2> stress = the_case.scene.in_situ_stress(place);
  if (stress.norm() == 0.)
    return;
  const auto principal = eigenvectors(stress); // the greatest first
  const Tensor<1, 2> &axis = principal[1].second;
  double angle = std::atan2(axis[1], axis[0]) * 180. / numbers::PI;
  angle += angle < -1e-6 ? 180. : 0.;
  std::ostringstream text;
  text << std::setprecision(4) << "at " << std::abs(angle) << " degrees to x; "
       << (principal[0].first > 0. ? "tension" : "compression") << " across it of "
       << to_string(std::abs(principal[0].first), dimension::stress);
  numbers.push_back({"maximum in-situ compression [Pa]", -principal[1].first, text.str()});
}


template <int dim>
void add_pore_pressure(const Case<dim> &the_case, std::vector<SceneNumber> &numbers)
{
  const Point<dim> centre =
    the_case.geometry.lower() + 0.5 * (the_case.geometry.upper() - the_case.geometry.lower());
  const double pressure = the_case.scene.in_situ_pore_pressure(centre);
  const double least = -eigenvalues(the_case.scene.in_situ_stress(centre))[0];
  if (!(least > 0.) || pressure == 0.)
    return;
  const double ratio = pressure / least;
  numbers.push_back({"pore pressure / least compressive stress", ratio,
                     ratio > 1.   ? "the pores would open fractures by themselves"
                     : ratio < 0. ? "below vacuum, where the stress says that pressures are not net"
                                  : "in the middle of the domain",
                     ratio > 1. || ratio < 0.});
}


namespace
{
/// Whether a crack cuts the domain in two: it has no tips.
template <int dim>
bool is_through(const Case<dim> &the_case, const InitialCrack<dim> &crack)
{
  return !crack.points.empty() && the_case.geometry.on_side(crack.points.front()) &&
         the_case.geometry.on_side(crack.points.back());
}

/// Whether anything pulls, pushes or moves the boundary.
template <int dim>
bool is_loaded(const Case<dim> &the_case)
{
  const auto &loads = the_case.boundary_conditions.loads();
  if (!loads.traction.empty() || !loads.normal_traction.empty() ||
      the_case.boundary_conditions.controlled_load())
    return true;
  const auto sides = the_case.geometry.side_names();
  return the_case.scene.moves_side &&
         std::any_of(sides.begin(), sides.end(),
                     [&](const std::string &side)
                     { return the_case.scene.moves_side(the_case.geometry.side(side)); });
}

/// The given pressure and the shear in situ beside what lets a crack of the deck begin to grow:
/// K_Ic = p sqrt(pi a), of a disc 2 p sqrt(a/pi), and the same of the shear that an open crack
/// lets go (Tada, Paris & Irwin 2000; of a disc, but for Poisson's ratio).
template <int dim>
void add_growth(const Case<dim> &the_case,
                const MeshSizes<dim> &mesh,
                const double given,
                const bool in_cracks,
                std::vector<SceneNumber> &numbers)
{
  double greatest = 0.;
  unsigned int number = 0;
  for (unsigned int c = 0; c < the_case.scene.cracks.size(); ++c)
  {
    const InitialCrack<dim> &crack = the_case.scene.cracks[c];
    if (crack.kind != InitialCrack<dim>::Kind::open || is_through(the_case, crack))
      continue;
    const RockProperties &rock = the_case.rock(mesh.region_at(flat_parts(crack).front().first));
    const double a = half_length(the_case, crack),
                 needed = crack.disc ? 0.5 * rock.toughness() * std::sqrt(numbers::PI / a)
                                     : rock.toughness() / std::sqrt(numbers::PI * a);
    const auto look_at = [&](const double across, const double along)
    {
      if (const double share = std::hypot(given - across, along) / needed;
          given > across && share > greatest)
      {
        greatest = share;
        number = c + 1;
      }
    };
    // Where the stress differs along it, linearly, K at its tip is that of so much of it.
    const double of_end = crack.disc ? 2. / 3. : 0.5;
    for (const FlatPart &part : stress_on(the_case, crack))
    {
      look_at(part.middle.across, part.middle.along);
      for (const OnPlane &end : part.ends)
        look_at((1. - of_end) * part.middle.across + of_end * end.across,
                (1. - of_end) * part.middle.along + of_end * end.along);
    }
  }
  if (number == 0)
    return; // none opens, or nobody knows the rock's toughness
  // Bonds of a coarse lattice, and a pressure that is put on at once, let cracks grow below what
  // statics say.
  constexpr double far_from_it = 0.5;
  std::ostringstream text;
  if (greatest >= 1.)
    text << "crack " << number << " grows"
         << (in_cracks ? "" : " once fluid comes to it, and as fast as it follows")
         << ", the longer it is the more easily, until walls or stress stop it, or the run ends";
  else if (greatest < far_from_it && !is_loaded(the_case))
    text << "crack " << number << " comes nearest to it, and does not grow";
  else
    text << "crack " << number
         << " comes nearest to it; by statics and alone in a large rock it does not grow, but with "
            "loads on the boundary, walls or cracks nearby, stress that differs along it, or a "
            "sudden pressure it may";
  numbers.push_back({"net pressure given / needed for growth", greatest, text.str()});
}
} // namespace


template <int dim>
void add_given_pressure(const Case<dim> &the_case,
                        const MeshSizes<dim> &mesh,
                        std::vector<SceneNumber> &numbers)
{
  const bool in_cracks = !std::isnan(the_case.scene.crack_pressure);
  const double given = in_cracks ? the_case.scene.crack_pressure
                                 : the_case.network.maximum_pressure().value_or(
                                     std::numeric_limits<double>::quiet_NaN()),
               across = least_compression_across_cracks(the_case);
  if (std::isnan(given) || std::isinf(across))
    return;
  if (across > 0.)
  {
    std::ostringstream text;
    text << "the least, of " << to_string(across, dimension::stress);
    if (given <= across)
      text << ": no crack of the deck opens"
           << (in_cracks ? "" : "; what flows goes through 'Fracture flow/Minimum aperture'");
    numbers.push_back(
      {"given pressure / in-situ stress across a crack", given / across, text.str()});
  }
  if (the_case.model->requirements().may_grow)
    add_growth(the_case, mesh, given, in_cracks, numbers);
}


template <int dim>
void add_shear_along_cracks(const Case<dim> &the_case, std::vector<SceneNumber> &numbers)
{
  constexpr double hardly_any = 1e-3; // of the stress in situ
  const Scene<dim> &scene = the_case.scene;
  const bool is_given = !std::isnan(scene.crack_pressure);
  // Where a crack slides most easily.
  OnPlane worst{0., 0., 0., 0.};
  double pressing = 1.;
  unsigned int number = 0;
  for (unsigned int c = 0; c < scene.cracks.size(); ++c)
    if (scene.cracks[c].kind == InitialCrack<dim>::Kind::open) // no other friction holds
      for_each_place<dim>(the_case, scene.cracks[c],
                          [&](const OnPlane &plane)
                          {
                            const double of_fluid = is_given                  ? scene.crack_pressure
                                                    : scene.has_pore_pressure ? plane.pores
                                                                              : plane.across,
                                         across = std::max(plane.across - of_fluid, 0.),
                                         more = plane.along * pressing - worst.along * across;
                            if (plane.along > hardly_any * plane.all &&
                                (more > 0. || (more == 0. && plane.along > worst.along)))
                            {
                              worst = plane;
                              pressing = across;
                              number = c + 1;
                            }
                          });
  if (number == 0)
    return;
  std::ostringstream text;
  text << "crack " << number << ": ";
  if (pressing > 0.)
    text << to_string(pressing, dimension::stress)
         << " presses its faces; with a friction coefficient of less than " << std::setprecision(3)
         << worst.along / pressing << " it slides at the start";
  else
    text << (worst.across <= 0. ? ""
             : !is_given && !scene.has_pore_pressure
               ? "its fluid is at the stress across it, for the rock has no pores that could take "
                 "it, so "
               : "its fluid is at the stress across it or above, so ")
         << "nothing presses its faces, and it slides at the start whatever their friction";
  numbers.push_back({"in-situ shear stress along a crack [Pa]", worst.along, text.str()});
}

template void add_pore_pressure(const Case<2> &, std::vector<SceneNumber> &);
template void add_given_pressure(const Case<2> &, const MeshSizes<2> &, std::vector<SceneNumber> &);
template void add_shear_along_cracks(const Case<2> &, std::vector<SceneNumber> &);
template void add_pore_pressure(const Case<3> &, std::vector<SceneNumber> &);
template void add_given_pressure(const Case<3> &, const MeshSizes<3> &, std::vector<SceneNumber> &);
template void add_shear_along_cracks(const Case<3> &, std::vector<SceneNumber> &);
} // namespace stockwork
