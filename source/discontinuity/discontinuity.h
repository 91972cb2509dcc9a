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
    joined_crack,     ///< has grown up to another crack, and ends on it
    reached_crack,    ///< the next cell is cut already, and cannot be joined
    waits,            ///< a tip in its way is about to grow as well: once more when it has
    needs_mesh        ///< a cell ahead has another size: the mesh must be refined first
  };

  /// The crack that another ends on, and the unit normal out of it on the side where that is not:
  /// what the one would have to cross. Nothing if something is there already.
  struct FarSide
  {
    unsigned int crack;
    unsigned int piece; ///< of it, where the one ends
    dealii::Tensor<1, dim> normal;
  };
  std::optional<FarSide> far_side(const unsigned int crack, const CrackEnd end) const;

  /// A crack begins where another ends on a third one, on the other side of that, and goes on by a
  /// span, or there is none. The outcome is the same on every rank.
  Outcome cross(const unsigned int crack,
                const CrackEnd end,
                const dealii::Tensor<1, dim> &direction,
                const Collectives &collectives);

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
    if (const auto found = pieces_of_cells.find(cell); found != pieces_of_cells.end())
      for (const auto &[c, i] : found->second)
        if (c == crack)
          return &cracks[c].pieces[i];
    return nullptr;
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
    return pieces_of_cells.count(cell) != 0;
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
    std::vector<std::uint64_t> pieces; ///< keys of those that `geometry` was made for
    CutGeometry<dim> geometry;
    std::vector<unsigned int> tips; ///< whose functions reach into the cell
    TabulatedColumns<dim> tip_columns;
    std::vector<EnrichedColumn> columns; ///< those that `cut` was made for
    CutCell<dim> cut;
  };

  /// Keys of the segments that are neighbours because cracks end on others, in pairs.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> segments_that_meet() const;

  unsigned int longest_piece(const unsigned int crack, const CrackSpan &span) const;

  std::vector<Outcome> grow_by_a_cell(const std::vector<Advance> &advances,
                                      const Collectives &collectives);

  /// Bring `pieces_of_cells` up to date.
  void find_pieces();

  /// Number the unknowns and bring `pieces_of_cells` and the columns of the cut cells up to date.
  void renumber();

  /// The pieces in a cell, of a list of them.
  PiecesInCell<dim> pieces_in(const std::vector<PieceIndex> &indices) const;

  /// What tells the pieces in a cell from others.
  std::vector<std::uint64_t> keys_of(const dealii::CellId &cell) const;

  /// Drop what belongs to cells that are not cut any more, or otherwise, and make what is missing
  /// in cells that had been cut. Numbering has to follow.
  void update_entries();

  /// Join the cracks of the case that end on others. The entry of one that crosses another, or
  /// shares cells with it otherwise, is refused.
  /// @param may_join none may if their tips have functions of their own
  void join_initial_cracks(const std::vector<InitialCrack<dim>> &given,
                           bool may_join,
                           const Collectives &collectives);

  /// Whether a crack through a cell is half a span there, and may go on or be taken back.
  bool is_underway(const dealii::CellId &cell) const;

  /// Whether cracks let another one that advances into their cell end on the one that passes
  /// through it.
  bool can_join(const Advance &advance, const dealii::CellId &cell) const;

  /// The piece by which a crack that advances into a cut cell ends on the crack that passes through
  /// it, and the share of the other piece at which it does. Nothing if it cannot.
  std::optional<std::pair<CrackPiece<dim>, double>>
  join(const Advance &advance, const dealii::CellId &cell, const unsigned int face) const;

  /// Whether a crack may have a piece in the cell of one that it has left a cell or more before.
  bool may_pass_beside(const Advance &advance, const CrackPiece<dim> &piece) const;

  /// Cells that are cut anew or otherwise, each with the rank that owns it.
  void take_new_cells(const std::vector<std::pair<unsigned int, dealii::CellId>> &new_cells,
                      const Collectives &collectives);

  void add_entry(const CellIterator &cell, const std::vector<PieceIndex> &pieces);

  void collect_entries();

  double domain_size;
  std::unique_ptr<MeshView<dim>> mesh_view;
  std::vector<CrackPath<dim>> cracks;
  std::vector<std::vector<CrackSpan>> spans_of_crack;
  std::vector<CrackTip<dim>> tips;
  Enrichment<dim> unknowns;
  PiecesOfCells pieces_of_cells;
  std::vector<Entry> entries;
  std::vector<int> entry_of_cell; ///< by active cell index
};
} // namespace stockwork
