#include "flow/permeability_tensor.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork::permeability_tensor
{
using dealii::Point;
using dealii::Tensor;

void declare_parameters(dealii::ParameterHandler &prm)
{
  prm.declare_entry(
    "Fluid", "network", dealii::Patterns::Selection("network|permeability tensor"),
    "What carries the fluid along a fracture. network: pressures of its own, which may differ from "
    "the rock's within a cell. permeability tensor: the pore pressure's elements, which conduct as "
    "much as the fracture does along its cells, with the cubic law. The pressure falls from the "
    "fracture's to the rock's within one cell then, whatever the permeability. For porous rock and "
    "'Fracture flow/Leak-off = resolved'.");
}


bool is_chosen(dealii::ParameterHandler &prm)
{
  return prm.get("Fluid") == "permeability tensor";
}


double parse_fracture_flow(dealii::ParameterHandler &prm, const std::string &entry)
{
  prm.enter_subsection("Fracture flow");
  if (prm.get("Leak-off") != "resolved")
    throw EntryError("Fracture flow/Leak-off", prm.get("Leak-off"),
                     "'resolved' with '" + entry +
                       " = permeability tensor', where the pore pressure is that of the fractures");
  if (std::isfinite(get_quantity(prm, "Vapour pressure", dimension::pressure)))
    throw EntryError("Fracture flow/Vapour pressure", prm.get("Vapour pressure"),
                     "-inf with '" + entry +
                       " = permeability tensor': the elements of the pore pressure have no vapour");
  const double minimum_aperture = get_quantity(prm, "Minimum aperture", dimension::length);
  prm.leave_subsection();
  return minimum_aperture;
}


template <int dim>
Cell<dim>::Cell(const std::array<Point<dim>, n_functions> &vertices)
{
  using Reference = dealii::GeometryInfo<dim>;
  const dealii::QGauss<dim> quadrature(2);
  points.resize(quadrature.size());
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    const Point<dim> &x = quadrature.point(q);
    Tensor<2, dim> jacobian;
    for (unsigned int v = 0; v < n_functions; ++v)
      jacobian += outer_product(Tensor<1, dim>(vertices[v]),
                                Reference::d_linear_shape_function_gradient(x, v));
    const Tensor<2, dim> to_real = transpose(invert(jacobian));
    points[q].weight = quadrature.weight(q) * std::abs(determinant(jacobian));
    volume += points[q].weight;
    for (unsigned int v = 0; v < n_functions; ++v)
    {
      points[q].value[v] = Reference::d_linear_shape_function(x, v);
      points[q].gradient[v] = to_real * Reference::d_linear_shape_function_gradient(x, v);
    }
  }
}


template <int dim>
void add_flow(const Cell<dim> &cell,
              const Segment<dim> &segment,
              const ValueAndSlope &conductance,
              const double time_over_viscosity,
              const State &state,
              Sink &sink)
{
  constexpr unsigned int n = Cell<dim>::n_functions;
  const LinearFunctional &B = segment.opening, &P = segment.pore_pressure;
  LocalSystem local;
  local.bulk = P.bulk;
  local.bulk.insert(local.bulk.end(), B.bulk.begin(), B.bulk.end());
  local.extra = B.extra;
  local.reinit();
  const double height = cell.volume / segment.area, factor = time_over_viscosity / (12. * height);

  // Of each function, the flow that a unit of each does, over the conductance.
  dealii::FullMatrix<double> flow(n, n);
  std::array<Tensor<1, dim>, n> along, mean;
  for (const auto &at : cell.points)
  {
    for (unsigned int v = 0; v < n; ++v)
    {
      along[v] = at.gradient[v] - (at.gradient[v] * segment.normal) * segment.normal;
      mean[v] += at.weight / cell.volume * at.gradient[v];
    }
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        flow(a, b) += factor * at.weight * (along[a] * along[b]);
  }
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int b = 0; b < n; ++b)
      flow(a, b) +=
        factor * cell.volume * across * (mean[a] * segment.normal) * (mean[b] * segment.normal);

  for (unsigned int a = 0; a < n; ++a)
  {
    double sum = 0.;
    for (unsigned int b = 0; b < n; ++b)
    {
      sum += flow(a, b) * state.current.bulk(P.bulk[b]);
      local.matrix(a, b) -= conductance.value * flow(a, b);
    }
    local.residual(a) -= conductance.value * sum;
    for (unsigned int k = 0; k < B.bulk.size(); ++k)
      local.matrix(a, n + k) -= conductance.slope * B.bulk_coefficients[k] * sum;
    for (unsigned int k = 0; k < B.extra.size(); ++k)
      local.matrix(a, local.bulk.size() + k) -= conductance.slope * B.extra_coefficients[k] * sum;
  }
  sink.add(local);
}


#define INSTANTIATE(dim)                                                                         \
  template struct Cell<dim>;                                                                     \
  template void add_flow(const Cell<dim> &, const Segment<dim> &, const ValueAndSlope &, double, \
                         const State &, Sink &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::permeability_tensor
