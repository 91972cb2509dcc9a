// Which bonds belong to which wet piece of tracked paths.
#include "fracture/peridynamics/tracked_paths.h"

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
using dealii::Point;

namespace
{
/// To share bonds out by. Pieces then read an opening alike to some tenths of a per cent, at any
/// angle; more would carry what the ends of a path lack farther along it.
constexpr unsigned int sweeps = 3;
/// The most that a lattice makes a piece read too much or too little by. What is off by more lacks
/// bonds, as the ends of paths do, and stays as it is.
constexpr double most_of_lattice = 0.1;
} // namespace


CellShares TrackedPaths::shares(const Crossing &crossing, const double reach) const
{
  CellShares result;
  unsigned int first = 0;
  while (first < wet.size() && wet[first].path != crossing.path)
    ++first;
  unsigned int last = first;
  while (last < wet.size() && wet[last].path == crossing.path)
    ++last;
  if (first == last || crossing.arc < wet[first].begin - reach ||
      crossing.arc > wet[last - 1].end + reach)
    return result;
  double sum = 0.;
  const auto add = [&](const unsigned int piece, const double share)
  {
    if (share <= 0.)
      return;
    const double weighted = wet[piece].weight * share;
    sum += weighted;
    if (!result.empty() && (result.back().first == piece || result.size() == result.capacity()))
      result.back().second += weighted;
    else
      result.emplace_back(piece, weighted);
  };
  const double from = crossing.arc - h, to = crossing.arc + h;
  const auto part = [&](const double begin, const double end)
  { return (std::min(end, to) - std::max(begin, from)) / (2. * h); };
  add(first, part(from, wet[first].begin));
  for (unsigned int i = first; i < last; ++i)
    add(i, part(wet[i].begin, wet[i].end));
  add(last - 1, part(wet[last - 1].end, to));
  for (auto &share : result)
    share.second /= sum;
  return result;
}


bool TrackedPaths::begins_along_lattice(const Path &path) const
{
  const dealii::Tensor<1, 2> crack =
    path.point(path.n_pieces() - path.ends[1].n_points) - path.point(path.ends[0].n_points);
  return std::min(std::abs(crack[0]), std::abs(crack[1])) < same_spot * h;
}


bool TrackedPaths::is_apart(const unsigned int path, const double distance) const
{
  // Where fluid is, and not ways, which may still be others.
  std::vector<std::vector<Point<2>>> places(paths.size());
  for (const Piece &piece : wet)
  {
    places[piece.path].push_back(piece.from);
    places[piece.path].push_back(piece.to);
  }
  for (unsigned int other = 0; other < paths.size(); ++other)
  {
    if (other == path)
      continue;
    if (places[other].empty())
      for (unsigned int i = 0; i <= paths[other].n_pieces(); ++i)
        places[other].push_back(paths[other].point(i));
    for (const Point<2> &place : places[other])
      for (const Point<2> &own : places[path])
        if (own.distance(place) < distance)
          return false;
  }
  return true;
}


/// Each bond is shared out wholly, so a uniform pressure remains one; and each piece shall have as
/// much of bonds as it is long. Both by turns (iterative proportional fitting; Sinkhorn 1967).
void TrackedPaths::share_evenly(const std::function<Readings()> &read, const double apart)
{
  for (Piece &piece : wet)
    piece.weight = 1.;
  // Where paths meet, which of them a bond belongs to changes with ways that may still be others.
  // Along the lattice all pieces are crossed alike, whatever a way wanders by.
  std::vector<bool> is_even(paths.size());
  for (unsigned int p = 0; p < paths.size(); ++p)
    is_even[p] = !begins_along_lattice(paths[p]) && is_apart(p, apart);
  if (std::none_of(is_even.begin(), is_even.end(), [](const bool even) { return even; }))
    return;
  const Readings readings = read();
  for (unsigned int sweep = 0; sweep < sweeps; ++sweep)
  {
    std::vector<double> by_piece(wet.size(), 0.), by_path(paths.size(), 0.),
      length(paths.size(), 0.);
    for (const auto &[crossing, reading] : readings)
      if (is_even[crossing.path])
        for (const auto &[piece, share] : shares(crossing, same_spot * h))
        {
          by_piece[piece] += share * reading;
          by_path[crossing.path] += share * reading;
        }
    for (const Piece &piece : wet)
      length[piece.path] += piece.end - piece.begin;
    for (unsigned int i = 0; i < wet.size(); ++i)
      if (const unsigned int p = wet[i].path; is_even[p])
        if (const double wanted = by_path[p] / length[p] * (wet[i].end - wet[i].begin);
            std::abs(by_piece[i] - wanted) < most_of_lattice * wanted)
          wet[i].weight *= wanted / by_piece[i];
  }
}
} // namespace stockwork::peridynamics
