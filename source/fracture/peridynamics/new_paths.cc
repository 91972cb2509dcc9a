// `Tracking = path`: where bonds are stretched too far and no path is near, one begins.
#include "fracture/peridynamics/new_paths.h"

#include "fracture/peridynamics/wording.h"
#include "stockwork/base/error.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// From all paths, of a place where one may begin [horizons]. Nearer to a tip bonds are stretched
/// by it.
constexpr double least_distance = 2.;
/// Bonds that are stretched as much as the most stretched one, less this share, are where a path
/// begins: in the middle of them, which is the same on any lattice.
constexpr double nearly_most = 0.02;
} // namespace


template <int dim>
NewPaths<dim>::NewPaths(const Lattice<dim> &lattice)
  : lattice(lattice)
{
}


template <int dim>
void NewPaths<dim>::look_beside(const TrackedPaths &paths)
{
  sites.clear();
  if constexpr (dim == 2)
  {
    double longest = 0.;
    for (const BondCoefficients<dim> &bond : lattice.coefficients)
      longest = std::max(longest, bond.length);
    const double least =
      least_distance * lattice.parameters.horizon * lattice.zone.spacing() - 0.5 * longest;
    for (const unsigned int i : lattice.zone.peridynamic_sites())
      if (paths.distance(lattice.zone.position(lattice.zone.sites()[i].place)) >= least)
        sites.push_back(i);
  }
}


template <int dim>
std::vector<typename NewPaths<dim>::Overstretched>
NewPaths<dim>::overstretched(const std::vector<double> &displacement,
                             const std::vector<double> &dilatation_forces,
                             const TrackedPaths &paths) const
{
  std::vector<Overstretched> result;
  if constexpr (dim == 2)
    for (const unsigned int i : sites)
    {
      // Bonds that the stress in situ presses together in all directions are looked at by their
      // elongation first, which tells nearly always.
      const bool pressed = lattice.in_situ_is_zero ||
                           eigenvalues(lattice.effective_in_situ_stress(
                             i, 0, lattice.zone.position(lattice.zone.sites()[i].place)))[0] <= 0.;
      for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
      {
        double force = lattice.force_of_dilatations(i, b, dilatation_forces);
        const auto stretch_by = [&](const double elongation) {
          return lattice.driving_stretch(i, b, elongation, force,
                                         lattice.rock_of_bonds.energy(i, b));
        };
        double longer = lattice.elongation(i, b, displacement);
        if ((pressed && longer <= 0.) || lattice.bonds.is_broken(i, b) ||
            !lattice.bonds.can_break(i, b) || lattice.never_breaks(i, b) ||
            lattice.volume_share(i, b) == 0.)
          continue;
        if (pressed && stretch_by(longer) < (1. - 2. * nearly_most) * lattice.softening.first)
          continue;
        const Tensor<1, dim> &e = lattice.coefficients[b].direction;
        const Point<dim> middle = lattice.zone.position(lattice.zone.sites()[i].place) +
                                  0.5 * lattice.coefficients[b].length * e;
        // As across a crack, by the traction across the bond, for compression along it opens none;
        // but no more than the strain, which sides that take the stress away take from the bond.
        if (!lattice.in_situ_is_zero)
        {
          const double in_situ =
            std::min(lattice.dry_stretch(i, b, middle, e), lattice.in_situ_stretch(i, b));
          longer += lattice.coefficients[b].length * in_situ;
          force += 2. * lattice.force_of_dilatation(b) * dim * in_situ *
                   lattice.rock_of_bonds.modulus(i, b);
        }
        const double stretch = rounded(stretch_by(longer) / lattice.softening.first);
        if (stretch < 1. - nearly_most ||
            !lattice.zone.all_rock().point_inside(middle, same_place * lattice.zone.spacing()) ||
            paths.distance(middle) <
              least_distance * lattice.parameters.horizon * lattice.zone.spacing())
          continue;
        result.push_back({stretch, i, b, middle});
      }
    }
  return result;
}


template <int dim>
bool NewPaths<dim>::is_in_zone(const Point<dim> &point) const
{
  if (!lattice.zone.is_inside(point, same_place * lattice.zone.spacing()) ||
      (lattice.parameters.zone_growth > 0 && lattice.zone.room().point_inside(point)))
    return true;
  for (unsigned int v = 0; v < 1u << dim; ++v)
  {
    Place<dim> corner;
    for (unsigned int d = 0; d < dim; ++d)
      corner[d] = static_cast<int>(std::floor((point[d] - lattice.zone.position(Place<dim>{})[d]) /
                                                lattice.zone.spacing() +
                                              same_place)) +
                  static_cast<int>(v >> d & 1);
    const unsigned int site = lattice.zone.find(corner);
    if (site == dealii::numbers::invalid_unsigned_int || !lattice.zone.sites()[site].peridynamic)
      return false;
  }
  return true;
}


/// Bonds that lead out of the zone do not break. Where it cuts off those around the most stretched
/// ones, these are the zone's choice and not the rock's.
template <int dim>
bool NewPaths<dim>::is_near_rim(const Overstretched &bond) const
{
  for (unsigned int d = 0; d < dim; ++d)
    for (const double side : {-1., 1.})
    {
      Point<dim> beside = bond.middle;
      beside[d] += side * (0.5 * lattice.parameters.horizon + 1.) * lattice.zone.spacing();
      if (!is_in_zone(beside))
        return true;
    }
  return false;
}


/// Of a crack that nothing has led here either end may be the first. One along an axis, or in a
/// diagonal, shall not have another first end by a rounding error.
template <int dim>
typename NewPaths<dim>::Beginning NewPaths<dim>::beginning_at(const Overstretched &bond,
                                                              const MeanStress &mean_stress) const
{
  Beginning result{bond, {}, {}};
  if constexpr (dim == 2)
  {
    const double horizon = lattice.parameters.horizon * lattice.zone.spacing();
    result.stress =
      mean_stress(bond.middle, 2. * horizon,
                  [&](const Tensor<1, dim> &away)
                  { return std::pow(1. - away.norm_square() / (4. * horizon * horizon), 2); });
    result.direction = across_greatest(result.stress, Tensor<1, dim>({0.9, 0.44}));
  }
  return result;
}


/// Bonds add the stress in situ across them to their elongation. Where sides have moved and taken
/// away a stress that was not the same in all directions, that is too much of some of them; and
/// beside a loaded side a few may be stretched by what others lack. The mean stress knows better:
/// by the strain that it gives in its direction, over that at which bonds soften.
template <int dim>
bool NewPaths<dim>::is_in_tension(const Beginning &path) const
{
  constexpr double least = 2. / 3.;
  const auto principal = eigenvalues(effective_stress(path));
  const double ratio = lattice.scene.rock.main().poisson_ratio;
  const double strain =
    ((1. - ratio) * principal[0] - ratio * std::max(0., principal[dim - 1])) / (1. - 2. * ratio);
  return strain >= least * lattice.strength(path.bond.site, path.bond.bond);
}


/// What a path crosses in a box holds, so none begins there; nor with a piece that leads into one,
/// for the crack would have come from nowhere.
template <int dim>
bool NewPaths<dim>::begins_in_unbreakable(const Beginning &path) const
{
  for (const auto &box : lattice.parameters.unbreakable)
    for (const double along : {-1., -0.5, 0., 0.5, 1.})
      if (box.point_inside(path.bond.middle + along * lattice.zone.spacing() * path.direction,
                           same_place * lattice.zone.spacing()))
        return true;
  return false;
}


template <int dim>
std::string NewPaths<dim>::begin(const StepContext &context,
                                 const std::vector<double> &displacement,
                                 const std::vector<double> &dilatation_forces,
                                 const MeanStress &mean_stress,
                                 TrackedPaths &paths)
{
  std::vector<Overstretched> all = overstretched(displacement, dilatation_forces, paths);
  std::string reason;
  while (reason.empty())
  {
    const std::vector<Point<dim>> held = begin_worst(all, context, mean_stress, paths, reason);
    if (held.empty())
      break;
    // What holds for good shall not hide what is stretched less.
    const double near = least_distance * lattice.parameters.horizon * lattice.zone.spacing();
    all.erase(std::remove_if(all.begin(), all.end(),
                             [&](const Overstretched &bond)
                             {
                               return std::any_of(held.begin(), held.end(),
                                                  [&](const Point<dim> &place)
                                                  { return place.distance(bond.middle) < near; });
                             }),
              all.end());
  }
  return reason;
}


template <int dim>
std::vector<Point<dim>> NewPaths<dim>::begin_worst(const std::vector<Overstretched> &all,
                                                   const StepContext &context,
                                                   const MeanStress &mean_stress,
                                                   TrackedPaths &paths,
                                                   std::string &reason)
{
  std::vector<Point<dim>> held;
  double most = 0.;
  for (const Overstretched &bond : all)
    most = std::max(most, bond.stretch);
  if (most < 1.)
    return held;
  const double least = (1. - nearly_most) * most;
  std::map<unsigned int, std::vector<const Overstretched *>> by_site;
  for (const Overstretched &bond : all)
    if (bond.stretch > least)
      by_site[bond.site].push_back(&bond);
  // Those that hang together by bonds are one place. Sites are sorted by place, so it does not
  // matter which rank looks.
  while (!by_site.empty())
  {
    std::vector<unsigned int> sites{by_site.begin()->first};
    std::vector<const Overstretched *> group;
    for (unsigned int k = 0; k < sites.size(); ++k)
    {
      const auto found = by_site.find(sites[k]);
      if (found == by_site.end())
        continue;
      group.insert(group.end(), found->second.begin(), found->second.end());
      by_site.erase(found);
      for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
        sites.push_back(lattice.zone.far_end(sites[k], b).site);
    }
    // Of several places only the worst, and those that are as bad.
    if (std::none_of(group.begin(), group.end(),
                     [&](const Overstretched *bond)
                     { return bond->stretch > most - 1.5 * same_stretch; }))
      continue;
    Tensor<1, dim> sum;
    double weights = 0.;
    for (const Overstretched *bond : group)
    {
      sum += (bond->stretch - least) * bond->middle;
      weights += bond->stretch - least;
    }
    const Point<dim> centre(sum / weights);
    // They may lie around something that is no place for a path.
    Overstretched place =
      **std::min_element(group.begin(), group.end(),
                         [&](const Overstretched *a, const Overstretched *b)
                         { return a->middle.distance(centre) < b->middle.distance(centre); });
    if (place.middle.distance(centre) <= lattice.zone.spacing())
      place.middle = centre;
    Beginning path = beginning_at(place, mean_stress);
    if (!is_in_tension(path))
    {
      if ((told & held_without_stress) == 0)
        messages.push_back("Bonds are stretched too far at " +
                           place_and_time(path.bond.middle, context) +
                           ", but around them the rock bears too little tension for a crack to "
                           "begin: they hold. Look at loads on sides, and at a stress in situ that "
                           "sides take away. " +
                           stress_and_strength(path));
      told |= held_without_stress;
      held.push_back(path.bond.middle);
      continue;
    }
    for (const Overstretched *bond : group)
      if (is_near_rim(*bond))
      {
        reason = why_none_begins(beginning_at(*bond, mean_stress), context);
        return held;
      }
    if (begins_in_unbreakable(path))
    {
      std::sort(group.begin(), group.end(),
                [](const Overstretched *a, const Overstretched *b)
                {
                  return std::make_tuple(-a->stretch, a->site, a->bond) <
                         std::make_tuple(-b->stretch, b->site, b->bond);
                });
      const auto free =
        std::find_if(group.begin(), group.end(),
                     [&](const Overstretched *bond) {
                       return !begins_in_unbreakable({*bond, path.direction, path.stress});
                     });
      if (free != group.end())
        path = beginning_at(**free, mean_stress);
    }
    reason = begin_one(path, context, paths);
    if (!reason.empty())
      break;
  }
  return held;
}


template <int dim>
std::string
NewPaths<dim>::begin_one(const Beginning &path, const StepContext &context, TrackedPaths &paths)
{
  if constexpr (dim == 2)
  {
    const double h = lattice.zone.spacing(), horizon = lattice.parameters.horizon * h;
    const Point<dim> &middle = path.bond.middle;
    Point<dim> place = middle;
    Tensor<1, dim> direction = path.direction;
    if (paths.distance(place) < least_distance * horizon)
      return ""; // another one has begun meanwhile
    // The side of the domain that is nearest, and so near that the path begins on it.
    Tensor<1, dim> inwards;
    double nearest = horizon;
    for (unsigned int d = 0; d < dim; ++d)
      for (const unsigned int side : {0u, 1u})
      {
        const double bound = side == 0 ? lattice.zone.all_rock().lower_bound(d)
                                       : lattice.zone.all_rock().upper_bound(d);
        if (std::abs(middle[d] - bound) > nearest - same_place * h)
          continue;
        nearest = std::abs(middle[d] - bound);
        place = middle;
        place[d] = bound;
        inwards = 0.;
        inwards[d] = side == 0 ? 1. : -1.;
      }
    const auto hold =
      [&](const unsigned int reason, const std::string &where, const std::string &what_to_do)
    {
      if ((told & reason) == 0)
        messages.push_back("Bonds are stretched too far at " + place_and_time(place, context) +
                           ", " + where + " lets no crack begin: they hold. " + what_to_do +
                           stress_and_strength(path));
      told |= reason;
      return std::string();
    };
    if (inwards.norm() > 0. && std::abs(direction * inwards) < std::sqrt(0.5))
      return hold(held_at_side,
                  "along a side of the domain, where 'Fracture/peridynamics/Tracking = path'",
                  "Enlarge the domain, or give the crack in 'Cracks'. ");
    if (begins_in_unbreakable(path))
      return hold(held_in_box, "in or beside a box of 'Fracture/peridynamics/Unbreakable', which",
                  "");
    if (inwards.norm() > 0.)
      direction = inwards;
    for (const double ahead : {inwards.norm() > 0. ? 0. : -1., 1.})
      if (!is_in_zone(place + ahead * (h + horizon) * direction))
        return why_none_begins(path, context);
    // What the deck presses in all cracks is nothing in a dry scene.
    const bool dry = lattice.scene.crack_pressure != 0.;
    if (inwards.norm() > 0.)
      paths.begin_at_side(place, direction, dry);
    else
      paths.begin_at(place, direction, dry);
    std::ostringstream angle;
    angle.precision(4);
    angle << std::atan2(direction[1], direction[0]) * 180. / M_PI;
    messages.push_back("A crack begins at " + place_and_time(place, context) + ", " + angle.str() +
                       " degrees from the x axis: bonds are stretched too far there, and no other "
                       "is near. " +
                       stress_and_strength(path) +
                       (dry ? " It is dry until a fracture joins it." : ""));
  }
  return "";
}

template <int dim>
void NewPaths<dim>::refuse_in_situ_tension(const TrackedPaths &paths) const
{
  if (lattice.in_situ_is_zero)
    return;
  const std::vector<double> displacement(lattice.zone.sites().size() * dim, 0.);
  const std::vector<Overstretched> all = overstretched(displacement, {}, paths);
  const auto worst = std::max_element(all.begin(), all.end(),
                                      [](const Overstretched &a, const Overstretched &b)
                                      { return a.stretch < b.stretch; });
  if (worst == all.end() || worst->stretch < 1.)
    return;
  const double tension = eigenvalues(
                 lattice.effective_in_situ_stress(worst->site, worst->bond, worst->middle))[0],
               strength = lattice.strength(worst->site, worst->bond);
  throw InputError("In situ/Stress: at " + in_metres(worst->middle) + " it is " +
                   (lattice.scene.has_pore_pressure
                      ? "an effective tension, with the pore pressure, of "
                      : "a tension of ") +
                   megapascals(tension) + ", and bonds there hold " + megapascals(strength) +
                   " with cells of " + text(lattice.zone.spacing()) +
                   " m: with 'Fracture/peridynamics/Tracking = path' cracks would begin all over "
                   "the rock before anything has moved. Compression is negative. Use less tension, "
                   "or cells of less than " +
                   text(std::pow(strength / tension, 2) * lattice.zone.spacing()) +
                   " m ('Fracture/peridynamics/Cell size'), which hold more.");
}


template <int dim>
std::string NewPaths<dim>::place_and_time(const Point<dim> &place, const StepContext &context) const
{
  std::ostringstream time;
  time.precision(4);
  time << context.time;
  return in_metres(place) + ", at " + time.str() + " s";
}


template <int dim>
SymmetricTensor<2, dim> NewPaths<dim>::effective_stress(const Beginning &path) const
{
  SymmetricTensor<2, dim> stress = path.stress;
  if (lattice.scene.has_pore_pressure)
    stress += lattice.effective_in_situ_stress(path.bond.site, path.bond.bond, path.bond.middle) -
              lattice.scene.in_situ_stress(path.bond.middle);
  return stress;
}


template <int dim>
std::string NewPaths<dim>::stress_and_strength(const Beginning &path) const
{
  const auto principal = eigenvalues(effective_stress(path));
  return std::string("The mean ") + (lattice.scene.has_pore_pressure ? "effective " : "") +
         "stress there is " + megapascals(principal[0]) + " across it and " +
         megapascals(principal[dim - 1]) + " along it; bonds with a horizon of " +
         text(lattice.parameters.horizon * lattice.zone.spacing()) + " m hold " +
         megapascals(lattice.strength(path.bond.site, path.bond.bond)) +
         " of a stress that is the same in all directions. That follows from the energy release "
         "rate, the stiffness and the horizon (with half of it, 1.41 times as much): with other "
         "cells cracks begin at another load.";
}


template <int dim>
std::string NewPaths<dim>::why_none_begins(const Beginning &path, const StepContext &context)
{
  const std::string what =
    "bonds are stretched too far at " + place_and_time(path.bond.middle, context) +
    ", and all around up to the rim of the peridynamic zone, far from all cracks; so near to the "
    "rim none can begin. " +
    stress_and_strength(path) +
    " If only a part of the rock is stretched so, let 'Fracture/peridynamics/Zone' reach two "
    "horizons beyond it; if all of it is, use smaller loads, less tension in 'In situ/Stress', or "
    "smaller cells; or name in 'Fracture/peridynamics/Unbreakable' what shall hold.";
  if (!(context.acceleration > 0. && !std::isnan(lattice.scene.crack_pressure)))
    return what;
  // Waves come to the rim, as they do where a crack has reached it.
  if ((told & held_at_rim) == 0)
    messages.push_back("They hold: " + what);
  told |= held_at_rim;
  return "";
}


template <int dim>
std::vector<std::string> NewPaths<dim>::take_messages()
{
  std::vector<std::string> taken;
  taken.swap(messages);
  return taken;
}

template class NewPaths<2>;
template class NewPaths<3>;
} // namespace stockwork::peridynamics
