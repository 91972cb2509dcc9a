#include "coupling/newton.h"

#include "stockwork/base/quantity.h"

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace stockwork
{
using namespace dealii;

template <int dim>
Point<dim> Newton<dim>::place_in_bulk(const unsigned int block) const
{
  const auto &residual = assembly.linear_system().residual_bulk.block(block);
  const types::global_dof_index first =
    block == 0 ? 0 : assembly.linear_system().residual_bulk.block(0).size();
  double greatest = -1.;
  types::global_dof_index worst = 0;
  for (const auto i : unknowns.owned()[block])
    if (std::abs(residual(i)) > greatest)
    {
      greatest = std::abs(residual(i));
      worst = first + i;
    }
  Point<dim> place;
  if (greatest == unknowns.communication.max(greatest))
  {
    std::map<types::global_dof_index, Point<dim>> points;
    DoFTools::map_dofs_to_support_points(unknowns.mapping, unknowns.dof_handler(), points);
    place = points.at(worst);
  }
  // Of ranks that share the greatest, which is rare, the place with the greatest coordinates.
  for (unsigned int d = 0; d < dim; ++d)
    place[d] = unknowns.communication.max(
      greatest == unknowns.communication.max(greatest) ? place[d] : -1e300);
  return place;
}


template <int dim>
void Newton<dim>::explain(NonlinearReport &report, const ResidualNorms &tolerances) const
{
  struct Equation
  {
    const char *name;
    double share; ///< of its tolerance
  };
  const auto share = [](const double norm, const double tolerance)
  { return norm / std::max(tolerance, 1e-300); };
  const Equation equations[] = {
    {"the balance of forces in the rock", share(norms.momentum, tolerances.momentum)},
    {"the balance of fluid in the pores", share(norms.mass, tolerances.mass)},
    {"the balance of forces on the fracture's faces", share(norms.extra, tolerances.extra)},
    {"the balance of fluid in the fracture",
     share(norms.fracture_fluid, tolerances.fracture_fluid)}};
  const unsigned int worst =
    std::max_element(std::begin(equations), std::end(equations),
                     [](const Equation &a, const Equation &b) { return a.share < b.share; }) -
    std::begin(equations);
  std::ostringstream text;
  text.precision(3);
  text << "; " << equations[worst].name << " is left with " << equations[worst].share
       << " times its tolerance";
  if (worst < 2)
    text << ", most of it at (" << place_in_bulk(worst) << ") m";
  else if (worst == 3 && unknowns.n_extra() > unknowns.n_mechanical_extra())
  {
    const auto &segments = network.segments();
    const std::vector<double> &residual = assembly.linear_system().residual_extra;
    const unsigned int n_model = unknowns.n_mechanical_extra();
    const auto greater = [](const double a, const double b) { return std::abs(a) < std::abs(b); };
    const unsigned int i = std::max_element(residual.begin() + n_model, residual.end(), greater) -
                           residual.begin() - n_model;
    if (i < segments.size() && network.unknown(segments[i].key))
      text << ", most of it at (" << segments[i].centre << ") m";
  }
  if (n_limited > 0)
    text << "; 'Nonlinear solver/Maximum pressure change' ("
         << (parameters.pressure_limit ? to_string(*parameters.pressure_limit, dimension::pressure)
                                       : "what pressures had changed by")
         << ") shortened " << n_limited << " of " << report.iterations << " iterations";
  if (n_halved > 0)
    text << "; " << n_halved << " were shortened because the residual grew";
  report.reason += text.str();
  report.advice =
    2 * n_limited > report.iterations
      ? "Try a greater 'Nonlinear solver/Maximum pressure change': the pressure has farther to go."
    : worst == 3
      ? "Try a greater 'Fracture flow/Minimum aperture' or a smaller 'Time/Minimum step'."
    : worst == 2
      ? "Try smaller cells where the fracture is, so that the part of it that still holds is "
        "resolved, more 'Nonlinear solver/Maximum iterations', or a smaller 'Time/Minimum step'."
      : "Try a smaller 'Time/Minimum step', or more 'Nonlinear solver/Maximum iterations'.";
}


template Point<2> Newton<2>::place_in_bulk(const unsigned int) const;
template Point<3> Newton<3>::place_in_bulk(const unsigned int) const;
template void Newton<2>::explain(NonlinearReport &, const ResidualNorms &) const;
template void Newton<3>::explain(NonlinearReport &, const ResidualNorms &) const;
} // namespace stockwork
