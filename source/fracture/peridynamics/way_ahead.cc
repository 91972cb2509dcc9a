// How the ways of tracked paths go on, and join what they meet or come past.
#include "fracture/peridynamics/tracked_paths.h"

#include <cmath>
#include <limits>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;

namespace
{
/// A way that is no farther from another path joins it with its next piece [pieces].
constexpr double nearly_there = 1.5;
/// A way that crosses no other path within so much is not about to meet it, but comes past it, if
/// it comes near [pieces].
constexpr double look_ahead = 3.;
/// Two tips that are led to one another, and in a turn each come nearer by a piece, see one another
/// from so far off, and meet half-way from so far [pieces].
constexpr double see_tips = look_ahead + 1., meet_tips = 2.5;
/// The sine of an angle. A way that comes past another path joins it unless it leads away from it
/// by more; and it goes straight to the way of another one, from farther off, if it leads towards
/// that by more: what bonds are between would be shared out to two ways that run on side by side.
constexpr double least_towards = 0.17;
} // namespace


TrackedPaths::Extension TrackedPaths::extension(const End &end, const Tensor<1, 2> &direction) const
{
  Extension result;
  const Path &path = paths[end.path];
  const unsigned int last_piece = end.side == 0 ? 0 : path.n_pieces() - 1;
  const Point<2> head = this->head(end);
  // Where the line ahead crosses a path, in pieces.
  double ahead = std::numeric_limits<double>::infinity();
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (unsigned int i = 0; i < paths[p].n_pieces(); ++i)
    {
      if (p == end.path && i == last_piece)
        continue;
      if (const auto met = meet(head, head + see_tips * h * direction, paths[p].point(i),
                                paths[p].point(i + 1), same_spot * h);
          met && see_tips * (*met)[0] < ahead && (*met)[0] > -same_spot)
      {
        ahead = see_tips * (*met)[0];
        result.joint = {p, paths[p].begin(i) + (*met)[1] * paths[p].length(i)};
      }
    }
  if (ahead <= see_tips)
    result.towards = tip_of(result.joint);
  result.joins = ahead < nearly_there;
  result.next = head + (result.joins ? ahead : 1.) * h * direction;
  if (result.joins)
    return result;
  const auto [beside, away] = nearest(head, end.path);
  const Tensor<1, 2> across = point(beside) - head;
  const double towards = across * direction;
  if (away < see_tips * h && towards > least_towards * away && !result.towards)
    result.towards = tip_of(beside);
  const bool is_way = end_at(beside).has_value(),
             passes = ahead > look_ahead && (is_way || !leads_to(head, direction, beside.path));
  if (away < nearly_there * h && towards >= -least_towards * away && (passes || is_way))
  {
    result.joins = result.passes = true;
    result.joint = beside;
    result.next = point(beside);
  }
  else if (passes && is_way && away < look_ahead * h && towards > least_towards * away)
    result.next = head + h / away * across;
  return result;
}


bool TrackedPaths::leads_to(const Point<2> &head,
                            const Tensor<1, 2> &direction,
                            const unsigned int path) const
{
  constexpr double farthest = nearly_there / least_towards;
  for (unsigned int i = 0; i < paths[path].n_pieces(); ++i)
    if (const auto met = meet(head, head + farthest * h * direction, paths[path].point(i),
                              paths[path].point(i + 1), same_spot * h);
        met && (*met)[0] > 0. && (*met)[0] < 1.)
      return true;
  return false;
}


std::optional<TrackedPaths::End> TrackedPaths::head_at(const Joint &joint) const
{
  const Path &path = paths[joint.path];
  for (const unsigned int side : {0u, 1u})
    if (path.ends[side].grows &&
        std::abs(joint.arc - path.begin(side == 0 ? 0 : path.n_pieces())) < short_piece * h)
      return End{joint.path, side};
  return {};
}


std::optional<TrackedPaths::End> TrackedPaths::tip_of(const Joint &joint) const
{
  if (const auto head = head_at(joint))
    return head;
  const auto end = end_at(joint);
  return end && at(*end).grows ? end : std::nullopt;
}


bool TrackedPaths::lead_to(const End &end, const Point<2> &place)
{
  Path &path = paths[end.path];
  Growth &growth = path.ends[end.side];
  const unsigned int last = end.side == 0 ? 0 : path.n_pieces();
  const std::array<double, 2> added{{place[0], place[1]}};
  if (path.point(last).distance(place) > short_piece * h)
  {
    path.points.insert(end.side == 0 ? path.points.begin() : path.points.end(), added);
    ++growth.n_points;
  }
  else if (growth.n_points > 0)
    path.points[last] = added;
  else
    return false;
  path.find_arcs();
  return true;
}


bool TrackedPaths::stops_where_joined(const End &end)
{
  Growth &growth = paths[end.path].ends[end.side];
  const double arc = paths[end.path].begin(end.side == 0 ? 0 : paths[end.path].n_pieces());
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (const unsigned int side : {0u, 1u})
      if (const Growth &other = paths[p].ends[side];
          other.joined && other.joined_path == end.path && p != end.path &&
          std::abs(other.joined_arc - arc) < short_piece * h)
      {
        growth.grows = false;
        growth.joined = growth.passes = true;
        growth.joined_path = p;
        growth.joined_arc = paths[p].begin(side == 0 ? 0 : paths[p].n_pieces());
        return true;
      }
  return false;
}


/// Two that come upon one another meet half-way, so that neither is the one which has been joined.
void TrackedPaths::join_heads(const End &a, const End &b)
{
  const Point<2> middle = head(a) + 0.5 * (head(b) - head(a));
  // What has not set out stays where it is, if that is near.
  if (!lead_to(a, middle))
    lead_to(b, head(a));
  else if (!lead_to(b, middle))
    lead_to(a, head(b));
  for (const auto &[end, other] : {std::make_pair(a, b), std::make_pair(b, a)})
  {
    Growth &growth = paths[end.path].ends[end.side];
    growth.grows = false;
    growth.joined = growth.passes = true;
    growth.joined_path = other.path;
    growth.joined_arc = paths[other.path].begin(other.side == 0 ? 0 : paths[other.path].n_pieces());
  }
}


void TrackedPaths::extend(const std::vector<std::pair<End, Tensor<1, 2>>> &ahead)
{
  std::vector<Extension> extensions;
  for (const auto &[end, direction] : ahead)
    extensions.push_back(extension(end, direction));
  const auto is_led_to = [&](const unsigned int k, const unsigned int l)
  {
    const auto &towards = extensions[k].towards;
    return towards && towards->path == ahead[l].first.path && towards->side == ahead[l].first.side;
  };
  for (unsigned int k = 0; k < ahead.size(); ++k)
    for (unsigned int l = 0; l < k; ++l)
      if (ahead[k].first.path != ahead[l].first.path && is_led_to(k, l) && is_led_to(l, k))
      {
        const Tensor<1, 2> apart = head(ahead[l].first) - head(ahead[k].first);
        const double distance = apart.norm();
        if (distance >= see_tips * h ||
            (distance >= meet_tips * h && (extensions[k].joins || extensions[l].joins)))
          continue;
        extensions[k].meets = extensions[l].meets = distance < meet_tips * h;
        extensions[k].joins = extensions[l].joins = extensions[k].meets;
        extensions[k].joint.path = ahead[l].first.path;
        extensions[l].joint.path = ahead[k].first.path;
        extensions[k].next = head(ahead[k].first) + h / distance * apart;
        extensions[l].next = head(ahead[l].first) - h / distance * apart;
      }
  std::vector<bool> has_joined(paths.size(), false);
  for (unsigned int k = 0; k < ahead.size(); ++k)
  {
    const End &end = ahead[k].first;
    const Extension &next = extensions[k];
    Growth &growth = paths[end.path].ends[end.side];
    if (!growth.grows || stops_where_joined(end))
      continue;
    // What it would join, or has been joined by, is not where it was any more.
    if (next.joins && (has_joined[end.path] || has_joined[next.joint.path] ||
                       (next.meets && !at(*next.towards).grows)))
      continue;
    if (!next.joins)
    {
      lead_to(end, next.next);
      continue;
    }
    has_joined[end.path] = has_joined[next.joint.path] = true;
    const auto other = next.meets ? next.towards : head_at(next.joint);
    if (other && other->path != end.path)
    {
      join_heads(end, *other);
      continue;
    }
    growth.grows = false;
    growth.joined = true;
    growth.passes = next.passes;
    growth.joined_path = next.joint.path;
    growth.joined_arc = next.joint.arc;
    lead_to(end, next.next);
  }
}
} // namespace stockwork::peridynamics
