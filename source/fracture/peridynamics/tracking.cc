// `Tracking = path`: bonds soften only where they cross the way of a crack, which is found from the
// stress ahead of its tip.
#include "fracture/peridynamics/peridynamics.h"
#include "fracture/peridynamics/pores_across.h"
#include "stockwork/mesh/key.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Turn of a way at a piece, and at its first one [rad].
constexpr double most_turn = 20. * M_PI / 180., most_first_turn = 70. * M_PI / 180.;
/// Between a path that begins beyond another one and that [rad].
constexpr double least_off_line = 20. * M_PI / 180.;

/// Of the stress at a place, from the tip, in the mean ahead of it. Near the tip the stress is the
/// lattice's, so most of it is that of a ring, 1.7 units wide; and sites come in and go out at its
/// sides, at 70 to 110 degrees, without a jump. Where a way is oblique to the mesh, the process
/// zone carries some shear. It turns the mean of the stress by up to 1.7 degrees, one way straight
/// ahead and the other way beside that; with these shares, 0.1
/// (doc/laboratory/peridynamics_paths.md).
double ring_weight(const Tensor<1, 2> &away, const Tensor<1, 2> &ahead)
{
  constexpr double first = 70. * M_PI / 180., last = 110. * M_PI / 180.;
  const double r = away.norm();
  if (r == 0.)
    return 0.;
  const double cosine = std::clamp(away * ahead / r, -1., 1.);
  const double t = std::clamp((last - std::acos(cosine)) / (last - first), 0., 1.);
  return r * r * std::exp(-0.5 * r * r) * (1.5 - 0.5 * cosine * cosine) * t * t * (3. - 2. * t);
}

/// The stress ahead of a tip without that share of the shear on the line ahead which is not in
/// situ.
SymmetricTensor<2, 2> without_shear(SymmetricTensor<2, 2> stress,
                                    const SymmetricTensor<2, 2> &in_situ,
                                    const Tensor<1, 2> &ahead,
                                    const double share)
{
  const Tensor<1, 2> normal({-ahead[1], ahead[0]});
  const double shear = ahead * ((stress - in_situ) * normal);
  stress -= 2. * share * shear * symmetrize(outer_product(ahead, normal));
  return stress;
}

/// A direction, turned towards another one, by so much at most.
Tensor<1, 2> turned(const Tensor<1, 2> &from, const Tensor<1, 2> &to, const double most)
{
  const double angle =
    std::clamp(std::atan2(from[0] * to[1] - from[1] * to[0], from * to), -most, most);
  return Tensor<1, 2>({std::cos(angle) * from[0] - std::sin(angle) * from[1],
                       std::sin(angle) * from[0] + std::cos(angle) * from[1]});
}

/// A direction that leads away from a line, to the side that its normal points to.
Tensor<1, 2> off_line(const Tensor<1, 2> &direction, const Tensor<1, 2> &normal)
{
  const Tensor<1, 2> along({-normal[1], normal[0]});
  const double side = direction * along < 0. ? -1. : 1.;
  return direction * normal >= std::sin(least_off_line)
           ? direction
           : std::sin(least_off_line) * normal + side * std::cos(least_off_line) * along;
}

/// A place itself, if it is that of a cell, or the nearest cell of the zone. The way of a tip that
/// has come to the rim of the zone, or to a side of the domain, leads beyond, where no rank has a
/// cell that a piece could belong to.
template <int dim>
Place<dim> cell_of_zone(const Zone<dim> &zone, const Place<dim> &place)
{
  bool is_cell = true;
  for (unsigned int v = 0; v < 1u << dim; ++v)
  {
    Place<dim> corner = place;
    for (unsigned int d = 0; d < dim; ++d)
      corner[d] += v >> d & 1;
    is_cell = is_cell && zone.find(corner) != dealii::numbers::invalid_unsigned_int;
  }
  if (is_cell)
    return place;
  const auto distance = [&place](const Place<dim> &cell)
  {
    int sum = 0;
    for (unsigned int d = 0; d < dim; ++d)
      sum += (cell[d] - place[d]) * (cell[d] - place[d]);
    return sum;
  };
  return *std::min_element(zone.cells().begin(), zone.cells().end(),
                           [&](const Place<dim> &a, const Place<dim> &b)
                           { return distance(a) < distance(b); });
}
} // namespace


template <int dim>
void Peridynamics<dim>::find_crossing_bonds()
{
  if constexpr (dim == 2)
    if (crossing_bonds.follow(paths))
    {
      new_paths.look_beside(paths);
      segments_lag = true;
    }
}


template <int dim>
void Peridynamics<dim>::tell_of_boundary()
{
  if constexpr (dim == 2)
  {
    const auto beyond = [this](const TrackedPaths &all)
    {
      std::map<std::pair<unsigned int, unsigned int>, Point<2>> tips;
      for (const TrackedPaths::End &end : all.ends())
        if (const Point<2> tip = all.tip(end);
            all.advance(end) > 0. && !lattice.zone.is_inside(tip, 0.5 * lattice.zone.spacing()))
          tips[{end.path, end.side}] = tip;
      return tips;
    };
    const auto before = beyond(committed_paths);
    for (const auto &[end, tip] : beyond(paths))
      if (before.count(end) == 0)
      {
        std::ostringstream text;
        text << "A crack at (" << tip << ") m has reached the boundary of the domain.";
        messages.push_back(text.str());
      }
  }
}


template <int dim>
void Peridynamics<dim>::follow_paths()
{
  fracture.cells.clear();
  fracture.segments.clear();
  find_crossing_bonds();
  if constexpr (dim == 2)
  {
    const double h = lattice.zone.spacing();
    const auto read = [&]
    {
      TrackedPaths::Readings readings;
      for (const BondAcross<dim> &bond : crossing_bonds)
      {
        const auto &[site, b] = bond.view;
        readings.emplace_back(bond.crossing,
                              lattice.zone.sites()[site].share * lattice.coefficients[b].stiffness *
                                lattice.coefficients[b].length *
                                std::abs(bond.direction * paths.left(bond.crossing)));
      }
      return readings;
    };
    // A way ends within a horizon of the tip, and bonds across it a horizon farther on; so do they
    // on the other path, and some more.
    paths.share_evenly(read, (4. * parameters.horizon + 2.) * h);
    for (const TrackedPaths::Piece &piece : paths.wet_pieces())
    {
      Segment<dim> segment;
      const Tensor<1, dim> along = piece.to - piece.from;
      segment.area = along.norm();
      segment.centre = piece.from + 0.5 * along;
      segment.key = Key().add(segment.centre, 1e-4 * h);
      segment.normal = cross_product_2d(-along) / along.norm();
      if (segment.normal[1] < 0. || (segment.normal[1] == 0. && segment.normal[0] < 0.))
        segment.normal = -segment.normal;
      segment.at_tip = piece.at_tip;
      FractureCell<dim> cell;
      cell.normal = segment.normal;
      for (unsigned int d = 0; d < dim; ++d)
        cell.place[d] = static_cast<int>(std::floor(
          (segment.centre[d] - lattice.zone.position(Place<dim>{})[d]) / h + same_place));
      cell.place = cell_of_zone<dim>(lattice.zone, cell.place);
      fracture.cells.push_back(cell);
      for (unsigned int v = 0; v < 1u << dim; ++v)
      {
        Place<dim> corner = cell.place;
        double weight = 1.;
        for (unsigned int d = 0; d < dim; ++d)
        {
          corner[d] += v >> d & 1;
          weight *= 1. - std::abs(segment.centre[d] - lattice.zone.position(corner)[d]) / h;
        }
        const unsigned int site = lattice.zone.find(corner);
        if (site == dealii::numbers::invalid_unsigned_int ||
            lattice.zone.sites()[site].pressure_dof == dealii::numbers::invalid_dof_index)
          continue;
        segment.pore_pressure.bulk.push_back(lattice.zone.sites()[site].pressure_dof);
        segment.pore_pressure.bulk_coefficients.push_back(weight);
        segment.pore_distance +=
          weight * std::abs((lattice.zone.position(corner) - segment.centre) * segment.normal);
      }
      fracture.segments.push_back(segment);
    }
    for (unsigned int i = 0; i < fracture.segments.size(); ++i)
      for (const unsigned int other : paths.wet_pieces()[i].neighbours)
        fracture.segments[i].neighbours.push_back(
          {fracture.segments[other].key, 0.5 * fracture.segments[i].area, 1.});
  }
  tips.look_at(paths);
}


template <int dim>
SymmetricTensor<2, dim> Peridynamics<dim>::stress_ahead(const Point<dim> &tip,
                                                        const Tensor<1, dim> &ahead,
                                                        const State &state,
                                                        const OfCells &of_cells) const
{
  SymmetricTensor<2, dim> stress;
  if constexpr (dim == 2)
  {
    const double length = parameters.horizon * lattice.zone.spacing();
    stress = mean_stress(
      tip, 3. * length,
      [&](const Tensor<1, dim> &away) { return ring_weight(away / length, ahead); }, state,
      of_cells);
  }
  return stress;
}


template <int dim>
std::string Peridynamics<dim>::begin_paths(const StepContext &context,
                                           const State &state,
                                           const OfCells &of_cells)
{
  const std::string reason = new_paths.begin(
    context, displacement, of_cells.dilatation_forces,
    [&](const Point<dim> &place, const double reach,
        const std::function<double(const Tensor<1, dim> &)> &weight)
    { return mean_stress(place, reach, weight, state, of_cells); },
    paths);
  for (std::string &message : new_paths.take_messages())
    messages.push_back(std::move(message));
  return reason;
}


template <int dim>
void Peridynamics<dim>::track(const State &state, const OfCells &of_cells)
{
  if constexpr (dim == 2)
  {
    const double h = lattice.zone.spacing();
    const auto energy = tips.energy(paths);
    // Before anything softens a way may still be another.
    const auto is_untouched = [&](const TrackedPaths::End &end)
    { return tips.is_untouched(end, energy); };
    // What has begun beyond another path, and may still be another, has not met anything for good.
    const auto may_change = [&](const TrackedPaths::End &end)
    { return paths.began_beyond(end.path) && is_untouched(end); };
    for (const TrackedPaths::Meeting &meeting : paths.meetings())
      if (!may_change(meeting.end) && (!meeting.beyond || is_untouched(*meeting.beyond)))
      {
        const Tensor<1, dim> ahead = paths.direction(meeting.end);
        const SymmetricTensor<2, dim> stress =
          stress_ahead(meeting.place, meeting.across, state, of_cells);
        paths.begin_beyond(
          meeting,
          off_line(turned(ahead, across_greatest(stress, ahead), most_first_turn), meeting.across));
      }
    for (const TrackedPaths::End &end : paths.ends())
      if (!paths.is_all_way(end.path) && is_untouched(end) && !paths.is_joined(end))
        paths.forget_way(end);
    // What a crack that is shorter than a horizon adds to the stress is turned by where the nodes
    // beside it lie (a notch of a cell, a third of a cell off their middle: by 20 degrees and
    // more). So it goes straight on, or as the stress in situ turns it; all other stress counts by
    // its share, in full from two horizons on.
    const auto share_to_drop = [&](const TrackedPaths::End &end)
    {
      return paths.is_all_way(end.path)
               ? 0.
               : std::clamp(2. - paths.full_length(end.path) / (parameters.horizon * h), 0., 1.);
    };
    // All ends by turns, so that none finds the others farther on than they find it.
    std::vector<std::pair<TrackedPaths::End, Tensor<1, dim>>> further;
    do
    {
      further.clear();
      for (const TrackedPaths::End &end : paths.ends())
        if (paths.lead(end) < (parameters.horizon - 1e-6) * h)
        {
          const Tensor<1, dim> ahead = paths.direction(end);
          const SymmetricTensor<2, dim> stress =
            without_shear(stress_ahead(paths.tip(end), ahead, state, of_cells),
                          scene.in_situ_stress(paths.tip(end)), ahead, share_to_drop(end));
          further.emplace_back(end, turned(ahead, across_greatest(stress, ahead),
                                           paths.has_set_out(end) ? most_turn : most_first_turn));
        }
      paths.extend(further);
    } while (!further.empty());
    find_crossing_bonds();
  }
}

#define INSTANTIATE(dim)                                                                  \
  template void Peridynamics<dim>::find_crossing_bonds();                                 \
  template void Peridynamics<dim>::tell_of_boundary();                                    \
  template void Peridynamics<dim>::follow_paths();                                        \
  template SymmetricTensor<2, dim> Peridynamics<dim>::stress_ahead(                       \
    const Point<dim> &, const Tensor<1, dim> &, const State &, const OfCells &) const;    \
  template std::string Peridynamics<dim>::begin_paths(const StepContext &, const State &, \
                                                      const OfCells &);                   \
  template void Peridynamics<dim>::track(const State &, const OfCells &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
