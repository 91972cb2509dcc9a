#include "discontinuity/discontinuity.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
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
template <int dim, class CellIterator>
bool reaches(const CrackTip<dim> &tip, const CellIterator &cell)
{
  return tip.point.distance(cell->center()) < tip.radius + 0.5 * cell->diameter();
}

/// Distance from a tip, in unit cells, within which its singular functions need points that gather
/// around it, inside the cell or out.
constexpr double near_tip = 0.1;

/// Which end of a piece lies beside a point of the unit cell, the nearer one; -1: none.
template <int dim>
int end_at(const CrackPiece<dim> &piece, const Point<dim> &unit_point)
{
  const double first = piece.unit_ends[0].distance(unit_point),
               last = piece.unit_ends[1].distance(unit_point);
  return std::min(first, last) > 1.5 * near_tip ? -1 : first < last ? 0 : 1;
}
} // namespace

template <int dim>
Discontinuity<dim>::Discontinuity(const double domain_size)
  : domain_size(domain_size)
{
}


template <int dim>
void Discontinuity<dim>::setup(const MeshView<dim> &d, const Collectives &collectives)
{
  mesh_view = std::make_unique<MeshView<dim>>(d);
  entries.clear();
  pieces_of_cells.clear();
  entry_of_cell.assign(d.triangulation.n_active_cells(), -1);
  if (cracks.empty())
    return;

  renumber();
  collect_entries();

  // Cells must still be there, and what boundary conditions hold may have changed.
  std::vector<std::vector<unsigned int>> mine;
  for (const OwnedPiece &owned : owned_pieces())
  {
    const auto constrained = constrained_components(d, owned.cell);
    std::vector<unsigned int> record{owned.crack, owned.piece};
    record.insert(record.end(), constrained.begin(), constrained.end());
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
      cracks[record[0]].pieces[record[1]].constrained[v] = record[2 + v];
  renumber();
}


template <int dim>
void Discontinuity<dim>::cut(
  const std::vector<InitialCrack<dim>> &given,
  const Collectives &collectives,
  const std::function<LinearStiffness<dim>(dealii::types::material_id)> &rock_of_region)
{
  cracks.clear();
  tips.clear();
  entries.clear();
  entry_of_cell.assign(entry_of_cell.size(), -1);
  const auto refuse = [](const InitialCrack<dim> &crack, const std::string &reason)
  { throw EntryError(crack.entry, crack.text, "a crack that fits the mesh. " + reason); };
  for (const InitialCrack<dim> &crack : given)
  {
    const std::vector<Point<dim>> &polyline = crack.points;
    try
    {
      cracks.push_back(
        cut_polyline(*mesh_view, polyline, domain_size, collectives, rock_of_region != nullptr));
    }
    catch (const InputError &error)
    {
      refuse(crack, error.what());
    }
    if (rock_of_region)
      for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
        if (cracks.back().is_tip[static_cast<int>(end)])
        {
          CrackTip<dim> tip;
          tip.crack = cracks.size() - 1;
          tip.end = end;
          const bool first = end == CrackEnd::first;
          tip.point = first ? polyline.front() : polyline.back();
          const auto out = tip.point - (first ? polyline[1] : polyline[polyline.size() - 2]);
          tip.along = out / out.norm();
          tip.field = std::make_shared<const NearTipField>(
            rock_of_region(cracks.back().piece_at(end).region), tip.along);
          tip.radius = maximum_tip_radius(mesh_view->triangulation, polyline, end, collectives);
          tips.push_back(tip);
        }
  }

  join_initial_cracks(given, rock_of_region == nullptr, collectives);
}


template <int dim>
void Discontinuity<dim>::restore(std::vector<CrackPath<dim>> earlier)
{
  cracks = std::move(earlier);
  find_pieces();
  update_entries();
  renumber();
}


template <int dim>
void Discontinuity<dim>::update_entries()
{
  std::vector<Entry> kept;
  std::vector<CellIterator> cut_otherwise;
  for (Entry &entry : entries)
    if (keys_of(entry.cell->id()) == entry.pieces)
      kept.push_back(std::move(entry));
    else if (is_cut(entry.cell->id()) || !entry.tips.empty())
      cut_otherwise.push_back(entry.cell);
  entries = std::move(kept);
  entry_of_cell.assign(entry_of_cell.size(), -1);
  for (unsigned int i = 0; i < entries.size(); ++i)
    entry_of_cell[entries[i].cell->active_cell_index()] = i;
  for (const CellIterator &cell : cut_otherwise)
  {
    const auto found = pieces_of_cells.find(cell->id());
    add_entry(cell, found == pieces_of_cells.end() ? std::vector<PieceIndex>() : found->second);
  }
}


template <int dim>
void Discontinuity<dim>::replace(std::vector<CrackPath<dim>> others)
{
  cracks = std::move(others);
  entries.clear();
  entry_of_cell.assign(entry_of_cell.size(), -1);
  renumber();
  if (mesh_view)
  {
    collect_entries();
    renumber();
  }
}


template <int dim>
void Discontinuity<dim>::collect_entries()
{
  for (const auto &cell : mesh_view->dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const auto found = pieces_of_cells.find(cell->id());
      if (found != pieces_of_cells.end())
        add_entry(cell, found->second);
      else if (std::any_of(tips.begin(), tips.end(),
                           [&cell](const CrackTip<dim> &tip) { return reaches(tip, cell); }))
        add_entry(cell, {});
    }
}


template <int dim>
PiecesInCell<dim> Discontinuity<dim>::pieces_in(const std::vector<PieceIndex> &indices) const
{
  PiecesInCell<dim> pieces;
  for (const auto &[crack, index] : indices)
    pieces.push_back(&cracks[crack].pieces[index]);
  return pieces;
}


template <int dim>
std::vector<std::uint64_t> Discontinuity<dim>::keys_of(const dealii::CellId &cell) const
{
  std::vector<std::uint64_t> keys;
  if (const auto found = pieces_of_cells.find(cell); found != pieces_of_cells.end())
    for (const CrackPiece<dim> *piece : pieces_in(found->second))
      keys.push_back(piece->key(domain_size));
  return keys;
}


template <int dim>
void Discontinuity<dim>::add_entry(const CellIterator &cell, const std::vector<PieceIndex> &indices)
{
  const PiecesInCell<dim> pieces = pieces_in(indices);
  const CrackPiece<dim> *const piece = pieces.empty() ? nullptr : pieces.front();
  const unsigned int crack =
    indices.empty() ? dealii::numbers::invalid_unsigned_int : indices.front().first;
  const auto &mapping = mesh_view->mapping;
  const unsigned int degree = cell->get_fe().base_element(0).degree;
  Entry entry;
  entry.cell = cell;
  for (const CrackPiece<dim> *one : pieces)
    entry.pieces.push_back(one->key(domain_size));
  std::optional<Point<dim>> tip_beside; // or in the cell: the nearest point of the unit cell
  for (unsigned int t = 0; t < tips.size(); ++t)
    if (reaches(tips[t], cell))
    {
      entry.tips.push_back(t);
      if (tips[t].point.distance(cell->center()) < cell->diameter())
        if (const auto unit = mapping.transform_real_to_unit_cell(cell, tips[t].point);
            dealii::GeometryInfo<dim>::is_inside_unit_cell(unit, near_tip))
          tip_beside = dealii::GeometryInfo<dim>::project_to_unit_cell(unit);
    }

  if (tip_beside && piece == nullptr)
    entry.geometry =
      make_cut_geometry<dim>(mapping, cell, nullptr, fan_quadrature(*tip_beside, {}, degree + 4));
  else if (const int end = tip_beside ? end_at(*piece, *tip_beside) : -1; end >= 0)
    // Around the piece's own end, which may be moved off a corner by a hair, or be where the crack
    // leaves the cell for the one with the tip.
    entry.geometry = make_cut_geometry<dim>(
      mapping, cell, piece,
      fan_quadrature(piece->unit_ends[end],
                     std::make_pair(piece->unit_ends[1 - end], piece->faces[1 - end]), degree + 4));
  else if (piece != nullptr)
    entry.geometry =
      make_cut_geometry<dim>(mapping, cell, pieces, entry.tips.empty() ? degree : degree + 2);
  else
    entry.geometry =
      make_cut_geometry<dim>(mapping, cell, nullptr, dealii::QGauss<dim>(degree + 3));

  const unsigned int n_points = entry.geometry.points.size();
  const unsigned int n_columns = 2 * dim * entry.tips.size();
  auto &table = entry.tip_columns;
  table.values.resize(n_points * n_columns);
  table.gradients.resize(n_points * n_columns);
  for (unsigned int k = 0; k < entry.tips.size(); ++k)
  {
    const CrackTip<dim> &tip = tips[entry.tips[k]];
    const auto functions = shifted_tip_functions<dim>(tip, mapping, cell, entry.geometry.points,
                                                      degree, tip.crack == crack ? piece : nullptr);
    for (unsigned int mode = 0; mode < 2; ++mode)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int c = table.extra.size();
        table.extra.push_back(tip.extra[mode]);
        table.component.push_back(d);
        for (unsigned int q = 0; q < n_points; ++q)
        {
          table.values[q * n_columns + c] = functions[2 * q + mode].value[d];
          table.gradients[q * n_columns + c] = functions[2 * q + mode].gradient[d];
        }
      }
  }
  entry_of_cell[cell->active_cell_index()] = entries.size();
  entries.push_back(std::move(entry));
}


template <int dim>
void Discontinuity<dim>::find_pieces()
{
  pieces_of_cells.clear();
  for (unsigned int c = 0; c < cracks.size(); ++c)
    for (unsigned int i = 0; i < cracks[c].pieces.size(); ++i)
      pieces_of_cells[cracks[c].pieces[i].cell].emplace_back(c, i);
  // First the crack that the others end on.
  for (auto &[cell, in_cell] : pieces_of_cells)
    for (unsigned int k = 1; k < in_cell.size(); ++k)
    {
      const auto &ends_on = cracks[in_cell.front().first].ends_on;
      const int other = in_cell[k].first;
      if (ends_on[0] == other || ends_on[1] == other)
        std::swap(in_cell.front(), in_cell[k]);
    }
}


template <int dim>
void Discontinuity<dim>::renumber()
{
  find_pieces();
  unknowns.rebuild(cracks, pieces_of_cells, tips, domain_size);
  spans_of_crack.clear();
  for (const CrackPath<dim> &crack : cracks)
    spans_of_crack.push_back(spans_of(crack));

  for (Entry &entry : entries)
  {
    const auto found = pieces_of_cells.find(entry.cell->id());
    if (found == pieces_of_cells.end() && entry.tips.empty())
      continue;
    const std::vector<EnrichedColumn> columns =
      found == pieces_of_cells.end()
        ? std::vector<EnrichedColumn>()
        : unknowns.columns(found->second.front().first, found->second.front().second);
    for (unsigned int c = 0; c < entry.tip_columns.extra.size(); ++c)
      entry.tip_columns.extra[c] = tips[entry.tips[c / (2 * dim)]].extra[c / dim % 2];
    const bool same_set = columns.size() == entry.columns.size() &&
                          std::equal(columns.begin(), columns.end(), entry.columns.begin(),
                                     [](const EnrichedColumn &a, const EnrichedColumn &b) {
                                       return a.corner == b.corner && a.component == b.component &&
                                              a.in_part == b.in_part;
                                     });
    if (same_set && !entry.cut.points.empty())
    {
      for (unsigned int c = 0; c < columns.size(); ++c)
        entry.cut.extra[c] = columns[c].extra;
      std::copy(entry.tip_columns.extra.begin(), entry.tip_columns.extra.end(),
                entry.cut.extra.begin() + columns.size());
    }
    else
      entry.cut = make_cut_cell(entry.geometry, columns, entry.tip_columns);
    entry.columns = columns;
  }
}


template <int dim>
const CrackTip<dim> *Discontinuity<dim>::tip(const unsigned int crack, const CrackEnd end) const
{
  for (const CrackTip<dim> &tip : tips)
    if (tip.crack == crack && tip.end == end)
      return &tip;
  return nullptr;
}


template <int dim>
std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>>
Discontinuity<dim>::mean_jumps(const unsigned int crack, const unsigned int index) const
{
  std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> jumps;
  const CrackPiece<dim> &piece = cracks[crack].pieces[index];
  const JumpShapes<dim> shapes(piece);
  for (const JumpColumn &column : unknowns.jumps(crack, index))
  {
    dealii::Tensor<1, dim> jump;
    jump[column.component] = shapes.mean(column);
    jumps.emplace_back(column.extra, jump);
  }
  for (const CrackTip<dim> &tip : tips)
    if (tip.crack == crack)
      for (unsigned int mode = 0; mode < 2; ++mode)
        if (const auto jump = tip.mean_jump(mode, piece); jump.norm_square() > 0.)
          jumps.emplace_back(tip.extra[mode], jump);
  return jumps;
}


template <int dim>
double Discontinuity<dim>::length(const unsigned int crack, const CrackSpan &span) const
{
  double sum = 0.;
  for (unsigned int i = span.first; i <= span.last; ++i)
    sum += cracks[crack].pieces[i].length();
  return sum;
}


template <int dim>
unsigned int Discontinuity<dim>::longest_piece(const unsigned int crack,
                                               const CrackSpan &span) const
{
  const auto &pieces = cracks[crack].pieces;
  unsigned int longest = span.first;
  for (unsigned int i = span.first + 1; i <= span.last; ++i)
    if (pieces[i].length() > pieces[longest].length())
      longest = i;
  return longest;
}


template <int dim>
std::uint64_t Discontinuity<dim>::segment_key(const unsigned int crack,
                                              const unsigned int piece) const
{
  const auto &spans = spans_of_crack[crack];
  const auto span =
    std::upper_bound(spans.begin(), spans.end(), piece,
                     [](const unsigned int p, const CrackSpan &s) { return p < s.first; });
  return key(crack, *(span - 1));
}


template <int dim>
std::vector<typename Discontinuity<dim>::OwnedPiece> Discontinuity<dim>::owned_pieces() const
{
  std::vector<OwnedPiece> owned;
  for (const Entry &entry : entries)
    if (const auto found = pieces_of_cells.find(entry.cell->id()); found != pieces_of_cells.end())
      for (const auto &[crack, index] : found->second)
        owned.push_back({crack, index, entry.cell});
  std::sort(owned.begin(), owned.end(),
            [](const OwnedPiece &a, const OwnedPiece &b)
            { return std::make_pair(a.crack, a.piece) < std::make_pair(b.crack, b.piece); });
  return owned;
}


template <int dim>
std::vector<std::pair<std::uint64_t, std::uint64_t>> Discontinuity<dim>::segments_that_meet() const
{
  std::map<dealii::CellId, std::vector<std::uint64_t>> at_junction;
  for (unsigned int c = 0; c < cracks.size(); ++c)
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
      if (cracks[c].ends_on[static_cast<int>(end)] >= 0)
      {
        const dealii::CellId &cell = cracks[c].piece_at(end).cell;
        auto &keys = at_junction[cell];
        if (const auto [passing, index] = pieces_of_cells.at(cell).front(); keys.empty())
          keys.push_back(segment_key(passing, index));
        keys.push_back(key(c, span_at(c, end)));
      }
  std::vector<std::pair<std::uint64_t, std::uint64_t>> pairs;
  for (const auto &[cell, keys] : at_junction)
    for (unsigned int i = 0; i < keys.size(); ++i)
      for (unsigned int j = i + 1; j < keys.size(); ++j)
        pairs.emplace_back(keys[i], keys[j]);
  return pairs;
}


template <int dim>
std::vector<Segment<dim>> Discontinuity<dim>::segments(
  const std::function<double(const Point<dim> &)> &in_situ_pore_pressure) const
{
  const auto meeting = segments_that_meet();
  std::vector<Segment<dim>> all;
  std::vector<dealii::types::global_dof_index> dofs;
  for (const OwnedPiece &owned : owned_pieces())
  {
    const auto &spans = spans_of_crack[owned.crack];
    const auto &pieces = cracks[owned.crack].pieces;
    const CrackPiece<dim> &piece = pieces[owned.piece];
    const std::uint64_t own_key = segment_key(owned.crack, owned.piece);
    if (own_key != piece.key(domain_size))
      continue; // another piece stands for the span
    const unsigned int k =
      std::find_if(spans.begin(), spans.end(),
                   [&owned](const CrackSpan &s) { return owned.piece <= s.last; }) -
      spans.begin();
    const CrackSpan &span = spans[k];

    Segment<dim> segment;
    segment.key = own_key;
    segment.region = piece.region;
    const Point<dim> &from = pieces[span.first].ends[0];
    segment.centre = from + 0.5 * (pieces[span.last].ends[1] - from);
    segment.area = length(owned.crack, span);
    segment.at_tip = (k == 0 && cracks[owned.crack].is_tip[0]) ||
                     (k + 1 == spans.size() && cracks[owned.crack].is_tip[1]);
    if (k > 0)
      segment.neighbours.push_back({key(owned.crack, spans[k - 1]), 0.5 * segment.area, 1.});
    if (k + 1 < spans.size())
      segment.neighbours.push_back({key(owned.crack, spans[k + 1]), 0.5 * segment.area, 1.});

    // As if all that meet at a junction ended there, each beside each: what crosses another crack
    // does not have to pass between the faces of that.
    for (const auto &[one, other] : meeting)
      if (segment.key == one || segment.key == other)
        segment.neighbours.push_back({segment.key == one ? other : one, 0.5 * segment.area, 1.});

    std::map<unsigned int, double> opening; // an unknown may open several pieces
    for (unsigned int i = span.first; i <= span.last; ++i)
    {
      const double share = pieces[i].length() / segment.area;
      const auto normal = pieces[i].normal();
      segment.normal += share * normal;
      for (const auto &[extra, jump] : mean_jumps(owned.crack, i))
        opening[extra] += share * (jump * normal);
    }
    segment.normal /= segment.normal.norm();
    for (const auto &[extra, coefficient] : opening)
    {
      segment.opening.extra.push_back(extra);
      segment.opening.extra_coefficients.push_back(coefficient);
    }

    segment.pore_pressure.constant = in_situ_pore_pressure(segment.centre);
    if (mesh_view->has_pore_pressure)
    {
      const auto &fe = owned.cell->get_fe();
      dofs.resize(fe.n_dofs_per_cell());
      owned.cell->get_dof_indices(dofs);
      const Point<dim> middle =
        piece.unit_ends[0] + 0.5 * (piece.unit_ends[1] - piece.unit_ends[0]);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (fe.system_to_component_index(i).first == dim)
        {
          const double share = fe.shape_value(i, middle);
          const Point<dim> &node = piece.corners[fe.system_to_component_index(i).second];
          segment.pore_pressure.bulk.push_back(dofs[i]);
          segment.pore_pressure.bulk_coefficients.push_back(share);
          segment.pore_distance += share * std::abs((node - piece.centre()) * piece.normal());
        }
    }
    all.push_back(std::move(segment));
  }
  return all;
}

template class Discontinuity<2>;
} // namespace stockwork
