// What bonds cannot do: refused, foreseen, or noticed while it happens.
#include "fracture/peridynamics/peridynamics.h"

#include "fracture/peridynamics/lattice_moduli.h"
#include "mesh/box_list.h"
#include "stockwork/base/error.h"
#include "stockwork/fracture/needs.h"
#include "verification/analytical/kgd.h"

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
/// In-situ stress along a crack less that across it, over the strength, below which pressure and
/// length are off by less than 1 %.
constexpr double equal_stress = 0.1;
/// That above which bonds break without end in the first step, or faces overlap, whatever its
/// length.
constexpr double hopeless_stress = 2.5;
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

std::string text(const double number)
{
  std::ostringstream stream;
  stream.precision(3);
  stream << number;
  return stream.str();
}

std::string megapascals(const double stress)
{
  return text(1e-6 * stress) + " MPa";
}

/// Unit normals and middles of the flat parts of a crack.
template <int dim>
std::vector<std::pair<Point<dim>, Tensor<1, dim>>> flat_parts(const InitialCrack<dim> &crack)
{
  std::vector<std::pair<Point<dim>, Tensor<1, dim>>> parts;
  if (crack.disc)
    parts.emplace_back(crack.disc->centre, crack.disc->normal);
  if constexpr (dim == 2)
    for (unsigned int i = 0; i + 1 < crack.points.size(); ++i)
      if (const Tensor<1, dim> along = crack.points[i + 1] - crack.points[i]; along.norm() > 0.)
        parts.emplace_back(crack.points[i] + 0.5 * along, cross_product_2d(along) / along.norm());
  return parts;
}
} // namespace


template <int dim>
void Peridynamics<dim>::refuse_what_bonds_do_not_know() const
{
  needs::cracks_without_proppant(scene, "peridynamics");
  for (unsigned int region = 0; region <= Rock::max_regions; ++region)
  {
    const RockProperties &rock = scene.rock(region);
    const std::string path =
      region == 0 ? std::string("Rock") : "Rock/Region " + std::to_string(region);
    if (rock.stiffness)
      throw EntryError(path + "/Law", "an anisotropic one",
                       "'elastic' with 'Fracture/Model = peridynamics': bonds are as stiff in one "
                       "direction as in another");
    const double nu = bond_based_poisson_ratio(rock.plane_stress);
    if (!parameters.state_based && std::abs(rock.poisson_ratio - nu) > 1e-6)
      throw EntryError(
        path + "/Poisson ratio", text(rock.poisson_ratio),
        std::string(rock.plane_stress ? "1/3" : "0.25") + " with bond-based peridynamics" +
          (rock.plane_stress ? " in plane stress" : "") + "; others with 'Bond law = state-based'");
    if (parameters.as_published &&
        (rock.is_random() || rock.young_modulus != scene.rock.main().young_modulus ||
         rock.biot_coefficient != scene.rock.main().biot_coefficient))
      throw EntryError("Fracture/peridynamics/Closure", "as published",
                       "'conserving' or 'in bonds' where the rock differs from place to place, "
                       "which the paper does not have");
    if (!parameters.growth)
      continue;
    needs::no_given_strength(
      rock, "peridynamics",
      "where the strength follows from the energy release rate and the cells' size", path);
    needs::energy_of_all_modes(rock, "peridynamics",
                               "whose bonds break by their stretch, whatever the mode", path);
    if (rock.is_random() && rock.random->varies(RandomField::tensile_strength))
      throw EntryError(path + "/Random field/Properties", "one with 'tensile strength'",
                       "a list without it with the fracture model 'peridynamics', where the "
                       "strength follows from the energy release rate and the cells' size; "
                       "'cohesive_xfem' and 'damage' take it");
  }
}


template <int dim>
double Peridynamics<dim>::strength() const
{
  const RockProperties &rock = scene.rock.main();
  return (dim * rock.lame_lambda() + 2. * rock.shear_modulus()) * softening.first;
}


template <int dim>
void Peridynamics<dim>::foresee(const double spacing)
{
  if (!parameters.growth)
    return;
  set_law(spacing);
  if (!parameters.in_bonds)
    foresee_stress(spacing);
  foresee_pressure(spacing);
}


template <int dim>
void Peridynamics<dim>::refuse_in_situ_tension()
{
  if (in_situ_is_zero)
    return;
  displacement.assign(zone.sites().size() * dim, 0.);
  const std::vector<Overstretched> all = overstretched_off_paths();
  const auto worst = std::max_element(all.begin(), all.end(),
                                      [](const Overstretched &a, const Overstretched &b)
                                      { return a.stretch < b.stretch; });
  if (worst == all.end() || worst->stretch < 1.)
    return;
  const double tension =
                 eigenvalues(effective_in_situ_stress(worst->site, worst->bond, worst->middle))[0],
               strength = strength_of(worst->site, worst->bond);
  std::ostringstream place;
  place.precision(4);
  place << worst->middle;
  throw InputError("In situ/Stress: at (" + place.str() + ") m it is " +
                   (scene.has_pore_pressure ? "an effective tension, with the pore pressure, of "
                                            : "a tension of ") +
                   megapascals(tension) + ", and bonds there hold " + megapascals(strength) +
                   " with cells of " + text(zone.spacing()) +
                   " m: with 'Fracture/peridynamics/Tracking = path' cracks would begin all over "
                   "the rock before anything has moved. Compression is negative. Use less tension, "
                   "or cells of less than " +
                   text(std::pow(strength / tension, 2) * zone.spacing()) +
                   " m ('Fracture/peridynamics/Cell size'), which hold more.");
}


template <int dim>
std::string Peridynamics<dim>::place_and_time(const Point<dim> &place,
                                              const StepContext &context) const
{
  std::ostringstream text;
  text.precision(4);
  text << "(" << place << ") m, at " << context.time << " s";
  return text.str();
}


template <int dim>
SymmetricTensor<2, dim> Peridynamics<dim>::effective_stress(const Beginning &path) const
{
  SymmetricTensor<2, dim> stress = path.stress;
  if (scene.has_pore_pressure)
    stress += effective_in_situ_stress(path.bond.site, path.bond.bond, path.bond.middle) -
              scene.in_situ_stress(path.bond.middle);
  return stress;
}


template <int dim>
std::string Peridynamics<dim>::stress_and_strength(const Beginning &path) const
{
  const auto principal = eigenvalues(effective_stress(path));
  return std::string("The mean ") + (scene.has_pore_pressure ? "effective " : "") +
         "stress there is " + megapascals(principal[0]) + " across it and " +
         megapascals(principal[dim - 1]) + " along it; bonds with a horizon of " +
         text(parameters.horizon * zone.spacing()) + " m hold " +
         megapascals(strength_of(path.bond.site, path.bond.bond)) +
         " of a stress that is the same in all directions. That follows from the energy release "
         "rate, the stiffness and the horizon (with half of it, 1.41 times as much): with other "
         "cells cracks begin at another load.";
}


template <int dim>
std::string Peridynamics<dim>::why_none_begins(const Beginning &path, const StepContext &context)
{
  const std::string what =
    "bonds are stretched too far at " + place_and_time(path.bond.middle, context) +
    ", and all around up to the rim of the peridynamic zone, far from all cracks; so near to the "
    "rim none can begin. " +
    stress_and_strength(path) +
    " If only a part of the rock is stretched so, let 'Fracture/peridynamics/Zone' reach two "
    "horizons beyond it; if all of it is, use smaller loads, less tension in 'In situ/Stress', or "
    "smaller cells; or name in 'Fracture/peridynamics/Unbreakable' what shall hold.";
  if (!(context.acceleration > 0. && !std::isnan(scene.crack_pressure)))
    return what;
  // Waves come to the rim, as they do where a crack has reached it.
  if ((told_off_paths & held_at_rim) == 0)
    messages.push_back("They hold: " + what);
  told_off_paths |= held_at_rim;
  return "";
}


/// Bonds that cross the way of a crack feel the stress along it as well, and the faces release only
/// that across it.
template <int dim>
void Peridynamics<dim>::foresee_stress(const double spacing)
{
  double worst = equal_stress * strength();
  std::string message;
  const std::string closure =
    "'Fracture/peridynamics/Closure = in bonds'" +
    std::string(parameters.state_based ? " with 'Fracture/peridynamics/Bond law = bond-based'"
                                       : "");
  for (const InitialCrack<dim> &crack : scene.cracks)
    for (const auto &[middle, normal] : flat_parts(crack))
    {
      const SymmetricTensor<2, dim> stress = scene.in_situ_stress(middle);
      const double across = normal * (stress * normal);
      const SymmetricTensor<2, dim> difference =
        stress - across * dealii::unit_symmetric_tensor<dim>();
      const double along = (trace(stress) - across) / (dim - 1),
                   shear = (stress * normal - across * normal).norm(), unequal = difference.norm();
      if (unequal <= worst)
        continue;
      worst = unequal;
      if (unequal > hopeless_stress * strength())
        throw InputError(
          "In situ/Stress: along the crack '" + crack.text + "' it is " + megapascals(along) +
          ", across it " + megapascals(across) +
          (shear > 1e-6 * unequal ? ", with a shear stress of " + megapascals(shear) : "") +
          ". Bonds ahead of the crack feel the difference, and hold " + megapascals(strength()) +
          " with cells of " + text(spacing) + " m. With more than " + text(hopeless_stress) +
          " times that, runs fail in their first steps. Use " + closure + ", a smaller difference" +
          (dim == 2 ? ", smaller cells, or 'cohesive_xfem'." : " or smaller cells."));
      message =
        "The in-situ stress along the crack '" + crack.text + "', " + megapascals(along) +
        ", is not that across it, " + megapascals(across) +
        (shear > 1e-6 * unequal ? ", and there is a shear stress of " + megapascals(shear) : "") +
        ". Bonds ahead of the crack feel all of it, and what they hold, " +
        megapascals(strength()) + " with cells of " + text(spacing) + " m, is " +
        (unequal > strength() ? "less" : "little more") +
        ": expect pressures and lengths that are wrong by ten per cent and more, or no " +
        "convergence. Use " + closure + (dim == 2 ? " or 'cohesive_xfem'." : ".");
    }
  if (!message.empty())
    messages.push_back(message);
}


/// At rest no step converges with it; in motion the rock beside the crack comes to pieces, and the
/// run goes on.
template <int dim>
void Peridynamics<dim>::foresee_given_pressure(const double spacing)
{
  for (const InitialCrack<dim> &crack : scene.cracks)
    for (const auto &[middle, normal] : flat_parts(crack))
    {
      const double across = normal * (scene.in_situ_stress(middle) * normal),
                   net = scene.crack_pressure + across;
      if (net < strength())
        continue;
      if (parameters.tracked && across >= strength())
        return; // refuse_in_situ_tension() says it better
      const std::string what =
        "in the crack '" + crack.text + "' the net pressure is " + megapascals(net) +
        ", and bonds of cells of " + text(spacing) + " m hold " + megapascals(strength()) +
        "; beyond that they break over an area where a crack should be. Cells of less than " +
        text(std::pow(strength() / net, 2) * spacing) +
        " m hold it ('Fracture/peridynamics/Cell size')";
      if (!parameters.has_inertia)
        throw EntryError("Cracks/Fluid pressure", megapascals(scene.crack_pressure),
                         "less: " + what);
      messages.push_back("'Cracks/Fluid pressure': " + what + ".");
      return;
    }
}


/// The pressure of a fracture in an infinite body is greatest when it is short. It is taken when
/// each wing has the length of the crack, or of a horizon.
template <int dim>
void Peridynamics<dim>::foresee_pressure(const double spacing)
{
  if (scene.crack_pressure > 0.)
    foresee_given_pressure(spacing);
  if (dim != 2 || scene.cracks.empty() || !(scene.injection_rate > 0.))
    return;
  const RockProperties &rock = scene.rock.main();
  const analytical::KgdParameters fracture{
    rock.young_modulus, rock.plane_stress ? 0. : rock.poisson_ratio, scene.rock.fluid().viscosity,
    rock.toughness(), scene.injection_rate};
  const analytical::Kgd kgd(fracture);
  double wing = parameters.horizon * spacing;
  for (const InitialCrack<dim> &crack : scene.cracks)
    wing = std::max(wing, crack.size());
  // Lengths are as t^(2/3).
  const double time = std::pow(wing / kgd.half_length(1.), 1.5);
  const double pressure = kgd.inlet_pressure(time);
  if (pressure < strength())
    return;
  const double finer = std::pow(strength() / pressure, 2) * spacing;
  messages.push_back(
    "A fracture of this rock, fluid and rate (K_m = " + text(fracture.dimensionless_toughness()) +
    ") needs a net pressure of " + megapascals(pressure) + " when its wings are " + text(wing) +
    " m long, and the bonds of cells of " + text(spacing) + " m hold " + megapascals(strength()) +
    ": they may break over an area where a crack should be. Cells of " + text(finer) +
    " m would do ('Fracture/peridynamics/Cell size'), or 'cohesive_xfem'.");
}


/// Rock that is stretched alike in all directions breaks everywhere at once, at a stress which is
/// greater the smaller the horizon.
template <int dim>
void Peridynamics<dim>::warn_of_pressure(const State &state)
{
  if (told_of_pressure || !state.segment_pressure)
    return;
  double pressure = 0.;
  for (const Segment<dim> &segment : all_segments)
    pressure = std::max(pressure,
                        state.segment_pressure(segment.key) +
                          segment.normal * (scene.in_situ_stress(segment.centre) * segment.normal));
  if (pressure < high_pressure * strength())
    return;
  std::ostringstream message;
  message.precision(3);
  message
    << "The net pressure in a crack, " << pressure * 1e-6
    << " MPa, has come near the strength of the bonds, " << strength() * 1e-6
    << " MPa with a horizon of " << parameters.horizon * zone.spacing()
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
    for (const BondAcross &bond : crossing_bonds)
    {
      const auto &[site, b] = bond.view;
      const double stretched = elongation(site, b, displacement);
      if (stretched >= 0. || bonds.is_broken(site, b) || views_of(site, b).front() != bond.view)
        continue;
      // How far its ends are apart across the path, of the image that crosses it.
      const FarEnd end = zone.far_end(site, b);
      Tensor<1, dim> normal = paths.left(bond.crossing);
      if (normal * bond.direction < 0.)
        normal = -normal;
      double parted = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        parted += (bond.direction[d] * coefficients[b].direction[d] < 0. ? -1. : 1.) * normal[d] *
                  ((end.mirrored >> d & 1 ? -1. : 1.) * displacement[end.site * dim + d] -
                   displacement[site * dim + d]);
      // Had they parted as much along it, it would be broken.
      if (parted < softening.last * relative_stretch(site, b) * coefficients[b].length)
        continue;
      double energy = 0.;
      for (const auto &[s, view] : views_of(site, b))
        energy += 0.25 * zone.sites()[s].share * (1. - bond_damage(s, view)) * stiffness(s, view) *
                  stretched * stretched;
      held += energy;
      if (energy > most)
      {
        most = energy;
        where = paths.point(bond.crossing);
      }
    }
  if (held <= little_held * dissipated)
    return "";
  std::ostringstream reason;
  reason.precision(3);
  reason << "the crack at (" << where
         << ") m is made to slide as it opens. Bonds across it that this presses do not break, and "
            "hold what has parted: they store "
         << 100. * held / dissipated
         << " % of what the crack has taken, and all that follows would be wrong. Let what pulls "
            "act across the crack, or use 'cohesive_xfem'";
  return reason.str();
}


template <int dim>
double Peridynamics<dim>::fracture_volume(const State &state, const Collectives &collectives) const
{
  std::vector<double> volume(1, 0.);
  for (unsigned int k = 0; k < owned_segments.size(); ++k)
    volume[0] += owned_segments[k].area * aperture(k, state);
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
  for (unsigned int d = 0; d < dim && !all_segments.empty(); ++d)
  {
    const auto [first, last] = std::minmax_element(all_segments.begin(), all_segments.end(),
                                                   [d](const Segment<dim> &a, const Segment<dim> &b)
                                                   { return a.centre[d] < b.centre[d]; });
    greatest = std::max(greatest, last->centre[d] - first->centre[d] + zone.spacing());
  }
  return greatest;
}


template <int dim>
Verdict Peridynamics<dim>::verdict_on(const StepContext &context,
                                      const State &state,
                                      const Collectives &collectives) const
{
  Verdict verdict;
  if (all_segments.empty())
    return verdict;
  double area = 0.;
  for (const Segment<dim> &segment : all_segments)
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
    parameters.most_advances * zone.spacing() * std::max<std::size_t>(n_tips_before, 1);
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
    for (const unsigned int i : zone.peridynamic_sites())
    {
      const double place = zone.position(zone.sites()[i].place)[d];
      lower[d] = std::min(lower[d], place);
      upper[d] = std::max(upper[d], place);
    }
    for (const auto &box : shape.boxes)
    {
      lower[d] = std::min(lower[d], box.lower_bound(d));
      upper[d] = std::max(upper[d], box.upper_bound(d));
    }
    const double more = parameters.zone_growth * zone.spacing();
    lower[d] = std::max(lower[d] - more, zone.room().lower_bound(d));
    upper[d] = std::min(upper[d] + more, zone.room().upper_bound(d));
  }
  return "bonds are stretched too far up to the rim of the peridynamic zone, however short the "
         "step "
         "is. A greater zone from the start: 'Fracture/peridynamics/Zone = " +
         to_string(dealii::BoundingBox<dim>({lower, upper})) + "'" + what_bonds_carry();
}


template <int dim>
std::string Peridynamics<dim>::what_bonds_carry() const
{
  return ". Bonds of cells of " + text(zone.spacing()) + " m hold " + megapascals(strength()) +
         ", the more the smaller the cells are; if pressures or in-situ stresses of the scene "
         "differ "
         "by as much, use smaller cells, or 'cohesive_xfem'.";
}

#define INSTANTIATE(dim)                                                                           \
  template void Peridynamics<dim>::refuse_what_bonds_do_not_know() const;                          \
  template double Peridynamics<dim>::strength() const;                                             \
  template void Peridynamics<dim>::foresee(double);                                                \
  template void Peridynamics<dim>::foresee_stress(double);                                         \
  template void Peridynamics<dim>::refuse_in_situ_tension();                                       \
  template std::string Peridynamics<dim>::place_and_time(const Point<dim> &, const StepContext &)  \
    const;                                                                                         \
  template SymmetricTensor<2, dim> Peridynamics<dim>::effective_stress(const Beginning &) const;   \
  template std::string Peridynamics<dim>::stress_and_strength(const Beginning &) const;            \
  template std::string Peridynamics<dim>::why_none_begins(const Beginning &, const StepContext &); \
  template void Peridynamics<dim>::foresee_given_pressure(double);                                 \
  template void Peridynamics<dim>::foresee_pressure(double);                                       \
  template std::string Peridynamics<dim>::why_sliding_crack_holds() const;                         \
  template void Peridynamics<dim>::warn_of_pressure(const State &);                                \
  template double Peridynamics<dim>::fracture_volume(const State &, const Collectives &) const;    \
  template double Peridynamics<dim>::extent() const;                                               \
  template Verdict Peridynamics<dim>::verdict_on(const StepContext &, const State &,               \
                                                 const Collectives &) const;                       \
  template std::string Peridynamics<dim>::wanted_zone() const;                                     \
  template std::string Peridynamics<dim>::what_bonds_carry() const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
