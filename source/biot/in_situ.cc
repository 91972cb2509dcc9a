#include "biot/in_situ.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

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
  prm.declare_entry("Stress", "", Quantities(dimension::stress),
                    "Total stress, tension positive: xx, yy[, zz] or with the shear components xy "
                    "(2-D), xy, xz, yz (3-D) behind them. Empty: none.");
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
double InSitu<dim>::pore_pressure(const Point<dim> &point) const
{
  return pressure_0 + (point[dim - 1] - datum) * pressure_gradient;
}


template class InSitu<2>;
template class InSitu<3>;
} // namespace stockwork
