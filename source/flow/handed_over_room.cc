// Room of a fracture that was part of one segment and becomes another one.
#include "flow/network.h"

#include <algorithm>

namespace stockwork
{
namespace
{
/// What the fluid changes from is (1 + c) times the last state less c times the one before (BDF2,
/// see TimeScheme): c, by the ratio of the two steps. Zero with the other schemes.
double weight_of_state_before(const StepContext &context)
{
  if (context.balances_fractures_by_step())
    return 0.;
  const double rate = context.rate * context.dt, ratio = (rate - 1.) / (2. - rate);
  return ratio * ratio / (1. + 2. * ratio);
}
} // namespace


/// Without this all of the fluid in a new segment would have to come from the one behind within the
/// step, through the narrowest part of the fracture: the shorter the step, the greater the pressure
/// that takes.
template <int dim>
void Network<dim>::hand_over_room(const StepContext &context,
                                  const State &state,
                                  const Collectives &collectives,
                                  Values &values) const
{
  const unsigned int n = network.size();
  values.handed_over.assign(n, 0.);
  const double weight = weight_of_state_before(context);
  std::vector<std::pair<unsigned int, unsigned int>> heirs; // and from whom
  for (unsigned int i = 0; i < n; ++i)
  {
    const auto old = history.find(network[i].key);
    if (old != history.end())
      values.aperture_reference[i] -= weight * old->second.handed_over / network[i].area;
    const auto fresh = appeared.find(network[i].key);
    if (network[i].part_of == 0 || fresh == appeared.end() || fresh->second == 0)
      continue;
    if (const auto from = number(network[i].part_of); from && history.count(network[*from].key) > 0)
      heirs.emplace_back(i, *from);
  }
  if (heirs.empty())
    return;

  std::vector<double> room(2 * n, 0.); // in what the fluid changes from, and in the last state
  const Unknowns &reference_state = state.fracture_reference(context);
  for (unsigned int k = 0; k < owned.size(); ++k)
    if (owned[k].part_of != 0)
    {
      room[owned_index[k]] += value(owned[k].room_before, reference_state);
      room[n + owned_index[k]] += value(owned[k].room_before, state.committed);
    }
  collectives.sum(room);
  for (const auto &[i, from] : heirs)
  {
    // None gives what it does not have.
    const double there = std::max(0., network[from].area * values.aperture_reference[from]),
                 given = std::clamp(network[i].area * room[i], 0., there);
    values.aperture_reference[i] += given / network[i].area;
    values.aperture_reference[from] -= given / network[from].area;
    const double before = std::clamp(network[i].area * room[n + i], 0.,
                                     std::max(0., history.at(network[from].key).volume));
    values.handed_over[i] += before;
    values.handed_over[from] -= before;
  }
}


template void
Network<2>::hand_over_room(const StepContext &, const State &, const Collectives &, Values &) const;
template void
Network<3>::hand_over_room(const StepContext &, const State &, const Collectives &, Values &) const;
} // namespace stockwork
