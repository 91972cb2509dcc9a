#include "flow/segment_graph.h"

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <queue>
#include <set>
#include <unordered_map>

namespace stockwork
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
constexpr double piece_length = 3.; // segments
constexpr unsigned int shortest_branch = 2, pieces_for_direction = 4;

/// For each segment, its neighbours.
using Adjacency = std::vector<std::vector<unsigned int>>;

Adjacency adjacency_of(const std::vector<NetworkSegment<2>> &network)
{
  std::unordered_map<std::uint64_t, unsigned int> index;
  for (unsigned int i = 0; i < network.size(); ++i)
    index[network[i].key] = i;
  Adjacency adjacency(network.size());
  for (unsigned int i = 0; i < network.size(); ++i)
  {
    adjacency[i].reserve(network[i].neighbours.size());
    for (const auto &neighbour : network[i].neighbours)
      adjacency[i].push_back(index.at(neighbour.key));
  }
  return adjacency;
}

/// Lengths of the shortest ways through the fracture, infinite where there is none.
std::vector<double> distances_from(const unsigned int start,
                                   const std::vector<NetworkSegment<2>> &network,
                                   const Adjacency &adjacency)
{
  std::vector<double> distance(network.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, unsigned int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> front;
  distance[start] = 0.;
  front.emplace(0., start);
  while (!front.empty())
  {
    const auto [so_far, i] = front.top();
    front.pop();
    if (so_far > distance[i])
      continue;
    for (const unsigned int j : adjacency[i])
    {
      const double length = so_far + network[i].centre.distance(network[j].centre);
      if (length < distance[j])
      {
        distance[j] = length;
        front.emplace(length, j);
      }
    }
  }
  return distance;
}

/// The coarser graph.
struct Pieces
{
  std::vector<std::vector<unsigned int>> segments;
  std::vector<std::set<unsigned int>> neighbours;
};

Pieces pieces_of(const std::vector<double> &distance,
                 const double length,
                 const Adjacency &adjacency,
                 std::vector<bool> &visited)
{
  constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
  const auto level = [&](const unsigned int i) { return static_cast<int>(distance[i] / length); };
  Pieces pieces;
  std::vector<unsigned int> piece_of(distance.size(), none);
  for (unsigned int start = 0; start < distance.size(); ++start)
  {
    if (!std::isfinite(distance[start]) || piece_of[start] != none)
      continue;
    std::vector<unsigned int> members{start};
    piece_of[start] = pieces.segments.size();
    for (unsigned int k = 0; k < members.size(); ++k)
      for (const unsigned int j : adjacency[members[k]])
        if (piece_of[j] == none && level(j) == level(start))
        {
          piece_of[j] = pieces.segments.size();
          members.push_back(j);
        }
    pieces.segments.push_back(members);
  }
  pieces.neighbours.resize(pieces.segments.size());
  for (unsigned int piece = 0; piece < pieces.segments.size(); ++piece)
    for (const unsigned int i : pieces.segments[piece])
    {
      visited[i] = true;
      for (const unsigned int j : adjacency[i])
        if (piece_of[j] != piece)
          pieces.neighbours[piece].insert(piece_of[j]);
    }
  return pieces;
}

/// The pieces of the branch that leaves @p fork through @p first, up to the next fork or its end.
std::vector<unsigned int> branch(const Pieces &pieces, unsigned int fork, const unsigned int first)
{
  std::vector<unsigned int> chain{first};
  while (pieces.neighbours[chain.back()].size() == 2)
  {
    const auto &both = pieces.neighbours[chain.back()];
    const unsigned int next = *both.begin() == fork ? *both.rbegin() : *both.begin();
    fork = chain.back();
    if (next == first)
      break;
    chain.push_back(next);
  }
  return chain;
}

/// Take away what is too short to be a branch.
void prune(Pieces &pieces)
{
  for (bool changed = true; changed;)
  {
    changed = false;
    for (unsigned int fork = 0; fork < pieces.neighbours.size() && !changed; ++fork)
      if (pieces.neighbours[fork].size() > 2)
        for (const unsigned int first : std::set<unsigned int>(pieces.neighbours[fork]))
        {
          const auto chain = branch(pieces, fork, first);
          if (chain.size() >= shortest_branch || pieces.neighbours[chain.back()].size() > 1)
            continue;
          pieces.neighbours[fork].erase(first);
          for (const unsigned int piece : chain)
            pieces.neighbours[piece].clear();
          changed = true;
          break;
        }
  }
}

/// Forks beside one another are one: where fractures cross, the two branches of one may part from
/// the other in two pieces.
void join_forks(Pieces &pieces)
{
  for (unsigned int fork = 0; fork < pieces.neighbours.size(); ++fork)
    while (pieces.neighbours[fork].size() > 2)
    {
      const auto &beside = pieces.neighbours[fork];
      const auto found =
        std::find_if(beside.begin(), beside.end(),
                     [&](const unsigned int piece) { return pieces.neighbours[piece].size() > 2; });
      if (found == beside.end())
        break;
      const unsigned int other = *found;
      for (const unsigned int piece : std::set<unsigned int>(pieces.neighbours[other]))
      {
        pieces.neighbours[piece].erase(other);
        if (piece == fork)
          continue;
        pieces.neighbours[piece].insert(fork);
        pieces.neighbours[fork].insert(piece);
      }
      pieces.neighbours[other].clear();
      pieces.segments[fork].insert(pieces.segments[fork].end(), pieces.segments[other].begin(),
                                   pieces.segments[other].end());
    }
}

Tensor<1, 2> direction(const Pieces &pieces,
                       const unsigned int fork,
                       const std::vector<unsigned int> &chain,
                       const std::vector<NetworkSegment<2>> &network)
{
  Point<2> origin;
  for (const unsigned int i : pieces.segments[fork])
    origin += network[i].centre / double(pieces.segments[fork].size());
  Tensor<1, 2> mean;
  std::vector<Tensor<1, 2>> offsets;
  for (unsigned int k = 0; k < std::min<std::size_t>(chain.size(), pieces_for_direction); ++k)
    for (const unsigned int i : pieces.segments[chain[k]])
      offsets.push_back(network[i].centre - origin);
  for (const auto &offset : offsets)
    mean += offset / double(offsets.size());
  SymmetricTensor<2, 2> spread;
  for (const auto &offset : offsets)
    spread += symmetrize(outer_product(offset - mean, offset - mean));
  const Tensor<1, 2> axis = eigenvectors(spread)[0].second;
  return axis * mean < 0. ? -axis : axis;
}
} // namespace


SegmentGraph segment_graph(const std::vector<NetworkSegment<2>> &network)
{
  SegmentGraph graph;
  const Adjacency adjacency = adjacency_of(network);
  double length = 0.;
  for (const auto &segment : network)
    length += piece_length * segment.area / network.size();
  std::vector<bool> visited(network.size(), false);
  for (unsigned int any = 0; any < network.size(); ++any)
  {
    if (visited[any])
      continue;
    // An end: the furthest from anywhere.
    std::vector<double> distance = distances_from(any, network, adjacency);
    for (double &d : distance)
      d = std::isfinite(d) ? d : -1.;
    const unsigned int end = std::max_element(distance.begin(), distance.end()) - distance.begin();
    Pieces pieces = pieces_of(distances_from(end, network, adjacency), length, adjacency, visited);
    prune(pieces);
    join_forks(pieces);

    ++graph.n_fractures;
    unsigned int n_ends = 0;
    for (unsigned int piece = 0; piece < pieces.neighbours.size(); ++piece)
    {
      const auto &neighbours = pieces.neighbours[piece];
      if (neighbours.size() < 3)
        continue;
      n_ends += neighbours.size();
      std::vector<Tensor<1, 2>> directions;
      for (const unsigned int first : neighbours)
      {
        const auto chain = branch(pieces, piece, first);
        n_ends += pieces.neighbours[chain.back()].size() < 2;
        directions.push_back(direction(pieces, piece, chain, network));
      }
      double least = M_PI;
      for (unsigned int i = 0; i < directions.size(); ++i)
        for (unsigned int j = i + 1; j < directions.size(); ++j)
          least = std::min(least, std::acos(std::clamp(directions[i] * directions[j], -1., 1.)));
      graph.fork_angles.push_back(least);
    }
    graph.n_branches += std::max(1u, n_ends / 2);
  }
  return graph;
}
} // namespace stockwork
