#include "discontinuity/enrichment.h"

#include "discontinuity/tip_functions.h"

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace stockwork
{
namespace
{
constexpr unsigned int no_unknown = dealii::numbers::invalid_unsigned_int;

template <int dim>
bool on_plus_side(const CrackPiece<dim> &piece, const unsigned int corner)
{
  return piece.plus_side(dealii::GeometryInfo<dim>::unit_cell_vertex(corner));
}

/// A crack that ends on another one.
struct Junction
{
  unsigned int crack;
  unsigned int on;       ///< the other crack
  unsigned int on_piece; ///< of it
  int side;              ///< of the other crack: 1 plus, 0 minus
  bool plus_beyond;      ///< along the other crack, the plus side of the one comes after it
};

template <int dim>
std::vector<Junction> junctions_of(const std::vector<CrackPath<dim>> &cracks,
                                   const PiecesOfCells &pieces_of_cells)
{
  std::vector<Junction> junctions;
  for (unsigned int c = 0; c < cracks.size(); ++c)
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
      if (const int on = cracks[c].ends_on[static_cast<int>(end)]; on >= 0)
      {
        const CrackPiece<dim> &last = cracks[c].piece_at(end);
        const unsigned int index = pieces_of_cells.at(last.cell).front().second;
        const CrackPiece<dim> &other = cracks[on].pieces[index];
        // By the ends themselves: what `along` says is not bound to them.
        const auto other_way = other.unit_ends[1] - other.unit_ends[0];
        junctions.push_back({c, static_cast<unsigned int>(on), index, side_of(other, last),
                             last.unit_normal() * other_way > 0.});
      }
  return junctions;
}
} // namespace


/// The unknowns at the corners of the cells that a crack cuts.
template <int dim>
class Enrichment<dim>::Numbering
{
public:
  Numbering(const std::vector<CrackPath<dim>> &cracks,
            const PiecesOfCells &pieces_of_cells,
            const double domain_size,
            std::vector<ExtraUnknown> &unknowns)
    : junctions(junctions_of(cracks, pieces_of_cells))
    , domain_size(domain_size)
  {
    std::vector<std::unordered_set<std::uint64_t>> closed; // by crack
    for (unsigned int c = 0; c < cracks.size(); ++c)
      closed.push_back(closed_corners(cracks[c], c));
    for (unsigned int c = 0; c < cracks.size(); ++c)
      for (const CrackPiece<dim> &piece : cracks[c].pieces)
        for (unsigned int v = 0; v < CrackPiece<dim>::n_corners; ++v)
        {
          const std::uint64_t corner = key(c, piece, v);
          if (closed[c].count(corner) != 0 ||
              beyond_tip_of_other(cracks, pieces_of_cells.at(piece.cell), c, piece, v, closed))
            continue;
          for (unsigned int d = 0; d < dim; ++d)
            if (!(piece.constrained[v] & (1u << d)))
            {
              const std::uint64_t unknown = hash_combine(corner, d);
              if (numbers.emplace(unknown, unknowns.size()).second)
                unknowns.push_back({unknown});
            }
        }
  }

  /// Of a crack at a corner of a piece, its own or another crack's.
  unsigned int unknown(const unsigned int crack,
                       const CrackPiece<dim> &piece,
                       const unsigned int corner,
                       const unsigned int component) const
  {
    const auto found = numbers.find(hash_combine(key(crack, piece, corner), component));
    return found == numbers.end() ? no_unknown : found->second;
  }

  const std::vector<Junction> junctions;

private:
  std::uint64_t
  key(const unsigned int crack, const CrackPiece<dim> &piece, const unsigned int corner) const
  {
    return hash_point(hash_combine(0xa, crack), piece.corners[corner], domain_size);
  }

  /// Where the tips keep a crack closed.
  std::unordered_set<std::uint64_t> closed_corners(const CrackPath<dim> &crack,
                                                   const unsigned int c) const
  {
    std::unordered_set<std::uint64_t> closed;
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
    {
      const CrackPiece<dim> &piece = crack.piece_at(end);
      const unsigned int e = static_cast<unsigned int>(end);
      if (crack.ends_on[e] >= 0)
        continue;
      if (piece.inside[e])
        for (unsigned int corner = 0; corner < CrackPiece<dim>::n_corners; ++corner)
          closed.insert(key(c, piece, corner));
      else if (!piece.at_boundary[e])
        for (const unsigned int corner : face_vertices[piece.faces[e]])
          closed.insert(key(c, piece, corner));
    }
    return closed;
  }

  /// Is a corner of a piece on the other side of the crack that passes the cell, and at the face
  /// that holds the tip of that? A function of it would jump in the rock beyond the tip.
  bool beyond_tip_of_other(const std::vector<CrackPath<dim>> &cracks,
                           const std::vector<PieceIndex> &in_cell,
                           const unsigned int crack,
                           const CrackPiece<dim> &piece,
                           const unsigned int corner,
                           const std::vector<std::unordered_set<std::uint64_t>> &closed) const
  {
    const auto [other, index] = in_cell.front();
    if (other == crack || closed[other].count(key(other, piece, corner)) == 0)
      return false;
    const CrackPiece<dim> &passing = cracks[other].pieces[index];
    return on_plus_side(passing, corner) != (side_of(passing, piece) == 1);
  }

  std::unordered_map<std::uint64_t, unsigned int> numbers;
  double domain_size;
};


template <int dim>
void Enrichment<dim>::add_columns(const std::vector<CrackPath<dim>> &cracks,
                                  const std::vector<PieceIndex> &in_cell,
                                  const Numbering &numbering)
{
  constexpr unsigned int n_corners = CrackPiece<dim>::n_corners;
  PiecesInCell<dim> pieces;
  for (const auto &[crack, index] : in_cell)
    pieces.push_back(&cracks[crack].pieces[index]);
  const auto parts = cell_parts(pieces);
  const auto [passing_crack, passing_index] = in_cell.front();
  const CrackPiece<dim> &passing = *pieces.front();
  auto &columns = cell_columns[passing_crack][passing_index];
  auto &jumps_of_passing = piece_jumps[passing_crack][passing_index];
  std::array<bool, n_corners> plus;
  for (unsigned int v = 0; v < n_corners; ++v)
    plus[v] = on_plus_side(passing, v);

  for (unsigned int v = 0; v < n_corners; ++v)
    for (unsigned int d = 0; d < dim; ++d)
      if (const unsigned int extra = numbering.unknown(passing_crack, passing, v, d);
          extra != no_unknown)
      {
        EnrichedColumn column{extra, v, d};
        for (unsigned int part = 0; part < parts.size(); ++part)
          column.in_part[part] = parts[part].side[0] - int(plus[v]);
        columns.push_back(column);
        jumps_of_passing.push_back({extra, v, d});
      }

  for (const Junction &junction : numbering.junctions)
  {
    if (junction.on != passing_crack)
      continue;
    const unsigned int k =
      std::find_if(in_cell.begin(), in_cell.end(),
                   [&junction](const PieceIndex &p) { return p.first == junction.crack; }) -
      in_cell.begin();
    const bool is_here = k < in_cell.size();
    // On which side of the other crack the two parts of the passing piece are.
    std::array<int, 2> side;
    for (int part = 0; part < 2; ++part)
    {
      const bool beyond =
        passing_index == junction.on_piece ? part == 1 : passing_index > junction.on_piece;
      side[part] = beyond == junction.plus_beyond;
    }
    for (unsigned int v = 0; v < n_corners; ++v)
    {
      // A corner on the side of the other crack has its own value in all of a cell that the other
      // does not cut.
      const bool same_side = int(plus[v]) == junction.side;
      if (same_side && !is_here)
        continue;
      const int at_corner = same_side ? on_plus_side(*pieces[k], v) : 0;
      if (!is_here && side[0] == 0)
        continue; // nothing of the function is in this cell
      for (unsigned int d = 0; d < dim; ++d)
        if (const unsigned int extra = numbering.unknown(junction.crack, passing, v, d);
            extra != no_unknown)
        {
          EnrichedColumn column{extra, v, d};
          for (unsigned int part = 0; part < parts.size(); ++part)
            if (parts[part].side[0] == junction.side)
              column.in_part[part] = (is_here ? parts[part].side[k] : side[0]) - at_corner;
          columns.push_back(column);

          const int sign = junction.side == 1 ? 1 : -1;
          JumpColumn jump{extra, v, d};
          for (unsigned int part = 0; part < 2; ++part)
            jump.on_part[part] = sign * (side[part] - at_corner);
          jumps_of_passing.push_back(jump);
          if (is_here)
            piece_jumps[junction.crack][in_cell[k].second].push_back({extra, v, d});
        }
    }
  }
}


template <int dim>
void Enrichment<dim>::rebuild(const std::vector<CrackPath<dim>> &cracks,
                              const PiecesOfCells &pieces_of_cells,
                              std::vector<CrackTip<dim>> &tips,
                              const double domain_size)
{
  all_unknowns.clear();
  piece_jumps.assign(cracks.size(), {});
  cell_columns.assign(cracks.size(), {});
  for (unsigned int c = 0; c < cracks.size(); ++c)
  {
    piece_jumps[c].resize(cracks[c].pieces.size());
    cell_columns[c].resize(cracks[c].pieces.size());
  }
  const Numbering numbering(cracks, pieces_of_cells, domain_size, all_unknowns);
  for (const auto &[cell, in_cell] : pieces_of_cells)
    add_columns(cracks, in_cell, numbering);
  for (CrackTip<dim> &tip : tips)
    for (unsigned int mode = 0; mode < tip.extra.size(); ++mode)
    {
      tip.extra[mode] = all_unknowns.size();
      all_unknowns.push_back({hash_combine(
        hash_combine(hash_combine(0x71b, tip.crack), static_cast<int>(tip.end)), mode)});
    }
}

template <int dim>
JumpShapes<dim>::JumpShapes(const CrackPiece<dim> &piece)
{
  // Gauss's two points in each of the two parts of the piece.
  constexpr unsigned int n_parts = 2, n_in_part = n_points / n_parts;
  const double offset = 0.5 / std::sqrt(3.);
  const double start[n_parts] = {0., piece.split}, size[n_parts] = {piece.split, 1. - piece.split};
  for (unsigned int q = 0; q < n_points; ++q)
  {
    const unsigned int part = q / n_in_part;
    const double place =
      start[part] + (q % n_in_part == 0 ? 0.5 - offset : 0.5 + offset) * size[part];
    values[q] =
      corner_functions<dim>(piece.unit_ends[0] + place * (piece.unit_ends[1] - piece.unit_ends[0]));
    share[q] = size[part] / n_in_part;
  }
}

template class Enrichment<2>;
template struct JumpShapes<2>;
} // namespace stockwork
