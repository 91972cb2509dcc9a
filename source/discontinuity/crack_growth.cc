#include "discontinuity/discontinuity.h"

#include <deal.II/dofs/dof_accessor.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace stockwork
{
namespace
{
/// What the owner of a tip's cell found out about the next one.
template <int dim>
struct Finding
{
  unsigned int advance;
  unsigned char outcome;
  unsigned int owner = dealii::numbers::invalid_unsigned_int; ///< of the next cell
  CrackPiece<dim> piece;                                      ///< first end at the old tip
  double split = 0.5; ///< of the piece that passes through the cell, if the new one ends on it

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &advance &outcome &owner &piece &split;
  }
};
} // namespace

template <int dim>
std::vector<typename Discontinuity<dim>::Outcome>
Discontinuity<dim>::grow(const std::vector<Advance> &advances, const Collectives &collectives)
{
  std::vector<Outcome> outcomes(advances.size());
  std::vector<unsigned int> n_new(advances.size(), 0); // pieces
  std::vector<double> length(advances.size(), 0.);     // of these [m]
  std::vector<unsigned int> moving;
  for (unsigned int a = 0; a < advances.size(); ++a)
    moving.push_back(a);

  const auto last_piece = [&](const unsigned int a) -> CrackPiece<dim> &
  {
    auto &pieces = cracks[advances[a].crack].pieces;
    return advances[a].end == CrackEnd::first ? pieces.front() : pieces.back();
  };
  bool undone = false;
  while (!moving.empty())
  {
    std::vector<Advance> tried;
    for (const unsigned int a : moving)
      tried.push_back(advances[a]);
    const std::vector<Outcome> reached = grow_by_a_cell(tried, collectives);

    std::vector<unsigned int> going_on;
    for (unsigned int i = 0; i < moving.size(); ++i)
    {
      const unsigned int a = moving[i], end = static_cast<unsigned int>(advances[a].end);
      outcomes[a] = reached[i];
      if (reached[i] == Outcome::joined_crack)
      {
        // What is left to the other crack may be short: it goes with the last span then.
        auto &pieces = cracks[advances[a].crack].pieces;
        CrackPiece<dim> &piece = last_piece(a),
                        &before = end == 0 ? pieces[1] : pieces[pieces.size() - 2];
        piece.joined[1 - end] = before.joined[end] =
          n_new[a] > 0 || before.joined[end] || piece.length() < shortest_span * piece.cell_size();
      }
      else if (reached[i] == Outcome::grown || reached[i] == Outcome::reached_boundary)
      {
        ++n_new[a];
        CrackPiece<dim> &piece = last_piece(a);
        piece.joined[1 - end] = n_new[a] > 1;
        // Where a tip near a corner turns, the next face across its new way may be hardly away.
        length[a] += piece.length();
        const bool rests =
          piece.crosses_transverse_face(end) && length[a] >= shortest_span * piece.cell_size();
        piece.joined[end] = reached[i] == Outcome::grown && !rests;
        if (piece.joined[end])
          going_on.push_back(a);
      }
      else if (n_new[a] > 0)
      {
        // Half a span is no place to rest.
        auto &pieces = cracks[advances[a].crack].pieces;
        if (advances[a].end == CrackEnd::first)
          pieces.erase(pieces.begin(), pieces.begin() + n_new[a]);
        else
          pieces.resize(pieces.size() - n_new[a]);
        undone = true;
      }
    }
    moving = going_on;
  }
  // Where each waits for the others, none of them will ever come.
  if (std::all_of(outcomes.begin(), outcomes.end(),
                  [](const Outcome outcome) { return outcome == Outcome::waits; }))
    outcomes.assign(outcomes.size(), Outcome::reached_crack);
  if (undone)
    restore(cracks);
  else
    renumber(); // the spans
  return outcomes;
}


/// One more cell for each.
template <int dim>
std::vector<typename Discontinuity<dim>::Outcome>
Discontinuity<dim>::grow_by_a_cell(const std::vector<Advance> &advances,
                                   const Collectives &collectives)
{
  const auto &triangulation = mesh_view->triangulation;

  std::vector<Finding<dim>> findings;
  for (unsigned int a = 0; a < advances.size(); ++a)
  {
    const Advance &advance = advances[a];
    const unsigned int end = static_cast<unsigned int>(advance.end);
    const CrackPath<dim> &crack = cracks[advance.crack];
    const CrackPiece<dim> &last = crack.piece_at(advance.end);
    for (const Entry &entry : entries)
      if (entry.cell->id() == last.cell)
      {
        Finding<dim> finding;
        const unsigned int face = last.faces[end];
        const auto set = [&](const Outcome outcome)
        {
          finding.advance = a;
          finding.outcome = static_cast<unsigned char>(outcome);
        };
        Assert(!entry.cell->at_boundary(face), dealii::ExcInternalError());
        const auto next = entry.cell->neighbor(face);
        if (next->has_children() || entry.cell->neighbor_is_coarser(face))
          set(Outcome::needs_mesh);
        else
        {
          const CellIterator active(&triangulation, next->level(), next->index(),
                                    &mesh_view->dof_handler);
          const unsigned int entry_face = entry.cell->neighbor_of_neighbor(face);
          finding.owner = active->subdomain_id();
          if (const auto joining = join(advance, next->id(), entry_face))
          {
            set(Outcome::joined_crack);
            std::tie(finding.piece, finding.split) = *joining;
          }
          else
          {
            finding.piece =
              continue_into<dim>(active, entry_face, crack.tip(advance.end), advance.direction);
            finding.piece.constrained = constrained_components(*mesh_view, active);
            set(!is_cut(next->id()) || may_pass_beside(advance, finding.piece) ? Outcome::grown
                : is_underway(next->id())                                      ? Outcome::waits
                                          : Outcome::reached_crack);
          }
        }
        findings.push_back(finding);
      }
  }
  findings = collectives.gather(findings);
  std::sort(findings.begin(), findings.end(),
            [](const Finding<dim> &a, const Finding<dim> &b) { return a.advance < b.advance; });

  std::vector<Outcome> outcomes(advances.size());
  std::vector<std::pair<unsigned int, dealii::CellId>> new_cells; // owner, cell
  std::set<dealii::CellId> taken;
  for (const Finding<dim> &finding : findings)
  {
    Outcome outcome = static_cast<Outcome>(finding.outcome);
    const bool joins = outcome == Outcome::joined_crack;
    if (joins || outcome == Outcome::grown)
    {
      const Advance &advance = advances[finding.advance];
      // What another tip has done in this very pass is looked at in the next one.
      if (!taken.insert(finding.piece.cell).second ||
          (joins && !can_join(advance, finding.piece.cell)))
        outcome = Outcome::waits;
      else
      {
        const int end = static_cast<int>(advance.end);
        if (joins)
        {
          const auto [other, index] = pieces_of_cells.at(finding.piece.cell).front();
          cracks[other].pieces[index].split = finding.split;
          cracks[advance.crack].ends_on[end] = other;
        }
        auto &pieces = cracks[advance.crack].pieces;
        if (advance.end == CrackEnd::last)
          pieces.push_back(finding.piece);
        else
          pieces.insert(pieces.begin(), reversed(finding.piece));
        new_cells.emplace_back(finding.owner, finding.piece.cell);
        if (finding.piece.at_boundary[1])
          outcome = Outcome::reached_boundary;
        if (joins || finding.piece.at_boundary[1])
          stop(advance.crack, advance.end);
        find_pieces(); // places in a crack may have moved
      }
    }
    outcomes[finding.advance] = outcome;
  }
  take_new_cells(new_cells, collectives);
  return outcomes;
}


template <int dim>
void Discontinuity<dim>::take_new_cells(
  const std::vector<std::pair<unsigned int, dealii::CellId>> &new_cells,
  const Collectives &collectives)
{
  find_pieces();
  update_entries();
  for (const auto &[owner, id] : new_cells)
    if (owner == collectives.rank())
    {
      const auto cell = mesh_view->triangulation.create_cell_iterator(id);
      const CellIterator active(&mesh_view->triangulation, cell->level(), cell->index(),
                                &mesh_view->dof_handler);
      if (entry_of_cell[active->active_cell_index()] < 0)
        add_entry(active, pieces_of_cells.at(id));
    }
  renumber();
}

template std::vector<Discontinuity<2>::Outcome> Discontinuity<2>::grow(const std::vector<Advance> &,
                                                                       const Collectives &);
template std::vector<Discontinuity<2>::Outcome>
Discontinuity<2>::grow_by_a_cell(const std::vector<Advance> &, const Collectives &);
template void
Discontinuity<2>::take_new_cells(const std::vector<std::pair<unsigned int, dealii::CellId>> &,
                                 const Collectives &);
} // namespace stockwork
