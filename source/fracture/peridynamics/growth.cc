#include "fracture/peridynamics/peridynamics.h"

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
/// Of the stretch at which they soften, at which bonds get the unknown that it takes.
constexpr double soon_to_soften = 0.9;
/// Solves within a step after which it is too long.
constexpr unsigned int most_passes = 60;
/// Attempts at a step after which it is no matter how far tips advance.
constexpr unsigned int attempts_for_advances = 3;
/// Attempts at a step, each with half the length of the one before, after which its length is not
/// what is wrong.
constexpr unsigned int attempts_for_length = 6;
/// In steps that get shorter, and between which the zone grows, while the fracture does not.
constexpr unsigned int most_stops_at_rim = 12;
} // namespace


template <int dim>
typename Peridynamics<dim>::OfCells
Peridynamics<dim>::pressure_stretch(const State &state, const Collectives &collectives) const
{
  if (parameters.in_bonds)
  {
    const auto strain = pressure_in_bonds.strain(state);
    return {{}, strain, dilatation_forces(state, strain)};
  }
  std::vector<double> result(fracture.cells.size(), 0.);
  const RockProperties &rock = scene.rock.main();
  const double compliance = 1. / (dim * rock.lame_lambda() + 2. * rock.shear_modulus());
  const double by_fluid = state.segment_pressure ? lattice.relief_by_fluid : 0.;
  if (by_fluid > 0. && scene.has_pore_pressure)
  {
    for (unsigned int i = 0; i < fracture.owned_cells.size(); ++i)
      result[fracture.owned_cells[i]] =
        -lattice.rock_at(fracture.cells[fracture.owned_cells[i]].place).biot_coefficient *
        by_fluid * value(fracture.owned_segments[i].pore_pressure, state.current);
    collectives.sum(result);
  }
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
  {
    const auto &n = fracture.cells[i].normal;
    const double in_situ = n * (scene.in_situ_stress(fracture.segments[i].centre) * n);
    result[i] -= compliance * in_situ;
    if (by_fluid > 0.)
      result[i] += by_fluid * (state.segment_pressure(fracture.segments[i].key) + in_situ);
  }
  return {result, {}, dilatation_forces(state, {})};
}


template <int dim>
double Peridynamics<dim>::relief_at(const unsigned int site,
                                    const unsigned int bond,
                                    const std::vector<double> &relief) const
{
  Tensor<1, dim> half, middle; // in spacings
  for (unsigned int d = 0; d < dim; ++d)
  {
    half[d] = 0.5 * lattice.stencil[bond].offset[d];
    middle[d] = lattice.zone.sites()[site].place[d] + half[d];
  }
  double nearest = parameters.horizon + 1., result = 0.;
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
  {
    Tensor<1, dim> away = middle;
    for (unsigned int d = 0; d < dim; ++d)
      away[d] -= fracture.cells[i].place[d] + 0.5;
    if (std::abs(away * fracture.cells[i].normal) >
        std::abs(half * fracture.cells[i].normal) - same_place)
      continue; // the plane of the fracture does not cross it
    // Of several equally near, the one that relieves most, whatever their order.
    const double distance = away.norm();
    if (distance < nearest - same_place || (distance < nearest + same_place && relief[i] > result))
    {
      nearest = std::min(nearest, distance);
      result = relief[i];
    }
  }
  return result;
}


template <int dim>
double Peridynamics<dim>::added_stretch(const unsigned int site,
                                        const unsigned int bond,
                                        const OfCells &of_cells) const
{
  return parameters.in_bonds
           ? pressure_in_bonds.stretch(site, bond, pressure_in_bonds.shares(site, bond, false),
                                       of_cells.strain)
           : lattice.in_situ_stretch(site, bond) +
               relief_at(site, bond, of_cells.relief) / lattice.rock_of_bonds.modulus(site, bond);
}


template <int dim>
double Peridynamics<dim>::added_dilatation(const unsigned int site,
                                           const unsigned int bond,
                                           const double added,
                                           const OfCells &of_cells) const
{
  if (of_cells.dilatation_forces.empty())
    return 0.;
  return parameters.in_bonds
           ? pressure_in_bonds.dilatation(site, bond, pressure_in_bonds.shares(site, bond, false),
                                          of_cells.strain)
           : dim * lattice.rock_of_bonds.modulus(site, bond) * added;
}


template <int dim>
double Peridynamics<dim>::stretch_that_counts(const unsigned int site,
                                              const unsigned int bond,
                                              const double added,
                                              const double dilated,
                                              const std::vector<double> &displacement,
                                              const OfCells &of_cells) const
{
  return lattice.driving_stretch(
    site, bond,
    lattice.elongation(site, bond, displacement) + added * lattice.coefficients[bond].length,
    lattice.force_of_dilatations(site, bond, of_cells.dilatation_forces) +
      2. * lattice.force_of_dilatation(bond) * dilated,
    relative_energy(site, bond));
}


template <int dim>
std::vector<typename Peridynamics<dim>::Candidate> Peridynamics<dim>::overstretched(
  const std::vector<double> &u, const OfCells &of_cells, Rim &rim) const
{
  const double least = lattice.softening.brittle() ? 1. : soon_to_soften;
  double most_of_cells = 0.;
  for (const double relief : of_cells.relief)
    most_of_cells = std::max(most_of_cells, relief);
  for (const SymmetricTensor<2, dim> &strain : of_cells.strain)
    most_of_cells = std::max(most_of_cells, strain.norm());
  std::vector<Candidate> candidates;
  const unsigned int half = lattice.stencil.size() / 2;
  const auto consider = [&](const unsigned int i, const unsigned int b)
  {
    if (lattice.bonds.is_broken(i, b) || lattice.never_breaks(i, b))
      return;
    const bool breakable = lattice.bonds.can_break(i, b);
    if (b >= half && breakable && lattice.zone.far_end(i, b).mirrored == 0)
      return; // seen from the other end
    const auto ratio_with = [&](const double more, const double dilated)
    {
      return rounded(stretch_that_counts(i, b, more, dilated, u, of_cells) /
                     lattice.softening.first);
    };
    const double most = most_of_cells / lattice.rock_of_bonds.modulus(i, b) +
                        (parameters.in_bonds ? 0. : lattice.in_situ_stretch(i, b));
    const bool dilates = lattice.law.dilatation_modulus > 0. && !of_cells.dilatation_forces.empty();
    const double most_dilated = dilates ? dim * std::max(most_of_cells, most) : 0.;
    if (ratio_with(most, most_dilated) < least || softening_bonds.find(i, b) != nullptr)
      return;
    const double added = added_stretch(i, b, of_cells),
                 ratio = ratio_with(added, added_dilatation(i, b, added, of_cells));
    if (ratio < least)
      return;
    if (breakable)
      candidates.push_back({ratio, i, b});
    else if (zone_may_include(i, b))
      rim = std::max(rim, Rim::grows);
    else
      rim = Rim::stays;
  };
  if (parameters.tracked)
    for (const BondAcross<dim> &bond : crossing_bonds)
      consider(bond.view.first, bond.view.second);
  else
    for (const unsigned int i : lattice.zone.peridynamic_sites())
      for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
        consider(i, b);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate &a, const Candidate &b)
            {
              return std::make_tuple(-a.stretch, a.site, a.bond) <
                     std::make_tuple(-b.stretch, b.site, b.bond);
            });
  return candidates;
}


template <int dim>
void Peridynamics<dim>::break_bonds(const std::vector<Candidate> &candidates)
{
  // What stress in situ does between the faces of a dry path is its bonds', for it has no segments:
  // they keep their unknowns as long as it is dry.
  const auto is_dry = [this](const BondView &view)
  { return parameters.tracked && pressure_in_bonds.dry_stretch(view.first, view.second) != 0.; };
  const auto break_bond = [this](const BondView &view)
  {
    lattice.bonds.set_broken(view.first, view.second);
    cracked.set_broken(view.first, view.second);
  };
  std::vector<SofteningBond> dry;
  for (const SofteningBond &bond : softening_bonds)
    if (is_dry(bond.view))
      dry.push_back(bond);
    else
      break_bond(bond.view);
  // The most stretched first, those as much stretched with them.
  for (unsigned int k = 0; k < candidates.size(); ++k)
  {
    if (k >= parameters.bonds_per_pass &&
        candidates[k].stretch <
          candidates[parameters.bonds_per_pass - 1].stretch - 0.5 * same_stretch)
      break;
    const auto [stretch, site, bond] = candidates[k];
    const BondView view = lattice.bonds.views_of(site, bond).front();
    if (lattice.bonds.is_broken(site, bond) ||
        std::any_of(dry.begin(), dry.end(), [&](const auto &other) { return other.view == view; }))
      continue; // the image of another
    dissipated += relative_energy(site, bond) * lattice.energy_at_unit_stretch({site, bond}) *
                  std::pow(stretch * lattice.critical_stretch, 2);
    if (!is_dry(view))
      break_bond(view);
    else
    {
      SofteningBond broken;
      broken.view = view;
      broken.committed = broken.trial = lattice.softening.last;
      dry.push_back(broken);
    }
  }
  softening_bonds.replace(std::move(dry));
}


template <int dim>
Verdict Peridynamics<dim>::advance(const StepContext &context,
                                   const State &state,
                                   const Collectives &collectives)
{
  Verdict verdict;
  if (parameters.explicit_steps)
  {
    if ((parameters.growth || lattice.stretch_of_given_pressure() != 0.) &&
        follow_explicit_bonds(state, collectives))
      verdict.kind = Verdict::Kind::topology_changed;
    return verdict;
  }
  if (parameters.growth || parameters.written != Parameters<dim>::Bonds::none)
    displacement = lattice.zone.displacement(state.current.bulk, collectives);
  if (!parameters.growth)
    return verdict_on(context, state, collectives);
  Rim rim = Rim::away;
  const OfCells of_cells = pressure_stretch(state, collectives);
  if (parameters.tracked)
  {
    if (const std::string reason = begin_paths(context, state, of_cells); !reason.empty())
    {
      verdict.kind = Verdict::Kind::stop;
      verdict.reason = reason;
      return verdict;
    }
    track(state, of_cells);
  }
  const std::vector<Candidate> candidates = overstretched(displacement, of_cells, rim);
  if (rim == Rim::stays && context.acceleration > 0. && !std::isnan(scene.crack_pressure))
  {
    // Waves come to the rim, and what they leave there is no end of what runs elsewhere.
    if (!told_of_rim)
      messages.push_back("A crack has reached the rim of the peridynamic zone and cannot grow "
                         "beyond. Enlarge 'Fracture/peridynamics/Zone'.");
    told_of_rim = true;
  }
  else if (rim == Rim::stays)
  {
    // Fluid that is pumped on would raise the pressure, and what pulls would stretch bonds that
    // hold; nothing else would come of it.
    verdict.kind = Verdict::Kind::stop;
    verdict.reason =
      std::string(context.step == 1 ? "bonds are stretched too far in the first step already, up to"
                                    : "a crack has reached") +
      " the rim of the peridynamic zone, which " +
      (parameters.zone_growth > 0
         ? "has no room to grow. Enlarge 'Fracture/peridynamics/Zone', or make the elements around "
           "it squares"
         : "does not grow. Enlarge 'Fracture/peridynamics/Zone', or let it grow by " +
             (parameters.cell_size > 0.
                ? "'Fracture/peridynamics/Zone growth'"
                : "'Fracture/peridynamics/Cell size = " + text(lattice.zone.spacing()) + " m'")) +
      what_bonds_carry();
    return verdict;
  }
  if (rim == Rim::grows)
  {
    enlarge_zone(); // for where this step wants to go: it takes effect after a shorter one
    verdict.kind = Verdict::Kind::reject;
    has_rejected = true;
    verdict.reason = "a crack has come to the rim of the zone, which grows between steps";
    // Each time as far as the rim: all of the rock is stretched too far ahead.
    if (++stops_at_rim >= most_stops_at_rim)
    {
      verdict.kind = Verdict::Kind::stop;
      verdict.reason = wanted_zone();
    }
    return verdict;
  }

  if (!parameters.tracked)
    warn_of_pressure(state); // on a path, bonds break nowhere else

  const unsigned int n_tips = std::max<std::size_t>(n_tips_before, 1);
  const unsigned int n_new = fracture.cells.size() - n_segments_before;
  const bool changed = lattice.softening.brittle()
                         ? !candidates.empty()
                         : soften_bonds(displacement, of_cells, candidates);
  if (!changed)
  {
    if (const std::string reason = why_sliding_crack_holds(); !reason.empty())
    {
      verdict.kind = Verdict::Kind::stop;
      verdict.reason = reason;
      return verdict;
    }
    // A tip may have fallen back since it was farthest. Fluid that stayed ahead of it would suck at
    // rock that is closed. Once in a step, or pieces would become wet and dry by turns; in porous
    // rock it belongs there, see Tips.
    if (parameters.tracked && !scene.has_pore_pressure && !has_let_fluid_back)
    {
      has_let_fluid_back = paths.let_fluid_back();
      if (has_let_fluid_back)
      {
        refresh_segments();
        ++passes;
        verdict.kind = Verdict::Kind::topology_changed;
        return verdict;
      }
    }
    verdict = verdict_on(context, state, collectives);
    if (verdict.kind != Verdict::Kind::accept)
      return verdict;
    verdict.advances = n_new == 0 ? 0 : 1 + (n_new - 1) / n_tips;
    verdict.length_is_right = softening_bonds.relaxation() < 1.;
    return verdict;
  }
  // A fracture in viscous fluid may jump by several cells in steps of any length.
  const bool too_far =
    n_new > parameters.most_advances * n_tips && context.attempt + 1 < attempts_for_advances;
  if (too_far || passes >= most_passes)
  {
    verdict.kind = Verdict::Kind::reject;
    has_rejected = true;
    std::ostringstream reason;
    reason << "a tip wants to advance by more than " << parameters.most_advances
           << " cells in a step";
    verdict.reason = passes >= most_passes ? "bonds go on breaking" : reason.str();
    if (passes >= most_passes && context.attempt >= attempts_for_length)
    {
      verdict.kind = Verdict::Kind::stop;
      verdict.reason = "bonds go on breaking, however short the step is" + what_bonds_carry();
    }
    return verdict;
  }

  if (lattice.softening.brittle())
  {
    break_bonds(candidates);
    if (parameters.tracked)
    {
      tips.look_at(paths);
      tips.advance(paths, {}); // there are other bonds, whether or not there are other segments
    }
  }

  refresh_segments();
  ++passes;
  verdict.kind = Verdict::Kind::topology_changed;
  return verdict;
}

#define INSTANTIATE(dim)                                                                        \
  template Peridynamics<dim>::OfCells Peridynamics<dim>::pressure_stretch(                      \
    const State &, const Collectives &) const;                                                  \
  template double Peridynamics<dim>::relief_at(unsigned int, unsigned int,                      \
                                               const std::vector<double> &) const;              \
  template double Peridynamics<dim>::added_stretch(unsigned int, unsigned int, const OfCells &) \
    const;                                                                                      \
  template double Peridynamics<dim>::added_dilatation(unsigned int, unsigned int, double,       \
                                                      const OfCells &) const;                   \
  template double Peridynamics<dim>::stretch_that_counts(unsigned int, unsigned int, double,    \
                                                         double, const std::vector<double> &,   \
                                                         const OfCells &) const;                \
  template std::vector<Peridynamics<dim>::Candidate> Peridynamics<dim>::overstretched(          \
    const std::vector<double> &, const OfCells &, Rim &) const;                                 \
  template void Peridynamics<dim>::break_bonds(const std::vector<Candidate> &);                 \
  template Verdict Peridynamics<dim>::advance(const StepContext &, const State &,               \
                                              const Collectives &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
