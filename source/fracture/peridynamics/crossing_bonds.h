#pragma once

#include "fracture/peridynamics/lattice.h"
#include "fracture/peridynamics/tracked_paths.h"

#include <optional>
#include <vector>

namespace stockwork::peridynamics
{
/// A bond that leads from one face of a fracture to the other, as seen from one of its ends.
template <int dim>
struct BondAcross
{
  BondView view;
  dealii::Tensor<1, dim> direction; ///< of the bond, or of its image that crosses the path
  TrackedPaths::Crossing crossing;  ///< where it crosses a path
  bool was_cut = false;             ///< by an open crack of the deck, and crosses another or a way
};


/// `Tracking = path`: the bonds that cross paths, sorted by view. In two dimensions; in three there
/// are none.
template <int dim>
class CrossingBonds
{
public:
  explicit CrossingBonds(const Lattice<dim> &lattice);

  /// The lattice has other sites.
  void forget();

  /// Find them, if paths run otherwise than before. @return whether they do
  bool follow(const TrackedPaths &paths);

  auto begin() const
  {
    return bonds.begin();
  }
  auto end() const
  {
    return bonds.end();
  }
  const std::vector<BondAcross<dim>> &all() const
  {
    return bonds;
  }

  /// Where a bond, or its image in the domain, crosses a path.
  std::optional<TrackedPaths::Crossing> crossing(unsigned int site, unsigned int bond) const;

private:
  const Lattice<dim> &lattice;
  std::vector<BondAcross<dim>> bonds;
  std::optional<TrackedPaths> followed; ///< those that `bonds` cross
};
} // namespace stockwork::peridynamics
