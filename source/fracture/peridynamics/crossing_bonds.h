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
  bool cohesive = false; ///< crosses a cohesive crack of the deck, whatever else it crosses
  double share = 1.;     ///< energy that it takes, over that in rock
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

  /// A bond that crosses a path, or whose image in the domain does; else null.
  const BondAcross<dim> *find(unsigned int site, unsigned int bond) const;

  /// Where it does.
  std::optional<TrackedPaths::Crossing> crossing(unsigned int site, unsigned int bond) const
  {
    const BondAcross<dim> *const across = find(site, bond);
    return across ? std::optional(across->crossing) : std::nullopt;
  }

private:
  const Lattice<dim> &lattice;
  std::vector<BondAcross<dim>> bonds;
  std::optional<TrackedPaths> followed; ///< those that `bonds` cross
};
} // namespace stockwork::peridynamics
