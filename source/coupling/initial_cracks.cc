#include "coupling/initial_cracks.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <deal.II/base/utilities.h>

#include <limits>

namespace stockwork
{
using namespace dealii;

void declare_initial_cracks(ParameterHandler &prm)
{
  prm.enter_subsection("Cracks");
  for (const auto &[name, meaning] :
       {std::make_pair("Open", "without any strength left: notches and open fractures"),
        std::make_pair("Cohesive", "with the rock's strength, so far undamaged")})
    prm.declare_entry(name, "", Patterns::Anything(),
                      std::string("Cracks ") + meaning +
                        ". Corners of polylines, 'x, y', separated by '->'; cracks separated by "
                        "';': '0, 0 -> 2 m, 0; 5, 1 -> 6, 2' [m].");
  prm.declare_entry(
    "Fluid pressure", "", Patterns::Anything(),
    "In all cracks, where it is given [Pa]; '0' in a dry case. Empty: computed from "
    "the flow in the fractures.");
  prm.leave_subsection();
}


double given_crack_pressure(ParameterHandler &prm)
{
  prm.enter_subsection("Cracks");
  const std::string text = prm.get("Fluid pressure");
  prm.leave_subsection();
  return text.empty() ? std::numeric_limits<double>::quiet_NaN()
                      : parse_quantity(text, dimension::pressure);
}


template <int dim>
std::vector<InitialCrack<dim>>
parse_initial_cracks(ParameterHandler &prm, const Point<dim> &lower, const Point<dim> &upper)
{
  std::vector<InitialCrack<dim>> cracks;
  prm.enter_subsection("Cracks");
  for (const auto &[entry, kind] : {std::make_pair("Open", InitialCrack<dim>::Kind::open),
                                    std::make_pair("Cohesive", InitialCrack<dim>::Kind::cohesive)})
    for (const std::string &text : Utilities::split_string_list(prm.get(entry), ';'))
    {
      if (text.empty())
        continue;
      InitialCrack<dim> crack;
      crack.kind = kind;
      crack.entry = std::string("Cracks/") + entry;
      crack.text = text;
      for (const std::string &corner : Utilities::split_string_list(text, "->"))
      {
        const auto numbers = Utilities::split_string_list(corner, ',');
        if (numbers.size() != dim)
          throw EntryError(std::string("Cracks/") + entry, text,
                           "corners with " + std::to_string(dim) + " coordinates each");
        Point<dim> point;
        for (unsigned int d = 0; d < dim; ++d)
        {
          point[d] = parse_quantity(numbers[d], dimension::length);
          if (point[d] < lower[d] || point[d] > upper[d])
            throw EntryError(std::string("Cracks/") + entry, text,
                             "a crack inside the domain; coordinate " + std::to_string(d + 1) +
                               " of (" + corner + ") is not between " + std::to_string(lower[d]) +
                               " and " + std::to_string(upper[d]) + " m");
        }
        crack.points.push_back(point);
      }
      if (crack.points.size() < 2)
        throw EntryError(std::string("Cracks/") + entry, text, "at least two corners");
      cracks.push_back(crack);
    }
  prm.leave_subsection();
  return cracks;
}


template std::vector<InitialCrack<2>>
parse_initial_cracks<2>(ParameterHandler &, const Point<2> &, const Point<2> &);
template std::vector<InitialCrack<3>>
parse_initial_cracks<3>(ParameterHandler &, const Point<3> &, const Point<3> &);
} // namespace stockwork
