#include "flow/network.h"

#include <algorithm>
#include <stdexcept>

#include "flow/conductivity.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork
{
template <int dim>
void Network<dim>::declare_parameters(dealii::ParameterHandler &prm)
{
  namespace Patterns = dealii::Patterns;
  prm.enter_subsection("Fracture flow");
  prm.declare_entry(
    "Minimum aperture", "", Quantity(dimension::length, Range::positive(), ""),
    "w_min in the hydraulic aperture (w^4 + w_min^4)^(1/4). Enters the conductivity "
    "only, never the volume. Small beside the aperture near the tip: a larger "
    "value lets viscous fluid run ahead. Empty: a hundredth of the aperture that the first crack "
    "has when it sets out, by toughness or viscosity, which is printed.");
  prm.declare_entry(
    "Vapour pressure", "-inf",
    Quantity(dimension::pressure, Range{-INFINITY, INFINITY, false, true}),
    "Cavitation pressure: where a segment cannot be filled at it, the rest is vapour, and "
    "the fluid lags behind the tip. Where pressures are net ones, for the rock "
    "is unstressed, it is minus the stress that is left out. -inf: the fluid fills "
    "every tip, by suction if need be. Not with Carter's leak-off, BDF2, nor a "
    "permeability tensor.");
  prm.declare_alias("Vapour pressure", "Least pressure", true);
  prm.declare_entry("Leak-off", "none", Patterns::Selection("none|carter|filter cake|resolved"),
                    "How fluid passes from fractures into the rock. carter: C_L/sqrt(t-t_0) "
                    "per face, out of the model. filter cake: c_l (p_f - p_m) per face, into the "
                    "rock's pores if it has them. resolved: the fracture is at the pore pressure "
                    "of the rock.");
  prm.declare_entry("Carter coefficient", "0", Quantity(dimension::carter, Range::non_negative()),
                    "C_L of one face.");
  prm.declare_entry("Filter cake coefficient", "0",
                    Quantity(dimension::leakoff_per_pressure, Range::non_negative()),
                    "c_l of one face.");
  prm.leave_subsection();
  Wells<dim>::declare_parameters(prm);
}


template <int dim>
void Network<dim>::parse_parameters(dealii::ParameterHandler &prm)
{
  prm.enter_subsection("Fracture flow");
  vapour_pressure = get_quantity(prm, "Vapour pressure", dimension::pressure);
  const std::string vapour_text = prm.get("Vapour pressure");
  carter_coefficient = get_quantity(prm, "Carter coefficient", dimension::carter);
  filter_cake_coefficient =
    get_quantity(prm, "Filter cake coefficient", dimension::leakoff_per_pressure);
  const std::string law = prm.get("Leak-off"), carter_text = prm.get("Carter coefficient"),
                    cake_text = prm.get("Filter cake coefficient");
  leak_off = law == "carter"        ? LeakOff::carter
             : law == "filter cake" ? LeakOff::filter_cake
             : law == "resolved"    ? LeakOff::resolved
                                    : LeakOff::none;
  prm.leave_subsection();
  if (leak_off == LeakOff::carter && carter_coefficient == 0.)
    throw EntryError("Fracture flow/Carter coefficient", "0", "a value > 0 with Carter leak-off");
  if (leak_off == LeakOff::carter && may_cavitate())
    throw EntryError("Fracture flow/Vapour pressure", vapour_text,
                     "-inf with Carter leak-off, which takes fluid that may not be there");
  if (leak_off == LeakOff::filter_cake && filter_cake_coefficient == 0.)
    throw EntryError("Fracture flow/Filter cake coefficient", "0",
                     "a value > 0 with leak-off through a filter cake");
  if (leak_off != LeakOff::carter && carter_coefficient != 0.)
    throw EntryError("Fracture flow/Carter coefficient", carter_text,
                     "0 with 'Leak-off = " + law + "': it belongs to 'carter'");
  if (leak_off != LeakOff::filter_cake && filter_cake_coefficient != 0.)
    throw EntryError("Fracture flow/Filter cake coefficient", cake_text,
                     "0 with 'Leak-off = " + law + "': it belongs to 'filter cake'");
  all_wells.parse_parameters(prm, vapour_pressure);
}


template <int dim>
void Network<dim>::set_fluid(const double viscosity,
                             const double compressibility,
                             const double rock_mobility)
{
  this->viscosity = viscosity;
  this->compressibility = compressibility;
  this->rock_mobility = rock_mobility;
  all_wells.set_compressibility(compressibility);
}


template <int dim>
void Network<dim>::set_pressures(
  const double given,
  std::function<dealii::SymmetricTensor<2, dim>(const dealii::Point<dim> &)> in_situ_stress)
{
  given_pressure = given;
  this->in_situ_stress = std::move(in_situ_stress);
}


template <int dim>
void Network<dim>::set_scales(const double minimum_aperture,
                              const double pressure,
                              const double aperture,
                              const double length)
{
  this->minimum_aperture = minimum_aperture;
  pressure_scale = pressure;
  const double conductance = aperture * aperture * aperture / (12. * viscosity * length);
  all_wells.set_scales(pressure, pressure * conductance * (dim == 2 ? 1. : length));
}


template <int dim>
void Network<dim>::set_segments(const dealii::ArrayView<const Segment<dim>> &segments,
                                const Collectives &collectives,
                                const EarlierValue &earlier)
{
  owned.assign(segments.begin(), segments.end());

  std::vector<SegmentNumbers<dim>> numbers;
  std::vector<typename Segment<dim>::Neighbour> neighbours; // one array is sent faster than many
  for (const Segment<dim> &segment : owned)
  {
    numbers.push_back({segment.key, segment.part_of, segment.centre, segment.normal, segment.area,
                       segment.pore_pressure.constant, !segment.pore_pressure.bulk.empty(),
                       segment.region, segment.pore_distance, segment.has_pressure_of_pores,
                       segment.share_of_pores, bridges_count(segment) ? segment.bare_aperture : 0.,
                       segment.propped_conductivity, collectives.rank(), segment.at_tip,
                       static_cast<unsigned int>(segment.neighbours.size())});
    neighbours.insert(neighbours.end(), segment.neighbours.begin(), segment.neighbours.end());
  }
  numbers = collectives.gather(numbers);
  neighbours = collectives.gather(neighbours);
  network.clear();
  auto begin = neighbours.cbegin();
  for (const SegmentNumbers<dim> &segment : numbers)
  {
    const auto end = begin + segment.n_neighbours;
    network.push_back({segment, {begin, end}, 0.});
    begin = end;
  }
  std::stable_sort(network.begin(), network.end(),
                   [](const auto &a, const auto &b) { return a.key < b.key; });
  // Of a segment that several ranks have parts of, the first is the owner.
  network.erase(std::unique(network.begin(), network.end(),
                            [](const auto &a, const auto &b) { return a.key == b.key; }),
                network.end());
  for (NetworkSegment<dim> &segment : network)
    segment.initial_pressure = initial_pressure(segment, earlier);

  const auto find = [&](const std::uint64_t key) -> unsigned int
  {
    const auto place =
      std::lower_bound(network.begin(), network.end(), key,
                       [](const auto &a, const std::uint64_t k) { return a.key < k; });
    if (place == network.end() || place->key != key)
      throw std::logic_error("a segment has a neighbour that does not exist");
    return place - network.begin();
  };

  owned_index.clear();
  for (const Segment<dim> &segment : owned)
    owned_index.push_back(find(segment.key));

  edges.assign(network.size(), {});
  for (unsigned int i = 0; i < network.size(); ++i)
    for (const auto &neighbour : network[i].neighbours)
    {
      const unsigned int j = find(neighbour.key);
      const auto &back = network[j].neighbours;
      const auto twin = std::find_if(back.begin(), back.end(),
                                     [&](const auto &n) { return n.key == network[i].key; });
      if (twin == back.end())
        throw std::logic_error("a segment is not its neighbour's neighbour");
      // What leaves one of them comes to the other, also where they are turned against one another
      // and each sees another width. The pressure that drives the flow is singular in the last
      // segment.
      double width = 0.5 * (neighbour.width + twin->width);
      if (network[i].at_tip != network[j].at_tip)
        width *= network[i].at_tip ? tip_gradient_factor(neighbour.distance, twin->distance)
                                   : tip_gradient_factor(twin->distance, neighbour.distance);
      edges[i].push_back({j, neighbour.distance, twin->distance, width});
    }

  if (leak_off == LeakOff::resolved &&
      (rock_mobility <= 0. ||
       std::any_of(network.begin(), network.end(),
                   [](const auto &segment) { return !segment.rock_has_pore_pressure; })))
    throw EntryError("Fracture flow/Leak-off", "resolved",
                     "another law where the rock has no pore pressure or is impermeable");

  all_wells.locate(network, pressure_is_given());
  set_offset(0);

  if (!in_step)
    return;
  const bool has_grown =
    std::any_of(network.begin(), network.end(),
                [&](const auto &segment)
                { return history.count(segment.key) == 0 && appeared.count(segment.key) == 0; });
  pass += has_grown;
  for (const auto &segment : network)
    if (history.count(segment.key) == 0)
      appeared.emplace(segment.key, pass);
}


template <int dim>
double Network<dim>::initial_pressure(const NetworkSegment<dim> &segment,
                                      const EarlierValue &earlier) const
{
  if (pressure_is_given())
    return given_pressure;
  if (const auto own = earlier(flow_key(segment.key, 1)))
    return *own;
  std::optional<double> beside;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto &neighbour : segment.neighbours)
    if (neighbour.distance <= nearest)
      if (const auto pressure = earlier(flow_key(neighbour.key, 1)))
      {
        nearest = neighbour.distance;
        beside = pressure;
      }
  if (beside)
    return *beside;
  if (segment.propped_conductivity > 0.)
    return segment.in_situ_pore_pressure;
  const auto &n = segment.normal;
  return in_situ_stress ? std::max(0., -(n * (in_situ_stress(segment.centre) * n))) : 0.;
}


template <int dim>
void Network<dim>::set_offset(const unsigned int first_index)
{
  unsigned int next = first_index;
  rows.assign(network.size(), no_row);
  leak_off_rows.assign(network.size(), no_row);
  for (unsigned int i = 0; i < network.size(); ++i)
    if (!pressure_is_given())
      rows[i] = next++;
  for (unsigned int i = 0; i < network.size(); ++i)
    if (leaks_into_pores(network[i]))
      leak_off_rows[i] = next++;
  all_wells.set_offset(next);
}


template <int dim>
std::vector<ExtraUnknown> Network<dim>::unknowns() const
{
  std::vector<ExtraUnknown> result;
  for (const auto &segment : network)
    if (!pressure_is_given())
      result.push_back({flow_key(segment.key, 1), segment.initial_pressure});
  for (const auto &segment : network)
    if (leaks_into_pores(segment))
      result.push_back(
        {flow_key(segment.key, 3), segment.has_pressure_of_pores
                                     ? 0.
                                     : segment.initial_pressure - segment.in_situ_pore_pressure});
  const auto of_wells = all_wells.unknowns();
  result.insert(result.end(), of_wells.begin(), of_wells.end());
  return result;
}


template <int dim>
void Network<dim>::set_start(std::vector<double> &extra) const
{
  const std::vector<ExtraUnknown> all = unknowns();
  for (unsigned int k = 0; k < all.size(); ++k)
    extra[extra.size() - all.size() + k] = all[k].initial;
  const auto nothing = [](std::uint64_t) { return std::optional<double>(); };
  for (unsigned int i = 0; i < network.size(); ++i)
    if (rows[i] != no_row)
      extra[rows[i]] = initial_pressure(network[i], nothing);
}


template <int dim>
void Network<dim>::begin_step(const StepContext &)
{
  in_step = true;
  pass = 0;
  appeared.clear();
  for (const auto &segment : network)
    if (history.count(segment.key) == 0)
      appeared.emplace(segment.key, 0);
}


template <int dim>
void Network<dim>::rollback()
{
  in_step = false;
  pass = 0;
  appeared.clear();
}


template <int dim>
typename Network<dim>::Exposure Network<dim>::exposure(const unsigned int segment,
                                                       const StepContext &context,
                                                       const Values &values) const
{
  const ValueAndSlope now = wetted_share(values.aperture[segment], bare_aperture(segment));
  if (const auto fresh = appeared.find(network[segment].key);
      fresh != appeared.end() && fresh->second > 0)
  {
    // Those of pass k out of n were reached, on average, in the middle of the k-th part of the
    // step.
    const double left = context.dt * (1. - (fresh->second - 0.5) / pass);
    return {0., left * now.value, left * now.slope};
  }
  const auto old = history.find(network[segment].key);
  const double begin = old == history.end() ? 0. : old->second.exposure;
  const double wetted =
    old == history.end()
      ? wetted_share(values.aperture_reference[segment], bare_aperture(segment)).value
      : old->second.wetted;
  // A face that closes within a long step must not leak what the mean over it asks for: there is
  // nothing left, and the fracture would be sucked shut.
  if (now.value < wetted)
    return {begin, begin + context.dt * now.value, context.dt * now.slope};
  return {begin, begin + 0.5 * context.dt * (wetted + now.value), 0.5 * context.dt * now.slope};
}


template <int dim>
bool Network<dim>::bridges_count(const Segment<dim> &segment) const
{
  return leak_off == LeakOff::carter || segment.taken_from_pores > 0.;
}


template <int dim>
double Network<dim>::bare_share(const unsigned int segment) const
{
  constexpr double least = 1e-3; // or nothing would say what the pressure drops by
  if (network[segment].bare_aperture == 0.)
    return 1.;
  const auto old = history.find(network[segment].key);
  return old == history.end() ? least : old->second.bare ? 1. : std::max(least, old->second.wetted);
}


template <int dim>
double Network<dim>::leak_off_coefficient(const unsigned int segment) const
{
  const NetworkSegment<dim> &s = network[segment];
  if (s.has_pressure_of_pores) // a mere scale: the drop does not count, and is what this asks for
    return resolved_coefficient(std::pow(minimum_aperture, 2) / (12. * viscosity), s.size(),
                                s.size());
  // A cake is what fluid leaves that enters the rock; proppant lies where a well has cleaned up.
  const bool clean = s.propped_conductivity > 0. && leaks_into_pores(s);
  const auto of_region = mobility_of_region.find(s.region);
  const double mobility = of_region != mobility_of_region.end() ? of_region->second : rock_mobility;
  if (leak_off == LeakOff::resolved || clean)
    return bare_share(segment) * resolved_coefficient(mobility, s.size(), s.pore_distance);
  if (leak_off != LeakOff::filter_cake)
    return 0.;
  return bare_share(segment) * (s.rock_has_pore_pressure && mobility > 0.
                                  ? 1. / (1. / filter_cake_coefficient + s.pore_distance / mobility)
                                  : filter_cake_coefficient);
}


template <int dim>
std::vector<double> Network<dim>::apertures(const Unknowns &unknowns,
                                            const Collectives &collectives) const
{
  std::vector<double> result(network.size());
  for (unsigned int k = 0; k < owned.size(); ++k)
    result[owned_index[k]] += opening(k, unknowns);
  collectives.sum(result);
  return result;
}


template <int dim>
double Network<dim>::opening(const unsigned int k, const Unknowns &unknowns) const
{
  const double of_rock = value(owned[k].opening, unknowns);
  if (owned[k].opening_by_pressure == 0.)
    return of_rock;
  const unsigned int row = rows[owned_index[k]];
  const double pressure = row == no_row ? given_pressure : unknowns.extra[row];
  return of_rock + owned[k].opening_by_pressure * pressure;
}


template <int dim>
std::vector<double> Network<dim>::pressures(const Unknowns &unknowns) const
{
  std::vector<double> result(network.size());
  for (unsigned int i = 0; i < network.size(); ++i)
    result[i] = rows[i] == no_row ? given_pressure : unknowns.extra[rows[i]];
  return result;
}


template <int dim>
std::optional<unsigned int> Network<dim>::number(const std::uint64_t key) const
{
  const auto segment =
    std::lower_bound(network.begin(), network.end(), key,
                     [](const auto &a, const std::uint64_t k) { return a.key < k; });
  if (segment == network.end() || segment->key != key)
    return {};
  return segment - network.begin();
}


template <int dim>
double Network<dim>::pressure(const std::uint64_t key, const Unknowns &unknowns) const
{
  const auto i = number(key);
  if (!i)
    return 0.;
  return rows[*i] == no_row ? given_pressure : unknowns.extra[rows[*i]];
}


template <int dim>
std::optional<unsigned int> Network<dim>::unknown(const std::uint64_t key) const
{
  const auto i = number(key);
  if (!i || rows[*i] == no_row)
    return {};
  return rows[*i];
}


template <int dim>
typename Network<dim>::Values Network<dim>::evaluate(const StepContext &context,
                                                     const State &state,
                                                     const Collectives &collectives) const
{
  const unsigned int n = network.size();
  const Unknowns &reference_state = state.fracture_reference(context);
  // BDF2 alone refers to what has never been a state.
  const bool from_committed =
    context.balances_fractures_by_step() || context.rate == 1. / context.dt;
  std::vector<double> all((from_committed ? 3 : 4) * n);
  for (unsigned int k = 0; k < owned.size(); ++k)
  {
    const unsigned int i = owned_index[k];
    all[i] += opening(k, state.current);
    all[n + i] += opening(k, reference_state);
    all[2 * n + i] += value(owned[k].pore_pressure, state.current);
    if (!from_committed)
      all[3 * n + i] += opening(k, state.committed);
  }
  collectives.sum(all);

  Values values;
  values.aperture.assign(all.begin(), all.begin() + n);
  values.aperture_reference.assign(all.begin() + n, all.begin() + 2 * n);
  const double *committed = all.data() + (from_committed ? 1 : 3) * n;
  // Where a fracture has just grown to, there was no room for fluid, even if the unknowns that the
  // opening is read from were there and not zero, as those of an older piece around the corner. And
  // where a segment has turned, the room was what its old opening says. What had been room in pores
  // all the same held the fluid that is in the segment now.
  for (unsigned int i = 0; i < n; ++i)
  {
    const auto fresh = appeared.find(network[i].key);
    const auto old = history.find(network[i].key);
    double &reference = values.aperture_reference[i];
    if (fresh != appeared.end() && fresh->second > 0)
      reference *= network[i].share_of_pores;
    else if (old != history.end())
      reference +=
        (1. - network[i].share_of_pores) * (old->second.volume / network[i].area - committed[i]);
    else // faces that proppant is going to push apart hold no fluid yet
      reference = std::max(reference, 0.);
    if (old != history.end())
      reference -= old->second.vapour / network[i].area;
  }
  hand_over_room(context, state, collectives, values);
  values.pore_pressure.assign(all.begin() + 2 * n, all.begin() + 3 * n);
  values.pressure = pressures(state.current);
  values.pressure_reference = pressures(reference_state);
  values.filter_cake_drop.resize(n);
  for (unsigned int i = 0; i < n; ++i)
    values.filter_cake_drop[i] = leak_off_rows[i] == no_row
                                   ? values.pressure[i] - values.pore_pressure[i]
                                   : state.current.extra[leak_off_rows[i]];
  find_vapour(context, values);
  return values;
}


template <int dim>
Transmissibility Network<dim>::transmissibility(const unsigned int segment,
                                                const Edge &edge,
                                                const Values &values) const
{
  Transmissibility all =
    cubic_law(values.aperture[segment], values.aperture[edge.other], edge.distance,
              edge.other_distance, edge.width, viscosity, minimum_aperture);
  all.value +=
    edge.width / (viscosity * (edge.distance + edge.other_distance)) *
    std::min(network[segment].propped_conductivity, network[edge.other].propped_conductivity);
  return all;
}


/// Newton's method for the complementarity: of both conditions a segment has the one that is nearer
/// to being violated (an active set; Hintermueller, Ito and Kunisch 2003). What is nearer is a
/// matter of the weight. Newton's iterations have volumes that are wrong by far, above all where
/// the fluid has just come; a segment must not turn to vapour for that under a pressure at which no
/// fluid would. So it is the pressure that counts: to a millionth of its scale.
template <int dim>
void Network<dim>::find_vapour(const StepContext &context, Values &values) const
{
  values.vapour.assign(network.size(), 0.);
  values.cavitates.assign(network.size(), false);
  if (!may_cavitate())
    return;
  constexpr double by_pressure = 1e6;
  const double dt = context.fracture_dt();
  const double c_f = compressibility * context.fracture_pressure_factor();
  for (unsigned int i = 0; i < network.size(); ++i)
  {
    if (rows[i] == no_row || all_wells.feeds(i))
      continue;
    const double w = values.aperture[i], p = values.pressure[i], area = network[i].area;
    double lack = area * (w - values.aperture_reference[i] +
                          std::max(w, 0.) * c_f * (p - values.pressure_reference[i])) +
                  2. * area * dt * leak_off_coefficient(i) * values.filter_cake_drop[i];
    for (const Edge &edge : edges[i])
      lack += dt * transmissibility(i, edge, values).value * (p - values.pressure[edge.other]);
    values.cavitates[i] = lack > by_pressure * vapour_scale(i) * (p - vapour_pressure);
    if (values.cavitates[i])
      values.vapour[i] = lack;
  }
}


template <int dim>
void Network<dim>::assemble(const StepContext &context,
                            const State &state,
                            const Collectives &collectives,
                            Sink &sink) const
{
  if (network.empty() && all_wells.empty())
    return;
  const Values values = evaluate(context, state, collectives);
  LocalSystem local;
  for (unsigned int k = 0; k < owned.size(); ++k)
  {
    const unsigned int i = owned_index[k];
    assemble_segment(i, owned[k], context, values, local);
    if (network[i].owner != collectives.rank())
      keep_part_of_opening(owned[k], local);
    sink.add(local);
  }
  all_wells.assemble(context, state,
                     all_wells.outside_pressures(values.pressure, state.current, collectives), rows,
                     collectives.rank() == 0, sink);
}


template <int dim>
std::vector<WellReport> Network<dim>::wells(const StepContext &context,
                                            const State &state,
                                            const Collectives &collectives) const
{
  return all_wells.report(
    context, state, apertures(state.current, collectives),
    all_wells.outside_pressures(pressures(state.current), state.current, collectives));
}


template class Network<2>;
template class Network<3>;
} // namespace stockwork
