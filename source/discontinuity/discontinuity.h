#pragma once

#include <deal.II/base/array_view.h>

#include "discontinuity/crack_path.h"
#include "discontinuity/cut_cell.h"
#include "discontinuity/enrichment.h"
#include "discontinuity/tip_functions.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/segment.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace stockwork
{
/// The cracks of a body, their unknowns and the cells they cut, kept in step with one another.
///
/// Paths and numbering are held by every rank; cut cells by the owner of the cell.
template <int dim>
class Discontinuity
{
public:
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;

  /// @param domain_size diameter of the domain [m], for tolerances
  explicit Discontinuity(const double domain_size);

  /// The mesh is new. Existing cracks keep their cells.
  /// @throws SolveError if a cut cell is not in the mesh any more
  void setup(const MeshView<dim> &mesh_view, const Collectives &collectives);

  /// Replace all cracks by those of the case. After setup().
  /// @param rock_of_region given: the tips lie exactly where the polylines end and have functions
  /// of their own, those of the rock there, and the cracks must not grow. Empty: cracks of whole
  /// cells.
  /// @throws EntryError if the mesh cannot hold a crack
  void
  cut(const std::vector<InitialCrack<dim>> &given,
      const Collectives &collectives,
      const std::function<LinearStiffness<dim>(dealii::types::material_id)> &rock_of_region = {});

  /// Put back cracks that were taken from paths() on this mesh.
  void restore(std::vector<CrackPath<dim>> earlier);

  /// Take over cracks from a restart file, before or after setup().
  void replace(std::vector<CrackPath<dim>> others);

  const std::vector<CrackPath<dim>> &paths() const
  {
    return cracks;
  }

  /// The spans of a crack in their order.
  const std::vector<CrackSpan> &spans(const unsigned int crack) const
  {
    return spans_of_crack[crack];
  }

  /// The span at an end of a crack.
  const CrackSpan &span_at(const unsigned int crack, const CrackEnd end) const
  {
    return end == CrackEnd::first ? spans_of_crack[crack].front() : spans_of_crack[crack].back();
  }

  /// Length of a span [m].
  double length(const unsigned int crack, const CrackSpan &span) const;

  /// Key of the segment that a span is to the fluid: that of its longest piece.
  std::uint64_t key(const unsigned int crack, const CrackSpan &span) const
  {
    return cracks[crack].pieces[longest_piece(crack, span)].key(domain_size);
  }

  /// Key of the segment that a piece belongs to.
  std::uint64_t segment_key(const unsigned int crack, const unsigned int piece) const;

  /// A crack that shall go on by one span.
  struct Advance
  {
    unsigned int crack;
    CrackEnd end;
    dealii::Tensor<1, dim> direction;
  };

  enum class Outcome : unsigned char
  {
    grown,
    reached_boundary, ///< has grown, and its tip has become a mouth on the domain's boundary
    reached_crack,    ///< the next cell is cut already
    needs_mesh        ///< a cell ahead has another size: the mesh must be refined first
  };

  /// Let cracks grow, all at once, each by a span or not at all; the same outcomes, in the given
  /// order, on every rank.
  std::vector<Outcome> grow(const std::vector<Advance> &advances, const Collectives &collectives);

  /// A tip does not grow any more.
  void stop(const unsigned int crack, const CrackEnd end)
  {
    cracks[crack].is_tip[static_cast<int>(end)] = false;
  }

  const Enrichment<dim> &enrichment() const
  {
    return unknowns;
  }

  /// A tip that has functions of its own, or null.
  const CrackTip<dim> *tip(const unsigned int crack, const CrackEnd end) const;

  /// The piece that cuts a cell, if it belongs to the crack; else null.
  const CrackPiece<dim> *piece_in(const dealii::CellId &cell, const unsigned int crack) const
  {
    const auto found = piece_of_cell.find(cell);
    return found != piece_of_cell.end() && found->second.first == crack
             ? &cracks[crack].pieces[found->second.second]
             : nullptr;
  }

  /// What opens a piece: unknowns, and the mean along the piece of the jump that one of each makes.
  std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>>
  mean_jumps(const unsigned int crack, const unsigned int piece) const;

  /// The cell with this active cell index as the bulk sees it, if this rank owns it and a crack
  /// cuts it or functions of a tip reach into it.
  const CutCell<dim> *cut_cell(const unsigned int active_cell_index) const
  {
    return active_cell_index < entry_of_cell.size() && entry_of_cell[active_cell_index] >= 0
             ? &entries[entry_of_cell[active_cell_index]].cut
             : nullptr;
  }

  bool is_cut(const dealii::CellId &cell) const
  {
    return piece_of_cell.count(cell) != 0;
  }

  /// A piece whose cell this rank owns.
  struct OwnedPiece
  {
    unsigned int crack;
    unsigned int piece;
    CellIterator cell;
  };

  std::vector<OwnedPiece> owned_pieces() const;

  /// The spans whose longest piece is this rank's as segments: geometry, neighbours, opening and
  /// pore pressure. The function gives the in-situ pore pressure.
  std::vector<Segment<dim>>
  segments(const std::function<double(const dealii::Point<dim> &)> &in_situ_pore_pressure) const;

private:
  /// A cut cell of this rank.
  struct Entry
  {
    CellIterator cell;
    CutGeometry<dim> geometry;
    std::vector<unsigned int> tips; ///< whose functions reach into the cell
    TabulatedColumns<dim> tip_columns;
    std::vector<EnrichedColumn> columns; ///< those that `cut` was made for
    CutCell<dim> cut;
  };

  unsigned int longest_piece(const unsigned int crack, const CrackSpan &span) const;

  std::vector<Outcome> grow_by_a_cell(const std::vector<Advance> &advances,
                                      const Collectives &collectives);

  /// Number the unknowns and bring `piece_of_cell` and the columns of the cut cells up to date.
  void renumber();

  void add_entry(const CellIterator &cell,
                 const CrackPiece<dim> *piece,
                 const unsigned int crack = dealii::numbers::invalid_unsigned_int);

  void collect_entries();

  double domain_size;
  std::unique_ptr<MeshView<dim>> mesh_view;
  std::vector<CrackPath<dim>> cracks;
  std::vector<std::vector<CrackSpan>> spans_of_crack;
  std::vector<CrackTip<dim>> tips;
  Enrichment<dim> unknowns;
  std::map<dealii::CellId, std::pair<unsigned, unsigned>> piece_of_cell; ///< crack, piece
  std::vector<Entry> entries;
  std::vector<int> entry_of_cell; ///< by active cell index
};
} // namespace stockwork
