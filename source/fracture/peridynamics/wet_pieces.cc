// Where the fluid is in tracked paths.
#include "fracture/peridynamics/softening.h"
#include "fracture/peridynamics/tracked_paths.h"

#include <algorithm>

namespace stockwork::peridynamics
{
std::array<unsigned int, 2> TrackedPaths::reached(const unsigned int p,
                                                  const double Growth::*fluid) const
{
  const Path &path = paths[p];
  std::array<unsigned int, 2> result{{0, 0}};
  for (const unsigned int side : {0u, 1u})
  {
    const Growth &growth = path.ends[side];
    const double front = growth.*fluid;
    double inner = 0.;
    for (unsigned int k = growth.n_points; k > 0; --k)
    {
      const double length = path.length(side == 0 ? k - 1 : path.n_pieces() - k);
      // Elsewhere fluid is in a piece as soon as its front is. Beyond another path it comes through
      // a face of whole rock, and not by the first bond that is stretched too far: its pressure on
      // all of the first horizon would part the rest. Cement as strong as rock has no such face.
      const bool is_first = is_all_way(p) && k == growth.n_points;
      const double cement = began_beyond(p) ? paths[path.ends[0].joined_path].cement : 0.,
                   least = is_first ? (1. - cement) * SofteningLaw::wet_damage * length : 0.;
      if (front <= inner + std::max(least, same_spot * h))
        break;
      ++result[side];
      inner += length;
    }
  }
  return result;
}


void TrackedPaths::wet_what_is_joined()
{
  // Whether the tips of a path have passed a place on it.
  const auto holds = [&](const unsigned int p, const double arc)
  {
    const Path &path = paths[p];
    const std::array<unsigned int, 2> come_to = reached(p, &Growth::wet);
    return arc >= path.begin(path.ends[0].n_points - come_to[0]) &&
           arc <= path.begin(path.n_pieces() - path.ends[1].n_points + come_to[1]);
  };
  bool changed = true;
  while (changed)
  {
    changed = false;
    for (unsigned int p = 0; p < paths.size(); ++p)
      for (const unsigned int side : {0u, 1u})
      {
        const Growth &growth = paths[p].ends[side];
        if (!growth.joined || paths[p].dry == paths[growth.joined_path].dry ||
            reached(p, &Growth::wet)[side] < growth.n_points ||
            !holds(growth.joined_path, growth.joined_arc))
          continue;
        paths[p].dry = paths[growth.joined_path].dry = false;
        changed = true;
      }
  }
}


void TrackedPaths::find_wet_pieces()
{
  wet_what_is_joined();
  wet.clear();
  std::vector<std::pair<unsigned int, Joint>> joints;
  // Pieces at ends of which fluid has reached all, and the path that goes on beyond each.
  std::vector<std::pair<unsigned int, unsigned int>> goes_on;
  for (unsigned int p = 0; p < paths.size(); ++p)
  {
    const Path &path = paths[p];
    if (path.dry)
      continue;
    const std::array<unsigned int, 2> come_to = reached(p, &Growth::wet),
                                      came_to = reached(p, &Growth::kept);
    const unsigned int first = path.ends[0].n_points - come_to[0],
                       end = path.n_pieces() - path.ends[1].n_points + come_to[1],
                       first_before = path.ends[0].n_points - came_to[0],
                       end_before = path.n_pieces() - path.ends[1].n_points + came_to[1];
    for (unsigned int i = first; i < end; ++i)
    {
      Piece piece{p, path.point(i), path.point(i + 1), path.begin(i), 0., false, {}};
      piece.end = piece.begin + path.length(i);
      const unsigned int number = wet.size();
      if (i > first)
        piece.neighbours.push_back(number - 1);
      if (i + 1 < end)
        piece.neighbours.push_back(number + 1);
      if (first_before < end_before && (i < first_before || i >= end_before))
        piece.part_of =
          i < first_before ? number + (first_before - i) : number - (i - end_before + 1);
      for (const unsigned int side : {0u, 1u})
      {
        const Growth &growth = path.ends[side];
        if (i != (side == 0 ? first : end - 1))
          continue;
        const bool all = come_to[side] == growth.n_points;
        if (growth.joined && all)
        {
          joints.emplace_back(number, Joint{growth.joined_path, growth.joined_arc});
          if (growth.beyond != 0)
            goes_on.emplace_back(number, growth.beyond);
        }
        else if (growth.grows || growth.joined)
          piece.at_tip = true;
      }
      wet.push_back(piece);
    }
  }
  const auto make_neighbours = [&](const unsigned int a, const unsigned int b)
  {
    const std::vector<unsigned int> &of_a = wet[a].neighbours;
    if (std::find(of_a.begin(), of_a.end(), b) != of_a.end())
      return;
    wet[a].neighbours.push_back(b);
    wet[b].neighbours.push_back(a);
  };
  for (const auto &[piece, joint] : joints)
    for (unsigned int i = 0; i < wet.size(); ++i)
      if (i != piece && wet[i].path == joint.path && wet[i].begin <= joint.arc &&
          wet[i].end >= joint.arc)
      {
        make_neighbours(piece, i); // they may have joined one another
        wet[i].at_tip = false;
        break;
      }
  // The mouths of both are opposite one another: the fluid need not go along what is between.
  for (const auto &[piece, beyond] : goes_on)
    for (unsigned int i = 0; i < wet.size(); ++i)
      if (wet[i].path == beyond)
      {
        make_neighbours(piece, i);
        break;
      }
}


bool TrackedPaths::set_advances(const std::function<double(const End &)> &advance,
                                const std::function<double(const End &)> &fluid,
                                const bool same_bonds)
{
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (const unsigned int side : {0u, 1u})
    {
      Growth &growth = paths[p].ends[side];
      if (growth.n_points == 0)
        continue;
      growth.advance = std::min(advance({p, side}), way({p, side}));
      growth.front = std::clamp(fluid({p, side}), growth.advance, way({p, side}));
      growth.wet = std::max(growth.wet, growth.front);
    }
  const std::vector<Piece> before = wet;
  const bool changed = wets_others();
  if (!same_bonds)
    went_on_from.clear();
  else if (changed)
    went_on_from = before;
  return changed;
}


bool TrackedPaths::are_same(const std::vector<Piece> &some, const std::vector<Piece> &others)
{
  return std::equal(some.begin(), some.end(), others.begin(), others.end(),
                    [](const Piece &a, const Piece &b)
                    { return a.path == b.path && a.begin == b.begin && a.end == b.end; });
}


bool TrackedPaths::wets_others()
{
  std::vector<Piece> before;
  before.swap(wet);
  find_wet_pieces();
  if (!are_same(wet, before))
    return true;
  for (unsigned int i = 0; i < wet.size(); ++i)
    wet[i].weight = before[i].weight;
  return false;
}


bool TrackedPaths::let_fluid_back()
{
  const std::vector<Path> paths_before = paths;
  const std::vector<Piece> wet_before = wet;
  for (unsigned int p = 0; p < paths.size(); ++p)
    for (const unsigned int side : {0u, 1u})
      if (Growth &growth = paths[p].ends[side];
          !growth.joined && !is_joined({p, side})) // the other path would be cut off
        growth.wet = std::max(growth.kept, growth.front);
  if (!wets_others())
    return false;
  const bool would_come_again = !went_on_from.empty() && are_same(wet, went_on_from);
  if (would_come_again)
  {
    paths = paths_before;
    wet = wet_before;
  }
  return !would_come_again;
}


bool TrackedPaths::is_wet(const unsigned int path) const
{
  return std::any_of(wet.begin(), wet.end(),
                     [&](const Piece &piece) { return piece.path == path; });
}
} // namespace stockwork::peridynamics
