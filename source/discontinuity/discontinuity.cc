#include "discontinuity/discontinuity.h"

#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/fe/fe.h>

#include "stockwork/base/error.h"

#include <algorithm>
#include <sstream>

namespace stockwork
{
using dealii::Point;

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

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &advance &outcome &owner &piece;
  }
};
} // namespace

template <int dim>
Discontinuity<dim>::Discontinuity(const double domain_size, const double scale)
  : domain_size(domain_size)
  , scale(scale)
{
}


template <int dim>
void Discontinuity<dim>::setup(const Discretization<dim> &d, const Collectives &collectives)
{
  discretization = std::make_unique<Discretization<dim>>(d);
  entries.clear();
  piece_of_cell.clear();
  entry_of_cell.assign(d.triangulation.n_active_cells(), -1);
  if (cracks.empty())
    return;

  renumber();
  collect_entries();

  // Cells must still be there, and what boundary conditions hold may have changed.
  std::vector<std::vector<unsigned int>> mine;
  for (const OwnedPiece &owned : owned_pieces())
  {
    const auto held = held_components(d, owned.cell);
    std::vector<unsigned int> record{owned.crack, owned.piece};
    record.insert(record.end(), held.begin(), held.end());
    mine.push_back(record);
  }
  const auto all = collectives.gather(mine);
  unsigned int n_cells = 0;
  for (const auto &crack : cracks)
    n_cells += crack.pieces.size();
  if (all.size() != n_cells)
    throw SolveError("The mesh has changed along a crack: " + std::to_string(n_cells - all.size()) +
                     " of " + std::to_string(n_cells) +
                     " cut cells have been refined or coarsened.");
  for (const auto &record : all)
    for (unsigned int v = 0; v < CrackPiece<dim>::n_corners; ++v)
      cracks[record[0]].pieces[record[1]].held[v] = record[2 + v];
  renumber();
}


template <int dim>
void Discontinuity<dim>::cut(const std::vector<std::vector<Point<dim>>> &polylines,
                             const Collectives &collectives)
{
  cracks.clear();
  entries.clear();
  entry_of_cell.assign(entry_of_cell.size(), -1);
  for (const auto &polyline : polylines)
    cracks.push_back(cut_polyline(*discretization, polyline, domain_size, collectives));

  std::map<dealii::CellId, unsigned int> seen;
  for (unsigned int c = 0; c < cracks.size(); ++c)
    for (const auto &piece : cracks[c].pieces)
      if (!seen.emplace(piece.cell, c).second)
      {
        std::ostringstream where;
        where << '(' << piece.centre() << ')';
        throw InputError("Cracks meet in the cell at " + where.str() +
                         "; a cell can hold one crack only. Refine the mesh or keep them apart.");
      }
  renumber();
  collect_entries();
  renumber();
}


template <int dim>
void Discontinuity<dim>::restore(std::vector<CrackPath<dim>> earlier)
{
  cracks = std::move(earlier);
  renumber();
  // Cells that are not cut any more.
  std::vector<Entry> kept;
  for (Entry &entry : entries)
    if (is_cut(entry.cell->id()))
      kept.push_back(std::move(entry));
  entries = std::move(kept);
  entry_of_cell.assign(entry_of_cell.size(), -1);
  for (unsigned int i = 0; i < entries.size(); ++i)
    entry_of_cell[entries[i].cell->active_cell_index()] = i;
}


template <int dim>
void Discontinuity<dim>::replace(std::vector<CrackPath<dim>> others)
{
  cracks = std::move(others);
  entries.clear();
  entry_of_cell.assign(entry_of_cell.size(), -1);
  renumber();
  if (discretization)
  {
    collect_entries();
    renumber();
  }
}


template <int dim>
void Discontinuity<dim>::collect_entries()
{
  for (const auto &cell : discretization->dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const auto found = piece_of_cell.find(cell->id()); found != piece_of_cell.end())
        add_entry(cell, cracks[found->second.first].pieces[found->second.second]);
}


template <int dim>
typename Discontinuity<dim>::Entry &Discontinuity<dim>::add_entry(const CellIterator &cell,
                                                                  const CrackPiece<dim> &piece)
{
  const unsigned int degree = cell->get_fe().base_element(0).degree;
  entries.push_back(
    {cell, make_cut_geometry<dim>(discretization->mapping, cell, piece, degree), {}, {}});
  entry_of_cell[cell->active_cell_index()] = entries.size() - 1;
  return entries.back();
}


template <int dim>
void Discontinuity<dim>::renumber()
{
  unknowns.rebuild(cracks, domain_size, scale);
  piece_of_cell.clear();
  for (unsigned int c = 0; c < cracks.size(); ++c)
    for (unsigned int i = 0; i < cracks[c].pieces.size(); ++i)
      piece_of_cell[cracks[c].pieces[i].cell] = {c, i};

  for (Entry &entry : entries)
    if (const auto found = piece_of_cell.find(entry.cell->id()); found != piece_of_cell.end())
    {
      const auto &columns = unknowns.columns(found->second.first, found->second.second);
      const bool same_set = columns.size() == entry.columns.size() &&
                            std::equal(columns.begin(), columns.end(), entry.columns.begin(),
                                       [](const EnrichedColumn &a, const EnrichedColumn &b) {
                                         return a.corner == b.corner && a.component == b.component;
                                       });
      if (same_set && !entry.cut.points.empty())
        for (unsigned int c = 0; c < columns.size(); ++c)
          entry.cut.extra[c] = columns[c].extra;
      else
        entry.cut = make_cut_cell(entry.geometry, columns);
      entry.columns = columns;
    }
}


template <int dim>
std::vector<typename Discontinuity<dim>::Outcome>
Discontinuity<dim>::grow(const std::vector<Advance> &advances, const Collectives &collectives)
{
  const auto &triangulation = discretization->triangulation;

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
        else if (is_cut(next->id()))
          set(Outcome::reached_crack);
        else
        {
          const CellIterator active(&triangulation, next->level(), next->index(),
                                    &discretization->dof_handler);
          set(Outcome::grown);
          finding.owner = active->subdomain_id();
          finding.piece = continue_into<dim>(active, entry.cell->neighbor_of_neighbor(face),
                                             crack.tip(advance.end), advance.direction);
          finding.piece.held = held_components(*discretization, active);
        }
        findings.push_back(finding);
      }
  }
  findings = collectives.gather(findings);
  std::sort(findings.begin(), findings.end(),
            [](const Finding<dim> &a, const Finding<dim> &b) { return a.advance < b.advance; });

  std::vector<Outcome> outcomes(advances.size());
  std::vector<std::pair<unsigned int, dealii::CellId>> new_cells; // owner, cell
  for (const Finding<dim> &finding : findings)
  {
    Outcome outcome = static_cast<Outcome>(finding.outcome);
    if (outcome == Outcome::grown && is_cut(finding.piece.cell))
      outcome = Outcome::reached_crack; // two tips met in this very pass
    if (outcome == Outcome::grown)
    {
      const Advance &advance = advances[finding.advance];
      auto &pieces = cracks[advance.crack].pieces;
      if (advance.end == CrackEnd::last)
        pieces.push_back(finding.piece);
      else
        pieces.insert(pieces.begin(), reversed(finding.piece));
      piece_of_cell[finding.piece.cell] = {advance.crack, 0}; // until renumber()
      new_cells.emplace_back(finding.owner, finding.piece.cell);
      if (finding.piece.at_boundary[1])
      {
        outcome = Outcome::reached_boundary;
        stop(advance.crack, advance.end);
      }
    }
    outcomes[finding.advance] = outcome;
  }
  renumber();
  for (const auto &[owner, id] : new_cells)
    if (owner == collectives.rank())
    {
      const auto cell = triangulation.create_cell_iterator(id);
      const auto &place = piece_of_cell.at(id);
      add_entry(
        CellIterator(&triangulation, cell->level(), cell->index(), &discretization->dof_handler),
        cracks[place.first].pieces[place.second]);
    }
  if (!new_cells.empty())
    renumber();
  return outcomes;
}


template <int dim>
std::vector<typename Discontinuity<dim>::OwnedPiece> Discontinuity<dim>::owned_pieces() const
{
  std::vector<OwnedPiece> owned;
  for (const Entry &entry : entries)
  {
    const auto &[crack, piece] = piece_of_cell.at(entry.cell->id());
    owned.push_back({crack, piece, entry.cell});
  }
  std::sort(owned.begin(), owned.end(),
            [](const OwnedPiece &a, const OwnedPiece &b)
            { return std::make_pair(a.crack, a.piece) < std::make_pair(b.crack, b.piece); });
  return owned;
}


template <int dim>
std::vector<Segment<dim>> Discontinuity<dim>::segments(
  const std::function<double(const Point<dim> &)> &in_situ_pore_pressure) const
{
  std::vector<Segment<dim>> all;
  std::vector<dealii::types::global_dof_index> dofs;
  for (const OwnedPiece &owned : owned_pieces())
  {
    const auto &pieces = cracks[owned.crack].pieces;
    const CrackPiece<dim> &piece = pieces[owned.piece];
    Segment<dim> segment;
    segment.key = piece.key(domain_size);
    segment.centre = piece.centre();
    segment.normal = piece.normal();
    segment.area = piece.length();
    if (owned.piece > 0)
      segment.neighbours.push_back(
        {pieces[owned.piece - 1].key(domain_size), 0.5 * piece.length(), 1.});
    if (owned.piece + 1 < pieces.size())
      segment.neighbours.push_back(
        {pieces[owned.piece + 1].key(domain_size), 0.5 * piece.length(), 1.});

    const JumpShapes<dim> shapes(piece);
    for (const EnrichedColumn &column : unknowns.columns(owned.crack, owned.piece))
    {
      segment.opening.extra.push_back(column.extra);
      segment.opening.extra_coefficients.push_back(shapes.mean(column.corner) *
                                                   segment.normal[column.component]);
    }

    segment.pore_pressure.constant = in_situ_pore_pressure(segment.centre);
    if (discretization->has_pore_pressure)
    {
      const auto &fe = owned.cell->get_fe();
      dofs.resize(fe.n_dofs_per_cell());
      owned.cell->get_dof_indices(dofs);
      const Point<dim> middle =
        piece.unit_ends[0] + 0.5 * (piece.unit_ends[1] - piece.unit_ends[0]);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (fe.system_to_component_index(i).first == dim)
        {
          segment.pore_pressure.bulk.push_back(dofs[i]);
          segment.pore_pressure.bulk_coefficients.push_back(fe.shape_value(i, middle));
        }
    }
    all.push_back(std::move(segment));
  }
  return all;
}

template <int dim>
void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                       const Discontinuity<dim> &discontinuity,
                       const double wanted,
                       const unsigned int rings_ahead,
                       std::vector<float> &sizes)
{
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const Point<dim> centre = cell->center();
      const double reach = 0.5 * cell->diameter();
      float &size = sizes[cell->active_cell_index()];
      for (const auto &path : discontinuity.paths())
        for (unsigned int i = 0; i < path.pieces.size(); ++i)
        {
          const CrackPiece<dim> &piece = path.pieces[i];
          const double h = wanted > 0. ? wanted : piece.cell_size();
          const bool at_tip =
            (i == 0 && path.is_tip[0]) || (i + 1 == path.pieces.size() && path.is_tip[1]);
          const double margin = (at_tip ? rings_ahead : 1.5) * h;
          if (centre.distance(piece.centre()) < margin + reach + 0.5 * piece.length())
            size = std::min(size, static_cast<float>(h));
        }
    }
}

template <int dim>
void request_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                       const std::vector<Point<dim>> &corners,
                       const double wanted,
                       const unsigned int rings,
                       std::vector<float> &sizes)
{
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const Point<dim> centre = cell->center();
      const double reach = 0.5 * cell->diameter() + rings * wanted;
      for (unsigned int i = 0; i + 1 < corners.size(); ++i)
      {
        const dealii::Tensor<1, dim> edge = corners[i + 1] - corners[i];
        const double along =
          std::clamp(((centre - corners[i]) * edge) / edge.norm_square(), 0., 1.);
        if (centre.distance(corners[i] + along * edge) < reach)
        {
          float &size = sizes[cell->active_cell_index()];
          size = std::min(size, static_cast<float>(wanted));
        }
      }
    }
}

template class Discontinuity<2>;
template void request_cell_size(const dealii::parallel::distributed::Triangulation<2> &,
                                const std::vector<Point<2>> &,
                                const double,
                                const unsigned int,
                                std::vector<float> &);
template void request_cell_size(const dealii::parallel::distributed::Triangulation<2> &,
                                const Discontinuity<2> &,
                                const double,
                                const unsigned int,
                                std::vector<float> &);
} // namespace stockwork
