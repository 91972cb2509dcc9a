#include "flow/wells.h"

#include <algorithm>
#include <limits>

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

template <int dim>
dealii::Point<dim> parse_point(const std::string &text)
{
  dealii::Point<dim> point;
  std::size_t begin = 0;
  for (unsigned int d = 0; d < dim; ++d)
  {
    const std::size_t comma = d + 1 < dim ? text.find(',', begin) : text.size();
    if (comma == std::string::npos)
      throw InputError("too few coordinates");
    point[d] = parse_finite_quantity(text.substr(begin, comma - begin), dimension::length);
    begin = comma + 1;
  }
  return point;
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
                      "at which a fracture is closed.");
    prm.declare_alias("Minimum pressure", "Least pressure", true);
    prm.declare_entry(
      "Perforations", "", Patterns::Anything(),
      "Points where the well is open to a fracture: coordinates separated by "
      "',', points by ';'. Each must lie on an initial crack (to 2 % of its length), and "
      "opens into the segment of the fracture that is nearest.");
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
                                                const double boiling_pressure)
{
  const std::string path = "Wells/" + section(number) + "/";
  Well well;
  well.number = number;
  well.points = prm.get("Perforations");
  well.name = prm.get("Name").empty() ? section(number) : prm.get("Name");
  well.pressure_control = (prm.get("Control") == "pressure");
  well.value = well.pressure_control
                 ? TimeHistory(prm.get("Pressure"), dimension::pressure, path + "Pressure")
                 : TimeHistory(prm.get("Rate"), rate_dimension<dim>, path + "Rate");

  if (const std::string text = prm.get("Minimum pressure"); !text.empty())
  {
    const std::string allowed = "a pressure such as '5 MPa', of a well with control 'rate'";
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
  }
  else if (!well.pressure_control && well.value.least() < 0.)
    well.minimum_pressure = std::isfinite(boiling_pressure) ? boiling_pressure : 0.;

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
      well.perforations.push_back({parse_point<dim>(well.points.substr(begin, end - begin)), {}});
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
  return well;
}


template <int dim>
void Wells<dim>::parse_parameters(dealii::ParameterHandler &prm, const double boiling_pressure)
{
  wells.clear();
  prm.enter_subsection("Wells");
  for (unsigned int number = 1; number <= max_wells; ++number)
  {
    prm.enter_subsection(section(number));
    const std::string path = "Wells/" + section(number) + "/";
    const std::string control = prm.get("Control"), points = prm.get("Perforations");
    if (control == "none" && !points.empty())
      throw EntryError(path + "Control", "none",
                       "'rate' or 'pressure' for a well that has perforations");
    for (const auto &[entry, its_control] :
         {std::make_pair("Rate", "rate"), std::make_pair("Pressure", "pressure")})
      if (!prm.get(entry).empty() && prm.get(entry) != "0" && control != its_control)
        throw EntryError(path + "Control", control,
                         std::string("'") + its_control + "' for a well whose '" + entry +
                           "' is given");
    if (control != "none")
      wells.push_back(read_well(prm, number, boiling_pressure));
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
  allowed << "points on fractures; (" << perforation.point << ") is on " << what;
  return EntryError("Wells/" + section(well.number) + "/Perforations", well.points, allowed.str());
}


template <int dim>
void Wells<dim>::locate(const std::vector<NetworkSegment<dim>> &segments,
                        const bool pressure_is_given)
{
  for (Well &well : wells)
    for (Perforation &perforation : well.perforations)
    {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto &segment : segments)
        nearest = std::min(nearest, segment.centre.distance(perforation.point));

      perforation.segments.clear();
      for (unsigned int i = 0; i < segments.size(); ++i)
        if (segments[i].centre.distance(perforation.point) <= nearest + 1e-6 * segments[i].size())
          perforation.segments.push_back(i);

      const auto complain = [&](const std::string &what)
      { throw perforation_error(well, perforation, what); };
      if (segments.empty())
        complain("none, for there are none at the start. Give an initial crack");
      if (nearest > segments[perforation.segments.front()].size())
        complain("none; the nearest segment of one is at distance " + std::to_string(nearest) +
                 " m");
      if (pressure_is_given)
        complain("one whose pressure is given, so the well would have no effect");
    }
  for (Well &well : wells)
    well.initial_pressure = segments[well.perforations[0].segments[0]].initial_pressure;
}


template <int dim>
bool Wells<dim>::feeds(const unsigned int segment) const
{
  for (const Well &well : wells)
    for (const Perforation &perforation : well.perforations)
      if (std::find(perforation.segments.begin(), perforation.segments.end(), segment) !=
          perforation.segments.end())
        return true;
  return false;
}


template <int dim>
std::vector<ExtraUnknown> Wells<dim>::unknowns() const
{
  std::vector<ExtraUnknown> result;
  for (const Well &well : wells)
    for (unsigned int k = 0; k < well.n_unknowns(); ++k)
    {
      ExtraUnknown unknown;
      unknown.key = flow_key(std::uint64_t(well.number) << 32 | k, 2);
      if (k == well.perforations.size())
        unknown.initial = well.initial_pressure;
      result.push_back(unknown);
    }
  return result;
}


template <int dim>
void Wells<dim>::set_offset(unsigned int first_index)
{
  for (Well &well : wells)
  {
    well.first_index = first_index;
    first_index += well.n_unknowns();
  }
}


template <int dim>
double Wells<dim>::mean(const Perforation &perforation, const std::vector<double> &values)
{
  double sum = 0.;
  for (const unsigned int i : perforation.segments)
    sum += values[i];
  return sum / perforation.segments.size();
}


template <int dim>
double Wells<dim>::Well::flow(const StepContext &context,
                              const State &state,
                              const double compressibility) const
{
  double sum = 0.;
  for (unsigned int k = 0; k < perforations.size(); ++k)
    sum += perforation_rate(k, context, state);
  if (!is_direct() && !pressure_control)
    sum += volume * compressibility * context.fracture_pressure_factor() / context.fracture_dt() *
           (state.current.extra[pressure_index()] -
            state.fracture_reference(context).extra[pressure_index()]);
  return sum;
}


template <int dim>
double Wells<dim>::Well::rate(const StepContext &context,
                              const State &state,
                              const double compressibility) const
{
  return pressure_control || is_dry(context, state, compressibility)
           ? flow(context, state, compressibility)
           : given(context);
}


template <int dim>
void Wells<dim>::assemble(const StepContext &context,
                          const State &state,
                          const std::vector<double> &pressures,
                          const std::vector<unsigned int> &rows,
                          Sink &sink) const
{
  const double dt = context.fracture_dt();
  LocalSystem local;
  for (const Well &well : wells)
  {
    const bool dry = well.is_dry(context, state, compressibility);
    for (unsigned int k = 0; k < well.perforations.size(); ++k)
    {
      const Perforation &perforation = well.perforations[k];
      const unsigned int n = perforation.segments.size();
      const double q = well.perforation_rate(k, context, state);

      // Unknowns: the segments' pressures, y_k, p_b
      local.extra.clear();
      for (const unsigned int i : perforation.segments)
        local.extra.push_back(rows[i]);
      if (!well.is_direct())
        local.extra.push_back(well.first_index + k);
      if (!well.is_direct() && !well.pressure_control)
        local.extra.push_back(well.pressure_index());
      local.reinit();

      for (unsigned int i = 0; i < n; ++i)
        local.residual(i) = dt * q / n;
      if (!well.is_direct())
      {
        const double borehole_pressure =
          well.pressure_control ? well.given(context) : state.current.extra[well.pressure_index()];
        const double c = dt * well.conductance;
        local.residual(n) =
          c * (mean(perforation, pressures) - borehole_pressure + well.friction * q * std::abs(q));
        for (unsigned int i = 0; i < n; ++i)
          local.matrix(i, n) = local.matrix(n, i) = c / n;
        local.matrix(n, n) = c * 2. * well.friction * std::abs(q) * well.conductance;
        if (!well.pressure_control)
        {
          local.matrix(n, n + 1) = -c;
          if (!dry)
          {
            local.residual(n + 1) = -dt * q;
            local.matrix(n + 1, n) = -c;
          }
        }
      }
      sink.add(local);
    }

    if (!well.is_direct() && !well.pressure_control)
    {
      const unsigned int index = well.pressure_index();
      // The row of the balance, or that of the pressure, as a volume.
      const double c = dry ? dt * well.conductance
                           : well.volume * compressibility * context.fracture_pressure_factor();
      const double reference =
        dry ? well.minimum_pressure : state.fracture_reference(context).extra[index];
      local.extra = {index};
      local.reinit();
      local.residual(0) =
        (dry ? 0. : dt * well.given(context)) - c * (state.current.extra[index] - reference);
      local.matrix(0, 0) = -c;
      sink.add(local);
    }
  }
}


template <int dim>
FluidVolumes Wells<dim>::volumes(const StepContext &context, const State &state) const
{
  FluidVolumes volumes;
  for (const Well &well : wells)
  {
    const double rate = well.rate(context, state, compressibility);
    (rate > 0. ? volumes.injected : volumes.outflow) += std::abs(rate) * context.dt;
    if (!well.is_direct() && !well.pressure_control)
    {
      const unsigned int index = well.pressure_index();
      volumes.in_boreholes +=
        well.volume * compressibility *
        (state.current.extra[index] - state.fracture_reference(context).extra[index]) *
        context.fracture_pressure_factor() * context.dt / context.fracture_dt();
    }
  }
  return volumes;
}


template <int dim>
std::vector<WellReport> Wells<dim>::report(const StepContext &context,
                                           const State &state,
                                           const std::vector<double> &apertures,
                                           const std::vector<double> &pressures) const
{
  std::vector<WellReport> reports;
  for (const Well &well : wells)
  {
    WellReport report;
    report.name = well.name;
    report.rate = well.rate(context, state, compressibility);
    report.wanted_rate = well.pressure_control ? report.rate : well.given(context);
    for (unsigned int k = 0; k < well.perforations.size(); ++k)
      report.perforation_rates.push_back(well.perforation_rate(k, context, state));
    report.inlet_segment = well.perforations[0].segments[0];
    report.inlet_pressure = mean(well.perforations[0], pressures);
    report.inlet_aperture = mean(well.perforations[0], apertures);

    const double q = report.perforation_rates[0];
    report.borehole_pressure = report.inlet_pressure + well.friction * q * std::abs(q);
    reports.push_back(std::move(report));
  }
  return reports;
}


template <int dim>
void Wells<dim>::check(const std::vector<InitialCrack<dim>> &cracks) const
{
  std::vector<dealii::Point<dim>> earlier;
  for (const Well &well : wells)
    for (const Perforation &perforation : well.perforations)
    {
      const auto complain = [&](const std::string &what)
      { throw perforation_error(well, perforation, what); };
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
}


template <int dim>
std::vector<std::pair<std::string, double>> Wells<dim>::least_pressures() const
{
  std::vector<std::pair<std::string, double>> result;
  for (const Well &well : wells)
    if (well.is_bounded())
      result.emplace_back(well.name, well.minimum_pressure);
  return result;
}


template <int dim>
void Wells<dim>::set_scales(const double pressure, const double typical_rate)
{
  for (Well &well : wells)
  {
    const double rate = well.pressure_control ? 0. : well.value.magnitude() * well.fraction;
    well.conductance = (rate > 0. ? rate : typical_rate) / pressure;
  }
}


template <int dim>
double Wells<dim>::greatest_rate() const
{
  double greatest = 0.;
  for (const Well &well : wells)
    if (!well.pressure_control)
      greatest = std::max(greatest, well.value.magnitude());
  return greatest;
}


template <int dim>
std::optional<double> Wells<dim>::greatest_pressure() const
{
  std::optional<double> greatest;
  for (const Well &well : wells)
    if (well.pressure_control)
      greatest = std::max(greatest.value_or(0.), well.value.magnitude());
  return greatest;
}


template <int dim>
double Wells<dim>::first_rate(const double t) const
{
  return wells.empty() || wells[0].pressure_control ? 0. : wells[0].value(t, t);
}


template <int dim>
double Wells<dim>::first_fraction() const
{
  return wells.empty() ? 1. : wells[0].fraction;
}


template <int dim>
std::vector<dealii::Point<dim>> Wells<dim>::first_perforations() const
{
  std::vector<dealii::Point<dim>> points;
  if (!wells.empty())
    for (const Perforation &perforation : wells[0].perforations)
      points.push_back(perforation.point);
  return points;
}


template <int dim>
double Wells<dim>::next_jump(const double t) const
{
  double next = std::numeric_limits<double>::infinity();
  for (const Well &well : wells)
    next = std::min(next, well.value.next_jump(t));
  return next;
}


template <int dim>
bool Wells<dim>::starts_at(const double t) const
{
  return std::any_of(wells.begin(), wells.end(),
                     [t](const Well &well)
                     { return !well.pressure_control && well.value.rises_from_zero(t); });
}


template class Wells<2>;
template class Wells<3>;
} // namespace stockwork
