// What a step has done to the fluid, and what is remembered of it.
#include "flow/network.h"

#include <boost/serialization/map.hpp>

#include <algorithm>
#include <limits>

#include "flow/conductivity.h"

namespace stockwork
{
template <int dim>
std::vector<double> Network<dim>::leaked_in_step(const StepContext &context,
                                                 const Values &values) const
{
  std::vector<double> volumes(network.size(), 0.);
  for (unsigned int i = 0; i < network.size(); ++i)
    if (leak_off == LeakOff::carter)
    {
      const Exposure times = exposure(i, context, values);
      volumes[i] = 2. * network[i].area * carter_volume(carter_coefficient, times.begin, times.end);
    }
    else
      volumes[i] =
        2. * network[i].area * leak_off_coefficient(i) * context.dt * values.filter_cake_drop[i];
  return volumes;
}


template <int dim>
FluidBalance Network<dim>::balance(const StepContext &context,
                                   const State &state,
                                   const Collectives &collectives) const
{
  const Values values = evaluate(context, state, collectives);
  const std::vector<double> leaked = leaked_in_step(context, values);

  // Storage terms of the scheme, carried over from its effective time to that of the step.
  const double scheme = context.dt / context.fracture_dt();
  const double c_f = compressibility * context.fracture_pressure_factor();

  FluidBalance balance;
  double room = 0.;
  balance.step = all_wells.volumes(context, state);
  for (unsigned int i = 0; i < network.size(); ++i)
  {
    const double area = network[i].area, w = values.aperture[i];
    const double gain =
      scheme * area *
      (w - values.aperture_reference[i] +
       std::max(w, 0.) * c_f * (values.pressure[i] - values.pressure_reference[i]) -
       values.vapour[i] / area);
    balance.fracture_volume += area * w - values.vapour[i];
    room += area * minimum_aperture;
    balance.step.in_fractures += gain;
    balance.step.leaked += leaked[i];

    // What it takes is supplied from outside, and nothing flows between equal pressures.
    if (pressure_is_given())
      (gain + leaked[i] > 0. ? balance.step.injected : balance.step.outflow) +=
        std::abs(gain + leaked[i]);
  }

  balance.total = total;
  balance.total += balance.step;

  // When nothing moves (after shut-in), compare with what moved on average so far.
  const double moved =
    std::max({balance.step.injected + balance.step.outflow, std::abs(balance.step.leaked),
              context.time > 0. ? balance.total.injected * context.dt / context.time : 0.});
  // Where nobody has moved any yet, what goes in and out of a closed fracture is next to nothing:
  // compare with the room that its faces leave.
  const double scale =
    balance.total.injected + balance.total.outflow > 0. ? moved : std::max(moved, room);
  balance.relative_error = scale > 0. ? std::abs(balance.step.defect()) / scale : 0.;
  return balance;
}


template <int dim>
typename Network<dim>::Rounding Network<dim>::rounding(const StepContext &context,
                                                       const State &state,
                                                       const Collectives &collectives) const
{
  const Values values = evaluate(context, state, collectives);
  double volume = 0., closed = 0., thrust = 0.;
  for (unsigned int i = 0; i < network.size(); ++i)
  {
    closed += network[i].area * minimum_aperture;
    // Of dry faces that press on one another, the stress in situ and that of their contact.
    const double in_situ =
      in_situ_stress ? (in_situ_stress(network[i].centre) * network[i].normal).norm() : 0.;
    thrust += network[i].area * std::max(std::abs(values.pressure[i]), in_situ);
    volume +=
      network[i].area * (std::abs(values.aperture[i]) + std::abs(values.aperture_reference[i]));
    for (const Edge &edge : edges[i])
      volume += context.fracture_dt() * transmissibility(i, edge, values).value *
                (std::abs(values.pressure[i]) + std::abs(values.pressure[edge.other]));
  }
  volume += all_wells.magnitude_of_terms(
    context, state, all_wells.outside_pressures(values.pressure, state.current, collectives));
  // A few last digits of each term; and of a closed fracture, whose terms are all zero, what is far
  // below the room that closed faces leave.
  const double last_digits = 4. * std::numeric_limits<double>::epsilon();
  return {last_digits * volume + 1e-12 * closed, last_digits * thrust};
}


template <int dim>
void Network<dim>::commit(const StepContext &context,
                          const State &state,
                          const Collectives &collectives)
{
  const Values values = evaluate(context, state, collectives);
  const std::vector<double> leaked = leaked_in_step(context, values);
  total = balance(context, state, collectives).total;
  for (unsigned int i = 0; i < network.size(); ++i)
  {
    const double exposed = exposure(i, context, values).end;
    History &entry = history[network[i].key];
    entry.exposure = exposed;
    entry.wetted = wetted_share(values.aperture[i], bare_aperture(i)).value;
    entry.bare = entry.bare || entry.wetted >= 1.;
    entry.leaked += leaked[i];
    entry.volume = network[i].area * values.aperture[i];
    entry.vapour = values.vapour[i];
    entry.handed_over = values.handed_over[i];
  }
  rollback(); // nothing is on trial any more
}


template <int dim>
std::vector<double> Network<dim>::leaked_volumes() const
{
  std::vector<double> result;
  for (const auto &segment : network)
  {
    const auto entry = history.find(segment.key);
    result.push_back(entry == history.end() ? 0. : entry->second.leaked);
  }
  return result;
}


template <int dim>
void Network<dim>::save(boost::archive::binary_oarchive &archive) const
{
  archive << history << total;
  all_wells.save(archive);
}


template <int dim>
void Network<dim>::load(boost::archive::binary_iarchive &archive)
{
  archive >> history >> total;
  all_wells.load(archive);
  rollback();
}


template std::vector<double> Network<2>::leaked_in_step(const StepContext &, const Values &) const;
template FluidBalance
Network<2>::balance(const StepContext &, const State &, const Collectives &) const;
template typename Network<2>::Rounding
Network<2>::rounding(const StepContext &, const State &, const Collectives &) const;
template void Network<2>::commit(const StepContext &, const State &, const Collectives &);
template std::vector<double> Network<2>::leaked_volumes() const;
template void Network<2>::save(boost::archive::binary_oarchive &) const;
template void Network<2>::load(boost::archive::binary_iarchive &);
template std::vector<double> Network<3>::leaked_in_step(const StepContext &, const Values &) const;
template FluidBalance
Network<3>::balance(const StepContext &, const State &, const Collectives &) const;
template typename Network<3>::Rounding
Network<3>::rounding(const StepContext &, const State &, const Collectives &) const;
template void Network<3>::commit(const StepContext &, const State &, const Collectives &);
template std::vector<double> Network<3>::leaked_volumes() const;
template void Network<3>::save(boost::archive::binary_oarchive &) const;
template void Network<3>::load(boost::archive::binary_iarchive &);
} // namespace stockwork
