#include "in_situ_numbers.h"

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


template <int dim>
void add_given_pressure(const Case<dim> &the_case, std::vector<SceneNumber> &numbers)
{
  const bool in_cracks = !std::isnan(the_case.scene.crack_pressure);
  const double given = in_cracks ? the_case.scene.crack_pressure
                                 : the_case.network.maximum_pressure().value_or(
                                     std::numeric_limits<double>::quiet_NaN()),
               across = least_compression_across_cracks(the_case.scene);
  if (std::isnan(given) || !(across > 0.) || std::isinf(across))
    return;
  std::ostringstream text;
  text << "the least, of " << to_string(across, dimension::stress);
  if (given <= across)
    text << ": no crack of the deck opens"
         << (in_cracks ? "" : "; what flows goes through 'Fracture flow/Minimum aperture'");
  numbers.push_back({"given pressure / in-situ stress across a crack", given / across, text.str()});
}

template void add_pore_pressure(const Case<2> &, std::vector<SceneNumber> &);
template void add_given_pressure(const Case<2> &, std::vector<SceneNumber> &);
template void add_pore_pressure(const Case<3> &, std::vector<SceneNumber> &);
template void add_given_pressure(const Case<3> &, std::vector<SceneNumber> &);
} // namespace stockwork
