// What the deck says of wells, and what is wrong with it.
#include "flow/wells.h"

#include <algorithm>
#include <sstream>

#include "mesh/box_list.h"
#include "stockwork/base/error.h"

namespace stockwork
{
namespace
{
constexpr unsigned int max_wells = 8;

template <int dim>
constexpr Dimension rate_dimension = dim == 2 ? dimension::rate_per_thickness : dimension::rate;

// kappa in dp = kappa q^2
template <int dim>
constexpr Dimension friction_dimension =
  dim == 2 ? Dimension{-5, 1, 0, 0, "perforation friction", "Pa s^2/m^4", "1e12 Pa s^2/m^4"}
           : Dimension{-7, 1, 0, 0, "perforation friction", "Pa s^2/m^6", "1e10 Pa s^2/m^6"};

template <int dim>
constexpr Dimension volume_dimension = dim == 2 ? dimension::area : dimension::volume;

std::string section(const unsigned int number)
{
  return "Well " + std::to_string(number);
}
} // namespace


template <int dim>
void Wells<dim>::declare_parameters(dealii::ParameterHandler &prm)
{
  namespace Patterns = dealii::Patterns;
  prm.enter_subsection("Wells");
  for (unsigned int number = 1; number <= max_wells; ++number)
  {
    prm.enter_subsection(section(number));
    prm.declare_entry("Control", "none", Patterns::Selection("none|rate|pressure"),
                      "What is given: the rate of injection, the pressure in the borehole (of an "
                      "injector, or of a producer), or nothing: there is no such well.");
    prm.declare_entry("Name", "", Patterns::Anything(), "Of the well in the output.");
    const std::string forms = " A value; pieces, each from its time on, as in '0 s: 1e-4; 50 s: "
                              "0'; or an expression in SI units, as in 'f(t) = 1e-4*min(t/10,1)'.";
    prm.declare_entry("Rate", "", Patterns::Anything(),
                      "Of the whole well, both wings [m^3/s; m^2/s in 2-D]; negative: production. "
                      "With control 'rate'." +
                        forms);
    prm.declare_entry("Pressure", "", Patterns::Anything(),
                      "In the borehole [Pa]. With control 'pressure'." + forms);
    prm.declare_entry("Minimum pressure", "", Patterns::Anything(),
                      "In the borehole [Pa]. With control 'rate': a well cannot take what is not "
                      "there; at this pressure the rate is what flows. Empty: where the rate may "
                      "be negative, the 'Vapour pressure' of 'Fracture flow' if that is finite, "
                      "else 0: vacuum, or in unstressed rock, where pressures are net ones, that "
                      "at which a fracture is closed; no bound for a well into rock without an "
                      "in-situ pore pressure.");
    prm.declare_alias("Minimum pressure", "Least pressure", true);
    prm.declare_entry(
      "Perforations", "", Patterns::Anything(),
      "Points where the well is open: coordinates separated by ',', points by ';'. Into fractures: "
      "each must lie on an initial crack (to 2 % of its length), and opens into the segment of the "
      "fracture that is nearest. Into the rock: anywhere within it.");
    prm.declare_entry("Opens into", "fracture", Patterns::Selection("fracture|rock"),
                      "What takes or gives the fluid: fractures, or the pores of the rock around "
                      "each perforation, in 2-D of a line across the plane.");
    prm.declare_entry(
      "Borehole radius", "", Patterns::Anything(),
      "Of a well into the rock, in 3-D of a ball in place of a perforation [m]: the "
      "pressure in the borehole is that of steady radial flow around it. May be "
      "empty where that pressure decides nothing: one perforation, a given rate "
      "that is never negative, no 'Borehole volume' and no 'Minimum pressure'; it "
      "is not written then.");
    prm.declare_entry(
      "Source radius", "", Patterns::Anything(),
      "Over which the fluid of a perforation into the rock enters the pores [m]; at "
      "least a cell. Empty: two cells as they are there at the start, which is "
      "printed.");
    prm.declare_entry("Perforation friction", "0", Patterns::Anything(),
                      "kappa in the pressure drop kappa q^2 of each perforation [Pa s^2/m^6; "
                      "Pa s^2/m^4 in 2-D], q the rate "
                      "through all of it (both wings). Without friction, several perforations "
                      "are at equal pressure, which lets the longest fracture take everything.");
    prm.declare_entry("Fraction in model", "1", Patterns::Double(0., 1.),
                      "Share of the well that lies in the model: 0.5 where a symmetry plane "
                      "passes through it. Rate, friction and borehole volume are given for the "
                      "whole well.");
    prm.declare_entry("Borehole volume", "0", Patterns::Anything(),
                      "Of the fluid in the borehole [m^3; m^2 in 2-D], which is as compressible as "
                      "in the fracture.");
    prm.leave_subsection();
  }
  prm.leave_subsection();
}


template <int dim>
typename Wells<dim>::Well Wells<dim>::read_well(dealii::ParameterHandler &prm,
                                                const unsigned int number,
                                                const double vapour_pressure)
{
  const std::string path = "Wells/" + section(number) + "/";
  Well well;
  well.number = number;
  well.in_rock = prm.get("Opens into") == "rock";
  well.points = prm.get("Perforations");
  well.name = prm.get("Name").empty() ? section(number) : prm.get("Name");
  well.pressure_control = (prm.get("Control") == "pressure");
  well.value = well.pressure_control
                 ? TimeHistory(prm.get("Pressure"), dimension::pressure, path + "Pressure")
                 : TimeHistory(prm.get("Rate"), rate_dimension<dim>, path + "Rate");

  if (const std::string text = prm.get("Minimum pressure"); !text.empty())
  {
    const std::string allowed = "a pressure such as '5 MPa', of a well with control 'rate'";
    well.has_own_minimum = true;
    if (well.pressure_control)
      throw EntryError(path + "Minimum pressure", text, allowed);
    try
    {
      well.minimum_pressure = parse_finite_quantity(text, dimension::pressure);
    }
    catch (const InputError &)
    {
      throw EntryError(path + "Minimum pressure", text, allowed);
    }
    if (well.value.minimum() >= 0.)
      throw EntryError(path + "Minimum pressure", text,
                       "nothing (an empty entry), for this well never takes fluid: to hold a least "
                       "pressure it would inject more than its 'Rate'");
  }
  else if (!well.pressure_control && well.value.minimum() < 0.)
    well.minimum_pressure = std::isfinite(vapour_pressure) ? vapour_pressure : 0.;

  well.fraction = prm.get_double("Fraction in model");
  if (!(well.fraction > 0.))
    throw EntryError(path + "Fraction in model", prm.get("Fraction in model"),
                     "a number > 0, up to 1");
  const auto non_negative = [&](const std::string &entry, const Dimension &dimension)
  {
    const std::string text = prm.get(entry);
    try
    {
      return Quantity(dimension, Range::non_negative()).parse(text);
    }
    catch (const InputError &)
    {
      throw EntryError(path + entry, text,
                       "a value >= 0, such as '" + std::string(dimension.example) + "'");
    }
  };
  well.friction =
    non_negative("Perforation friction", friction_dimension<dim>) / (well.fraction * well.fraction);
  well.volume = non_negative("Borehole volume", volume_dimension<dim>) * well.fraction;

  try
  {
    for (std::size_t begin = 0; begin < well.points.size();)
    {
      const std::size_t end = std::min(well.points.find(';', begin), well.points.size());
      well.perforations.push_back(
        {parse_point<dim>(well.points.substr(begin, end - begin)), {}, {}});
      begin = end + 1;
    }
    if (well.perforations.empty())
      throw InputError("none");
  }
  catch (const InputError &)
  {
    throw EntryError(path + "Perforations", well.points,
                     std::string("one or more points, ") +
                       (dim == 2 ? "'0, 0; 1 m, 20 cm'" : "'0, 0, 0; 1 m, 20 cm, 0'"));
  }
  read_source(prm, path, well);
  return well;
}


template <int dim>
void Wells<dim>::read_source(dealii::ParameterHandler &prm, const std::string &path, Well &well)
{
  const auto radius = [&](const std::string &entry, const bool needed, const std::string &allowed)
  {
    const std::string text = prm.get(entry);
    if (text.empty() && !needed)
      return 0.;
    if (!text.empty() && !well.in_rock)
      throw EntryError(path + entry, text,
                       "nothing (an empty entry) for a well that opens into fractures: 'Opens into "
                       "= rock'");
    try
    {
      return Quantity(dimension::length, Range::positive()).parse(text);
    }
    catch (const InputError &)
    {
      throw EntryError(path + entry, text, allowed);
    }
  };
  const double borehole = radius(
    "Borehole radius", well.in_rock && !well.is_direct(),
    "a radius > 0, such as '10 cm', of a well into the rock whose borehole's pressure counts "
    "(which is given or bounded, shared by perforations, or stores fluid)");
  const double source = radius("Source radius", false, "a radius > 0, such as '2 m'");
  if (!well.in_rock)
    return;
  for (Perforation &perforation : well.perforations)
    perforation.source.emplace(
      typename PointSource<dim>::Entries{perforation.point, well.fraction, borehole, source});
}


/// Of a well that is not there.
void refuse_entries(const dealii::ParameterHandler &prm, const std::string &path)
{
  constexpr std::pair<const char *, const char *> defaults[] = {
    {"Perforations", ""},          {"Name", ""},
    {"Minimum pressure", ""},      {"Opens into", "fracture"},
    {"Borehole radius", ""},       {"Source radius", ""},
    {"Perforation friction", "0"}, {"Borehole volume", "0"},
    {"Fraction in model", "1"}};
  for (const auto &[entry, otherwise] : defaults)
    if (prm.get(entry) != otherwise)
      throw EntryError(path + "Control", "none",
                       std::string("'rate' or 'pressure' for a well whose '") + entry +
                         "' is given");
}


template <int dim>
void Wells<dim>::parse_parameters(dealii::ParameterHandler &prm, const double vapour_pressure)
{
  wells.clear();
  prm.enter_subsection("Wells");
  for (unsigned int number = 1; number <= max_wells; ++number)
  {
    prm.enter_subsection(section(number));
    const std::string path = "Wells/" + section(number) + "/";
    const std::string control = prm.get("Control");
    if (control == "none")
      refuse_entries(prm, path);
    for (const auto &[entry, its_control] :
         {std::make_pair("Rate", "rate"), std::make_pair("Pressure", "pressure")})
      if (!prm.get(entry).empty() && prm.get(entry) != "0" && control != its_control)
        throw EntryError(path + "Control", control,
                         std::string("'") + its_control + "' for a well whose '" + entry +
                           "' is given");
    if (control != "none")
      wells.push_back(read_well(prm, number, vapour_pressure));
    prm.leave_subsection();
  }
  prm.leave_subsection();
}


template <int dim>
EntryError Wells<dim>::perforation_error(const Well &well,
                                         const Perforation &perforation,
                                         const std::string &what)
{
  std::ostringstream allowed;
  allowed << "points " << (well.in_rock ? "in the rock" : "on fractures") << "; ("
          << perforation.point << ") " << what;
  return EntryError("Wells/" + section(well.number) + "/Perforations", well.points, allowed.str());
}


template <int dim>
void Wells<dim>::check(const std::vector<InitialCrack<dim>> &cracks) const
{
  std::vector<dealii::Point<dim>> earlier;
  for (const Well &well : wells)
    for (const Perforation &perforation : well.perforations)
    {
      if (well.in_rock)
        continue;
      const auto complain = [&](const std::string &what)
      { throw perforation_error(well, perforation, "is on " + what); };
      const InitialCrack<dim> *nearest = nullptr;
      for (const InitialCrack<dim> &crack : cracks)
        if (nearest == nullptr ||
            crack.distance(perforation.point) < nearest->distance(perforation.point))
          nearest = &crack;
      if (nearest == nullptr)
        complain("none. Give an initial crack there");
      const double distance = nearest->distance(perforation.point), size = nearest->size();
      if (!(distance <= 0.02 * size))
        complain("none; '" + nearest->text + "' passes at a distance of " +
                 to_string(distance, dimension::length) +
                 ". Give an initial crack there, or move the point onto this one");
      for (const InitialCrack<dim> &crack : cracks)
        if (&crack != nearest &&
            crack.distance(perforation.point) <= distance + 1e-6 * crack.size())
          complain("two cracks at once, '" + nearest->text + "' and '" + crack.text +
                   "'; move it onto one of them");
      for (const auto &other : earlier)
        if (other.distance(perforation.point) <= 1e-6 * size)
          complain("one that is perforated at this place already; each perforation is given once");
      earlier.push_back(perforation.point);
    }
  for (auto well = wells.begin(); well != wells.end(); ++well)
    for (auto point = well->perforations.begin(); point != well->perforations.end(); ++point)
      for (auto other_well = well; well->in_rock && other_well != wells.end(); ++other_well)
        for (auto other = other_well == well ? point + 1 : other_well->perforations.begin();
             other != other_well->perforations.end(); ++other)
          if (other_well->in_rock && other->point == point->point)
            throw perforation_error(*other_well, *other,
                                    "is perforated already; each perforation is given once");
}


template <int dim>
void Wells<dim>::check(const double start_time, const double end_time, const bool rock_gives) const
{
  for (const Well &well : wells)
  {
    well.value.check(start_time, end_time);
    if (well.pressure_control)
      well.value.check_starts_by(start_time);
    if (well.volume > 0. && (well.pressure_control || !(compressibility > 0.)))
      throw EntryError("Wells/" + section(well.number) + "/Borehole volume",
                       to_string(well.volume / well.fraction, volume_dimension<dim>),
                       well.pressure_control
                         ? "0 for a well with control 'pressure', whose fluid is not counted"
                         : "0 with a fluid that is incompressible ('Fluid/Bulk modulus'), which "
                           "the borehole cannot store");
  }
  if (!rock_gives && wells.size() == 1 && !wells[0].in_rock && !wells[0].pressure_control &&
      wells[0].value.minimum() < 0. && wells[0].value.maximum() <= 0.)
    wells[0].value.refuse("a rate that is positive at some time: in rock whose pores give no fluid "
                          "('Fracture flow/Leak-off' is not 'resolved') a closed crack holds "
                          "nothing that could be produced");
}


#define INSTANTIATE(dim)                                                               \
  template void Wells<dim>::declare_parameters(dealii::ParameterHandler &);            \
  template void Wells<dim>::parse_parameters(dealii::ParameterHandler &, double);      \
  template EntryError Wells<dim>::perforation_error(const Well &, const Perforation &, \
                                                    const std::string &);              \
  template void Wells<dim>::check(const std::vector<InitialCrack<dim>> &) const;       \
  template void Wells<dim>::check(double, double, bool) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork
