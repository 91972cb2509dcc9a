#include "coupling/initial_cracks.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "mesh/box_list.h"

#include <deal.II/base/utilities.h>

#include <limits>
#include <regex>
#include <sstream>

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
                        "';': '0, 0 -> 2 m, 0; 5, 1 -> 6, 2' [m]. In 3-D flat, round cracks: "
                        "'disc (0, 0, 0) normal (0, 0, 1) radius 2 m', with centre and radius [m] "
                        "and any vector across the crack.");
  prm.declare_entry(
    "Propped", "", Patterns::Anything(),
    "Cracks without any strength left that proppant holds open, as those above. Where "
    "the rock has pore pressure, there is no filter cake on their faces.");
  prm.declare_entry("Propped conductivity", "", Patterns::Anything(),
                    "Of the proppant in propped cracks, permeability times thickness: '500 md m' "
                    "[m^3]. Uniform along the crack.");
  prm.declare_entry(
    "Propped aperture", "0", Quantity(dimension::length, Range::non_negative()),
    "How far apart proppant holds the faces in the middle of a crack, or at its mouth [m], from "
    "the first step on; towards the tips it is less, so that the faces close smoothly there. Fluid "
    "pressure may open them farther. The fluid in the proppant's pores is not counted. Wants "
    "backward Euler. 0: the faces touch, and the crack presses on nothing around it.");
  prm.declare_entry(
    "Fluid pressure", "", Patterns::Anything(),
    "In all cracks, where it is given [Pa]; '0' in a dry case. 0 or more with explicit steps "
    "('Time/Scheme'). Empty: computed from the flow in the fractures.");
  prm.leave_subsection();
}


double given_crack_pressure(ParameterHandler &prm)
{
  prm.enter_subsection("Cracks");
  const std::string text = prm.get("Fluid pressure");
  prm.leave_subsection();
  if (text.empty())
    return std::numeric_limits<double>::quiet_NaN();
  try
  {
    return parse_finite_quantity(text, dimension::pressure);
  }
  catch (const InputError &error)
  {
    throw EntryError("Cracks/Fluid pressure", text, std::string("a pressure: ") + error.what());
  }
}


namespace
{
Proppant parse_proppant(ParameterHandler &prm)
{
  Proppant proppant;
  prm.enter_subsection("Cracks");
  const std::string conductivity = prm.get("Propped conductivity"),
                    aperture = prm.get("Propped aperture");
  const bool propped = !prm.get("Propped").empty(), computed = prm.get("Fluid pressure").empty();
  proppant.aperture = get_quantity(prm, "Propped aperture", dimension::length);
  prm.leave_subsection();

  const auto refuse_conductivity = [&](const std::string &allowed)
  { throw EntryError("Cracks/Propped conductivity", conductivity, allowed); };
  if (!propped && proppant.aperture > 0.)
    throw EntryError("Cracks/Propped aperture", aperture, "0 without cracks in 'Cracks/Propped'");
  if (!propped && !conductivity.empty())
    refuse_conductivity("nothing (an empty entry) without 'Cracks/Propped'");
  if (!computed && !conductivity.empty())
    refuse_conductivity("nothing (an empty entry) where 'Cracks/Fluid pressure' is given and no "
                        "flow is computed");
  if (!propped || !computed)
    return proppant;

  const std::string allowed = "a conductivity > 0, such as '500 md m'";
  try
  {
    proppant.conductivity = parse_finite_quantity(conductivity, dimension::conductivity);
  }
  catch (const InputError &error)
  {
    refuse_conductivity(allowed + ": " + error.what());
  }
  if (!(proppant.conductivity > 0.))
    refuse_conductivity(allowed);
  return proppant;
}


void parse_geometry(const std::string &text, InitialCrack<2> &crack)
{
  for (const std::string &corner : Utilities::split_string_list(text, "->"))
  {
    if (Utilities::split_string_list(corner, ',').size() != 2)
      throw EntryError(crack.entry, text, "corners with 2 coordinates each");
    crack.points.push_back(parse_point<2>(corner));
    const std::size_t n = crack.points.size();
    if (n > 1 && !(crack.points[n - 1].distance(crack.points[n - 2]) > 0.))
      throw EntryError(crack.entry, text, "corners that differ from the one before");
  }
  if (crack.points.size() < 2)
    throw EntryError(crack.entry, text, "at least two corners");
}


void parse_geometry(const std::string &text, InitialCrack<3> &crack)
{
  static const std::regex pattern(
    R"(\s*disc\s*(\([^)]*\))\s*normal\s*\(([^)]*)\)\s*radius\s*(.*\S)\s*)");
  std::smatch match;
  const auto numbers = [&]() { return split_list(match[2]); };
  if (!std::regex_match(text, match, pattern) || numbers().size() != 3)
    throw EntryError(crack.entry, text, "'disc (0, 0, 0) normal (0, 0, 1) radius 2 m' in 3-D");
  Disc<3> disc;
  disc.centre = parse_point<3>(match[1]);
  for (unsigned int d = 0; d < 3; ++d)
    disc.normal[d] = parse_finite_quantity(numbers()[d], dimension::number);
  disc.radius = parse_finite_quantity(match[3], dimension::length);
  if (!(disc.normal.norm() > 0.) || !(disc.radius > 0.))
    throw EntryError(crack.entry, text, "a normal other than (0, 0, 0) and a radius > 0");
  disc.normal /= disc.normal.norm();
  crack.disc = disc;
}


/// Whether the rim of a disc passes through a box; one that does not would cut it in two.
bool rim_within(const Disc<3> &disc, const Point<3> &lower, const Point<3> &upper)
{
  Tensor<1, 3> axis;
  axis[std::abs(disc.normal[0]) < 0.6 ? 0 : 1] = 1.;
  const Tensor<1, 3> across =
    cross_product_3d(disc.normal, axis) / cross_product_3d(disc.normal, axis).norm();
  const Tensor<1, 3> along = cross_product_3d(disc.normal, across);
  constexpr unsigned int n = 360;
  for (unsigned int i = 0; i < n; ++i)
  {
    const double angle = 2. * numbers::PI * i / n;
    const Point<3> point =
      disc.centre + disc.radius * (std::cos(angle) * across + std::sin(angle) * along);
    bool inside = true;
    for (unsigned int d = 0; d < 3; ++d)
      inside &= point[d] > lower[d] && point[d] < upper[d];
    if (inside)
      return true;
  }
  return false;
}
} // namespace


template <int dim>
std::vector<InitialCrack<dim>>
parse_initial_cracks(ParameterHandler &prm, const Point<dim> &lower, const Point<dim> &upper)
{
  std::vector<InitialCrack<dim>> cracks;
  const Proppant proppant = parse_proppant(prm);
  prm.enter_subsection("Cracks");
  for (const auto &[entry, kind] : {std::make_pair("Open", InitialCrack<dim>::Kind::open),
                                    std::make_pair("Cohesive", InitialCrack<dim>::Kind::cohesive),
                                    std::make_pair("Propped", InitialCrack<dim>::Kind::propped)})
    for (const std::string &text : Utilities::split_string_list(prm.get(entry), ';'))
    {
      if (text.empty())
        continue;
      InitialCrack<dim> crack;
      crack.kind = kind;
      crack.entry = std::string("Cracks/") + entry;
      crack.text = text;
      if (crack.kind == InitialCrack<dim>::Kind::propped)
        crack.proppant = proppant;
      try
      {
        parse_geometry(text, crack);
      }
      catch (const EntryError &)
      {
        throw;
      }
      catch (const InputError &error) // of a number in it
      {
        throw EntryError(crack.entry, text, std::string("lengths and numbers: ") + error.what());
      }
      std::vector<Point<dim>> within = crack.points;
      if (crack.disc)
        within = {crack.disc->centre};
      for (const Point<dim> &point : within)
        for (unsigned int d = 0; d < dim; ++d)
          if (point[d] < lower[d] || point[d] > upper[d])
          {
            std::string where;
            for (unsigned int e = 0; e < dim; ++e)
            {
              std::ostringstream coordinate;
              coordinate << point[e];
              where += (e > 0 ? ", " : "") + coordinate.str();
            }
            throw EntryError(crack.entry, text,
                             "a crack inside the domain; coordinate " + std::to_string(d + 1) +
                               " of (" + where + ") is not between " + std::to_string(lower[d]) +
                               " and " + std::to_string(upper[d]) + " m");
          }
      if constexpr (dim == 3)
        if (crack.disc && !rim_within(*crack.disc, lower, upper))
          throw EntryError(
            crack.entry, text,
            "a disc whose rim lies in the domain, in part at least: this one cuts it "
            "in two");
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
