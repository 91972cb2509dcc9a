// What bonds cannot do, noticed while it happens.
#include "fracture/peridynamics/peridynamics.h"

#include "fracture/peridynamics/wording.h"
#include "mesh/box_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Net pressure over the strength from which on bonds may break in a cloud of damage.
constexpr double high_pressure = 0.5;
/// Overlap of faces over the extent of the fracture that is no rounding error of a closed one.
constexpr double overlap = 1e-7;
/// Attempts at a step in which a fracture jumps, before it is believed that it does at any length.
constexpr unsigned int attempts_for_jumps = 3;
/// Of energy in bonds across what has parted, over what the crack has taken, that is no matter.
constexpr double little_held = 0.05;
/// A jump: so many times what 'Most advances per step' permits, or so many times the extent before
/// and half of what it permits.
constexpr double most_advances = 3.;
constexpr double most_enlargement = 3.;
} // namespace


/// Rock that is stretched alike in all directions breaks everywhere at once, at a stress which is
/// greater the smaller the horizon.
template <int dim>
void Peridynamics<dim>::warn_of_pressure(const State &state)
{
  if (told_of_pressure || !state.segment_pressure)
    return;
  double pressure = 0.;
  for (const Segment<dim> &segment : fracture.segments)
    pressure = std::max(pressure,
                        state.segment_pressure(segment.key) +
                          segment.normal * (scene.in_situ_stress(segment.centre) * segment.normal));
  if (pressure < high_pressure * lattice.strength())
    return;
  std::ostringstream message;
  message.precision(3);
  message
    << "The net pressure in a crack, " << pressure * 1e-6
    << " MPa, has come near the strength of the bonds, " << lattice.strength() * 1e-6
    << " MPa with a horizon of " << parameters.horizon * lattice.zone.spacing()
    << " m. They may break over an area where a crack should be, and branches may be those of "
       "the mesh. The strength grows as the cells shrink, with the root.";
  messages.push_back(message.str());
  told_of_pressure = true;
}


template <int dim>
std::string Peridynamics<dim>::why_sliding_crack_holds() const
{
  if (!parameters.tracked || std::isnan(scene.crack_pressure))
    return "";
  double held = 0., most = 0.;
  Point<dim> where;
  if constexpr (dim == 2)
    for (const BondAcross<dim> &bond : crossing_bonds)
    {
      const auto &[site, b] = bond.view;
      const double stretched = lattice.elongation(site, b, displacement);
      if (stretched >= 0. || lattice.bonds.is_broken(site, b) ||
          lattice.bonds.views_of(site, b).front() != bond.view)
        continue;
      // How far its ends are apart across the path, of the image that crosses it.
      const FarEnd end = lattice.zone.far_end(site, b);
      Tensor<1, dim> normal = paths.left(bond.crossing);
      if (normal * bond.direction < 0.)
        normal = -normal;
      double parted = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        parted += (bond.direction[d] * lattice.coefficients[b].direction[d] < 0. ? -1. : 1.) *
                  normal[d] *
                  ((end.mirrored >> d & 1 ? -1. : 1.) * displacement[end.site * dim + d] -
                   displacement[site * dim + d]);
      // Had they parted as much along it, it would be broken.
      if (parted <
          lattice.softening.last * relative_stretch(site, b) * lattice.coefficients[b].length)
        continue;
      double energy = 0.;
      for (const auto &[s, view] : lattice.bonds.views_of(site, b))
        energy += 0.25 * lattice.zone.sites()[s].share * (1. - softening_bonds.damage(s, view)) *
                  lattice.stiffness(s, view) * stretched * stretched;
      held += energy;
      if (energy > most)
      {
        most = energy;
        where = paths.point(bond.crossing);
      }
    }
  const double taken = dissipated + softened_in_step();
  if (held <= little_held * taken)
    return "";
  std::ostringstream reason;
  reason.precision(3);
  reason << "the crack at (" << where
         << ") m is made to slide as it opens. Bonds across it that this presses do not break, and "
            "hold what has parted: they store "
         << 100. * held / taken
         << " % of what the crack has taken, and all that follows would be wrong. Let what pulls "
            "act across the crack, or use 'cohesive_xfem'";
  return reason.str();
}


template <int dim>
double Peridynamics<dim>::fracture_volume(const State &state, const Collectives &collectives) const
{
  std::vector<double> volume(1, 0.);
  for (unsigned int k = 0; k < fracture.owned_segments.size(); ++k)
    volume[0] += fracture.owned_segments[k].area * fracture.aperture(k, state);
  collectives.sum(volume);
  return volume[0];
}


template <int dim>
double Peridynamics<dim>::extent() const
{
  // Fluid may get into a path far from all others at once, which is no jump of a tip.
  if (parameters.tracked)
    return paths.length();
  double greatest = 0.;
  for (unsigned int d = 0; d < dim && !fracture.segments.empty(); ++d)
  {
    const auto [first, last] = std::minmax_element(
      fracture.segments.begin(), fracture.segments.end(),
      [d](const Segment<dim> &a, const Segment<dim> &b) { return a.centre[d] < b.centre[d]; });
    greatest = std::max(greatest, last->centre[d] - first->centre[d] + lattice.zone.spacing());
  }
  return greatest;
}


template <int dim>
Verdict Peridynamics<dim>::verdict_on(const StepContext &context,
                                      const State &state,
                                      const Collectives &collectives) const
{
  Verdict verdict;
  if (fracture.segments.empty())
    return verdict;
  double area = 0.;
  for (const Segment<dim> &segment : fracture.segments)
    area += segment.area;
  const double volume = fracture_volume(state, collectives), reach = extent();
  if (!parameters.in_bonds && volume < -overlap * area * reach)
  {
    verdict.kind = Verdict::Kind::stop;
    verdict.reason =
      "the fracture holds less than nothing, " + text(volume) + (dim == 2 ? " m^2" : " m^3") +
      ": its faces overlap by " + text(-1e6 * volume / area) +
      " um on the average, for nothing keeps faces of bonds apart. The pressure in the fracture is "
      "less than what the rock closes it with, or its tips run ahead of the fluid" +
      what_bonds_carry();
    return verdict;
  }
  const double grown = reach - extent_before;
  const double permitted =
    parameters.most_advances * lattice.zone.spacing() * std::max<std::size_t>(n_tips_before, 1);
  if (grown > most_advances * permitted ||
      (reach > most_enlargement * extent_before && grown > 0.5 * permitted))
  {
    const bool again = context.attempt + 1 < attempts_for_jumps;
    verdict.kind = again ? Verdict::Kind::reject : Verdict::Kind::stop;
    verdict.reason = "the fracture jumps from " + text(extent_before) + " to " + text(reach) + " m";
    if (!again)
      verdict.reason += " within " + text(context.dt) + " s" + what_bonds_carry();
  }
  return verdict;
}


template <int dim>
std::string Peridynamics<dim>::wanted_zone() const
{
  // The zone, the boxes that joined while the step was tried, and room for what it wants next.
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
  {
    lower[d] = std::numeric_limits<double>::infinity();
    upper[d] = -lower[d];
    for (const unsigned int i : lattice.zone.peridynamic_sites())
    {
      const double place = lattice.zone.position(lattice.zone.sites()[i].place)[d];
      lower[d] = std::min(lower[d], place);
      upper[d] = std::max(upper[d], place);
    }
    for (const auto &box : shape.boxes)
    {
      lower[d] = std::min(lower[d], box.lower_bound(d));
      upper[d] = std::max(upper[d], box.upper_bound(d));
    }
    const double more = parameters.zone_growth * lattice.zone.spacing();
    lower[d] = std::max(lower[d] - more, lattice.zone.room().lower_bound(d));
    upper[d] = std::min(upper[d] + more, lattice.zone.room().upper_bound(d));
  }
  return "bonds are stretched too far up to the rim of the peridynamic zone, however short the "
         "step "
         "is. A greater zone from the start: 'Fracture/peridynamics/Zone = " +
         to_string(dealii::BoundingBox<dim>({lower, upper})) + "'" + what_bonds_carry();
}


template <int dim>
std::string Peridynamics<dim>::what_bonds_carry() const
{
  return ". Bonds of cells of " + text(lattice.zone.spacing()) + " m hold " +
         megapascals(lattice.strength()) +
         ", the more the smaller the cells are; if pressures or in-situ stresses of the scene "
         "differ "
         "by as much, use smaller cells, or 'cohesive_xfem'.";
}

#define INSTANTIATE(dim)                                                                        \
  template std::string Peridynamics<dim>::why_sliding_crack_holds() const;                      \
  template void Peridynamics<dim>::warn_of_pressure(const State &);                             \
  template double Peridynamics<dim>::fracture_volume(const State &, const Collectives &) const; \
  template double Peridynamics<dim>::extent() const;                                            \
  template Verdict Peridynamics<dim>::verdict_on(const StepContext &, const State &,            \
                                                 const Collectives &) const;                    \
  template std::string Peridynamics<dim>::wanted_zone() const;                                  \
  template std::string Peridynamics<dim>::what_bonds_carry() const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
