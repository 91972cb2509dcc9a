#pragma once

#include "fracture/damage/crack_cell.h"
#include "stockwork/exchange/cell_role.h"
#include "stockwork/exchange/extra_unknown.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/segment.h"
#include "stockwork/mesh/mesh_view.h"

#include <deal.II/fe/fe_values.h>

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace stockwork::damage
{
/// A motion of one side of a crack against the other as a rigid body: base + turn (x - middle), the
/// matrix antisymmetric, so that it strains nothing.
template <int dim>
struct Motion
{
  dealii::Tensor<1, dim> base;
  dealii::Tensor<2, dim> turn;

  dealii::Tensor<1, dim> at(const dealii::Tensor<1, dim> &place) const
  {
    return base + turn * place;
  }
};

/// All cracked cells, and what they are on the mesh: the extra functions of the bulk, and the
/// segments of the fluid. The list is the same on every rank, in the order in which cells have
/// cracked, and so are the unknowns.
template <int dim>
class Band
{
public:
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;

  static constexpr unsigned int n_faces = dealii::GeometryInfo<dim>::faces_per_cell;
  static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

  std::vector<CrackCell<dim>> cells;

  /// Number of the cracked cell beyond a face, where the crack of one of the two passes it.
  unsigned int neighbour(const unsigned int i, const unsigned int face) const
  {
    return links[i][face];
  }

  /// Whether the crack of a cell runs into a whole one.
  bool is_front(unsigned int i) const;

  /// The mesh is new.
  void setup(const MeshView<dim> &mesh_view);

  /// More cells are cracked.
  void add(const std::vector<CrackCell<dim>> &more);

  /// Another list in place of this one.
  void replace(const std::vector<CrackCell<dim>> &others);

  /// The cells that a crack of the scene passes, of those that this rank owns.
  std::vector<CrackCell<dim>> passed(const InitialCrack<dim> &crack) const;

  std::vector<ExtraUnknown> unknowns() const;

  /// @param linear whether a jump may change in its cell
  explicit Band(const bool linear)
    : linear(linear)
  {
  }

  /// What the unknowns of a cell do to its plus side against the minus side: the mean jump and,
  /// where it is linear, how the opening changes along each of CrackCell::axes() over the cell's
  /// size: all [m]. A single vertex on one side of the crack does not know how this side turns.
  const std::vector<Motion<dim>> &motions(const unsigned int i) const
  {
    return all_motions[i];
  }

  unsigned int first_unknown(const unsigned int i) const
  {
    return first_unknowns[i];
  }

  /// The mean over the cell [m].
  dealii::Tensor<1, dim> jump(const unsigned int i, const std::vector<double> &extra) const
  {
    dealii::Tensor<1, dim> a;
    for (unsigned int d = 0; d < dim; ++d)
      a[d] = extra[first_unknown(i) + d];
    return a;
  }

  /// At each of CrackCell::points() [m].
  std::array<dealii::Tensor<1, dim>, CrackCell<dim>::n_points>
  jumps(const unsigned int i, const std::vector<double> &extra) const;

  /// Null: the cell is whole, or another rank's.
  const CutCell<dim> *cut_cell(const unsigned int active_cell_index) const
  {
    const auto found = cuts.find(active_cell_index);
    return found == cuts.end() ? nullptr : &found->second;
  }

  bool is_cracked(const unsigned int active_cell_index) const
  {
    return by_index.count(active_cell_index) != 0;
  }

  /// Number in `cells` of a cell that this rank owns or has as a ghost.
  std::optional<unsigned int> number(const CellIterator &cell) const
  {
    const auto found = by_index.find(cell->active_cell_index());
    return found == by_index.end() ? std::nullopt : std::make_optional(found->second);
  }

  struct Owned
  {
    unsigned int number;
    CellIterator cell;
  };

  /// In the order of `cells`.
  const std::vector<Owned> &owned() const
  {
    return owned_cells;
  }

  std::vector<Segment<dim>>
  segments(const std::function<double(const dealii::Point<dim> &)> &in_situ_pore_pressure) const;

private:
  /// The active cell, unless this rank neither owns it nor has it as a ghost.
  std::optional<CellIterator> find(const dealii::CellId &id) const;

  /// Find the cells from a number on on the mesh.
  void embed(unsigned int first);

  /// Of a new cell.
  void link_neighbours(unsigned int i);
  std::vector<Motion<dim>> motions_of(unsigned int i) const;

  void make_cut(unsigned int i, const CellIterator &cell, dealii::FEValues<dim> &values);

  void add_neighbours(unsigned int i, Segment<dim> &segment) const;

  void add_pore_pressure(const Owned &owned, Segment<dim> &segment) const;

  const bool linear;
  std::unique_ptr<MeshView<dim>> mesh_view;
  std::vector<std::vector<Motion<dim>>> all_motions;       ///< of each cell
  std::vector<unsigned int> first_unknowns{0};             ///< of each cell, and their number
  std::unordered_map<unsigned int, CutCell<dim>> cuts;     ///< by active cell index
  std::unordered_map<unsigned int, unsigned int> by_index; ///< active cell index to number
  std::vector<Owned> owned_cells;
  std::vector<std::array<unsigned int, n_faces>> links;
  /// By place: a cracked cell that has the face, and the face's number in it.
  std::unordered_map<std::uint64_t, std::pair<unsigned int, unsigned int>> faces;
};

/// The cell, with the crack's plane given, but not yet parted.
template <int dim, class CellAccessor>
CrackCell<dim> describe(const CellAccessor &cell)
{
  CrackCell<dim> result;
  result.id = cell->id();
  result.region = cell->material_id();
  for (const unsigned int f : cell->face_indices())
    if (cell->at_boundary(f))
      result.boundary |= 1u << f;
  for (unsigned int v = 0; v < CrackCell<dim>::n_vertices; ++v)
    result.vertices[v] = cell->vertex(v);
  return result;
}
} // namespace stockwork::damage
