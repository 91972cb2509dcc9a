#include "in_situ_numbers.h"

#include "scales.h"
#include "scene_estimates.h"

#include "stockwork/base/quantity.h"

#include "exchange/flat_parts.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// The least that presses the faces of a crack together in situ, in the middle of its parts [Pa];
/// infinity without a crack.
template <int dim>
double least_compression_across_cracks(const Scene<dim> &scene)
{
  double least = std::numeric_limits<double>::infinity();
  for (const InitialCrack<dim> &crack : scene.cracks)
    for (const auto &[place, normal] : flat_parts(crack))
      least = std::min(least, -(normal * (scene.in_situ_stress(place) * normal)));
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
/// The given pressure beside the one with which a crack of the deck begins to grow: K_Ic =
/// p sqrt(pi a), of a disc 2 p sqrt(a/pi) (Tada, Paris & Irwin 2000).
template <int dim>
void add_setting_out(const Case<dim> &the_case,
                     const double given,
                     const bool in_cracks,
                     std::vector<SceneNumber> &numbers)
{
  const double toughness = the_case.rock.main().toughness();
  // What a well feeds is the first one.
  const unsigned int n_cracks = in_cracks ? the_case.scene.cracks.size() : 1;
  double greatest = 0.;
  unsigned int number = 0;
  for (unsigned int c = 0; c < n_cracks; ++c)
  {
    const InitialCrack<dim> &crack = the_case.scene.cracks[c];
    if (crack.kind != InitialCrack<dim>::Kind::open)
      continue;
    const double a = half_length(the_case, crack),
                 needed = crack.disc ? 0.5 * toughness * std::sqrt(numbers::PI / a)
                                     : toughness / std::sqrt(numbers::PI * a),
                 share = (given - closing_stress(the_case.scene, crack)) / needed;
    if (share > greatest)
    {
      greatest = share;
      number = c + 1;
    }
  }
  if (number == 0)
    return;
  std::ostringstream text;
  text << "crack " << number;
  if (greatest < 1.)
    text << (n_cracks > 1 ? " comes nearest to it" : "") << ": no crack of the deck grows";
  else
    text
      << " grows" << (in_cracks ? "" : " as fast as fluid follows")
      << ", and the longer it is the more easily, until walls or stress stop it, or the run ends";
  numbers.push_back({"net pressure given / needed for growth", greatest, text.str()});
}
} // namespace


template <int dim>
void add_given_pressure(const Case<dim> &the_case, std::vector<SceneNumber> &numbers)
{
  const bool in_cracks = !std::isnan(the_case.scene.crack_pressure);
  const double given = in_cracks ? the_case.scene.crack_pressure
                                 : the_case.network.maximum_pressure().value_or(
                                     std::numeric_limits<double>::quiet_NaN()),
               across = least_compression_across_cracks(the_case.scene);
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
  if (given > across && the_case.model->requirements().may_grow &&
      the_case.rock.main().toughness() > 0.)
    add_setting_out(the_case, given, in_cracks, numbers);
}


template <int dim>
void add_shear_along_cracks(const Case<dim> &the_case, std::vector<SceneNumber> &numbers)
{
  constexpr double rounding = 1e-6; // of the stress in situ
  const Scene<dim> &scene = the_case.scene;
  // Of the crack that slides most easily.
  double shear = 0., pressing = 1.;
  unsigned int number = 0;
  for (unsigned int c = 0; c < scene.cracks.size(); ++c)
  {
    const InitialCrack<dim> &crack = scene.cracks[c];
    if (crack.kind != InitialCrack<dim>::Kind::open)
      continue; // what holds it is not friction alone
    const Point<dim> middle = flat_parts(crack).front().first;
    const double along = shear_stress(scene, crack);
    if (!(along > rounding * scene.in_situ_stress(middle).norm()))
      continue;
    const double of_fluid = !std::isnan(scene.crack_pressure) ? scene.crack_pressure
                            : scene.has_pore_pressure         ? scene.in_situ_pore_pressure(middle)
                                                              : closing_stress(scene, crack),
                 across = std::max(closing_stress(scene, crack) - of_fluid, 0.);
    if (along * pressing > shear * across)
    {
      shear = along;
      pressing = across;
      number = c + 1;
    }
  }
  if (number == 0)
    return;
  std::ostringstream text;
  text << "crack " << number << ": ";
  if (pressing > 0.)
    text << to_string(pressing, dimension::stress)
         << " presses its faces; with a friction coefficient of less than " << std::setprecision(3)
         << shear / pressing << " it slides at the start";
  else
    text << "its fluid is at the stress across it"
         << (std::isnan(scene.crack_pressure) && !scene.has_pore_pressure
               ? ", for the rock has no pores that could take it"
               : " or above")
         << ", so nothing presses its faces, and it slides at the start whatever their friction";
  numbers.push_back({"in-situ shear stress along a crack [Pa]", shear, text.str()});
}

template void add_pore_pressure(const Case<2> &, std::vector<SceneNumber> &);
template void add_given_pressure(const Case<2> &, std::vector<SceneNumber> &);
template void add_shear_along_cracks(const Case<2> &, std::vector<SceneNumber> &);
template void add_pore_pressure(const Case<3> &, std::vector<SceneNumber> &);
template void add_given_pressure(const Case<3> &, std::vector<SceneNumber> &);
template void add_shear_along_cracks(const Case<3> &, std::vector<SceneNumber> &);
} // namespace stockwork
