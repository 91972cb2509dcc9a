#include "fracture/cohesive_xfem/cohesive_xfem.h"

#include <cmath>
#include <sstream>

namespace stockwork::cohesive_xfem
{
using dealii::Tensor;

namespace
{
/// Of what drives a tip that does not move over the strength: it will not move any more.
constexpr double hopeless = 20.;

constexpr const char *remedy =
  " Make the cells alike as far as the fracture shall run (Mesh/Box/X spacing and Y spacing, 'size "
  "from place to place').";

/// Unit vector in the direction of v, its angle rounded to 1e-6, so that the noise of a solver
/// neither tilts a crack nor tells numbers of ranks apart.
Tensor<1, 2> rounded_direction(const Tensor<1, 2> &v)
{
  const double grid = 1e-6;
  const double angle = std::round(std::atan2(v[1], v[0]) / grid) * grid;
  Tensor<1, 2> t;
  t[0] = std::cos(angle);
  t[1] = std::sin(angle);
  // Rounding leaves 1e-7 of a right angle; along the axes a crack shall be exactly straight.
  for (unsigned int d = 0; d < 2; ++d)
    if (std::abs(t[d]) < grid)
    {
      t[d] = 0.;
      t[1 - d] = t[1 - d] > 0. ? 1. : -1.;
    }
  return t;
}
} // namespace

template <int dim>
double CohesiveXFEM<dim>::distance_to_damage(const unsigned int crack,
                                             const CrackEnd end,
                                             const double least,
                                             const State &state) const
{
  const auto &pieces = discontinuity.paths()[crack].pieces;
  const unsigned int n = pieces.size();
  double distance = 0.;
  for (unsigned int k = 0; k < n; ++k)
  {
    const unsigned int i = end == CrackEnd::first ? k : n - 1 - k;
    const auto &columns = discontinuity.enrichment().jumps(crack, i);
    const JumpShapes<dim> shapes(pieces[i]);
    const PointDamage history = damage(pieces[i]);
    const CohesiveLaw law = law_at(pieces[i]);
    for (unsigned int r = 0; r < n_points; ++r)
    {
      const unsigned int q = end == CrackEnd::first ? r : n_points - 1 - r;
      if (law.evaluate(separation(pieces[i], shapes, q, columns, state.current.extra), history[q])
            .damage >= least)
        return distance;
      distance += pieces[i].length() * shapes.share[q];
    }
  }
  return distance;
}


template <int dim>
bool CohesiveXFEM<dim>::fluid_overpowers(const unsigned int crack,
                                         const CrackEnd end,
                                         const State &state) const
{
  if (!state.segment_pressure)
    return false;
  const auto &spans = discontinuity.spans(crack);
  const unsigned int n = spans.size();
  double most = 0.;
  for (unsigned int i = 0; i < std::min(2u, n); ++i)
  {
    const CrackSpan &span = spans[end == CrackEnd::first ? i : n - 1 - i];
    most =
      std::max(most, std::abs(state.segment_pressure(discontinuity.key(crack, span)) -
                              closing_stress(discontinuity.paths()[crack].pieces[span.first])));
  }
  return most > 10. * law_at(discontinuity.paths()[crack].piece_at(end)).strength;
}


template <int dim>
double CohesiveXFEM<dim>::reached_length(const unsigned int crack,
                                         const CrackEnd end,
                                         const State &state) const
{
  const auto &pieces = discontinuity.paths()[crack].pieces;
  const auto &spans = discontinuity.spans(crack);
  const CrackSpan &last = discontinuity.span_at(crack, end);
  const double length = discontinuity.length(crack, last);
  const std::uint64_t key = discontinuity.key(crack, last);
  if (spans.size() < 2 || discontinuity.paths()[crack].ends_on[static_cast<int>(end)] >= 0 ||
      bare_tips.count(key) == 0 || !state.segment_pressure || !std::isnan(scene.crack_pressure) ||
      state.segment_pressure(key) >= closing_stress(pieces[last.first]))
    return length;

  const CrackSpan &next = spans[end == CrackEnd::first ? 1 : spans.size() - 2];
  const double in_last = std::max(volume(crack, last, state.current), 0.),
               in_next = std::max(volume(crack, next, state.current), 0.);
  if (in_last == 0. || in_next == 0.)
    return 0.;
  // With w ~ x^(2/3) at the distance x from the front, V ~ x^(5/3) is beyond any place.
  const double ratio = std::pow(in_last / (in_last + in_next), 0.6);
  return std::min(length, discontinuity.length(crack, next) * ratio / (1. - ratio));
}


template <int dim>
std::string CohesiveXFEM<dim>::reason_to_stop(const State &state) const
{
  bool swells = false;
  for (unsigned int c = 0; c < discontinuity.paths().size(); ++c)
  {
    // One that has met another may go on beyond it.
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
      if (parameters.growth && discontinuity.far_side(c, end))
        return "";
    if (limits.has_grown[c])
    {
      // A tip that stops in this very step has its step accepted.
      if (c >= committed_paths.size() || committed_paths[c].is_tip[0] ||
          committed_paths[c].is_tip[1])
        return "";
      const unsigned int n = discontinuity.paths()[c].pieces.size();
      swells |= volume(c, {0, n - 1}, state.current) > limits.volume[c] * (1. + 1e-9);
    }
  }
  return swells
           ? "no fracture that the fluid drives can grow any more, and more is pumped into it. " +
               limits.blocked_by
           : "";
}


template <int dim>
void CohesiveXFEM<dim>::warn_of_arrested_tip(const unsigned int crack,
                                             const CrackEnd end,
                                             const double drive,
                                             const std::string &cause)
{
  // A tip that waits for its turn is driven by the strength or a little more.
  constexpr double clearly = 2.;
  const double strength = strength_ahead(crack, end);
  if (drive < clearly * strength ||
      !limits.told_of_arrest.insert({crack, static_cast<unsigned int>(end)}).second)
    return;
  std::ostringstream text;
  text << "Crack " << crack + 1 << " at (" << discontinuity.paths()[crack].tip(end)
       << ") is arrested: pressure and tension ahead come to " << drive << " Pa, the strength is "
       << strength << " Pa. " << cause << " What follows may be too short and its pressure too "
       << "high.";
  messages.push_back(text.str());
}


template <int dim>
bool CohesiveXFEM<dim>::press_faces(const State &state)
{
  // What is left after four solves goes with the next step. In the first one faces may part from
  // all that presses them in situ, which takes more.
  constexpr unsigned int enough = 4, enough_to_part = 50;
  if (n_presses == (started ? enough : enough_to_part))
    return false;
  const auto which =
    n_presses < enough ? FaceContact<dim>::Press::all : FaceContact<dim>::Press::parting;
  const auto &paths = discontinuity.paths();
  const auto &extra = state.current.extra;
  double opening = 0.;
  for (unsigned int c = 0; c < paths.size(); ++c)
    for (unsigned int i = 0; i < paths[c].pieces.size(); ++i)
      opening = std::max(opening, contact.traction(discontinuity, c, i, extra).gap);
  bool pressed = false;
  for (unsigned int c = 0; c < paths.size(); ++c)
    for (unsigned int i = 0; i < paths[c].pieces.size(); ++i)
      pressed |=
        contact.press(discontinuity, c, i, extra, opening, broken_share(paths[c].pieces[i]), which);
  n_presses += pressed;
  return pressed;
}


template <int dim>
CohesiveLaw CohesiveXFEM<dim>::law_at(const dealii::types::material_id region,
                                      const dealii::Point<dim> &place) const
{
  const RockProperties &rock = scene.rock(region);
  if (!rock.is_random())
    return law;
  const auto factors = rock.random->factors(place);
  return law.times(factors[RandomField::tensile_strength],
                   factors[RandomField::energy_release_rate]);
}


template <int dim>
CohesiveLaw CohesiveXFEM<dim>::law_at(const CrackPiece<dim> &piece) const
{
  const CohesiveLaw rock = law_at(piece.region, piece.centre());
  const double share = parameters.cohesive_energy;
  // The stiffness is the rock's, so the strength goes as the root of the energy.
  return cemented.count(piece.key(scene.domain_size)) > 0 ? rock.times(std::sqrt(share), share)
                                                          : rock;
}


template <int dim>
double CohesiveXFEM<dim>::strength_ahead(const unsigned int crack, const CrackEnd end) const
{
  const CrackPath<dim> &path = discontinuity.paths()[crack];
  const CrackPiece<dim> &last = path.piece_at(end);
  return law_at(last.region, path.tip(end) + 0.5 * last.cell_size() * path.direction(end)).strength;
}


template <int dim>
double CohesiveXFEM<dim>::cohesive_length(const dealii::types::material_id region) const
{
  return scene.rock(region).plane_modulus() * scene.rock.main().energy_release_rate /
         (law.strength * law.strength);
}


template <int dim>
std::vector<typename CohesiveXFEM<dim>::TipAhead>
CohesiveXFEM<dim>::look_ahead(const State &state, const Collectives &collectives) const
{
  std::vector<Advance> advances;
  std::vector<HalfDisc<dim>> tips; // of one cell's radius
  if (parameters.growth)
    for (unsigned int c = 0; c < discontinuity.paths().size(); ++c)
      for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
      {
        const CrackPath<dim> &path = discontinuity.paths()[c];
        if (!path.is_tip[static_cast<int>(end)])
          continue;
        advances.push_back({c, end, path.direction(end)});
        tips.push_back({path.tip(end), path.direction(end), path.piece_at(end).cell_size()});
      }
  return look_ahead(tips, advances, state, collectives);
}


template <int dim>
std::vector<typename CohesiveXFEM<dim>::TipAhead>
CohesiveXFEM<dim>::look_ahead(const std::vector<HalfDisc<dim>> &places,
                              const std::vector<Advance> &advances,
                              const State &state,
                              const Collectives &collectives) const
{
  std::vector<TipAhead> tips;
  std::vector<HalfDisc<dim>> discs; // for the growth of each tip, and for its direction
  for (unsigned int i = 0; i < places.size(); ++i)
  {
    const auto &[centre, direction, h] = places[i];
    const auto region = discontinuity.paths()[advances[i].crack].piece_at(advances[i].end).region;
    const double radius =
      std::min(parameters.averaging_radius * h, std::max(0.5 * cohesive_length(region), 1.2 * h));
    tips.push_back({advances[i], {}, {}});
    discs.push_back({centre, direction, radius});
    discs.push_back({centre, direction, parameters.direction_radius * h});
  }
  const auto averages = average_ahead<dim>(
    discs, *mesh_view,
    [this](const unsigned int cell) { return discontinuity.cut_cell(cell) != nullptr; }, scene,
    state, collectives);
  for (unsigned int i = 0; i < tips.size(); ++i)
  {
    tips[i].near = averages[2 * i];
    tips[i].wide = averages[2 * i + 1];
  }
  return tips;
}


template <int dim>
dealii::Tensor<1, dim> CohesiveXFEM<dim>::direction_of_growth(const TipAhead &tip) const
{
  if (parameters.straight)
    return tip.advance.direction;
  // Orthogonal to the largest tension, forward.
  const Tensor<1, dim> normal = dealii::eigenvectors(tip.wide.stress)[0].second;
  Tensor<1, dim> direction;
  direction[0] = -normal[1];
  direction[1] = normal[0];
  if (direction * tip.advance.direction < 0.)
    direction *= -1.;
  return rounded_direction(direction);
}


template <int dim>
double CohesiveXFEM<dim>::tension_across(const TipAhead &tip) const
{
  if (!parameters.straight)
    return dealii::eigenvalues(tip.near.stress)[0];
  Tensor<1, dim> across;
  across[0] = -tip.advance.direction[1];
  across[1] = tip.advance.direction[0];
  return across * (tip.near.stress * across);
}


template <int dim>
typename CohesiveXFEM<dim>::TipState
CohesiveXFEM<dim>::judge(const TipAhead &tip, const State &state, GrowthPass &pass)
{
  const unsigned int c = tip.advance.crack;
  const CrackEnd end = tip.advance.end;
  const CrackSpan &last = discontinuity.span_at(c, end);
  const double span = discontinuity.length(c, last);
  const double pressure =
    state.segment_pressure ? state.segment_pressure(discontinuity.key(c, last)) : 0.;
  // One intact span is enough: where the fluid's pressure alone exceeds the strength, cutting
  // would never end. Where it does so by far, there is no cohesive zone worth the name: spans
  // open by less than the fluid's aperture would be cut one after another.
  const bool broken_here = distance_to_damage(c, end, 1., state) <= 0.5 * span * (1. + 1e-9);
  const double added = parameters.as_published ? tip.near.pore_pressure : pressure;
  const double drive = added + tension_across(tip);
  // A dry crack goes on at the threshold: the seam's compliance ahead of the damage counts.
  if (pressure != 0. && distance_to_damage(c, end, 1e-12, state) >= span * (1. - 1e-9))
  {
    warn_of_arrested_tip(c, end, drive, "The cell behind it is cut, but has not begun to break.");
    // And that was so when the step began.
    const bool arrested_before =
      committed_limits.told_of_arrest.count({c, static_cast<unsigned>(end)}) > 0;
    return drive > hopeless * strength_ahead(c, end) && arrested_before ? TipState::arrested
                                                                        : TipState::rests;
  }
  if (!broken_here && fluid_overpowers(c, end, state))
    return TipState::rests;
  // Suction at the tip and the tension ahead, both many times the strength, leave a difference
  // that tells nothing: there the fluid has to have arrived.
  if (reached_length(c, end, state) < 0.8 * span)
    return TipState::rests;
  if (drive < parameters.growth_threshold * strength_ahead(c, end) * (1. - 1e-6))
    return TipState::rests;
  if (advances[c][static_cast<int>(end)] >= parameters.most_advances)
  {
    pass.held_back = true;
    return TipState::rests;
  }
  pass.growing.push_back({c, end, direction_of_growth(tip)});
  pass.broken.push_back(broken_here);
  return TipState::rests;
}


template <int dim>
std::string CohesiveXFEM<dim>::take_new_span(const GrowthPass &pass, const unsigned int i)
{
  const Advance &growing = pass.growing[i];
  const unsigned int crack = growing.crack, end = static_cast<unsigned int>(growing.end);
  const auto &path = discontinuity.paths()[crack];
  ++advances[crack][end];
  limits.has_grown[crack] = true;
  limits.wait_for_mesh.erase({crack, end});
  limits.told_of_arrest.erase({crack, end});
  const CrackSpan &span = discontinuity.span_at(crack, growing.end);
  const std::uint64_t key = discontinuity.key(crack, span);
  if (pass.broken[i])
    bare_tips.insert(key);
  // A process zone of fewer cells is not resolved, unless it was not from the start.
  std::ostringstream reason;
  for (unsigned int k = span.first; k <= span.last && reason.str().empty(); ++k)
  {
    const double size = path.pieces[k].cell_size(),
                 largest = std::max(0.25 * cohesive_length(path.pieces[k].region), largest_cell) *
                           (1. + 1e-6);
    if (size > largest)
      reason << "has come to cells of " << size << " m. Larger ones than " << largest
             << " m do not resolve the process zone." << remedy;
  }
  return reason.str();
}


template <int dim>
std::string CohesiveXFEM<dim>::grow(GrowthPass &pass, const Collectives &collectives)
{
  using Outcome = typename Discontinuity<dim>::Outcome;
  const auto outcomes = discontinuity.grow(pass.growing, collectives);
  for (unsigned int i = 0; i < pass.growing.size(); ++i)
  {
    const Advance &growing = pass.growing[i];
    const unsigned int crack = growing.crack;
    const GrowthLimits::Tip tip{crack, static_cast<unsigned int>(growing.end)};
    std::ostringstream text;
    text << "Crack " << crack + 1 << " at (" << discontinuity.paths()[crack].tip(growing.end)
         << ") ";
    const std::string where = text.str();
    if (outcomes[i] == Outcome::grown || outcomes[i] == Outcome::reached_boundary ||
        outcomes[i] == Outcome::joined_crack)
    {
      pass.grown = true;
      if (const std::string reason = take_new_span(pass, i); !reason.empty())
        return where + reason;
    }
    if (outcomes[i] == Outcome::reached_boundary)
      limits.blocked_by = where + "has reached the boundary of the domain.";
    if (outcomes[i] == Outcome::joined_crack)
    {
      // The fluid drives the other one from now on.
      const int other = discontinuity.paths()[crack].ends_on[static_cast<int>(growing.end)];
      limits.has_grown[other] = true;
      limits.blocked_by = where + "has joined crack " + std::to_string(other + 1) + ".";
      messages.push_back(limits.blocked_by);
    }
    if (outcomes[i] == Outcome::reached_crack)
    {
      discontinuity.stop(crack, growing.end);
      limits.blocked_by =
        where +
        (discontinuity.paths().size() == 1
           ? "has turned back into a cell that it cuts already, and stops: little stress in situ, "
             "or none, holds it straight."
           : "has met another crack where it cannot join it, or itself, and stops: one is there "
             "already, or a tip.");
    }
    if (outcomes[i] == Outcome::reached_boundary || outcomes[i] == Outcome::reached_crack)
      messages.push_back(limits.blocked_by);
    if (outcomes[i] == Outcome::needs_mesh)
    {
      pass.needs_mesh = true;
      limits.wait_for_mesh.insert(tip);
      if (committed_limits.wait_for_mesh.count(tip) != 0)
        return where +
               "cannot go on: the cells ahead have another size than those along it, and refining "
               "the mesh has not changed that." +
               remedy;
    }
  }
  refresh_segments();
  return "";
}


template <int dim>
bool CohesiveXFEM<dim>::cross(const State &state, const Collectives &collectives)
{
  std::vector<Advance> crossing;
  std::vector<HalfDisc<dim>> places;
  if (parameters.growth)
    for (unsigned int c = 0; c < discontinuity.paths().size(); ++c)
      for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
        if (const auto far = discontinuity.far_side(c, end))
        {
          const CrackPath<dim> &path = discontinuity.paths()[c];
          crossing.push_back({c, end, parameters.straight ? path.direction(end) : far->normal});
          places.push_back({path.tip(end), far->normal, path.piece_at(end).cell_size()});
        }
  if (crossing.empty())
    return false;
  bool crossed = false;
  for (const TipAhead &tip : look_ahead(places, crossing, state, collectives))
  {
    const unsigned int c = tip.advance.crack;
    const CrackEnd end = tip.advance.end;
    const auto far = discontinuity.far_side(c, end);
    const double pressure =
      state.segment_pressure
        ? state.segment_pressure(discontinuity.segment_key(far->crack, far->piece))
        : 0.;
    const double added = parameters.as_published ? tip.near.pore_pressure : pressure;
    const double drive = added + tension_across(tip);
    // With the fluid's pressure, as ahead of a tip: the fluid fills cracks to their tips, so what
    // is ahead never bears more than the strength less the pressure. No crack is there whose tip
    // would make more of the stress: the mean itself has to part the rock.
    if (drive < strength_ahead(c, end) * (1. - 1e-6))
      continue;
    const Tensor<1, dim> direction = direction_of_growth(tip);
    // One that would rather run along the other crack does not leave it.
    constexpr double least_across = 0.3;
    if (direction * far->normal < least_across)
      continue;
    const dealii::Point<dim> where = discontinuity.paths()[c].tip(end);
    using Outcome = typename Discontinuity<dim>::Outcome;
    const Outcome outcome = discontinuity.cross(c, end, direction, collectives);
    if (outcome != Outcome::grown && outcome != Outcome::reached_boundary)
      continue;
    crossed = true;
    advances.push_back({{1, 1}});
    limits.has_grown.push_back(true);
    limits.volume.push_back(0.);
    std::ostringstream text;
    text << "Crack " << c + 1 << " at (" << where << ") has crossed crack " << far->crack + 1
         << " and goes on as crack " << discontinuity.paths().size() << ".";
    messages.push_back(text.str());
  }
  if (crossed)
    refresh_segments();
  return crossed;
}


template <int dim>
Verdict
CohesiveXFEM<dim>::advance(const StepContext &, const State &state, const Collectives &collectives)
{
  Verdict verdict;
  const auto stop = [&verdict](const std::string &reason)
  {
    verdict.kind = Verdict::Kind::stop;
    verdict.reason = reason;
    return verdict;
  };
  contact.begin_solve(); // if there is another one in this step
  if (const std::string reason = reason_to_stop(state); !reason.empty())
    return stop(reason);
  if (press_faces(state))
  {
    verdict.kind = Verdict::Kind::topology_changed;
    return verdict;
  }

  const std::vector<TipAhead> tips = look_ahead(state, collectives);
  GrowthPass pass;
  bool arrested_everywhere = !tips.empty() && std::isnan(scene.crack_pressure);
  for (const TipAhead &tip : tips)
    arrested_everywhere &= judge(tip, state, pass) == TipState::arrested;
  if (arrested_everywhere)
    return stop(
      "every tip is arrested, although pressure and tension ahead come to more than " +
      std::to_string(static_cast<int>(hopeless)) +
      " times the strength: the fracture cannot turn as it wants to on this mesh. Smaller "
      "cells, a longer notch, or one along the greatest compression may do.");

  if (!pass.growing.empty())
    if (const std::string reason = grow(pass, collectives); !reason.empty())
      return stop(reason);
  // Where cracks have just met, the step is solved with the junction first.
  if (!pass.grown)
    pass.grown = cross(state, collectives);
  if (pass.grown)
    verdict.kind = Verdict::Kind::topology_changed;
  verdict.held_back = pass.held_back || pass.needs_mesh;
  verdict.advances = 0;
  for (const auto &[first, last] : advances)
    verdict.advances = std::max({*verdict.advances, first, last});
  return verdict;
}

template double
CohesiveXFEM<2>::distance_to_damage(unsigned int, CrackEnd, double, const State &) const;
template std::string CohesiveXFEM<2>::reason_to_stop(const State &) const;
template void
CohesiveXFEM<2>::warn_of_arrested_tip(unsigned int, CrackEnd, double, const std::string &);
template bool CohesiveXFEM<2>::fluid_overpowers(unsigned int, CrackEnd, const State &) const;
template double CohesiveXFEM<2>::reached_length(unsigned int, CrackEnd, const State &) const;
template bool CohesiveXFEM<2>::press_faces(const State &);
template CohesiveLaw CohesiveXFEM<2>::law_at(dealii::types::material_id,
                                             const dealii::Point<2> &) const;
template CohesiveLaw CohesiveXFEM<2>::law_at(const CrackPiece<2> &) const;
template double CohesiveXFEM<2>::strength_ahead(unsigned int, CrackEnd) const;
template double CohesiveXFEM<2>::cohesive_length(dealii::types::material_id) const;
template Verdict CohesiveXFEM<2>::advance(const StepContext &, const State &, const Collectives &);
} // namespace stockwork::cohesive_xfem
