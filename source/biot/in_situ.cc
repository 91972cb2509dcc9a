#include "biot/in_situ.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <cmath>

namespace stockwork
{
using namespace dealii;

namespace
{
template <int dim>
SymmetricTensor<2, dim>
parse_stress(const ParameterHandler &prm, const std::string &entry, const Dimension &dimension)
{
  constexpr unsigned int n = SymmetricTensor<2, dim>::n_independent_components;
  const std::vector<double> values = get_quantities(prm, entry, dimension);
  SymmetricTensor<2, dim> stress;
  if (values.empty())
    return stress;
  if (values.size() != dim && values.size() != n)
    throw EntryError("In situ/" + entry, prm.get(entry),
                     dim == 2 ? "xx, yy or xx, yy, xy" : "xx, yy, zz or xx, yy, zz, xy, xz, yz");
  for (unsigned int i = 0; i < values.size(); ++i)
    stress.access_raw_entry(i) = values[i];
  return stress;
}
} // namespace


template <int dim>
void InSitu<dim>::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("In situ");
  prm.declare_entry(
    "Stress", "", Quantities(dimension::stress),
    "Total stress, tension positive. In 2-D: xx, yy or xx, yy, xy. In 3-D: xx, yy, zz or xx, "
    "yy, zz, xy, xz, yz. Empty: none.");
  prm.declare_entry("Stress across the plane", "", Quantity(dimension::stress, Range::finite(), ""),
                    "Total zz in 2-D, the same everywhere; empty: that of plane strain, nu (xx + "
                    "yy) of the effective stress. Rock that yields asks for it.");
  prm.declare_entry("Stress gradient", "", Quantities(dimension::pressure_gradient),
                    "Change of the components per metre upwards (along the last coordinate).");
  prm.declare_entry("Pore pressure", "0 Pa", Quantity(dimension::pressure), "At the datum.");
  prm.declare_entry("Pore pressure gradient", "0 Pa/m", Quantity(dimension::pressure_gradient),
                    "Per metre upwards; taken to be in equilibrium with the fluid's weight.");
  prm.declare_entry("Datum", "0 m", Quantity(dimension::length),
                    "Height (last coordinate) at which the values above hold.");
  prm.leave_subsection();
}


template <int dim>
void InSitu<dim>::parse_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("In situ");
  stress_0 = parse_stress<dim>(prm, "Stress", dimension::stress);
  stress_gradient = parse_stress<dim>(prm, "Stress gradient", dimension::pressure_gradient);
  across_plane = get_optional_quantity(prm, "Stress across the plane", dimension::stress);
  if (dim == 3 && across_plane)
    throw EntryError("In situ/Stress across the plane", prm.get("Stress across the plane"),
                     "nothing (an empty entry) in 3-D: 'In situ/Stress' has a zz");
  pressure_0 = get_quantity(prm, "Pore pressure", dimension::pressure);
  pressure_gradient = get_quantity(prm, "Pore pressure gradient", dimension::pressure_gradient);
  datum = get_quantity(prm, "Datum", dimension::length);
  prm.leave_subsection();
}


template <int dim>
SymmetricTensor<2, dim> InSitu<dim>::stress(const Point<dim> &point) const
{
  return stress_0 + (point[dim - 1] - datum) * stress_gradient;
}


template <int dim>
SymmetricTensor<2, 3> InSitu<dim>::tensor(const Point<dim> &point, const RockProperties &rock) const
{
  const SymmetricTensor<2, dim> known = stress(point);
  SymmetricTensor<2, 3> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result[i][j] = known[i][j];
  if (dim == 2)
    result[2][2] =
      across_plane.value_or(rock.plane_stress ? 0.
                                              : rock.poisson_ratio * trace(known) -
                                                  (1. - 2. * rock.poisson_ratio) *
                                                    rock.biot_coefficient * pore_pressure(point));
  return result;
}


template <int dim>
double InSitu<dim>::pore_pressure(const Point<dim> &point) const
{
  return pressure_0 + (point[dim - 1] - datum) * pressure_gradient;
}


namespace
{
/// Places where the traction across a crack is looked at, with the normal there.
template <int dim>
std::vector<std::pair<Point<dim>, Tensor<1, dim>>> places_across(const InitialCrack<dim> &crack)
{
  std::vector<std::pair<Point<dim>, Tensor<1, dim>>> places;
  if (crack.disc)
    for (const double side : {-1., 1.})
    {
      // The highest and the lowest point of the rim.
      Tensor<1, dim> up;
      up[dim - 1] = 1.;
      up -= (up * crack.disc->normal) * crack.disc->normal;
      if (up.norm() > 1e-10)
        up *= side * crack.disc->radius / up.norm();
      places.emplace_back(crack.disc->centre + up, crack.disc->normal);
    }
  if constexpr (dim == 2)
    for (unsigned int i = 0; i + 1 < crack.points.size(); ++i)
    {
      const Tensor<1, dim> along = crack.points[i + 1] - crack.points[i];
      if (along.norm() > 0.)
        for (const Point<dim> &end : {crack.points[i], crack.points[i + 1]})
          places.emplace_back(end, Point<dim>(-along[1], along[0]) / along.norm());
    }
  return places;
}
} // namespace


template <int dim>
void InSitu<dim>::check(ParameterHandler &prm,
                        const double rock_density,
                        const std::vector<InitialCrack<dim>> &fluid_filled,
                        std::vector<std::string> &warnings) const
{
  // For messages and plausibility only: of water, and a density that no rock has.
  constexpr double gravity = 9.81, fluid_density = 1000., maximum_density = 2e4;
  prm.enter_subsection("In situ");
  const std::string stress_text = prm.get("Stress"), gradient_text = prm.get("Stress gradient"),
                    pressure_text = prm.get("Pore pressure gradient");
  prm.leave_subsection();

  // div sigma = rho g upwards, and nothing sideways.
  for (unsigned int d = 0; d + 1 < dim; ++d)
    if (stress_gradient[d][dim - 1] != 0.)
      throw EntryError("In situ/Stress gradient", gradient_text,
                       "no gradient of a shear component with the vertical: nothing would hold the "
                       "rock sideways");
  const double weight = stress_gradient[dim - 1][dim - 1];
  if (weight < 0. || weight > maximum_density * gravity)
    throw EntryError("In situ/Stress gradient", gradient_text,
                     "a vertical component that is in equilibrium with the rock's weight, rho g: "
                     "compression grows downwards");
  if (pressure_gradient > 0. || pressure_gradient < -maximum_density * gravity)
    throw EntryError("In situ/Pore pressure gradient", pressure_text,
                     "a value in equilibrium with the fluid's weight, -rho g: "
                     "the pressure grows downwards");
  const auto is_unlike = [](const double value, const double usual)
  { return value != 0. && usual > 0. && std::abs(value - usual) > 0.25 * usual; };
  if (is_unlike(weight, rock_density * gravity))
    warnings.push_back("'In situ/Stress gradient': the vertical stress changes by " +
                       to_string(weight, dimension::pressure_gradient) +
                       ", the weight of rock of the deck's density is " +
                       to_string(rock_density * gravity, dimension::pressure_gradient) + ".");
  if (is_unlike(-pressure_gradient, fluid_density * gravity))
    warnings.push_back("'In situ/Pore pressure gradient': the pore pressure changes by " +
                       to_string(pressure_gradient, dimension::pressure_gradient) +
                       ", the weight of water makes " +
                       to_string(-fluid_density * gravity, dimension::pressure_gradient) +
                       ": fluid would flow before anything is injected.");

  bool pressed_open = false;
  for (const InitialCrack<dim> &crack : fluid_filled)
    for (const auto &[place, normal] : places_across(crack))
    {
      const double across = normal * (stress(place) * normal);
      // What rounding leaves of a stress of zero across a crack is none.
      if (across > 1e-9 * stress(place).norm())
        throw EntryError("In situ/Stress", stress_text,
                         "compression (negative) across cracks that fluid is to fill; across '" +
                           crack.text + "' there is a tension of " +
                           to_string(across, dimension::stress));
      const double tension = eigenvalues(stress(place))[0];
      if (tension > 1e-9 * stress(place).norm())
        throw EntryError("In situ/Stress", stress_text,
                         "compression in every direction where fluid is to fill cracks; at '" +
                           crack.text + "' there is a tension of " +
                           to_string(tension, dimension::stress) + " in one");
      pressed_open = pressed_open || (across < 0. && pore_pressure(place) > -across);
    }
  if (pressed_open)
    warnings.push_back("'In situ/Pore pressure' is greater than the compression across a crack: it "
                       "would be open before anything is injected.");
}


template class InSitu<2>;
template class InSitu<3>;
} // namespace stockwork
