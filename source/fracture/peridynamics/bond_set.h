#pragma once

#include "fracture/peridynamics/bond_law.h"
#include "fracture/peridynamics/broken_bonds.h"
#include "fracture/peridynamics/zone.h"

#include <optional>
#include <utility>
#include <vector>

namespace stockwork::peridynamics
{
/// A bond, by the places of its ends; the second may lie beyond a plane of symmetry.
template <int dim>
using BondPlaces = std::pair<Place<dim>, Place<dim>>;

/// A site and its bond: a bond as one of its ends sees it, see BondSet::for_each_view().
using BondView = std::pair<unsigned int, unsigned int>;

/// Which bonds of the lattice are broken. A bond is seen from each of its ends that has bonds, and
/// from both sides of a plane of symmetry; breaking it breaks all of these.
template <int dim>
class BondSet
{
public:
  /// All whole. @p zone must not change meanwhile.
  void reinit(const Zone<dim> &zone, const std::vector<StencilBond<dim>> &stencil);

  unsigned int n_bonds() const
  {
    return stencil.size();
  }

  const std::vector<StencilBond<dim>> &bonds() const
  {
    return stencil;
  }

  /// Index of the bond with this offset; invalid if the stencil has none.
  unsigned int bond(const Place<dim> &offset) const;

  /// Of a site that has bonds.
  bool is_broken(const unsigned int site, const unsigned int bond) const
  {
    return broken(number[site], bond);
  }

  bool can_break(const unsigned int site, const unsigned int bond) const
  {
    const FarEnd end = zone->far_end(site, bond);
    return !end.absent && zone->sites()[end.site].peridynamic;
  }

  /// Call `use(site, bond)` for the bond as it is seen from all its ends.
  template <class Function>
  void for_each_view(unsigned int site, unsigned int bond, const Function &use) const;

  /// The views of a bond, each once, sorted.
  std::vector<BondView> views_of(unsigned int site, unsigned int bond) const;

  void set_broken(unsigned int site, unsigned int bond);

  unsigned int n_broken(unsigned int site) const;

  /// Call `use(bond)` for each broken bond of a peridynamic site.
  template <class Function>
  void for_each_broken(const unsigned int site, const Function &use) const
  {
    broken.for_each(number[site], use);
  }

  /// Those that have a broken bond, in any order.
  std::vector<unsigned int> damaged_sites() const;

  /// Share of a site's bonds that is broken, by volume.
  double damage(unsigned int site) const;

  /// All broken bonds, each at least once, sorted.
  std::vector<BondPlaces<dim>> places() const;

  /// The ends of a bond of a site that has bonds.
  BondPlaces<dim> places(unsigned int site, unsigned int bond) const;

  /// Site and bond, as one of the ends that has bonds sees it; nothing of a bond that is not known.
  std::optional<BondView> find(const BondPlaces<dim> &places) const;

  /// Break bonds by the places of their ends; those that are not known are ignored.
  void set_broken(const std::vector<BondPlaces<dim>> &places);

private:
  /// The bond with direction d, or all in `mirrored`, reversed.
  unsigned int reflected(unsigned int bond, unsigned int mirrored) const;

  const Zone<dim> *zone = nullptr;
  std::vector<StencilBond<dim>> stencil;
  std::map<Place<dim>, unsigned int> index_of_offset;
  std::vector<unsigned int> number; ///< of each site among the peridynamic ones
  BrokenBonds broken;               ///< by that number
};


template <int dim>
template <class Function>
void BondSet<dim>::for_each_view(const unsigned int site,
                                 const unsigned int bond,
                                 const Function &use) const
{
  const FarEnd far = zone->far_end(site, bond);
  const Site<dim> &here = zone->sites()[site], &there = zone->sites()[far.site];
  use(site, bond);
  if (!there.peridynamic)
    return;
  const unsigned int back = reflected(opposite(bond, stencil.size()), far.mirrored);
  if (there.has_bonds)
    use(far.site, back);
  // The images of bonds of sites on planes of symmetry are bonds of these sites as well.
  for (unsigned int m = 1; m < 1u << dim; ++m)
  {
    if ((zone->planes_of(here.place) & m) == m)
      use(site, reflected(bond, m));
    if (there.has_bonds && (zone->planes_of(there.place) & m) == m)
      use(far.site, reflected(back, m));
  }
}
} // namespace stockwork::peridynamics
