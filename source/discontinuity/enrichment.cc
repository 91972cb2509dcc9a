#include "discontinuity/enrichment.h"

#include "discontinuity/tip_functions.h"

#include <unordered_map>
#include <unordered_set>

namespace stockwork
{
template <int dim>
void Enrichment<dim>::rebuild(const std::vector<CrackPath<dim>> &cracks,
                              std::vector<CrackTip<dim>> &tips,
                              const double domain_size)
{
  all_unknowns.clear();
  piece_columns.assign(cracks.size(), {});
  for (unsigned int c = 0; c < cracks.size(); ++c)
  {
    const auto &pieces = cracks[c].pieces;
    const auto vertex_key = [&](const CrackPiece<dim> &piece, const unsigned int corner)
    { return hash_point(hash_combine(0xa, c), piece.corners[corner], domain_size); };

    std::unordered_set<std::uint64_t> closed;
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
    {
      const CrackPiece<dim> &piece = cracks[c].piece_at(end);
      const unsigned int e = static_cast<unsigned int>(end);
      if (piece.inside[e])
        for (unsigned int corner = 0; corner < CrackPiece<dim>::n_corners; ++corner)
          closed.insert(vertex_key(piece, corner));
      else if (!piece.at_boundary[e])
        for (const unsigned int corner : face_vertices[piece.faces[e]])
          closed.insert(vertex_key(piece, corner));
    }

    std::unordered_map<std::uint64_t, unsigned int> numbers;
    piece_columns[c].resize(pieces.size());
    for (unsigned int i = 0; i < pieces.size(); ++i)
      for (unsigned int v = 0; v < CrackPiece<dim>::n_corners; ++v)
      {
        const std::uint64_t key = vertex_key(pieces[i], v);
        if (closed.count(key) != 0)
          continue;
        for (unsigned int d = 0; d < dim; ++d)
          if (!(pieces[i].constrained[v] & (1u << d)))
          {
            const std::uint64_t unknown = hash_combine(key, d);
            const auto [entry, is_new] = numbers.emplace(unknown, all_unknowns.size());
            if (is_new)
              all_unknowns.push_back({unknown});
            piece_columns[c][i].push_back({entry->second, v, d});
          }
      }
  }
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
  // Gauss's two points in each of the equal parts of the piece.
  constexpr unsigned int n_parts = n_points / 2;
  const double offset = 0.5 / std::sqrt(3.);
  for (unsigned int q = 0; q < n_points; ++q)
  {
    const double place = (q / 2 + (q % 2 == 0 ? 0.5 - offset : 0.5 + offset)) / n_parts;
    values[q] =
      corner_functions<dim>(piece.unit_ends[0] + place * (piece.unit_ends[1] - piece.unit_ends[0]));
  }
}

template class Enrichment<2>;
template struct JumpShapes<2>;
} // namespace stockwork
