// Cracks that end on other cracks, or begin there.
#include "discontinuity/discontinuity.h"

#include <deal.II/dofs/dof_accessor.h>

#include "stockwork/base/error.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace stockwork
{
namespace
{
/// In unit cells: a tip that is nearer to another crack than this lies on neither side of it. A
/// crack along a line of the mesh is further away than that.
constexpr double least_distance = 0.4 * corner_clearance;

/// Of a point from the line through a piece, on its plus side, in unit cells.
double unit_distance(const CrackPiece<2> &piece, const dealii::Point<2> &unit_point)
{
  const auto normal = piece.unit_normal();
  return normal * (unit_point - piece.unit_ends[0]) / normal.norm();
}
} // namespace

template <int dim>
bool Discontinuity<dim>::is_underway(const dealii::CellId &cell) const
{
  for (const auto &[crack, index] : pieces_of_cells.at(cell))
  {
    const auto &pieces = cracks[crack].pieces;
    const auto spans = spans_of(cracks[crack]);
    if ((pieces.front().joined[0] && index <= spans.front().last) ||
        (pieces.back().joined[1] && index >= spans.back().first))
      return true;
  }
  return false;
}


template <int dim>
bool Discontinuity<dim>::can_join(const Advance &advance, const dealii::CellId &cell) const
{
  const auto [other, index] = pieces_of_cells.at(cell).front();
  const CrackPath<dim> &path = cracks[other], &own = cracks[advance.crack];
  if (other == advance.crack || path.pieces[index].inside[0] || path.pieces[index].inside[1] ||
      own.ends_on[1 - static_cast<int>(advance.end)] == static_cast<int>(other) ||
      path.ends_on[0] == static_cast<int>(advance.crack) ||
      path.ends_on[1] == static_cast<int>(advance.crack))
    return false;

  // Functions of one junction do not reach to another one between other cracks.
  constexpr unsigned int reach = 2; // pieces
  for (unsigned int i = index - std::min(index, reach);
       i <= std::min<std::size_t>(index + reach, path.pieces.size() - 1); ++i)
    if (pieces_of_cells.at(path.pieces[i].cell).front().first != other)
      return false;
  const unsigned int n = own.pieces.size();
  for (unsigned int k = 0; k < std::min(reach, n); ++k)
    if (const auto &piece = own.pieces[advance.end == CrackEnd::first ? k : n - 1 - k];
        pieces_of_cells.at(piece.cell).size() > 1)
      return false;
  return true;
}


template <int dim>
std::optional<std::pair<CrackPiece<dim>, double>> Discontinuity<dim>::join(
  const Advance &advance, const dealii::CellId &cell, const unsigned int face) const
{
  const auto found = pieces_of_cells.find(cell);
  if (found == pieces_of_cells.end() || !tips.empty() || is_underway(cell) ||
      !can_join(advance, cell))
    return {};
  const auto &in_cell = found->second;
  const auto [other, index] = in_cell.front();
  const CrackPath<dim> &path = cracks[other];
  const CrackPiece<dim> &passing = path.pieces[index];
  const CrackPath<dim> &own = cracks[advance.crack];
  std::optional<double> share;
  if (in_cell.size() > 1)
  {
    const CrackPiece<dim> &third = cracks[in_cell[1].first].pieces[in_cell[1].second];
    if (!third.inside[0] && !third.inside[1])
      return {};
    share = passing.split;
  }
  // Straight on: the stress that a tip turns to is that on both sides of the other crack.
  const CrackPiece<dim> piece =
    continue_onto(passing, face, own.tip(advance.end), own.direction(advance.end), share);
  if (std::abs(unit_distance(passing, piece.unit_ends[0])) < least_distance)
    return {};
  for (unsigned int k = 1; k < in_cell.size(); ++k)
    if (side_of(passing, cracks[in_cell[k].first].pieces[in_cell[k].second]) ==
        side_of(passing, piece))
      return {};
  return std::make_pair(piece, *share);
}


template <int dim>
bool Discontinuity<dim>::may_pass_beside(const Advance &advance, const CrackPiece<dim> &piece) const
{
  const auto &in_cell = pieces_of_cells.at(piece.cell);
  const CrackPath<dim> &own = cracks[advance.crack];
  const auto [other, index] = in_cell.front();
  if (in_cell.size() > 1 ||
      own.ends_on[1 - static_cast<int>(advance.end)] != static_cast<int>(other))
    return false;
  for (const CrackPiece<dim> &one : own.pieces)
    if (pieces_of_cells.at(one.cell).front().first != other)
      return false; // it has been away
  const CrackPiece<dim> &passing = cracks[other].pieces[index];
  const double first = unit_distance(passing, piece.unit_ends[0]),
               last = unit_distance(passing, piece.unit_ends[1]);
  return first * last > 0. && std::min(std::abs(first), std::abs(last)) > 1e-4;
}


template <int dim>
std::optional<typename Discontinuity<dim>::FarSide>
Discontinuity<dim>::far_side(const unsigned int crack, const CrackEnd end) const
{
  if (cracks[crack].ends_on[static_cast<int>(end)] < 0)
    return {};
  const CrackPiece<dim> &last = cracks[crack].piece_at(end);
  const auto &in_cell = pieces_of_cells.at(last.cell);
  if (in_cell.size() > 2)
    return {};
  const auto [other, index] = in_cell.front();
  const CrackPiece<dim> &passing = cracks[other].pieces[index];
  const double sign = side_of(passing, last) == 1 ? -1. : 1.;
  return FarSide{other, index, sign * passing.normal()};
}


template <int dim>
typename Discontinuity<dim>::Outcome
Discontinuity<dim>::cross(const unsigned int crack,
                          const CrackEnd end,
                          const dealii::Tensor<1, dim> &direction,
                          const Collectives &collectives)
{
  const CrackPiece<dim> &last = cracks[crack].piece_at(end);
  const auto far = far_side(crack, end);
  if (!far)
    return Outcome::reached_crack;
  const CrackPiece<dim> &passing = cracks[far->crack].pieces[far->piece];
  CrackPath<dim> path;
  path.pieces = {leave_from(passing, direction)};
  path.ends_on[0] = far->crack;
  path.is_tip[0] = false;
  CrackPiece<dim> &piece = path.pieces.front();
  if (side_of(passing, piece) == side_of(passing, last) ||
      std::abs(unit_distance(passing, piece.unit_ends[1])) < least_distance)
    return Outcome::reached_crack;

  // What only the owner of the cell knows: whether the crack would leave the body.
  std::vector<unsigned char> at_boundary;
  std::vector<std::pair<unsigned int, dealii::CellId>> new_cells;
  for (const Entry &entry : entries)
    if (entry.cell->id() == piece.cell)
    {
      at_boundary.push_back(entry.cell->at_boundary(piece.faces[1]));
      new_cells.emplace_back(collectives.rank(), piece.cell);
    }
  piece.at_boundary[1] = collectives.gather(at_boundary).front() != 0;
  if (piece.at_boundary[1])
    return Outcome::reached_crack;

  const std::vector<CrackPath<dim>> before = cracks;
  cracks.push_back(path);
  take_new_cells(new_cells, collectives);
  if (piece.crosses_transverse_face(1) && piece.length() >= shortest_span * piece.cell_size())
    return Outcome::grown;
  // On to the next face across it.
  const unsigned int number = cracks.size() - 1;
  cracks.back().pieces.front().joined[1] = true;
  const Outcome outcome =
    grow({{number, CrackEnd::last, path.pieces.front().along}}, collectives)[0];
  if (outcome == Outcome::grown || outcome == Outcome::reached_boundary)
  {
    cracks[number].pieces[1].joined[0] = true;
    renumber();
    return outcome;
  }
  restore(before);
  return outcome;
}


template <int dim>
void Discontinuity<dim>::join_initial_cracks(const std::vector<InitialCrack<dim>> &given,
                                             const bool may_join,
                                             const Collectives &collectives)
{
  const auto refuse =
    [&](const unsigned int crack, const CrackPiece<dim> &piece, const std::string &reason)
  {
    std::ostringstream text;
    text << "a crack that fits the mesh. Cracks meet in the cell at (" << piece.centre() << "); "
         << reason;
    throw EntryError(given[crack].entry, given[crack].text, text.str());
  };
  const auto distance_of_end =
    [&](const unsigned int crack, const unsigned int end, const unsigned int other)
  {
    const auto &points = given[crack].points;
    return given[other].distance(end == 0 ? points.front() : points.back());
  };

  // What goes beyond another crack is cut off, if it is part of a cell.
  std::vector<std::array<int, 2>> joins(cracks.size(), {{-1, -1}});
  for (unsigned int c = 0; c < cracks.size(); ++c)
    for (unsigned int other = 0; other < cracks.size(); ++other)
      for (const unsigned int end : {0, 1})
      {
        auto &pieces = cracks[c].pieces;
        const double size = (end == 0 ? pieces.front() : pieces.back()).cell_size();
        const double gap = distance_of_end(c, end, other);
        if (!may_join || c == other || !cracks[c].is_tip[end] || gap > size ||
            joins[other][0] == static_cast<int>(c) || joins[other][1] == static_cast<int>(c))
          continue;
        std::set<dealii::CellId> of_other;
        for (const CrackPiece<dim> &piece : cracks[other].pieces)
          of_other.insert(piece.cell);
        const unsigned int n = pieces.size();
        unsigned int n_off = 0; // pieces from the end
        for (unsigned int k = 0; k < std::min(n, 4u); ++k)
          if (of_other.count(pieces[end == 0 ? k : n - 1 - k].cell) != 0)
            n_off = k + 1;
        if (n_off == 0 && gap > 1e-6 * size)
          continue;
        joins[c][end] = other;
        if (n_off == n)
          refuse(c, pieces.front(),
                 "nothing of it is left beside the other crack. Refine the mesh.");
        if (end == 0)
          pieces.erase(pieces.begin(), pieces.begin() + n_off);
        else
          pieces.resize(n - n_off);
      }

  std::map<dealii::CellId, unsigned int> seen;
  for (unsigned int c = 0; c < cracks.size(); ++c)
    for (const auto &piece : cracks[c].pieces)
      if (!seen.emplace(piece.cell, c).second)
        refuse(c, piece,
               may_join ? "one may end on the other, and they cannot cross. Give one of "
                          "them as two cracks that end there, or keep them apart by "
                          "more than a cell."
                        : "a cell can hold one crack only. Refine the mesh or keep "
                          "them apart.");
  renumber();
  collect_entries();
  renumber();

  for (unsigned int c = 0; c < cracks.size(); ++c)
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
    {
      if (joins[c][static_cast<int>(end)] < 0)
        continue;
      Outcome outcome = Outcome::grown;
      for (unsigned int k = 0; k < 3 && outcome == Outcome::grown; ++k)
        outcome = grow({{c, end, cracks[c].direction(end)}}, collectives)[0];
      if (outcome != Outcome::joined_crack)
        refuse(c, cracks[c].piece_at(end),
               "the mesh cannot hold that one ends on the other there. Move them by a part of a "
               "cell, or refine the mesh.");
    }
}

template std::optional<std::pair<CrackPiece<2>, double>>
Discontinuity<2>::join(const Advance &, const dealii::CellId &, const unsigned int) const;
template bool Discontinuity<2>::is_underway(const dealii::CellId &) const;
template bool Discontinuity<2>::can_join(const Advance &, const dealii::CellId &) const;
template bool Discontinuity<2>::may_pass_beside(const Advance &, const CrackPiece<2> &) const;
template std::optional<Discontinuity<2>::FarSide> Discontinuity<2>::far_side(const unsigned int,
                                                                             const CrackEnd) const;
template Discontinuity<2>::Outcome Discontinuity<2>::cross(const unsigned int,
                                                           const CrackEnd,
                                                           const dealii::Tensor<1, 2> &,
                                                           const Collectives &);
template void Discontinuity<2>::join_initial_cracks(const std::vector<InitialCrack<2>> &,
                                                    const bool,
                                                    const Collectives &);
} // namespace stockwork
