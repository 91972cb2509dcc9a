#include "fracture/peridynamics/tracked_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;

namespace
{
/// An initial crack that ends no farther from another one begins there [pieces].
constexpr double same_place_as = 0.3;
/// Of the greater principal stress, less than which they do not differ.
constexpr double same_stress = 1e-9;
} // namespace


Tensor<1, 2> across_greatest(const dealii::SymmetricTensor<2, 2> &stress, const Tensor<1, 2> &ahead)
{
  const double half = 0.5 * (stress[0][0] - stress[1][1]), shear = stress[0][1];
  if (std::hypot(half, shear) <= same_stress * stress.norm())
    return ahead;
  const double angle = 0.5 * std::atan2(shear, half) + 0.5 * M_PI;
  const Tensor<1, 2> direction({std::cos(angle), std::sin(angle)});
  return direction * ahead < 0. ? -direction : direction;
}


std::optional<std::array<double, 2>> TrackedPaths::meet(const Point<2> &a,
                                                        const Point<2> &b,
                                                        const Point<2> &c,
                                                        const Point<2> &d,
                                                        const double tolerance)
{
  const Tensor<1, 2> along = d - c;
  const double length = along.norm();
  const auto above = [&](const Point<2> &x)
  { return (along[0] * (x[1] - c[1]) - along[1] * (x[0] - c[0])) / length; };
  const double s = above(a), t = above(b);
  if ((s >= -tolerance) == (t >= -tolerance))
    return {};
  const double share = s / (s - t);
  const double place = (a + share * (b - a) - c) * along / length;
  if (place < -tolerance || place > length + tolerance)
    return {};
  return std::array<double, 2>{{share, std::clamp(place / length, 0., 1.)}};
}


void TrackedPaths::Path::find_arcs()
{
  arcs.assign(points.size(), 0.);
  for (unsigned int i = ends[0].n_points; i < n_pieces(); ++i)
    arcs[i + 1] = arcs[i] + length(i);
  for (unsigned int i = ends[0].n_points; i > 0; --i)
    arcs[i - 1] = arcs[i] - length(i - 1);
}


void TrackedPaths::reinit(const std::vector<InitialCrack<2>> &cracks,
                          const double spacing,
                          const std::function<bool(const Point<2> &)> &may_grow,
                          const double cement)
{
  h = spacing;
  paths.clear();
  for (const InitialCrack<2> &crack : cracks)
  {
    if (crack.points.size() < 2)
      continue;
    Path path;
    path.ends[0].grows = may_grow(crack.points.front());
    path.ends[1].grows = may_grow(crack.points.back());
    path.points.push_back({{crack.points[0][0], crack.points[0][1]}});
    for (unsigned int leg = 0; leg + 1 < crack.points.size(); ++leg)
    {
      const Tensor<1, 2> along = crack.points[leg + 1] - crack.points[leg];
      unsigned int n = std::max(1l, std::lround(along.norm() / h));
      // A well in the middle of a crack is in the middle of a piece.
      if (n % 2 == 0 && crack.points.size() == 2 && path.ends[0].grows && path.ends[1].grows)
        n += along.norm() / h > n ? 1 : -1;
      for (unsigned int i = 1; i <= n; ++i)
      {
        const Point<2> point = crack.points[leg] + double(i) / n * along;
        path.points.push_back({{point[0], point[1]}});
      }
    }
    if (crack.kind == InitialCrack<2>::Kind::cohesive)
      path.cement = cement;
    path.find_arcs();
    paths.push_back(path);
  }
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (const unsigned int side : {0u, 1u})
      join_where_it_begins({p, side});
  find_wet_pieces();
}


void TrackedPaths::join_where_it_begins(const End &end)
{
  Growth &growth = paths[end.path].ends[end.side];
  const Point<2> own = paths[end.path].point(end.side == 0 ? 0 : paths[end.path].n_pieces());
  for (unsigned int p = 0; p < paths.size() && growth.grows; ++p)
    for (unsigned int i = 0; i < paths[p].n_pieces() && p != end.path; ++i)
    {
      const Point<2> from = paths[p].point(i);
      const Tensor<1, 2> along = paths[p].point(i + 1) - from;
      const double place = std::clamp((own - from) * along / along.norm_square(), 0., 1.);
      if (own.distance(from + place * along) > same_place_as * h)
        continue;
      growth.grows = false;
      growth.joined = true;
      growth.joined_path = p;
      growth.joined_arc = paths[p].begin(i) + place * along.norm();
      break;
    }
}


std::optional<TrackedPaths::Crossing> TrackedPaths::crossing(const Point<2> &a,
                                                             const Point<2> &b) const
{
  const double reach = 0.5 * a.distance(b) + h;
  const Point<2> middle = a + 0.5 * (b - a);
  // Bonds across an open crack are cut already. Across cement they hold. Those that also cross the
  // way of a fracture, and more squarely, are opened by that: they bear the stress across it, and
  // not that across the cement.
  std::optional<Crossing> found;
  double nearest = 0., slant_of_nearest = 0.;
  const auto is_better = [&](const unsigned int path, const double away, const double slant)
  {
    if (found && path != found->path &&
        (paths[path].cement > 0. || paths[found->path].cement > 0.) &&
        std::abs(slant - slant_of_nearest) > same_spot)
      return slant < slant_of_nearest;
    return !found || away < nearest - same_spot;
  };
  for (unsigned int p = 0; p < paths.size(); ++p)
  {
    const Path &path = paths[p];
    for (unsigned int i = 0; i < path.n_pieces(); ++i)
    {
      const Point<2> c = path.point(i), d = path.point(i + 1);
      if (std::min(c[0], d[0]) > middle[0] + reach || std::max(c[0], d[0]) < middle[0] - reach ||
          std::min(c[1], d[1]) > middle[1] + reach || std::max(c[1], d[1]) < middle[1] - reach)
        continue;
      if (const auto shares = meet(a, b, c, d, same_spot * h))
      {
        const double away = std::abs((*shares)[0] - 0.5),
                     slant = std::abs((b - a) * (d - c)) / (a.distance(b) * c.distance(d));
        if (is_better(p, away, slant))
        {
          nearest = away;
          slant_of_nearest = slant;
          found = Crossing{p, path.begin(i) + (*shares)[1] * path.length(i)};
        }
      }
    }
  }
  return found;
}


bool TrackedPaths::crosses_initial(const unsigned int path,
                                   const Point<2> &a,
                                   const Point<2> &b) const
{
  const Path &crack = paths[path];
  for (unsigned int i = crack.ends[0].n_points; i < crack.n_pieces() - crack.ends[1].n_points; ++i)
    if (meet(a, b, crack.point(i), crack.point(i + 1), same_spot * h))
      return true;
  return false;
}


unsigned int TrackedPaths::piece_at(const Crossing &crossing) const
{
  const Path &path = paths[crossing.path];
  unsigned int piece = 0;
  for (unsigned int end = path.n_pieces(); piece + 1 < end;)
    if (const unsigned int middle = (piece + end) / 2; path.begin(middle) < crossing.arc)
      piece = middle;
    else
      end = middle;
  return piece;
}


Point<2> TrackedPaths::point(const Crossing &crossing) const
{
  const Path &path = paths[crossing.path];
  const unsigned int piece = piece_at(crossing);
  const double share = (crossing.arc - path.begin(piece)) / path.length(piece);
  return path.point(piece) + share * (path.point(piece + 1) - path.point(piece));
}


Tensor<1, 2> TrackedPaths::left(const Crossing &crossing) const
{
  const Path &path = paths[crossing.path];
  const unsigned int piece = piece_at(crossing);
  const Tensor<1, 2> along = path.point(piece + 1) - path.point(piece);
  return Tensor<1, 2>({-along[1], along[0]}) / along.norm();
}


bool TrackedPaths::run_as(const TrackedPaths &other) const
{
  return std::equal(paths.begin(), paths.end(), other.paths.begin(), other.paths.end(),
                    [](const Path &a, const Path &b)
                    {
                      return a.points == b.points && a.ends[0].n_points == b.ends[0].n_points &&
                             a.ends[1].n_points == b.ends[1].n_points;
                    });
}


std::vector<std::array<Point<2>, 2>> TrackedPaths::boxes() const
{
  std::vector<std::array<Point<2>, 2>> result;
  for (const Path &path : paths)
    for (unsigned int i = 0; i < path.n_pieces(); ++i)
    {
      const Point<2> a = path.point(i), b = path.point(i + 1);
      result.push_back({{Point<2>(std::min(a[0], b[0]), std::min(a[1], b[1])),
                         Point<2>(std::max(a[0], b[0]), std::max(a[1], b[1]))}});
    }
  return result;
}


std::optional<TrackedPaths::End> TrackedPaths::end_at(const Crossing &crossing) const
{
  const Path &path = paths[crossing.path];
  const double tolerance = same_spot * h;
  if (crossing.arc < tolerance && (path.ends[0].n_points > 0 || crossing.arc < -tolerance))
    return End{crossing.path, 0};
  const unsigned int last = path.n_pieces() - path.ends[1].n_points;
  if (path.ends[1].n_points > 0 && crossing.arc > path.begin(last) - tolerance)
    return End{crossing.path, 1};
  return {};
}


std::vector<TrackedPaths::End> TrackedPaths::ends() const
{
  std::vector<End> result;
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (const unsigned int side : {0u, 1u})
      if (paths[p].ends[side].grows)
        result.push_back({p, side});
  return result;
}


double TrackedPaths::way(const End &end) const
{
  const Path &path = paths[end.path];
  double length = 0.;
  for (unsigned int i = 0; i < at(end).n_points; ++i)
    length += path.length(end.side == 0 ? i : path.n_pieces() - 1 - i);
  return length;
}


double TrackedPaths::along_way(const Crossing &crossing, const End &end) const
{
  const Path &path = paths[end.path];
  const double start = path.begin(path.n_pieces() - path.ends[1].n_points);
  return end.side == 0 ? -crossing.arc : crossing.arc - start;
}


double TrackedPaths::lead(const End &end) const
{
  return way(end) - at(end).advance;
}


Point<2> TrackedPaths::tip(const End &end) const
{
  const Path &path = paths[end.path];
  const unsigned int n = at(end).n_points, last = path.n_pieces();
  double left = at(end).advance;
  // From the end of the initial crack outwards.
  for (unsigned int k = n; k > 0; --k)
  {
    const unsigned int inner = end.side == 0 ? k : last - k,
                       outer = end.side == 0 ? k - 1 : last - k + 1;
    const Tensor<1, 2> along = path.point(outer) - path.point(inner);
    if (left <= along.norm())
      return path.point(inner) + left / along.norm() * along;
    left -= along.norm();
  }
  return path.point(end.side == 0 ? 0 : last);
}


Tensor<1, 2> TrackedPaths::direction(const End &end) const
{
  const Path &path = paths[end.path];
  const unsigned int last = path.n_pieces();
  const Tensor<1, 2> along =
    end.side == 0 ? path.point(0) - path.point(1) : path.point(last) - path.point(last - 1);
  return along / along.norm();
}


void TrackedPaths::forget_way(const End &end)
{
  Path &path = paths[end.path];
  Growth &growth = path.ends[end.side];
  if (end.side == 0)
    path.points.erase(path.points.begin(), path.points.begin() + growth.n_points);
  else
    path.points.resize(path.points.size() - growth.n_points);
  growth.n_points = 0;
  path.find_arcs();
  growth.advance = growth.wet = growth.kept = growth.front = 0.;
}


std::vector<TrackedPaths::Meeting> TrackedPaths::meetings() const
{
  std::vector<Meeting> result;
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (const unsigned int side : {0u, 1u})
    {
      const Growth &growth = paths[p].ends[side];
      if (!has_met({p, side}) || growth.passes)
        continue;
      const Joint joint{growth.joined_path, growth.joined_arc};
      Meeting meeting{{p, side}, point(joint), left(joint), {}};
      if (meeting.across * direction({p, side}) < 0.)
        meeting.across = -meeting.across;
      if (growth.beyond != 0)
        meeting.beyond = End{growth.beyond, 1};
      result.push_back(meeting);
    }
  return result;
}


void TrackedPaths::begin_beyond(const Meeting &meeting, const Tensor<1, 2> &direction)
{
  if (at(meeting.end).beyond == 0)
  {
    // Not 0: there is the path that has been met.
    paths[meeting.end.path].ends[meeting.end.side].beyond = paths.size();
    paths.emplace_back();
  }
  const Growth &met = at(meeting.end);
  Path &path = paths[met.beyond];
  const Point<2> next = meeting.place + h * direction;
  path.points = {{{meeting.place[0], meeting.place[1]}}, {{next[0], next[1]}}};
  path.ends = {};
  path.ends[0].joined = true;
  path.ends[0].joined_path = met.joined_path;
  path.ends[0].joined_arc = met.joined_arc;
  path.ends[1].grows = true;
  path.ends[1].n_points = 1;
  path.find_arcs();
  path.dry = paths[meeting.end.path].dry && paths[met.joined_path].dry;
}


void TrackedPaths::begin_at(const Point<2> &place, const Tensor<1, 2> &direction, const bool dry)
{
  const Point<2> from = place - h * direction;
  begin_at_side(place, direction, dry);
  Path &path = paths.back();
  path.points.insert(path.points.begin(), std::array<double, 2>{{from[0], from[1]}});
  path.ends[0].grows = true;
  path.ends[0].n_points = 1;
  path.find_arcs();
}


void TrackedPaths::begin_at_side(const Point<2> &place,
                                 const Tensor<1, 2> &direction,
                                 const bool dry)
{
  const Point<2> to = place + h * direction;
  Path path;
  path.points = {{{place[0], place[1]}}, {{to[0], to[1]}}};
  path.ends[1].grows = true;
  path.ends[1].n_points = 1;
  path.find_arcs();
  path.dry = dry;
  paths.push_back(path);
}


bool TrackedPaths::is_joined(const End &end) const
{
  for (const Path &path : paths)
    for (const Growth &other : path.ends)
      if (other.joined)
        if (const auto at = end_at({other.joined_path, other.joined_arc});
            at && at->path == end.path && at->side == end.side)
          return true;
  return false;
}


std::pair<TrackedPaths::Joint, double> TrackedPaths::nearest(const Point<2> &to,
                                                             const unsigned int but) const
{
  std::pair<Joint, double> result{{}, std::numeric_limits<double>::infinity()};
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (unsigned int i = 0; i < paths[p].n_pieces() && p != but; ++i)
    {
      const Point<2> from = paths[p].point(i);
      const Tensor<1, 2> along = paths[p].point(i + 1) - from;
      const double share = std::clamp((to - from) * along / along.norm_square(), 0., 1.);
      if (const double away = to.distance(from + share * along);
          away < result.second - same_spot * h)
        result = {{p, paths[p].begin(i) + share * along.norm()}, away};
    }
  return result;
}


std::optional<Point<2>> TrackedPaths::overlap() const
{
  constexpr double same_middle = 1e-3, along_one_another = 0.17; // pieces; sine of an angle
  const auto overlaps =
    [&](const Path &path, const unsigned int i, const Path &other, const unsigned int j)
  {
    const Point<2> from = path.point(i),
                   middle = other.point(j) + 0.5 * (other.point(j + 1) - other.point(j));
    const Tensor<1, 2> along = (path.point(i + 1) - from) / path.length(i),
                       along_other = (other.point(j + 1) - other.point(j)) / other.length(j);
    if (middle.distance(from + 0.5 * path.length(i) * along) < same_middle * h)
      return true;
    const Tensor<1, 2> away = middle - from;
    const double place = away * along;
    return std::abs(along[0] * along_other[1] - along[1] * along_other[0]) < along_one_another &&
           place > 0. && place < path.length(i) &&
           (away - place * along).norm() < same_place_as * h;
  };
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (unsigned int q = p; q < paths.size(); ++q)
      for (unsigned int i = 0; i < paths[p].n_pieces(); ++i)
        for (unsigned int j = p == q ? i + 1 : 0; j < paths[q].n_pieces(); ++j)
          if (overlaps(paths[p], i, paths[q], j))
            return paths[q].point(j);
  return {};
}


std::optional<Point<2>> TrackedPaths::cross() const
{
  const auto ends_at = [&](const Path &path, const Point<2> &place)
  {
    return std::min(path.point(0).distance(place), path.point(path.n_pieces()).distance(place)) <
           same_place_as * h;
  };
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (unsigned int q = p; q < paths.size(); ++q)
      for (unsigned int i = 0; i < paths[p].n_pieces(); ++i)
        for (unsigned int j = p == q ? i + 2 : 0; j < paths[q].n_pieces(); ++j)
        {
          const Point<2> from = paths[q].point(j);
          const auto met = meet(paths[p].point(i), paths[p].point(i + 1), from,
                                paths[q].point(j + 1), same_spot * h);
          if (!met)
            continue;
          const Point<2> place = from + (*met)[1] * (paths[q].point(j + 1) - from);
          if (!ends_at(paths[p], place) && !ends_at(paths[q], place))
            return place;
        }
  return {};
}


double TrackedPaths::distance(const Point<2> &point) const
{
  return nearest(point, paths.size()).second;
}


double TrackedPaths::initial_length(const Path &path)
{
  double sum = 0.;
  for (unsigned int i = path.ends[0].n_points; i < path.n_pieces() - path.ends[1].n_points; ++i)
    sum += path.length(i);
  return sum;
}


double TrackedPaths::initial_length() const
{
  double sum = 0.;
  for (const Path &path : paths)
    sum += initial_length(path);
  return sum;
}


double TrackedPaths::length() const
{
  double sum = initial_length();
  for (const Path &path : paths)
    sum += path.ends[0].advance + path.ends[1].advance;
  return sum;
}


double TrackedPaths::full_length(const unsigned int path) const
{
  const Path &own = paths[path];
  if (own.ends[0].joined || own.ends[1].joined)
    return std::numeric_limits<double>::infinity();
  const bool at_side = !own.ends[0].grows || !own.ends[1].grows;
  return (at_side ? 2. : 1.) * (initial_length(own) + own.ends[0].advance + own.ends[1].advance);
}
} // namespace stockwork::peridynamics
